"""What can be done to what is open: one struct per kind of change, each small and absolute.

A change says what is to be, never by how much: applied twice it is applied once, and a
journal of changes can be played again. The page sends them; the journal on disk holds them.
Applying them is in :mod:`~lipwright.studio.state`.
"""

from __future__ import annotations

from typing import Literal

import msgspec

from lipwright.engines.bigram.edits import Edit

PairName = tuple[str, str]
Key = tuple[float, float]
Keys = tuple[Key, ...]
Target = Literal["set", "overrides"]
Row = tuple[str, float, float]
Value = float | str


class Change(msgspec.Struct, frozen=True, tag_field="type", rename="camel", omit_defaults=False):
    """Any change."""


class DrawCurve(Change, frozen=True, tag="drawCurve"):
    """Draw the curve of one pose in one pair; no keys take the pose out of the pair.

    Parameters
    ----------
    target : {"set", "overrides"}
        Where it is drawn. A pair that the target has not is begun with what is seen.
    pair : tuple of two str
    pose : str
    keys : tuple of (time, weight)
        Over 0..1 of the pair, times rising, first and last weight 0.
    """

    target: Target
    pair: PairName
    pose: str
    keys: Keys | None


class DrawPair(Change, frozen=True, tag="drawPair"):
    """Draw all of a pair anew, as when it is pasted."""

    target: Target
    pair: PairName
    curves: dict[str, Keys]
    boundary: float | None = None
    word: str | None = None


class ClearPair(Change, frozen=True, tag="clearPair"):
    """Take a pair out of the target: overrides fall back to the set, the set to a stand-in."""

    target: Target
    pair: PairName


class MoveMark(Change, frozen=True, tag="moveMark"):
    """Say where in 0..1 the boundary of a pair's two phones lies."""

    target: Target
    pair: PairName
    boundary: float


class NameWord(Change, frozen=True, tag="nameWord"):
    """Give a pair another example word."""

    target: Target
    pair: PairName
    word: str


class DrawPhone(Change, frozen=True, tag="drawPhone"):
    """Draw the single-phone curve of a class, which missing pairs are made of.

    ``keys`` lie over the phone's own 0..1, and reach from -1 to 2; none remove the pose.
    """

    target: Target
    phone: str
    pose: str
    keys: Keys | None


class SetRule(Change, frozen=True, tag="setRule"):
    """Change one number or choice of the stages; nothing goes back to what it was.

    Parameters
    ----------
    target : {"set", "overrides"}
    kind : {"pose", "threshold", "setting", "gain"}
    names : tuple of str
        The pose; the two poses of a threshold; nothing for a setting.
    field : str
        ``"limit"``, ``"window"``, ``"warp"``, ...; nothing for thresholds and gains.
    value : float or str, optional
    """

    target: Target
    kind: Literal["pose", "threshold", "setting", "gain"]
    names: tuple[str, ...]
    field: str
    value: Value | None


class SoundRef(msgspec.Struct, frozen=True, rename="camel"):
    """A sound that is kept: what it is asked for by, and how long it is in seconds."""

    key: str
    duration: float


class LineData(msgspec.Struct, frozen=True, rename="camel"):
    """A line as it is kept: what was said, and when each phone sounds."""

    id: str
    title: str
    phones: tuple[Row, ...]
    words: tuple[Row, ...]
    phone_set: str = "arpabet"
    text: str = ""
    language: str = ""
    source: str = ""
    sound: SoundRef | None = None
    notes: tuple[str, ...] = ()
    edits: tuple[Edit, ...] = ()


class AddLine(Change, frozen=True, tag="addLine"):
    """Put a line that was made into the list."""

    line: LineData


class RemoveLine(Change, frozen=True, tag="removeLine"):
    """Take a line out of the list."""

    line: str


class MoveBoundary(Change, frozen=True, tag="moveBoundary"):
    """Move where one phone ends and the next begins.

    Parameters
    ----------
    line : str
    phone : int
        Number of the phone that ends there; -1 moves the start of the first.
    time : float
        Seconds. A word's edge that lay there goes along.
    """

    line: str
    phone: int
    time: float


class PutEdit(Change, frozen=True, tag="putEdit"):
    """Correct one pose in one phone of a line; an edit of the same place is replaced."""

    line: str
    edit: Edit


class RemoveEdit(Change, frozen=True, tag="removeEdit"):
    """Take an edit of a line away, found or lost."""

    line: str
    edit: Edit


AnyChange = (
    DrawCurve
    | DrawPair
    | ClearPair
    | MoveMark
    | NameWord
    | DrawPhone
    | SetRule
    | AddLine
    | RemoveLine
    | MoveBoundary
    | PutEdit
    | RemoveEdit
)
