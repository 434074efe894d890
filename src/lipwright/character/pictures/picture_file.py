"""The file of a character of pictures: its mouth shapes, in JSON that artists edit.

Each shape says where it lies among the controls of a set (``at``: one or more points), for
which sounds alone it is drawn (``only``), and which picture shows it. Any list of shapes
works so. Three lists that animators know are built in: Rhubarb's A to X, Preston Blair's,
and Fleming & Dobbs'. The sounds are classes of the Common Phoneme Set.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache, lru_cache
from pathlib import Path
from typing import NoReturn

import msgspec

from lipwright.character.pictures.timing import Timing
from lipwright.character.vocabulary import POSES
from lipwright.errors import CharacterError, FileFormatError, InputError
from lipwright.files import convert, file_version, read_bytes, read_document
from lipwright.phones import SILENCE, load_phone_set

FORMAT = "lipwright/pictures"
VERSION = 1
DATA = Path(__file__).parents[2] / "data" / "pictures"
BUILT_IN_PICTURES = ("rhubarb", "preston_blair", "fleming_dobbs")
"""The lists of mouth shapes that come with Lipwright."""

CLOSED = "bmp"
"""The class of p, b and m: the sounds that no list of shapes can do without."""
MEDIA = {
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
    ".gif": "image/gif",
    ".webp": "image/webp",
}
Point = dict[str, float]


class Shape(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One mouth shape.

    Attributes
    ----------
    label : str
        Its name, as other programs will read it.
    at : list of dict of str to float
        Where it lies: weights of controls; what is not named is 0.
    only : list of str
        The sounds it is drawn for; none for all of them.
    picture : str
        The picture's file, from the folder of the character's file.
    about : str
        What it is for.
    """

    label: str
    at: list[Point]
    only: list[str] = []
    picture: str = ""
    about: str = ""


class _Timing(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    fps: float = 24.0
    on: int = 1
    minimum_hold: str = "60 ms"
    lead: str = "40 ms"
    rest_after: float = 0.3


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    name: str
    shapes: list[Shape]
    rest: str
    reach: dict[str, str]
    missing: list[str] = []
    fallback: dict[str, str] = {}
    relax: dict[str, str] = {}
    weights: dict[str, float] = {}
    timing: _Timing = _Timing()
    about: str = ""


@dataclass(frozen=True, slots=True)
class PictureCharacter:
    """A list of mouth shapes, and how they are held.

    Parameters
    ----------
    name : str
    shapes : tuple of Shape
        In the character's own order, those that are not drawn included.
    rest : str
        The shape of a silent mouth.
    reach : dict of str to str
        For a sound, the shape that it must show; the first one goes before the next.
    missing : tuple of str
        Shapes that are not drawn.
    fallback : dict of str to str
        What stands in for a shape that is not drawn.
    relax : dict of str to str
        What each shape becomes in a short pause.
    weights : dict of str to float
        How much a control counts when pictures are compared with curves, 1 where not given.
    timing : Timing
    where : str
        Its file, in errors.

    Raises
    ------
    CharacterError
        If it cannot work: the message names the place.
    """

    name: str
    shapes: tuple[Shape, ...]
    rest: str
    reach: dict[str, str]
    missing: tuple[str, ...] = ()
    fallback: dict[str, str] = field(default_factory=dict)
    relax: dict[str, str] = field(default_factory=dict)
    weights: dict[str, float] = field(default_factory=dict)
    timing: Timing = field(default_factory=Timing)
    where: str = ""

    def __post_init__(self) -> None:
        try:
            _check(self)
        except CharacterError as error:
            raise CharacterError(
                error.found,
                where=", at ".join(filter(None, (self.where or self.name, error.where))),
                expected=error.expected,
                cure=error.cure,
            ) from None

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels of all shapes."""
        return tuple(shape.label for shape in self.shapes)

    @property
    def drawn(self) -> tuple[str, ...]:
        """The labels of the shapes that are drawn."""
        return tuple(label for label in self.labels if label not in self.missing)

    def shown_for(self, label: str) -> str:
        """Return the drawn shape that shows ``label``: itself, or what stands in for it."""
        for _ in self.shapes:
            if label not in self.missing:
                return label
            label = self.fallback[label]
        raise CharacterError(f"{label!r} stands in for itself", where="fallback")

    def without(self, labels: Iterable[str]) -> PictureCharacter:
        """Return the character with these shapes not drawn.

        Raises
        ------
        CharacterError
            If a label is unknown, or nothing stands in for it.
        """
        return replace(self, missing=tuple(dict.fromkeys((*self.missing, *labels))))

    def no_model(self) -> NoReturn:
        """Say that pictures have no model to move.

        Raises
        ------
        CharacterError
            Always.
        """
        raise CharacterError(
            "a character of pictures has no model",
            where=self.where or self.name,
            expected=".html .tsv .xml .rhubarb.json .dat .json .csv or .wav",
        )

    def check_controls(self, controls: Sequence[str]) -> None:
        """Refuse an animation whose controls the shapes do not lie among.

        Raises
        ------
        CharacterError
            If a control is known to neither the animation nor the nine canonical poses, or
            none of them is the animation's.
        """
        named = tuple(dict.fromkeys(c for s in self.shapes for point in s.at for c in point))
        expected = f"one of {', '.join(controls)}"
        for control in named:
            if control not in controls and control not in POSES:
                where = f"{self.where or self.name}, at shapes"
                raise CharacterError(f"no control {control!r}", where=where, expected=expected)
        if not set(named) & set(controls):
            raise CharacterError(
                f"none of its controls ({', '.join(named)}) is the set's",
                where=self.where or self.name,
                expected=expected,
            )


def _check(of: PictureCharacter) -> None:
    labels = of.labels
    _check_labels(labels)
    sounds = load_phone_set("common").labels
    for number, shape in enumerate(of.shapes):
        if not shape.at:
            raise CharacterError("no point", where=f"shapes[{number}].at", expected="one or more")
        _known(shape.only, (*sounds, SILENCE), f"shapes[{number}].only", "sound")
    _known([of.rest], labels, "rest", "shape")
    _known(of.reach, (*sounds, SILENCE), "reach", "sound")
    _known(of.reach.values(), labels, "reach", "shape")
    if CLOSED not in of.reach:
        raise CharacterError(
            "no closed shape", where="reach", expected=f"a shape for {CLOSED!r}: p, b and m"
        )
    for place, table in (("fallback", of.fallback), ("relax", of.relax)):
        _known((*table, *table.values()), labels, place, "shape")
    _known(of.missing, labels, "missing", "shape")
    for label in of.missing:
        if label not in of.fallback:
            raise CharacterError(
                f"{label!r} is not drawn, and nothing stands in for it",
                where="fallback",
                expected=f"a shape for {label!r}",
            )
        of.shown_for(label)
    for control, weight in of.weights.items():
        if weight < 0:
            raise CharacterError(f"{weight:g}", where=f"weights.{control}", expected="0 or more")


def _check_labels(labels: Sequence[str]) -> None:
    if len(labels) < 2:
        raise CharacterError(f"{len(labels)} shapes", where="shapes", expected="two or more")
    for number, label in enumerate(labels):
        where = f"shapes[{number}].label"
        if not re.fullmatch(r"[^\s\x00-\x1f]+", label):
            raise CharacterError(repr(label), where=where, expected="a name without spaces")
        if label in labels[:number]:
            raise CharacterError(f"{label!r} stands twice", where=where)


def _known(names: Iterable[str], known: Sequence[str], where: str, kind: str) -> None:
    for name in names:
        if name not in known:
            expected = f"one of {' '.join(known)}"
            raise CharacterError(f"no {kind} {name!r}", where=where, expected=expected)


def is_pictures(spec: str | Path) -> bool:
    """Whether ``spec`` names a character of pictures: a built-in list, or such a file."""
    if str(spec) in BUILT_IN_PICTURES:
        return True
    if Path(spec).suffix.lower() != ".json":
        return False
    return _holds_pictures(str(spec), file_version(str(spec)))


@lru_cache(maxsize=32)
def _holds_pictures(path: str, version: object) -> bool:
    """Look into a file, once in each of its versions."""
    try:
        content = json.loads(read_bytes(path))
    except (InputError, ValueError, RecursionError):
        return False  # whoever reads it as something else says what is wrong
    return isinstance(content, dict) and content.get("format") == FORMAT


def load_pictures(spec: str | Path) -> PictureCharacter:
    """Return a character of pictures.

    Parameters
    ----------
    spec : str or Path
        One of :data:`BUILT_IN_PICTURES`, or a file.

    Raises
    ------
    InputError
        If there is no such list or file, or a picture is not there.
    FileFormatError
        If the file breaks its format.
    CharacterError
        If the list cannot work.
    """
    built_in = str(spec) in BUILT_IN_PICTURES
    path = Path(spec)
    if not built_in and not path.suffix and not path.exists():
        raise CharacterError(
            f"no mouth shapes {str(spec)!r}",
            expected=f"{', '.join(BUILT_IN_PICTURES)}, or the path of a file",
        )
    return _built_in(str(spec)) if built_in else _read(path, str(spec))


@cache
def _built_in(name: str) -> PictureCharacter:
    return _read(DATA / f"{name}.json", name)


def _read(path: Path, where: str) -> PictureCharacter:
    read = convert(read_document(path, format=FORMAT, version=VERSION), _Document, where)
    found = PictureCharacter(
        read.name,
        tuple(read.shapes),
        read.rest,
        read.reach,
        tuple(read.missing),
        read.fallback,
        read.relax,
        read.weights,
        _timing(read.timing, where),
        where,
    )
    _check_pictures(found, path.parent)
    return found


def _timing(read: _Timing, where: str) -> Timing:
    try:
        return Timing(read.fps, read.on, read.minimum_hold, read.lead, read.rest_after)
    except InputError as error:
        place = f"{where}, at timing.{error.where}"
        raise FileFormatError(error.found, where=place, expected=error.expected) from None


def _check_pictures(of: PictureCharacter, folder: Path) -> None:
    for number, shape in enumerate(of.shapes):
        if not shape.picture or shape.label in of.missing:
            continue
        where = f"{of.where}, at shapes[{number}].picture"
        if Path(shape.picture).suffix.lower() not in MEDIA:
            expected = f"one of {' '.join(MEDIA)}"
            raise FileFormatError(repr(shape.picture), where=where, expected=expected)
        if Path(shape.picture).is_absolute() or not (folder / shape.picture).is_file():
            raise CharacterError(
                f"there is no picture {shape.picture!r}",
                where=where,
                expected="a file, named from the folder of the character's file",
            )
