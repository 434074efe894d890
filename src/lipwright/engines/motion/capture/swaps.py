"""Swapped labels: found where two markers jump into each other's paths, and put right.

Works on a still head, where a marker's place is its place among the others. A label that
jumps is held against the paths that are free at that instant: those of the other labels
that jump, and of markers not seen. A path goes on where its last place, carried along by
the markers around it, would have it. Which label a path bears in the end, its majority of
frames decides: labels swapped for the whole take cannot be told.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.capture.around import Indices, distances, neighbours, shared
from lipwright.engines.motion.capture.head import median
from lipwright.engines.motion.capture.motion import Floats
from lipwright.engines.motion.capture.spikes import HALF

SUSPECT = 0.4
"""A jump counts from this share of the way to the nearest other marker."""
LEAST = 1e-3
"""Metres: smaller jumps never count."""
CLEARLY = 0.5
"""Another's path must be nearer than its own by this factor."""
_STRAYS, _FARTHEST = 0.05, 2.0
_AT_ONCE = 2048


@dataclass(frozen=True, slots=True)
class Swap:
    """Frames in which labels were swapped.

    Parameters
    ----------
    labels : tuple of str
    first, last : int
        Frames, the last exclusive.
    """

    labels: tuple[str, ...]
    first: int
    last: int


def find_swaps(points: Floats, labels: Sequence[str]) -> tuple[Indices, list[Swap]]:
    """Find which label each marker's path bears in each frame.

    Parameters
    ----------
    points : (T, M, 3) float64
        On a still head; NaN where a marker was not seen.
    labels : sequence of str

    Returns
    -------
    order : (T, M) int
        The column in which each marker stands: ``points[t, order[t]]`` is put right.
    swaps : list of Swap
    """
    tangle = _Tangle(points)
    changes = [(0, tangle.path_of.copy())]
    for frame in tangle.frames():
        if tangle.step(frame):
            changes.append((frame, tangle.path_of.copy()))
    return _named(changes, np.isfinite(points[:, :, 0]), labels)


class _Tangle:
    """Paths followed from event to event; ``path_of[label]`` is the path a label bears."""

    def __init__(self, points: Floats) -> None:
        self.points = points
        count = points.shape[1]
        self.seen = np.isfinite(points[:, :, 0])
        steps = np.arange(len(points))[:, None]
        self.last = np.maximum.accumulate(np.where(self.seen, steps, -1), axis=0)
        home = median(points)
        self.around = neighbours(home)
        nearest = distances(home).min(axis=1)
        self.reach = np.maximum(SUSPECT * np.where(np.isfinite(nearest), nearest, 0.0), LEAST)
        self.path_of = np.arange(count)
        self.since = np.zeros(count, dtype=np.intp)
        self.kept: dict[int, tuple[Floats, int]] = {}
        self.suspect = np.concatenate(
            [self._jumps(at, at + _AT_ONCE) for at in range(0, len(points), _AT_ONCE)]
        )

    def _jumps(self, first: int, last: int) -> NDArray[np.bool_]:
        """Tell, for some frames, which labels leave their places and their neighbours."""
        here = self.points[first:last]
        before = self.last[np.maximum(np.arange(first, first + len(here)) - 1, 0)]
        place = np.take_along_axis(self.points, np.maximum(before, 0)[:, :, None], axis=0)
        move = here - place
        far = np.minimum(
            np.linalg.norm(move, axis=2), np.linalg.norm(move - shared(move, self.around), axis=2)
        )
        return np.asarray(self.seen[first:last] & (before >= 0) & (far > self.reach))

    def frames(self) -> list[int]:
        """Frames in which a label jumps."""
        return [int(frame) for frame in np.flatnonzero(self.suspect.any(axis=1))]

    def step(self, frame: int) -> bool:
        """Give the labels that jump in a frame their paths; tell whether any changed."""
        jumping = np.array(
            [a for a in np.flatnonzero(self.suspect[frame]) if self._stays(int(a), frame)],
            dtype=np.intp,
        )
        if not len(jumping):
            return False
        free = np.flatnonzero(self.suspect[frame] | ~self.seen[frame])
        places = np.stack([self._expected(int(label), frame) for label in free])
        here = self.points[frame, jumping]
        far = np.linalg.norm(here[:, None] - places[None], axis=2)
        far[~np.isfinite(far)] = np.inf
        own = far[np.arange(len(jumping)), np.searchsorted(free, jumping)]
        unseen = frame - 1 - np.array([self._last(int(label), frame)[1] for label in free])
        gate = self.reach[free] * np.minimum(1 + _STRAYS * unseen, _FARTHEST)
        taken = self._matched(far, own, gate, jumping, free)
        if not taken:
            return False
        self._change(taken, free, frame)
        return True

    def _stays(self, label: int, frame: int) -> bool:
        """Whether a label that jumps is still there after the frames that a spike may last."""
        after = slice(frame + 1, frame + 1 + HALF)
        later = self.points[after, label][self.seen[after, label]]
        if not len(later):
            return True
        before = self.points[self.last[frame - 1, label], label]
        here = self.points[frame, label]
        return bool(np.linalg.norm(later[-1] - here) < np.linalg.norm(later[-1] - before))

    def _matched(
        self, far: Floats, own: Floats, gate: Floats, jumping: Indices, free: Indices
    ) -> dict[int, int]:
        """Return for labels the labels whose paths they take, the nearest first."""
        taken: dict[int, int] = {}
        for flat in np.argsort(far, axis=None, kind="stable"):
            i, j = divmod(int(flat), far.shape[1])
            label, other = int(jumping[i]), int(free[j])
            if far[i, j] > gate[j] or label in taken or other in taken.values():
                continue
            if label == other or far[i, j] < CLEARLY * own[i]:
                taken[label] = other
        return {} if all(a == b for a, b in taken.items()) else taken

    def _expected(self, label: int, frame: int) -> Floats:
        """Where the path that a label bears should be: its last place, carried along."""
        place, at = self._last(label, frame)
        if at < 0:
            return np.full(3, np.nan)
        around = [
            m
            for m in self.around[label]
            if self.seen[at, m] and self.seen[frame, m] and not self.suspect[frame, m]
        ]
        if not around:
            return place
        return np.asarray(place + np.mean(self.points[frame, around] - self.points[at, around], 0))

    def _last(self, label: int, frame: int) -> tuple[Floats, int]:
        at = int(self.last[frame - 1, label])
        if at >= self.since[label]:
            return self.points[at, label], at
        return self.kept.get(int(self.path_of[label]), (np.full(3, np.nan), -1))

    def _change(self, taken: dict[int, int], free: Indices, frame: int) -> None:
        involved = {a for pair in taken.items() for a in pair if pair[0] != pair[1]}
        moving = {a: b for a, b in taken.items() if a in involved}
        losers = [a for a in free.tolist() if a in involved and a not in moving]
        left = [a for a in free.tolist() if a in involved and a not in moving.values()]
        moving |= dict(zip(losers, left, strict=True))
        paths = {a: int(self.path_of[b]) for a, b in moving.items()}
        for label in moving:
            self.kept[int(self.path_of[label])] = self._last(label, frame)
        for label, path in paths.items():
            self.path_of[label], self.since[label] = path, frame


def _named(
    changes: list[tuple[int, Indices]], seen: NDArray[np.bool_], labels: Sequence[str]
) -> tuple[Indices, list[Swap]]:
    """Let each path bear the label it has in most frames."""
    length, count = seen.shape
    ends = [frame for frame, _ in changes[1:]] + [length]
    borne = np.zeros((count, count))
    for (first, path_of), end in zip(changes, ends, strict=True):
        borne[path_of, np.arange(count)] += seen[first:end].sum(axis=0) + 1e-6 * (end - first)
    name = np.full(count, -1)
    for flat in np.argsort(-borne, axis=None, kind="stable"):
        path, label = divmod(int(flat), count)
        if name[path] < 0 and label not in name:
            name[path] = label
    order = np.empty((length, count), dtype=np.intp)
    swaps = []
    for (first, path_of), end in zip(changes, ends, strict=True):
        column = np.empty(count, dtype=np.intp)
        column[name[path_of]] = np.arange(count)
        order[first:end] = column
        for cycle in _cycles(column):
            swaps.append(Swap(tuple(labels[i] for i in cycle), first, end))
    return order, _joined(swaps)


def _cycles(column: Indices) -> list[list[int]]:
    found, done = [], set()
    for start in np.flatnonzero(column != np.arange(len(column))).tolist():
        cycle, at = [], start
        while at not in done:
            done.add(at)
            cycle.append(at)
            at = int(column[at])
        if cycle:
            found.append(cycle)
    return found


def _joined(swaps: list[Swap]) -> list[Swap]:
    """One entry for a swap that goes on while others come and go."""
    joined: list[Swap] = []
    for swap in swaps:
        before = next(
            (i for i, a in enumerate(joined) if a.labels == swap.labels and a.last == swap.first),
            None,
        )
        if before is None:
            joined.append(swap)
        else:
            joined[before] = Swap(swap.labels, joined[before].first, swap.last)
    return joined
