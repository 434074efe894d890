"""What the sounds of a line ask of its drawings: which shape must be shown, and where.

Each p, b and m must show the closed mouth, each f and v the teeth on the lip, a long
silence the mouth at rest. A drawing that must show a shape touches its phone's time; of
several that do, the one that fits best a little early is taken: lips that close late are
seen, lips that close early are not.
"""

from __future__ import annotations

import math
from bisect import bisect_left, insort
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.character.pictures.picture_file import CLOSED, PictureCharacter
from lipwright.errors import LabelError
from lipwright.phones import SILENCE, load_reduction

Row = tuple[str, float, float]
Floats = NDArray[np.float64]

POSES_OF = {CLOSED: "PBM", "f": "FV"}
"""The canonical pose in which a sound is seen, where only the curves are known."""
SHOWN = 0.8
"""From this weight on, a pose counts as shown."""
SETTLING = 0.1
"""Seconds at each end of a silence in which the mouth still moves."""


@dataclass(frozen=True, slots=True, eq=False)
class Sounds:
    """The sounds of a line, as classes of the Common Phoneme Set.

    Parameters
    ----------
    rows : list of (class, start, end)
        In order of time.
    known : bool
        Whether these are all sounds; else only those that the curves show.
    """

    rows: list[Row]
    known: bool = True

    @classmethod
    def of(cls, animation: Animation) -> Sounds:
        """Return the sounds of an animation's phones; of its curves, where they say nothing."""
        try:
            rows, _ = load_reduction(animation.phones.phone_set, "common").rows(animation.phones)
        except LabelError:  # a notation of the user's own
            rows = []
        if any(label != SILENCE for label, _, _ in rows):
            return cls(rows)
        return cls(_rows_of_curves(animation), known=False)

    def silences(self, end: float) -> list[tuple[float, float]]:
        """Return the stretches of 0..``end`` (seconds) without speech."""
        found, time = [], 0.0
        for label, first, last in self.rows:
            if label == SILENCE:
                continue
            if first > time:
                found.append((time, first))
            time = max(time, last)
        return [*found, (time, end)] if end > time else found

    def coverage(self, labels: Sequence[str], edges: Floats, end: float) -> Floats:
        """Return which share of each stretch between two edges is one of these sounds.

        Parameters
        ----------
        labels : sequence of str
        edges : (N + 1,) seconds
        end : float
            Of the line, in seconds.

        Returns
        -------
        (N,) float64
            0..1.
        """
        spans = [row for row in self._times(labels) if row[1] > row[0]]
        if SILENCE in labels:
            first = min(0.0, self.rows[0][1])
            before, after = (first - 1.0, first), (end, max(edges[-1], end) + 1.0)
            spans = sorted([before, *spans, *self.silences(end), after])
        if not spans:
            return np.zeros(len(edges) - 1)
        firsts, lasts = np.array(spans).T
        times = np.stack((firsts, lasts), axis=1).ravel()
        sums = np.cumsum(np.stack((np.zeros(len(spans)), lasts - firsts), axis=1).ravel())
        covered: Floats = np.diff(np.interp(edges, times, sums)) / np.diff(edges)
        return covered

    def _times(self, labels: Sequence[str]) -> list[tuple[float, float]]:
        return [(a, b) for label, a, b in self.rows if label in labels and label != SILENCE]


def _rows_of_curves(animation: Animation) -> list[Row]:
    rows: list[Row] = []
    for label, pose in POSES_OF.items():
        if pose not in animation.controls:
            continue
        shown = np.concatenate(([False], animation.control(pose) >= SHOWN, [False]))
        edges = np.flatnonzero(shown[1:] != shown[:-1]) / animation.rate + animation.start
        rows += [(label, float(a), float(b)) for a, b in edges.reshape(-1, 2)]
    return sorted(rows, key=lambda row: row[1])


@dataclass(frozen=True, slots=True)
class Grid:
    """Where drawings may start.

    Parameters
    ----------
    count : int
        How many places for drawings there are.
    step : float
        Seconds of each.
    lead : float
        Seconds by which pictures are earlier than their sounds.
    """

    count: int
    step: float
    lead: float

    @property
    def end(self) -> float:
        """The end of the last place, in seconds."""
        return self.count * self.step

    def touching(self, start: float, end: float) -> range:
        """Return the places that touch ``start``..``end`` (seconds)."""
        first = max(math.floor(start / self.step + 1e-6), 0)
        last = min(math.ceil(end / self.step - 1e-6), self.count)
        return range(min(first, self.count - 1), max(last, first + 1))

    def place(self, start: float, end: float) -> int:
        """Return the place that suits a phone best, a lead early but never off the phone."""

        def shared(place: int) -> float:
            first, last = place * self.step, (place + 1) * self.step
            return min(last, end - self.lead) - max(first, start - self.lead)

        # Of two that suit alike, max takes the earlier.
        return max(self.touching(start, end), key=lambda place: round(shared(place), 6))


def required(
    of: PictureCharacter, sounds: Sounds, grid: Grid
) -> tuple[dict[int, str], tuple[str, ...]]:
    """Return the shape that a place must show, and what could not be had.

    Parameters
    ----------
    of : PictureCharacter
    sounds : Sounds
    grid : Grid

    Returns
    -------
    dict of int to str
        Places and the labels of drawn shapes.
    tuple of str
        A note for each sound that found no place.
    """
    must: dict[int, str] = {}
    if sounds.known:
        rest = of.shown_for(of.rest)
        for start, end in sounds.silences(grid.end):
            if end - start >= of.timing.rest_after:
                must.update(dict.fromkeys(_quiet_places(start, end, grid), rest))
    placed: list[tuple[int, int, str]] = []
    lost = []
    for label, wanted in of.reach.items():
        shape = of.shown_for(wanted)
        if shape != wanted and label != CLOSED:
            continue  # it is not drawn: what is nearest will do
        for number, (sound, start, end) in enumerate(sounds.rows):
            if sound != label or end <= 0 or start >= grid.end:
                continue
            place = _free(placed, number, shape, start, end, grid)
            if place is None:
                lost.append(f"no drawing is left for {shape} at {start:.2f} s")
            else:
                insort(placed, (number, place, shape))
    must.update({place: shape for _, place, shape in placed})
    return must, tuple(lost)


def _quiet_places(start: float, end: float, grid: Grid) -> range:
    """Return the places well inside a silence; the middle one where there is none."""
    first = start + (SETTLING if start > 0 else 0.0)
    last = end - (SETTLING + grid.lead if end < grid.end - 1e-9 else 0.0)
    inside = range(math.ceil(first / grid.step - 1e-6), math.floor(last / grid.step + 1e-6))
    if inside:
        return inside
    middle = min(int(0.5 * (first + last) / grid.step), grid.count - 1)
    return range(middle, middle + 1)


def _free(
    placed: list[tuple[int, int, str]],
    number: int,
    shape: str,
    start: float,
    end: float,
    grid: Grid,
) -> int | None:
    """Return a place on a phone, or beside it, that keeps the order of phones; or None."""
    least, most = 0, grid.count - 1
    index = bisect_left(placed, (number,))
    if index:
        _, before, other = placed[index - 1]
        least = before + (other != shape)
    if index < len(placed):
        _, after, other = placed[index]
        most = after - (other != shape)
    near = grid.touching(start, end)
    least, most = max(least, near.start - 1), min(most, near.stop)
    return min(max(grid.place(start, end), least), most) if least <= most else None
