"""Phones made ready for the stages: silences filled in, small gaps closed.

DESIGN section 4, first paragraph: the mouth opens before the sound and closes after it,
so every line starts and ends in silence.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from lipwright.engines.bigram.polyline import Floats, Ints
from lipwright.errors import LabelError
from lipwright.phones import SILENCE
from lipwright.timeline import Interval

ROUNDING = 0.010


@dataclass(frozen=True, slots=True, eq=False)
class Spans:
    """Where each bigram lies in time.

    Parameters
    ----------
    phones : tuple of Interval
        N prepared phones, without gaps, silence at both ends; none where nothing is said.
    origins : (N,) int
        Which phone of the input each one is; -1 for silences that were put in.
    start, boundary, end : (N - 1,) float64
        Seconds of each bigram: of its silence only the part next to the phone.
    """

    phones: tuple[Interval, ...]
    origins: Ints
    start: Floats
    boundary: Floats
    end: Floats

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """The classes of each bigram."""
        labels = [phone.label for phone in self.phones]
        return list(pairwise(labels))


def prepare(phones: Iterable[Interval], padding: float, silence_reach: float) -> Spans:
    """Return the bigrams of a line and their times.

    Parameters
    ----------
    phones : iterable of Interval
        Classes of the set, in order; gaps over 10 ms become silence, smaller ones and
        overlaps under 10 ms are closed in the middle.
    padding, silence_reach : float
        Seconds, see :class:`~lipwright.engines.bigram.model.Settings`.

    Raises
    ------
    LabelError
        If phones are out of order or overlap by 10 ms or more: it names both.
    """
    rows = _closed(list(phones))
    rows = _merged(rows)
    if all(phone.label == SILENCE for phone, _ in rows):
        rows = []
    if rows:
        first, last = rows[0][0], rows[-1][0]
        if first.label != SILENCE:
            rows.insert(0, (Interval(SILENCE, first.start - padding, first.start), -1))
        if last.label != SILENCE:
            rows.append((Interval(SILENCE, last.end, last.end + padding), -1))
    return _spans(rows, silence_reach)


Row = tuple[Interval, int]


def _closed(phones: list[Interval]) -> list[Row]:
    starts = [phone.start for phone in phones]
    ends = [phone.end for phone in phones]
    rows: list[Row] = []
    silences: dict[int, Row] = {}
    for index in range(len(phones) - 1):
        gap = starts[index + 1] - ends[index]
        if gap >= ROUNDING:
            silences[index] = (Interval(SILENCE, ends[index], starts[index + 1]), -1)
        elif gap > -ROUNDING:
            middle = 0.5 * (starts[index + 1] + ends[index]) if gap else ends[index]
            ends[index] = starts[index + 1] = middle
        else:
            raise LabelError(
                f"{_name(phones[index])} and {_name(phones[index + 1])} overlap",
                where=f"phones {index + 1} and {index + 2}",
                expected="phones in order, overlapping by less than 10 ms",
            )
    for index, phone in enumerate(phones):
        if ends[index] <= starts[index]:
            raise LabelError(
                f"{_name(phone)} has no length once overlaps are closed",
                where=f"phone {index + 1}",
            )
        rows.append((Interval(phone.label, starts[index], ends[index], phone.confidence), index))
        if index in silences:
            rows.append(silences[index])
    return rows


def _name(phone: Interval) -> str:
    return f"{phone.label!r} ({phone.start:.3f} to {phone.end:.3f} s)"


def _merged(rows: list[Row]) -> list[Row]:
    merged: list[Row] = []
    for phone, origin in rows:
        if merged and phone.label == SILENCE == merged[-1][0].label:
            before, known = merged[-1]
            whole = Interval(SILENCE, before.start, phone.end)
            merged[-1] = (whole, max(known, origin))
        else:
            merged.append((phone, origin))
    return merged


def _spans(rows: list[Row], silence_reach: float) -> Spans:
    phones = tuple(phone for phone, _ in rows)
    starts = np.array([phone.start for phone in phones])
    ends = np.array([phone.end for phone in phones])
    silent = np.array([phone.label == SILENCE for phone in phones], dtype=bool)
    start, boundary, end = starts[:-1].copy(), starts[1:].copy(), ends[1:].copy()
    before, after = silent[:-1], silent[1:]
    start[before] = np.maximum(start[before], boundary[before] - silence_reach)
    end[after] = np.minimum(end[after], boundary[after] + silence_reach)
    origins = np.array([origin for _, origin in rows], dtype=np.int64)
    return Spans(phones, origins, start, boundary, end)
