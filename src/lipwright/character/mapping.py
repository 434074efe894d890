"""Mappings: how each control is made from a rig's channels; files that animators edit.

A row per control: channels and weights. A channel's value is the sum of its rows'
weights, times each control's value and gain, kept within the channel's limits (0..1
where none are given). A channel is a morph target, or a joint that turns. A mapping says
what is wanted, in names of a vocabulary or of a rig; :mod:`lipwright.character.fitting`
finds these names on a rig.
"""

from __future__ import annotations

from collections.abc import Mapping as MappingType
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import msgspec

from lipwright.errors import FileFormatError
from lipwright.files import convert, format_number, quote, read_document

FORMAT = "lipwright/mapping"
VERSION = 1
JAW_DEGREES = 20.0
"""How far a jaw turns at 1 where nobody says: a wide yawn is about 30."""
Row = dict[str, float]


class JointChannel(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A channel that turns a joint, by so many degrees at 1.

    Parameters
    ----------
    joint : str
        The joint's name; the channel's own where none is given.
    axis : tuple of 3 float, optional
        In the joint's own space; None means that it is found from the model.
    degrees : float
        By the right hand about the axis; where the axis is found, what is positive opens.
    """

    joint: str = ""
    axis: tuple[float, float, float] | None = None
    degrees: float = JAW_DEGREES


@dataclass(frozen=True, slots=True)
class Mapping:
    """How controls are made from channels.

    Parameters
    ----------
    name : str
        The vocabulary's or the character's name.
    controls : dict of str to dict of str to float
        For each control, channels and weights; an empty row keeps a control still.
    otherwise : dict of str to list of dict
        For a control, rows to try where the rig has not all of the first one's channels.
    names : dict of str to list of str
        For a vocabulary: other spellings of a channel's name.
    gains : dict of str to float
        What a control is multiplied by, 1 where none is given.
    limits : dict of str to tuple of float
        The least and greatest value of a channel, 0 and 1 where none are given.
    notes : dict of str to str
        What to know about a control.
    about : str
        What to know about the mapping.
    joints : dict of str to JointChannel
        Channels that turn joints, usable in rows like any other.
    """

    name: str
    controls: dict[str, Row]
    otherwise: dict[str, list[Row]] = field(default_factory=dict)
    names: dict[str, list[str]] = field(default_factory=dict)
    gains: dict[str, float] = field(default_factory=dict)
    limits: dict[str, tuple[float, float]] = field(default_factory=dict)
    notes: dict[str, str] = field(default_factory=dict)
    about: str = ""
    joints: dict[str, JointChannel] = field(default_factory=dict)

    @property
    def channels(self) -> tuple[str, ...]:
        """The channels that it uses, each once."""
        rows = [*self.controls.values(), *(row for rows in self.otherwise.values() for row in rows)]
        return tuple(dict.fromkeys(name for row in rows for name in row))

    def to_bytes(self) -> bytes:
        """Return the content of the mapping's file: a row per line, in a stable order."""
        parts = [
            f'"format": {quote(FORMAT)}',
            f'"version": {VERSION}',
            f'"name": {quote(self.name)}',
        ]
        if self.about:
            parts.append(f'"about": {quote(self.about)}')
        parts.append(block("controls", {k: row(made) for k, made in self.controls.items()}))
        alternatives = {
            control: "[" + ", ".join(map(row, rows)) + "]"
            for control, rows in self.otherwise.items()
        }
        spellings = {k: "[" + ", ".join(map(quote, v)) + "]" for k, v in self.names.items()}
        limits = {
            k: f"[{format_number(low)}, {format_number(high)}]"
            for k, (low, high) in self.limits.items()
        }
        sections = {
            "joints": {k: _joint(joint) for k, joint in self.joints.items()},
            "otherwise": alternatives,
            "names": spellings,
            "gains": {k: format_number(gain) for k, gain in self.gains.items()},
            "limits": limits,
            "notes": {k: quote(note) for k, note in self.notes.items()},
        }
        parts += [block(key, rows) for key, rows in sections.items() if rows]
        return ("{\n  " + ",\n  ".join(parts) + "\n}\n").encode()


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    name: str
    controls: dict[str, Row]
    otherwise: dict[str, list[Row]] = {}
    names: dict[str, list[str]] = {}
    gains: dict[str, float] = {}
    limits: dict[str, tuple[float, float]] = {}
    notes: dict[str, str] = {}
    about: str = ""
    joints: dict[str, JointChannel] = {}


def read_mapping(path: str | Path) -> Mapping:
    """Return the mapping in a file.

    Raises
    ------
    InputError
        If the file cannot be read.
    FileFormatError
        If it is no mapping, or a number in it makes no sense: the message names the place.
    """
    document = read_document(path, format=FORMAT, version=VERSION)
    read = convert(document, _Document, str(path))
    check_numbers(read.gains, read.limits, str(path))
    check_joints(read.joints, str(path))
    return Mapping(
        read.name,
        read.controls,
        read.otherwise,
        read.names,
        read.gains,
        read.limits,
        read.notes,
        read.about,
        read.joints,
    )


def check_numbers(
    gains: MappingType[str, float], limits: MappingType[str, tuple[float, float]], where: str
) -> None:
    """Refuse gains below zero, and limits the wrong way round.

    Raises
    ------
    FileFormatError
    """
    for control, gain in gains.items():
        if gain < 0:
            raise FileFormatError(
                f"the gain {gain}", where=f"{where}, at gains.{control}", expected="0 or more"
            )
    for channel, (low, high) in limits.items():
        if low > high:
            raise FileFormatError(
                f"the limits {low} to {high}",
                where=f"{where}, at limits.{channel}",
                expected="the lower one first",
            )


def check_joints(joints: MappingType[str, JointChannel], where: str) -> None:
    """Refuse axes without a direction, and turns of no degrees or too many.

    Raises
    ------
    FileFormatError
    """
    for channel, joint in joints.items():
        place = f"{where}, at joints.{channel}"
        if joint.axis is not None and max(map(abs, joint.axis)) < 1e-9:
            raise FileFormatError(
                "the axis has no direction", where=place, expected="one such as [1, 0, 0]"
            )
        if not 0 < abs(joint.degrees) <= 90:
            raise FileFormatError(
                f"{format_number(joint.degrees)} degrees",
                where=place,
                expected="more than 0 and at most 90, of either sign",
            )


def _joint(joint: JointChannel) -> str:
    fields = [f'"joint": {quote(joint.joint)}'] if joint.joint else []
    if joint.axis is not None:
        fields.append(f'"axis": [{", ".join(map(format_number, joint.axis))}]')
    fields.append(f'"degrees": {format_number(joint.degrees)}')
    return "{" + ", ".join(fields) + "}"


def merged(mappings: Sequence[Mapping], name: str) -> Mapping:
    """Return several mappings as one: the later one goes before the earlier, row by row."""
    whole = Mapping(name, {})
    for one in mappings:
        # A row that is drawn anew leaves what stood in for the old one.
        otherwise = {c: rows for c, rows in whole.otherwise.items() if c not in one.controls}
        notes = {c: note for c, note in whole.notes.items() if c not in one.controls}
        whole = Mapping(
            name,
            {**whole.controls, **one.controls},
            {**otherwise, **one.otherwise},
            {**whole.names, **one.names},
            {**whole.gains, **one.gains},
            {**whole.limits, **one.limits},
            {**notes, **one.notes},
            joints={**whole.joints, **one.joints},
        )
    return whole


def row(weights: MappingType[str, float]) -> str:
    """Return channels and weights as one line of a file."""
    return "{" + ", ".join(f"{quote(k)}: {format_number(v)}" for k, v in weights.items()) + "}"


def block(key: str, rows: MappingType[str, str]) -> str:
    """Return an object of a file, each of its rows on a line of its own."""
    lines = ",\n    ".join(f"{quote(name)}: {text}" for name, text in rows.items())
    return f"{quote(key)}: {{\n    {lines}\n  }}" if rows else f"{quote(key)}: {{}}"
