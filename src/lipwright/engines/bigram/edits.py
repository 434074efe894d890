"""Edits of one line: corrections that hang on phones, not on seconds (DESIGN section 4).

An edit names a word, its occurrence in the line, and a phone of it by number. The line may
be re-recorded, realigned, or spoken by another voice: the edit finds its phone again; one
that no longer does is named in the report, never dropped in silence.

Gains, levels and holds act on the placed keys, before stitching. Keys that are drawn
anew act after stage 5, and the bounds are then solved again, unless the edit is unlocked.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import msgspec
import numpy as np

from lipwright.engines.bigram.model import Pose
from lipwright.engines.bigram.polyline import Axis, Line, merge_equal
from lipwright.engines.bigram.table import Placed
from lipwright.errors import InputError, SetError
from lipwright.files import check_document, convert, parse_json, read_bytes
from lipwright.timeline import Interval, Tier

FORMAT, VERSION = "lipwright/edits", 1
SHOULDER = 0.25
BLEND = 0.03


class Edit(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One correction of one pose in one phone.

    Parameters
    ----------
    word : str
        The word, in any case; nothing for phones outside words.
    phone : int
        Which phone of the word, from 1.
    pose : str
    occurrence : int
        Which of several same words in the line, from 1.
    label : str
        The phone's label when the edit was made; where it is now another, the edit is lost.
    gain : float
        What the pose's curves in the phone are multiplied by.
    level : float, optional
        The pose reaches this weight in the middle of the phone.
    hold : float
        Its peak there is held for so many seconds longer on both sides.
    keys : list of (float, float), optional
        The pose's curve drawn anew: keys over the phone's own 0..1.
    unlocked : bool
        Whether drawn keys stand as they are, bounds or not.
    """

    word: str
    phone: int
    pose: str
    occurrence: int = 1
    label: str = ""
    gain: float = 1.0
    level: float | None = None
    hold: float = 0.0
    keys: tuple[tuple[float, float], ...] | None = None
    unlocked: bool = False

    def __post_init__(self) -> None:
        if self.phone < 1 or self.occurrence < 1:
            raise SetError(f"phone {self.phone}, occurrence {self.occurrence}", expected="from 1")
        if not 0 <= self.gain <= 10:
            raise SetError(f"gain {self.gain}", expected="0 to 10")
        if self.level is not None and not 0 <= self.level <= 1:
            raise SetError(f"level {self.level}", expected="0 to 1")
        if not 0 <= self.hold <= 2:
            raise SetError(f"hold {self.hold}", expected="0 to 2 s")
        if self.keys is not None:
            times = [time for time, _ in self.keys]
            rising = all(a < b for a, b in pairwise(times))
            inside = all(0 <= t <= 1 and 0 <= v <= 1 for t, v in self.keys)
            if len(self.keys) < 2 or not (rising and inside):
                raise SetError("keys", expected="two or more, times rising, both in 0..1")

    @property
    def name(self) -> str:
        """How a report names it."""
        which = f" ({self.occurrence})" if self.occurrence > 1 else ""
        return f"{self.pose} in phone {self.phone} of {self.word!r}{which}"


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    edits: tuple[Edit, ...]
    about: str = ""


def read_edits(path: str | Path) -> tuple[Edit, ...]:
    """Return the edits in a file.

    Raises
    ------
    FileFormatError
        If it is broken; the message names the place.
    """
    return edits_from(read_bytes(path), str(path))


def edits_from(data: bytes, where: str) -> tuple[Edit, ...]:
    """Return the edits that the content of a file holds."""
    document = check_document(parse_json(data, where), where, format=FORMAT, version=VERSION)
    return convert(document, _Document, where).edits


@dataclass(frozen=True, slots=True)
class Found:
    """An edit and the phone that it hangs on."""

    edit: Edit
    phone: Interval


def find(
    edits: Iterable[Edit], phones: Sequence[Interval], words: Tier
) -> tuple[tuple[Found, ...], tuple[str, ...]]:
    """Return the edits that find their phone, and the names of those that do not."""
    found, lost = [], []
    for edit in edits:
        phone = _phone(edit, phones, words)
        if phone is None:
            lost.append(edit.name)
        else:
            found.append(Found(edit, phone))
    return tuple(found), tuple(lost)


def _phone(edit: Edit, phones: Sequence[Interval], words: Tier) -> Interval | None:
    if edit.word:
        same = [word for word in words if plain_word(word.label) == plain_word(edit.word)]
        if len(same) < edit.occurrence:
            return None
        word = same[edit.occurrence - 1]
        inside = [phone for phone in phones if phone.middle in word and phone.label != "sil"]
    else:
        inside = [phone for phone in phones if words.at(phone.middle) is None]
    if len(inside) < edit.phone:
        return None
    phone = inside[edit.phone - 1]
    return phone if edit.label in ("", phone.label) else None


def same_place(one: Edit, other: Edit) -> bool:
    """Whether two edits hang on one phone and change one pose."""
    alike = (one.phone, one.occurrence, one.pose) == (other.phone, other.occurrence, other.pose)
    return alike and plain_word(one.word) == plain_word(other.word)


def plain_word(word: str) -> str:
    """Return a word in one spelling: any case, either Unicode form, without punctuation."""
    folded = unicodedata.normalize("NFC", unicodedata.normalize("NFC", word).casefold())
    return "".join(letter for letter in folded if letter.isalnum() or _is_written(letter))


def _is_written(mark: str) -> bool:
    # Hindi's vowels are marks; Hebrew's and Arabic's (classes 10 to 35) need not be written,
    # and the dot is what casefold leaves of the Turkish capital of i.
    is_mark = unicodedata.category(mark) in ("Mn", "Mc") and mark != "\u0307"
    return is_mark and not 10 <= unicodedata.combining(mark) <= 35


def scale_placed(placed: Placed, found: Sequence[Found], order: Sequence[str]) -> Placed:
    """Return placed keys with the gains of edits in them."""
    values = placed.values.copy()
    for one in found:
        if one.edit.gain != 1:
            values[_mine(placed, one, order)] *= one.edit.gain
    return Placed(placed.bigram, placed.pose, placed.times, np.minimum(values, 1.0))


def _mine(placed: Placed, one: Found, order: Sequence[str]) -> np.ndarray:
    inside = (placed.times >= one.phone.start) & (placed.times <= one.phone.end)
    mine: np.ndarray = inside & (placed.pose == order.index(one.edit.pose))
    return mine


def added_lines(
    placed: Placed, found: Sequence[Found], poses: Sequence[Pose], axis: Axis
) -> list[Line]:
    """Return the curves, on the axis, that levels and holds add before stitching."""
    order = [pose.name for pose in poses]
    lines = []
    for one in found:
        number = order.index(one.edit.pose)
        points = []
        if one.edit.level is not None:
            points.append(_tent(one.phone, one.edit.level))
        if one.edit.hold:
            points.append(_held(placed, one, order, poses[number].limit))
        for times, values in points:
            if len(times):
                lines.append((times - axis.base + number * axis.width, values))
    return lines


def _tent(phone: Interval, level: float) -> Line:
    shoulder = SHOULDER * phone.duration
    start, end = phone.start, phone.end
    times = [start - shoulder, start + shoulder, end - shoulder, end + shoulder]
    return np.array(times), np.array([0.0, level, level, 0.0])


def _held(placed: Placed, one: Found, order: Sequence[str], limit: float) -> Line:
    mine = np.flatnonzero(_mine(placed, one, order))
    if one.edit.level is not None:
        peak, first, last = one.edit.level, one.phone.start, one.phone.end
    elif len(mine):
        peak = float(placed.values[mine].max())
        at = placed.times[mine][placed.values[mine] == peak]
        first, last = float(at.min()), float(at.max())
    else:
        return np.zeros(0), np.zeros(0)
    flank, hold = max(peak / limit, 1e-3), one.edit.hold
    times = [first - hold - flank, first - hold, last + hold, last + hold + flank]
    return np.array(times), np.array([0.0, peak, peak, 0.0])


def reach(found: Sequence[Found], poses: Sequence[Pose]) -> float:
    """Return how far, in seconds, edits may move a curve beyond the line's own span."""
    limits = {pose.name: pose.limit for pose in poses}
    return max(
        (
            one.edit.hold + 1 / limits[one.edit.pose] + SHOULDER * one.phone.duration + BLEND
            for one in found
        ),
        default=0.0,
    )


def redraw(line: Line, found: Sequence[Found], order: Sequence[str], axis: Axis) -> Line:
    """Return the line with drawn keys in place of what stood in their phones.

    The curve goes over into what is beside within ``BLEND`` seconds.
    """
    for one in found:
        if one.edit.keys is None:
            continue
        offset = order.index(one.edit.pose) * axis.width - axis.base
        drawn = np.array(one.edit.keys)
        times = one.phone.start + drawn[:, 0] * one.phone.duration + offset
        ends = np.array([times[0] - BLEND, times[-1] + BLEND])
        kept = (line[0] < ends[0]) | (line[0] > ends[1])
        merged = np.concatenate((line[0][kept], ends, times))
        values = np.concatenate((line[1][kept], np.interp(ends, *line), drawn[:, 1]))
        sorting = np.argsort(merged, kind="stable")
        line = merge_equal(merged[sorting], values[sorting])
    return line


def check_poses(edits: Iterable[Edit], names: Sequence[str]) -> None:
    """Refuse edits of poses that the set has not.

    Raises
    ------
    InputError
    """
    for edit in edits:
        if edit.pose not in names:
            raise InputError(
                f"unknown pose {edit.pose!r}", where=edit.name, expected=", ".join(names)
            )
