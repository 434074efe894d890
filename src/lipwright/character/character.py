"""Characters: a model, and how a set's controls move it.

A user's model is calibrated once, when it is first asked for (:mod:`.calibration`).
``head`` and ``crab`` are built in and made by the package's own code; anything else is a path to a
GLB, VRM or glTF file, or to a character file that names one. What a character file maps,
and before it a mapping file that a user gives, goes before what is known of the model's
vocabulary.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from lipwright.animation import Animation
from lipwright.character.between import with_betweens
from lipwright.character.character_file import OWN_PLACES, CharacterFile, Versions
from lipwright.character.character_reading import is_character_file, read_character_file
from lipwright.character.mapping import JointChannel, Mapping, merged, read_mapping
from lipwright.errors import CharacterError, InputError, did_you_mean
from lipwright.files import Kept, file_version, write_atomically
from lipwright.performance import RiggedModel
from lipwright.speech import Speech

if TYPE_CHECKING:
    from lipwright.character.calibration import Calibration
    from lipwright.character.fitting import Fitting
    from lipwright.character.rig import Rig
    from lipwright.gltf import Gltf


@dataclass(frozen=True, slots=True, eq=False)
class Character:
    """A model, and how a set's controls move it.

    Parameters
    ----------
    name : str
        ``"head"``, the character file's name for it, or the model file's name without
        its suffix.
    model : function
        Returns the model; for a built-in character it is made when first asked for.
    mapping : Mapping, optional
        What goes before the vocabulary's mapping: the character file's and the user's own.
    mapping_name : str
        The mapping's file, in errors.
    model_name : str
        The model's path, or the built-in character's name.
    bigram_set : str
        The set that it was drawn for, a name or a path; nothing where any will do.
    file : CharacterFile, optional
        The character file.
    mappings : tuple of (Mapping, str)
        What ``mapping`` was put together from, the first beneath, each with its place.
    files : tuple of (str, Version)
        All files that were read.
    calibrated : bool
        Whether gains are found from the mesh; a built-in one is made to measure.
    """

    name: str
    model: Callable[[], Gltf]
    mapping: Mapping | None = None
    mapping_name: str = "mapping"
    model_name: str = ""
    bigram_set: str = ""
    file: CharacterFile | None = None
    mappings: tuple[tuple[Mapping, str], ...] = ()
    files: Versions = ()
    calibrated: bool = True
    _rig: list[Rig] = field(default_factory=list, repr=False)
    _found: list[tuple[Fitting, Calibration]] = field(default_factory=list, repr=False)

    @property
    def fits(self) -> bool:
        """Whether it is a built-in character as it comes, which needs no checking."""
        return self.model_name in BUILT_IN and self.mapping is None

    def report(self) -> dict[str, Any]:
        """Return what an animation's report says of it, as JSON values."""
        if self.file is None:
            return {"name": self.name}
        path = Path(self.file.path).as_posix()
        return {"name": self.name, "file": path, "digest": self.file.digest}

    def notes(self, controls: Sequence[str], speech: Speech) -> list[str]:
        """Return what the user should know of this character, a set's controls and a line."""
        if self.file is None:
            return []
        own = [one for one, place in self.mappings if place.endswith(OWN_PLACES)]
        named = dict.fromkeys(name for one in own for name in (*one.controls, *one.gains))
        notes = []
        for name in named:
            if name not in controls:
                guess = did_you_mean(name, controls)
                text = f"{self.file.path} maps {name!r}, which the set has not"
                notes.append(f"{text}; {guess}" if guess else text)
        too_fast = self.file.too_fast(speech)
        return [*notes, too_fast] if too_fast else notes

    def read_rig(self) -> Rig:
        """Return what the model has that can move a mouth."""
        from lipwright.character.rig import read_rig

        if not self._rig:
            self._rig.append(read_rig(self.model()))
        return self._rig[0]

    def fit(self) -> Fitting:
        """Return how each control is made on this model, calibrated."""
        return self._fitted()[0]

    def calibration(self) -> Calibration:
        """Return what was found of the mouth on the mesh, and how it made the gains."""
        return self._fitted()[1]

    def _fitted(self) -> tuple[Fitting, Calibration]:
        from lipwright.character.calibration import Calibration, calibrate

        if not self._found:
            found = self._plain()
            if self.calibrated:
                self._found.append(calibrate(self.read_rig(), found))
            else:
                self._found.append((found, Calibration(reason="it is made to measure")))
        return self._found[0]

    def _plain(self) -> Fitting:
        """Return how each control is made, before calibration."""
        from lipwright.character.fitting import fit  # Only who shows a model pays for it.

        return fit(self.read_rig(), self.mapping, self.mapping_name)

    def check(self, controls: Sequence[str]) -> None:
        """Refuse early what :meth:`rig` would refuse.

        Raises
        ------
        CharacterError
            If none of the controls moves anything on this model.
        """
        still = np.zeros((1, len(controls)), np.float32)
        self._drive(Animation(tuple(controls), still, 1.0), self._plain())

    def strange_to(self, controls: Sequence[str]) -> str:
        """Return what to say of a set that was not drawn for this model; nothing if it was."""
        fitting = self._plain()
        known = [one for one in controls if one in fitting.controls or fitting.weights_of(one)]
        if 2 * len(known) >= len(controls):
            return ""
        text = f"{self.name} knows {len(known)} of the set's {len(controls)} poses"
        return f"{text} ({', '.join(known)}): the others are not seen; choose another --set"

    def rig(self, animation: Animation) -> RiggedModel:
        """Return the model with its morph targets' values over time.

        Parameters
        ----------
        animation : Animation
            Of a set's controls, or of the model's own morph targets.

        Raises
        ------
        CharacterError
            If none of the controls moves anything on this model.
        """
        fitting = self.fit()
        channels, joints = self._drive(animation, fitting), fitting.joints
        driven = {name: joints[name] for name in channels.controls if name in joints}
        return RiggedModel(self.name, self.model().to_glb(), channels, driven)

    def channels(self, animation: Animation) -> Animation:
        """Return the rig's channels over time: :meth:`rig` without the model.

        Raises
        ------
        CharacterError
            If none of the controls moves anything on this model.
        """
        return self._drive(animation, self.fit())

    def _drive(self, animation: Animation, fitting: Fitting) -> Animation:
        try:
            driven = fitting.drive(animation)
        except CharacterError as error:
            raise error.at(self.model().where) from None
        return with_betweens(driven, self.read_rig().all_targets)

    def picture(self) -> str:
        """Return a drawing (SVG) of the mouth and of the vertices that were taken for it.

        Raises
        ------
        CharacterError
            If no mouth was found on the mesh.
        """
        from lipwright.character.calibration import calibrate
        from lipwright.character.picture import mouth_picture  # Few ever draw it.

        found = self.calibration()
        if found.mouth is None and not self.calibrated:
            found = calibrate(self.read_rig(), self.fit())[1]
        return mouth_picture(self.name, self.fit(), found)

    def write_mapping(self, path: str | Path) -> None:
        """Write how each control is made, in the model's own names, as a file to edit."""
        write_atomically(path, self.fit().to_mapping(self.name).to_bytes())


def load_character(spec: str | Path, mapping: str | Path | None = None) -> Character:
    """Return a character.

    Parameters
    ----------
    spec : str or Path
        ``"head"``, or the path of a character file (``.json``) or of a GLB, VRM or glTF
        file.
    mapping : str or Path, optional
        A mapping file of the user's; it goes before the character's own.

    Returns
    -------
    Character
        Checked: the model can be read and has morph targets, the mapping fits it.

    Raises
    ------
    InputError
        If a file cannot be read.
    FileFormatError
        If a file breaks its format.
    CharacterError
        If the model cannot move a mouth, or the mapping names what the model has not.
    """
    file = file_of(spec)
    source, where = file.model if file else (str(spec), "")
    name, model, files = _model(source, where)
    mappings = _mappings(file, mapping)
    character = Character(
        file.name if file else name,
        model,
        merged([one for one, _ in mappings], name) if mappings else None,
        mappings[-1][1] if mappings else "",
        source,
        set_of(file, name),
        file,
        mappings,
        (*(file.files if file else ()), *files, *_version(mapping)),
        calibrated=source not in BUILT_IN,
    )
    if mappings or source not in BUILT_IN:
        from lipwright.character.fitting import fit

        rig = character.read_rig()
        joints: dict[str, JointChannel] = {}
        for one, place in mappings:  # each by itself, so that an error names its own place
            fit(rig, replace(one, joints={**joints, **one.joints}), place)
            joints |= one.joints
    return character


_kept: Kept[Character] = Kept(8)


def keep_character(spec: str | Path, mapping: str | Path | None = None) -> Character:
    """Return a character; it is loaded once, and anew when a file of it changes."""
    spelled = tuple(str(path) if path else "" for path in (spec, mapping))
    key = (spelled, tuple(map(os.path.abspath, spelled)))
    return _kept.get(key, lambda: load_character(spec, mapping))


def file_of(spec: str | Path) -> CharacterFile | None:
    """Return a character's file with its bases; None for a model or a built-in character."""
    if str(spec) in BUILT_IN or not is_character_file(spec):
        return None
    return read_character_file(spec, BUILT_IN)


def set_of(file: CharacterFile | None, name: str) -> str:
    """Return the set that a character was drawn for; nothing where any will do."""
    if file is None:
        return BUILT_IN_SETS.get(name, "")
    of_base = BUILT_IN_SETS.get(file.built_in) or BUILT_IN_SETS.get(file.model[0], "")
    return file.bigram_set[0] or of_base


def _model(source: str, where: str) -> tuple[str, Callable[[], Gltf], Versions]:
    """Return a model's name, the model, and its files; ``where`` is who names it."""
    if source in BUILT_IN:
        return source, BUILT_IN[source], ()
    if not source and not where:
        raise CharacterError("no character", expected=f"{', '.join(BUILT_IN)}, or a file")
    if not source:
        raise CharacterError(
            "names no model",
            where=where,
            expected="a 'model', or a 'base' that has one",
            cure=f'for the built-in one write "base": "{next(iter(BUILT_IN))}"',
        )
    try:
        return _read_model(Path(source))
    except InputError as error:
        raise (error.at(f"{where}, at model") if where else error) from None


def _read_model(path: Path) -> tuple[str, Callable[[], Gltf], Versions]:
    if not path.suffix and not path.exists():
        raise CharacterError(
            f"no character {str(path)!r}",
            expected=f"{', '.join(BUILT_IN)}, or the path of a GLB, VRM or glTF file",
            cure=did_you_mean(path.name, BUILT_IN),
        )
    # Of a glTF in several files nobody says when a buffer changes: it is read every time.
    version = () if path.suffix.lower() == ".gltf" else _version(path)
    from lipwright.gltf import read_gltf

    model = read_gltf(path)
    return path.stem, lambda: model, version or ((str(path), None),)


def _version(path: str | Path | None) -> Versions:
    return ((str(path), file_version(path)),) if path is not None else ()


def _mappings(
    file: CharacterFile | None, mapping: str | Path | None
) -> tuple[tuple[Mapping, str], ...]:
    """Return the mappings of a character, the user's last."""
    layers = file.layers if file else ()
    found = [placed for layer in layers for placed in layer.mappings]
    if mapping is not None:
        found.append((read_mapping(mapping), str(mapping)))
    return tuple(found)


@cache
def _head() -> Gltf:
    from lipwright.character.builtin import to_gltf  # Only a model's user pays for making it.
    from lipwright.character.head import build_head

    return to_gltf(build_head(), "Head")


@cache
def _crab() -> Gltf:
    from lipwright.character.builtin import to_gltf
    from lipwright.character.crab import build_crab

    return to_gltf(build_crab(), "Crab")


BUILT_IN: dict[str, Callable[[], Gltf]] = {"head": _head, "crab": _crab}
"""The characters that come with Lipwright, by name."""

BUILT_IN_SETS: dict[str, str] = {"crab": "crab"}
"""The bigram set of each built-in character that has one of its own."""
