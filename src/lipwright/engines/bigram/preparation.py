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
        return _spans(_Line([], np.zeros(0), np.zeros(0), np.zeros(0, int)), np.zeros((0, 2)), 0)
    labels, starts, ends = (list(column) for column in zip(*phones, strict=True))
    line = _Line(labels, np.array(starts, float), np.array(ends, float), np.arange(len(labels)))
    heard = np.stack((line.starts, line.ends), axis=1)
    line.close_gaps()
    line.merge_silences()
    if line.labels == [SILENCE]:
        return prepare((), padding, silence_reach)
    line.pad(padding)
    return _spans(line, heard, silence_reach)


@dataclass(slots=True)
class _Line:
    """Columns of a line under construction."""

    labels: list[str]
    starts: Floats
    ends: Floats
    origins: Ints

    def close_gaps(self) -> None:
        """Fill gaps with silence, the smallest from both sides."""
        gaps = self.starts[1:] - self.ends[:-1]
        close = (gaps != 0) & (gaps < ROUNDING)
        middles = 0.5 * (self.starts[1:] + self.ends[:-1])[close]
        self.starts[1:][close] = middles
        self.ends[:-1][close] = middles
        for index in np.flatnonzero(self.ends <= self.starts)[:1]:
            raise LabelError(
                f"{self.labels[index]!r} at {self.starts[index]:.6g} s has no length",
                where=f"phone {index + 1}",
            )
        wide = np.flatnonzero(gaps >= ROUNDING) + 1
        self.insert(wide, self.ends[wide - 1], self.starts[wide])

    def insert(self, before: Ints, starts: Floats, ends: Floats) -> None:
        """Insert silences before the phones with these numbers."""
        for index in before[::-1].tolist():
            self.labels.insert(index, SILENCE)
        self.starts = np.insert(self.starts, before, starts)
        self.ends = np.insert(self.ends, before, ends)
        self.origins = np.insert(self.origins, before, -1)

    def merge_silences(self) -> None:
        """Make one of silences that follow one another."""
        silent = np.array([label == SILENCE for label in self.labels])
        first = np.flatnonzero(~np.append([False], silent[1:] & silent[:-1]))
        if len(first) == len(silent):
            return
        self.ends = self.ends[np.append(first[1:] - 1, len(silent) - 1)]
        self.starts = self.starts[first]
        self.origins = np.maximum.reduceat(self.origins, first)
        self.labels = [self.labels[index] for index in first.tolist()]

    def pad(self, padding: float) -> None:
        """Put silence at ends that have none."""
        start, end = self.starts[:1], self.ends[-1:]
        if self.labels[-1] != SILENCE:
            self.insert(np.array([len(self.labels)]), end, end + padding)
        if self.labels[0] != SILENCE:
            self.insert(np.array([0]), start - padding, start)


def _spans(line: _Line, given: Floats, silence_reach: float) -> Spans:
    starts, ends, origins = line.starts, line.ends, line.origins
    silent = np.array([label == SILENCE for label in line.labels], dtype=bool)
    first, boundary, last = starts[:-1].copy(), starts[1:].copy(), ends[1:].copy()
    before, after = silent[:-1], silent[1:]
    first[before] = np.maximum(first[before], boundary[before] - silence_reach)
    last[after] = np.minimum(last[after], boundary[after] + silence_reach)
    heard = np.stack((starts, ends), axis=1)
    known = origins >= 0
    heard[known] = given[origins[known]]
    return Spans(tuple(line.labels), starts, ends, origins, heard, first, boundary, last)
