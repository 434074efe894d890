"""Phones made ready for the stages: silences filled in, small gaps closed.

DESIGN section 4, first paragraph: the mouth opens before the sound and closes after it,
so every line starts and ends in silence.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from lipwright.engines.bigram.polyline import Floats, Ints
from lipwright.errors import LabelError
from lipwright.phones import SILENCE

ROUNDING = 0.010
Row = tuple[str, float, float]


@dataclass(frozen=True, slots=True, eq=False)
class Spans:
    """Where each phone and each bigram lies in time.

    Parameters
    ----------
    labels : tuple of str
        N classes, silence at both ends; none where nothing is said.
    starts, ends : (N,) float64
        Seconds of each phone; there are no gaps.
    origins : (N,) int
        Which phone of the input each one is; -1 for silences that were put in.
    heard : (N, 2) float64
        Start and end of each phone before small gaps were closed.
    first, boundary, last : (N - 1,) float64
        Seconds of each bigram: of its silence only the part next to the phone.
    """

    labels: tuple[str, ...]
    starts: Floats
    ends: Floats
    origins: Ints
    heard: Floats
    first: Floats
    boundary: Floats
    last: Floats

    @property
    def pairs(self) -> list[tuple[str, str]]:
        """The classes of each bigram."""
        return list(pairwise(self.labels))


def prepare(phones: Sequence[Row], padding: float, silence_reach: float) -> Spans:
    """Return the bigrams of a line and their times.

    Parameters
    ----------
    phones : sequence of (str, float, float)
        Classes of the set with start and end in seconds, in order and without overlap;
        gaps of 10 ms and more become silence, smaller ones are closed in the middle.
    padding, silence_reach : float
        Seconds, see :class:`~lipwright.engines.bigram.model.Settings`.

    Raises
    ------
    LabelError
        If a phone has no length: it names it.
    """
    if not phones:
        return _spans(_Line([], [], [], []), np.zeros((0, 2)), silence_reach)
    line = _Line([], [], [], [])
    starts = np.array([start for _, start, _ in phones], dtype=np.float64)
    ends = np.array([end for _, _, end in phones], dtype=np.float64)
    heard = np.stack((starts, ends), axis=1)
    gaps = starts[1:] - ends[:-1]
    close = (gaps != 0) & (gaps < ROUNDING)
    middles = 0.5 * (starts[1:] + ends[:-1])[close]
    starts[1:][close] = middles
    ends[:-1][close] = middles
    silences = np.append(gaps >= ROUNDING, [False]).tolist()
    rows = zip(phones, starts.tolist(), ends.tolist(), silences, strict=True)
    for index, ((label, _, _), start, end, silence) in enumerate(rows):
        line.add(label, start, end, index)
        if silence:
            line.add(SILENCE, end, float(starts[index + 1]), -1)
    if all(label == SILENCE for label in line.labels):
        line = _Line([], [], [], [])
    if line.labels and line.labels[0] != SILENCE:
        line.insert_before(padding)
    if line.labels and line.labels[-1] != SILENCE:
        line.add(SILENCE, line.ends[-1], line.ends[-1] + padding, -1)
    return _spans(line, heard, silence_reach)


@dataclass(slots=True)
class _Line:
    """Columns of a line under construction."""

    labels: list[str]
    starts: list[float]
    ends: list[float]
    origins: list[int]

    def add(self, label: str, start: float, end: float, origin: int) -> None:
        if end <= start:
            raise LabelError(
                f"{label!r} at {start:.6g} s has no length", where=f"phone {origin + 1}"
            )
        if label == SILENCE and self.labels and self.labels[-1] == SILENCE:
            self.ends[-1] = end
            self.origins[-1] = max(self.origins[-1], origin)
            return
        self.labels.append(label)
        self.starts.append(start)
        self.ends.append(end)
        self.origins.append(origin)

    def insert_before(self, padding: float) -> None:
        self.labels.insert(0, SILENCE)
        self.ends.insert(0, self.starts[0])
        self.starts.insert(0, self.starts[0] - padding)
        self.origins.insert(0, -1)


def _spans(line: _Line, given: Floats, silence_reach: float) -> Spans:
    starts = np.array(line.starts, dtype=np.float64)
    ends = np.array(line.ends, dtype=np.float64)
    silent = np.array([label == SILENCE for label in line.labels], dtype=bool)
    first, boundary, last = starts[:-1].copy(), starts[1:].copy(), ends[1:].copy()
    before, after = silent[:-1], silent[1:]
    first[before] = np.maximum(first[before], boundary[before] - silence_reach)
    last[after] = np.minimum(last[after], boundary[after] + silence_reach)
    origins = np.array(line.origins, dtype=np.int64)
    heard = np.stack((starts, ends), axis=1)
    known = origins >= 0
    heard[known] = given[origins[known]]
    return Spans(tuple(line.labels), starts, ends, origins, heard, first, boundary, last)
