"""Splices: how two units that were never neighbours go over into one another.

Cao et al. 2004, section 6.3, *Blending*. Where the recordings hold the same two phones one
after the other, that pair shows how the first goes over into the second: the first unit is
blended with the pair's first half, the pair's second half with the second unit, each half
brought evenly to its phone's time. Else the first unit is carried on by what follows it in
its take, the second is led up to by what comes before it in its own, and the two are
blended over both phones.

Weights are of the instant, not of the number of the frame, so that the result does not hang
on the frame rate. Of a long phone, a silence above all, at most ``REACH`` next to the splice
belongs to it. In a unit with a splice on either side the two weights share fairly: at each
end they are as published.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.closures import evenly
from lipwright.engines.motion.recorded import Floats, Ints, Recorded, at, take_bounds

REACH = 0.2
"""Seconds on either side that a splice may take."""
COMPARED = 64
"""Pairs of units that are compared where the recordings hold more."""

Pairs = Callable[[int, int], NDArray[np.integer]]
"""``pairs(a, b)``: units of label ``a`` whose successor in their take has label ``b``."""


@dataclass(frozen=True, slots=True)
class Splice:
    """One jump of a result.

    Parameters
    ----------
    phone : int
        Number of the phone after it.
    time : float
        Seconds.
    before, after : int
        The units.
    pair : int
        First unit of the recorded pair that shows the way; -1 where there is none.
    """

    phone: int
    time: float
    before: int
    after: int
    pair: int


@dataclass(frozen=True, slots=True, eq=False)
class Course:
    """Where each phone of a result comes from.

    Parameters
    ----------
    units : (N,) int64
    spans : (N, 2) float64
        Seconds of each phone; each begins where the one before it ends.
    spoken : (N,) str
        What the phones are, which with stand-ins is not what the units are.
    warps : (N, KNOTS) float64
        How each unit's time answers its phone's, see :mod:`lipwright.engines.motion.warping`.
    """

    units: Ints
    spans: Floats
    spoken: tuple[str, ...]
    warps: Floats


class PairTable:
    """All pairs of neighbouring units, found by their labels in logarithmic time.

    Parameters
    ----------
    data : Recorded
    """

    def __init__(self, data: Recorded) -> None:
        label, take = np.asarray(data.label, np.int64), np.asarray(data.take)
        self._count = len(data.labels)
        near = np.flatnonzero(take[1:] == take[:-1])
        keys = label[near] * self._count + label[near + 1]
        order = np.argsort(keys, kind="stable")
        self._keys, self._units = keys[order], near[order]

    def __call__(self, first: int, second: int) -> Ints:
        """Return the units of label ``first`` that a unit of label ``second`` follows."""
        key = first * self._count + second
        low, high = np.searchsorted(self._keys, [key, key + 1])
        return self._units[low:high]


def find_splices(data: Recorded, course: Course, pairs: Pairs) -> list[Splice]:
    """Return the places where neighbours in a result were none in a take.

    Parameters
    ----------
    data : Recorded
    course : Course
    pairs : callable
    """
    known = {label: number for number, label in enumerate(data.labels)}
    own = data.label[course.units].tolist()  # where the database has no such phone
    wanted = [known.get(label, number) for label, number in zip(course.spoken, own, strict=True)]
    before, after = course.units[:-1], course.units[1:]
    follows = (after == before + 1) & (data.take[before] == data.take[after])
    return [
        Splice(
            phone=n + 1,
            time=float(course.spans[n + 1, 0]),
            before=int(before[n]),
            after=int(after[n]),
            pair=_likest(data, int(before[n]), int(after[n]), pairs(wanted[n], wanted[n + 1])),
        )
        for n in np.flatnonzero(~follows).tolist()
    ]


def blend(
    data: Recorded, course: Course, splices: list[Splice], times: Floats, own: Floats
) -> Floats:
    """Return frames in which the units go over into one another.

    Parameters
    ----------
    data : Recorded
    course : Course
    splices : list of Splice
    times : (T,) float64
        Seconds of the frames.
    own : (T, K) float64
        Each frame as its own unit has it.
    """
    reached = [_Side.of(data, course, splice, times, left) for splice in splices for left in (1, 0)]
    if not reached:
        return own
    rows = np.concatenate([side.rows for side in reached])
    positions, low, high = (
        np.concatenate([getattr(side, name) for side in reached])
        for name in ("positions", "low", "high")
    )
    other = at(data, positions, low, high)
    weight = np.concatenate([side.weight for side in reached])
    behind = np.repeat([side.behind for side in reached], [len(side.rows) for side in reached])
    return _mixed(own, rows, other, weight, behind)


@dataclass(frozen=True, slots=True, eq=False)
class _Side:
    """What a splice adds to the frames on one side of it."""

    rows: Ints
    positions: Floats  # in the database
    low: Ints
    high: Ints
    weight: Floats
    behind: bool  # whether the splice lies behind these frames

    @classmethod
    def of(
        cls, data: Recorded, course: Course, splice: Splice, times: Floats, behind: int
    ) -> _Side:
        phone = splice.phone - 1 + behind
        start, end = course.spans[phone]
        reaches = [
            min(REACH, float(np.diff(course.spans[splice.phone - 1 + i])[0])) for i in (0, 1)
        ]
        seam, reach = splice.time, reaches[behind]
        near = (seam, seam + reach) if behind else (seam - reach, seam)
        rows = np.arange(*np.searchsorted(times, near))
        away = np.abs(times[rows] - seam)
        if splice.pair >= 0:
            unit = splice.pair + behind
            first, last = data.spans[unit]
            share = (times[rows] - start) / (end - start)
            positions = first + share * (last - first) - 0.5
            weight = 1 - away / reach
        else:
            unit = splice.before if behind else splice.after
            edge = data.spans[unit, behind]
            positions = edge + (times[rows] - seam) * data.rate - 0.5
            weight = (reach - away) / sum(reaches)
        low, high = (bound.repeat(len(rows)) for bound in take_bounds(data, np.array([unit])))
        return cls(rows, positions, low, high, weight, bool(behind))


def _mixed(
    own: Floats, rows: Ints, other: Floats, weight: Floats, behind: NDArray[np.bool_]
) -> Floats:
    """Mix each frame with what the splices before and after it bring."""
    shares, brought = np.zeros((2, len(own))), np.zeros((2, *own.shape))
    for side in (0, 1):
        mine = behind == bool(side)
        shares[side, rows[mine]] = weight[mine]
        brought[side, rows[mine]] = other[mine]
    after, before = shares
    # One weight alone is as published; of two, neither may undo the other at its own end.
    parts = np.stack((after * (1 - before), before * (1 - after), (1 - after) * (1 - before)))
    parts /= parts.sum(axis=0)
    result: Floats = (
        parts[0][:, None] * brought[0] + parts[1][:, None] * brought[1] + parts[2][:, None] * own
    )
    return result


def _likest(data: Recorded, before: int, after: int, found: NDArray[np.integer]) -> int:
    """Return the first unit of the pair whose motion is most like the two units'; or -1."""
    if not len(found):
        return -1
    tried = evenly(np.asarray(found, np.int64), COMPARED)
    apart = np.zeros(len(tried))
    for unit, other in ((before, tried), (after, tried + 1)):
        own = data.frames[_picked(data, np.array([unit]))]
        apart += ((data.frames[_picked(data, other)] - own) ** 2).sum(axis=(1, 2))
    return int(tried[apart.argmin()])


def _picked(data: Recorded, units: Ints) -> Ints:
    """First, middle and last frame of each unit, (N, 3)."""
    first, last = data.first[units], data.last[units] - 1
    return np.stack((first, (first + last) // 2, last), axis=1).astype(np.int64)
