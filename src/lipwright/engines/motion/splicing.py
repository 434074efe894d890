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

from collections.abc import Callable, Sequence
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
    places = np.flatnonzero(~follows)
    shown = [pairs(wanted[n], wanted[n + 1]) for n in places.tolist()]
    likest = _likest(data, before[places], after[places], shown)
    return [
        Splice(
            phone=n + 1,
            time=float(course.spans[n + 1, 0]),
            before=int(before[n]),
            after=int(after[n]),
            pair=pair,
        )
        for n, pair in zip(places.tolist(), likest.tolist(), strict=True)
    ]


def blend(
    data: Recorded,
    courses: Sequence[Course],
    splices: Sequence[Sequence[Splice]],
    times: Floats,
    own: Floats,
) -> Floats:
    """Return frames in which the units of each course go over into one another.

    Parameters
    ----------
    data : Recorded
    courses : sequence of Course
        M of them.
    splices : sequence of sequence of Splice
        Of each course.
    times : (T,) float64
        Seconds of the frames.
    own : (M, T, K) float64
        Each frame as its own unit has it.
    """
    spliced = [number for number, some in enumerate(splices) if some]
    if not spliced:
        return own
    sides = [
        [_side(data, courses[number], splices[number], times, behind) for behind in (0, 1)]
        for number in spliced
    ]
    flat = [side for both in sides for side in both]
    # Frames of all courses at once: each look-up costs more than what it looks up.
    other = at(data, *(np.concatenate([getattr(side, name) for side in flat]) for name in _PLACES))
    parts = iter(np.split(other, np.cumsum([len(side.rows) for side in flat])[:-1]))
    mixed = own.copy()
    for number, both in zip(spliced, sides, strict=True):
        mixed[number] = _mixed(own[number], both, [next(parts), next(parts)])
    return mixed


_PLACES = ("positions", "low", "high")


@dataclass(frozen=True, slots=True, eq=False)
class _Side:
    """What splices add to the frames before them, or to those behind them."""

    rows: Ints
    positions: Floats  # in the database
    low: Ints
    high: Ints
    weight: Floats


def _side(
    data: Recorded, course: Course, splices: Sequence[Splice], times: Floats, behind: int
) -> _Side:
    """Return what all splices add to the frames before them (0), or behind them (1)."""
    seam = np.array([splice.time for splice in splices])
    phone = np.array([splice.phone for splice in splices])
    pair = np.array([splice.pair for splice in splices])
    lengths = np.minimum(np.diff(course.spans, axis=1)[:, 0], REACH)
    reach = (lengths[phone - 1], lengths[phone])
    begin, end = (seam, seam + reach[1]) if behind else (seam - reach[0], seam)
    first = np.searchsorted(times, begin)
    count = np.searchsorted(times, end) - first
    of = np.repeat(np.arange(len(splices)), count)
    rows = np.arange(len(of)) + (first - np.cumsum(count) + count)[of]
    away = np.abs(times[rows] - seam[of])
    shown = (pair >= 0)[of]
    unit = np.array([splice.before if behind else splice.after for splice in splices])
    unit = np.where(pair >= 0, pair + behind, unit)
    spans = np.asarray(data.spans[unit], np.float64)
    start, stop = course.spans[phone - 1 + behind].T
    share = (times[rows] - start[of]) / (stop - start)[of]
    along = spans[of, 0] + share * (spans[:, 1] - spans[:, 0])[of]
    carried = spans[of, behind] + (times[rows] - seam[of]) * data.rate
    weight = np.where(
        shown, 1 - away / reach[behind][of], (reach[behind][of] - away) / (reach[0] + reach[1])[of]
    )
    low, high = take_bounds(data, unit)
    return _Side(rows, np.where(shown, along, carried) - 0.5, low[of], high[of], weight)


def _mixed(own: Floats, sides: Sequence[_Side], other: Sequence[Floats]) -> Floats:
    """Mix each frame with what the splices before and after it bring."""
    shares, brought = np.zeros((2, len(own))), np.zeros((2, *own.shape))
    for number, side in enumerate(sides):
        shares[number, side.rows] = side.weight
        brought[number, side.rows] = other[number]
    after, before = shares
    # One weight alone is as published; of two, neither may undo the other at its own end.
    parts = np.stack((after * (1 - before), before * (1 - after), (1 - after) * (1 - before)))
    parts /= parts.sum(axis=0)
    result: Floats = (
        parts[0][:, None] * brought[0] + parts[1][:, None] * brought[1] + parts[2][:, None] * own
    )
    return result


def _likest(
    data: Recorded, before: Ints, after: Ints, found: Sequence[NDArray[np.integer]]
) -> Ints:
    """Return, of each splice's pairs, that whose motion is most like the two units'; or -1."""
    result = np.full(len(found), -1)
    some = np.flatnonzero([len(one) > 0 for one in found])
    if not len(some):
        return result
    tried = [evenly(np.asarray(found[n], np.int64), COMPARED) for n in some.tolist()]
    counts = np.array([len(one) for one in tried])
    every, starts = np.concatenate(tried), np.cumsum(counts) - counts
    apart = np.zeros(len(every))
    for unit, other in ((before, every), (after, every + 1)):
        own = np.repeat(data.frames[_picked(data, unit[some])], counts, axis=0)
        apart += ((data.frames[_picked(data, other)] - own) ** 2).sum(axis=(1, 2))
    least = np.flatnonzero(apart == np.repeat(np.minimum.reduceat(apart, starts), counts))
    result[some] = every[least[np.searchsorted(least, starts)]]
    return result


def _picked(data: Recorded, units: Ints) -> Ints:
    """First, middle and last frame of each unit, (N, 3)."""
    first, last = data.first[units], data.last[units] - 1
    return np.stack((first, (first + last) // 2, last), axis=1).astype(np.int64)
