"""Characters: a model, and how a set's controls move it.

``head`` is built in and made by the package's own code; anything else is a path to a
GLB, VRM or glTF file. A mapping file that a user gives goes before what is known of the
model's vocabulary.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from lipwright.animation import Animation
from lipwright.character.between import with_betweens
from lipwright.character.fitting import Fitting, fit
from lipwright.character.mapping import Mapping, read_mapping
from lipwright.character.rig import Rig, read_rig
from lipwright.errors import CharacterError
from lipwright.files import write_atomically
from lipwright.gltf import Gltf, read_gltf
from lipwright.performance import RiggedModel


@dataclass(frozen=True, slots=True, eq=False)
class Character:
    """A model, and how a set's controls move it.

    Parameters
    ----------
    name : str
        ``"head"``, or the model file's name without its suffix.
    model : function
        Returns the model; for a built-in character it is made when first asked for.
    mapping : Mapping, optional
        The user's own mapping.
    mapping_name : str
        The mapping's file, in errors.
    """

    name: str
    model: Callable[[], Gltf]
    mapping: Mapping | None = None
    mapping_name: str = "mapping"

    def read_rig(self) -> Rig:
        """Return what the model has that can move a mouth."""
        return read_rig(self.model())

    def fit(self) -> Fitting:
        """Return how each control is made on this model."""
        return fit(self.read_rig(), self.mapping, self.mapping_name)

    def check(self, controls: Sequence[str]) -> None:
        """Refuse early what :meth:`rig` would refuse.

        Raises
        ------
        CharacterError
            If none of the controls moves anything on this model.
        """
        still = np.zeros((1, len(controls)), np.float32)
        self._drive(Animation(tuple(controls), still, 1.0))

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
        channels = self._drive(animation)
        return RiggedModel(self.name, self.model().to_glb(), channels)

    def _drive(self, animation: Animation) -> Animation:
        try:
            driven = self.fit().drive(animation)
        except CharacterError as error:
            raise error.at(self.model().where) from None
        return with_betweens(driven, self.read_rig().all_targets)

    def write_mapping(self, path: str | Path) -> None:
        """Write how each control is made, in the model's own names, as a file to edit."""
        write_atomically(path, self.fit().to_mapping(self.name).to_bytes())


def load_character(spec: str | Path, mapping: str | Path | None = None) -> Character:
    """Return a character.

    Parameters
    ----------
    spec : str or Path
        ``"head"``, or the path of a GLB, VRM or glTF file.
    mapping : str or Path, optional
        A mapping file of the user's.

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
    own = read_mapping(mapping) if mapping is not None else None
    own_name = str(mapping) if mapping is not None else ""
    if str(spec) in BUILT_IN:
        character = Character(str(spec), BUILT_IN[str(spec)], own, own_name)
    else:
        path = Path(spec)
        if not path.suffix and not path.exists():
            raise CharacterError(
                f"no character {str(spec)!r}",
                expected=f"{', '.join(BUILT_IN)}, or the path of a GLB, VRM or glTF file",
            )
        model = read_gltf(path)
        character = Character(path.stem, lambda: model, own, own_name)
        character.read_rig()
    if own is not None:
        character.fit()
    return character


@cache
def _head() -> Gltf:
    from lipwright.character.builtin import to_gltf  # Only a model's user pays for making it.
    from lipwright.character.head import build_head

    return to_gltf(build_head(), "Head")


BUILT_IN: dict[str, Callable[[], Gltf]] = {"head": _head}
"""The characters that come with Lipwright, by name."""
