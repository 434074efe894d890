"""Exact algebra of piecewise-linear functions on keys, all poses on one axis.

A function is a pair of arrays: ``times`` strictly increasing, ``values`` at them. The
curves of several poses lie behind one another on one axis, in blocks of equal width, so
that one numpy call serves all of them (:class:`Axis`). Each block starts and ends with
zeros. Nothing is sampled: where two functions cross, the crossing becomes a key.

Keys closer than ``SAME`` seconds are one key.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Line = tuple[Floats, Floats]

SAME = 1e-11
FLAT = 1e-12


@dataclass(frozen=True, slots=True)
class Axis:
    """Blocks of equal width, one for each pose.

    Parameters
    ----------
    base : float
        The second at which every block begins.
    width : float
        Seconds of a block, margins included.
    count : int
        How many blocks there are.
    """

    base: float
    width: float
    count: int

    def cut(self, line: Line, first: int, last: int) -> Line:
        """Return the keys of blocks ``first`` up to, without, ``last``."""
        times, values = line
        low, high = np.searchsorted(
            times, [first * self.width - SAME, last * self.width - SAME], side="left"
        )
        return times[low:high], values[low:high]

    def block_of(self, times: Floats) -> Ints:
        """Return the block that each instant on the axis lies in."""
        blocks = ((times + SAME) / self.width).astype(np.int64)
        return np.minimum(blocks, self.count - 1)

    def own(self, line: Line, block: int) -> Line:
        """Return one block's keys in seconds of the line itself."""
        times, values = self.cut(line, block, block + 1)
        return times - (block * self.width - self.base), values

    def onto(self, line: Line, source: int, target: int) -> Line:
        """Return block ``source`` moved onto block ``target``."""
        times, values = self.cut(line, source, source + 1)
        return times + (target - source) * self.width, values


def _distinct(times: Floats) -> NDArray[np.bool_]:
    keep = np.empty(len(times), dtype=bool)
    keep[:1] = True
    np.greater(times[1:], times[:-1] + SAME, out=keep[1:])
    return keep


def merge_equal(times: Floats, values: Floats, pick: Literal["max", "min"] = "max") -> Line:
    """Return keys with those at the same instant made one, the larger (smaller) kept."""
    keep = _distinct(times)
    if keep.all():
        return times, values
    starts = np.flatnonzero(keep)
    reduce = np.maximum if pick == "max" else np.minimum
    return times[starts], reduce.reduceat(values, starts)


def insert(line: Line, more: Line, pick: Literal["max", "min"] = "max") -> Line:
    """Return ``line`` with more keys in it."""
    if not len(more[0]):
        return line
    times = np.concatenate((line[0], more[0]))
    order = np.argsort(times, kind="stable")
    return merge_equal(times[order], np.concatenate((line[1], more[1]))[order], pick)


def crossings(times: Floats, one: Floats, other: Floats) -> Line:
    """Return where two functions with common key times cross between keys, and the value."""
    gap = one - other
    left = np.flatnonzero(gap[1:] * gap[:-1] < 0)
    share = gap[left] / (gap[left] - gap[left + 1])
    return (
        times[left] + share * (times[left + 1] - times[left]),
        one[left] + share * (one[left + 1] - one[left]),
    )


def combine(one: Line, other: Line, pick: Literal["max", "min"] = "max") -> Line:
    """Return the pointwise maximum (minimum) of two functions, crossings as keys."""
    times = np.concatenate((one[0], other[0]))
    times.sort(kind="stable")
    times = times[_distinct(times)]
    a, b = np.interp(times, *one), np.interp(times, *other)
    values = np.maximum(a, b) if pick == "max" else np.minimum(a, b)
    return insert((times, values), crossings(times, a, b), pick)


def prune(line: Line, tolerance: float = FLAT) -> Line:
    """Return the function without the keys that lie on the line of their neighbours."""
    times, values = line
    if len(times) < 3:
        return line
    share = (times[1:-1] - times[:-2]) / (times[2:] - times[:-2])
    straight = values[:-2] + share * (values[2:] - values[:-2])
    keep = np.ones(len(times), dtype=bool)
    np.greater(np.abs(straight - values[1:-1]), tolerance, out=keep[1:-1])
    # Of a run of nearly straight keys every other one stays: errors cannot add up.
    drop = ~keep
    drop[1:] &= ~(drop[:-1] & _odd_in_run(drop)[1:])
    return times[~drop], values[~drop]


def _odd_in_run(flags: NDArray[np.bool_]) -> NDArray[np.bool_]:
    index = np.arange(len(flags))
    last_false = np.maximum.accumulate(np.where(flags, -1, index))
    odd: NDArray[np.bool_] = (index - last_false) % 2 == 0
    return odd


def maxima(values: Floats) -> tuple[Ints, Ints]:
    """Return first and last index of every key or plateau that falls on both sides."""
    rise = values[1:] - values[:-1]
    moves = np.flatnonzero(np.abs(rise) > FLAT)
    up = rise[moves] > 0
    tops = np.flatnonzero(up[:-1] & ~up[1:])
    return moves[tops] + 1, moves[tops + 1]


def range_max(values: Floats, low: Ints, high: Ints) -> Floats:
    """Return the maximum of ``values[low:high]`` for each pair; -inf where it is empty."""
    result = np.full(len(low), -np.inf)
    full = high > low
    if full.any():
        padded = np.append(values, -np.inf)
        ends = np.stack((low[full], high[full]), axis=1).ravel()
        result[full] = np.maximum.reduceat(padded, ends)[::2]
    return result


def _falling_cone(line: Line, reach: Floats) -> Line:
    """Least of ``f(s) + (reach(t) - reach(s))`` over ``s <= t``, on keys."""
    times, values = line
    lowered = values - reach
    least = np.minimum.accumulate(lowered)
    result = least + reach
    left = np.flatnonzero((lowered[:-1] > least[:-1]) & (lowered[1:] < least[:-1]))
    if not len(left):
        return times, result
    share = (lowered[left] - least[left]) / (lowered[left] - lowered[left + 1])
    when = times[left] + share * (times[left + 1] - times[left])
    height = least[left] + reach[left] + share * (reach[left + 1] - reach[left])
    return insert((times, result), (when, height), "min")


def steepest_below(line: Line, axis: Axis, limits: Floats, first: int) -> Line:
    """Return the greatest function below ``line`` whose slope keeps each block's limit.

    Parameters
    ----------
    line : pair of (N,) float64
        Keys of blocks ``first``, ``first + 1``, … of the axis.
    axis : Axis
    limits : (B,) float64
        Greatest slope of each of these blocks, per second.
    first : int
        The block that the line begins with.
    """
    line = _falling_cone(line, _reach(line[0], axis, limits, first))
    mirrored = (-line[0][::-1], line[1][::-1])
    backward = _falling_cone(mirrored, -_reach(line[0], axis, limits, first)[::-1])
    return -backward[0][::-1], backward[1][::-1]


def _reach(times: Floats, axis: Axis, limits: Floats, first: int) -> Floats:
    """Time stretched by each block's limit, so that the limit is one everywhere."""
    if len(limits) == 1 or (limits == limits[0]).all():
        return times * limits[:1]
    block = axis.block_of(times) - first
    start = np.concatenate(([0.0], np.cumsum(limits * axis.width)))
    return start[block] + limits[block] * (times - (block + first) * axis.width)


def steepest_above(line: Line, axis: Axis, limits: Floats, first: int) -> Line:
    """Return the least function above ``line`` whose slope keeps the limit, at most 1."""
    times, values = steepest_below((line[0], 1.0 - line[1]), axis, limits, first)
    return times, np.clip(1.0 - values, 0.0, 1.0)


def hold(line: Line, by: float) -> Line:
    """Return the greatest value within ``by`` seconds on either side: peaks are held."""
    times, values = line
    if by <= 0:
        return line
    events = np.concatenate((times - by, times + by))
    events.sort(kind="stable")
    events = events[_distinct(events)]
    behind, ahead = np.interp(events - by, *line), np.interp(events + by, *line)
    shifted = insert((events, np.maximum(behind, ahead)), crossings(events, behind, ahead), "max")
    middle = 0.5 * (shifted[0][1:] + shifted[0][:-1])
    inner = range_max(
        values, np.searchsorted(times, middle - by), np.searchsorted(times, middle + by)
    )
    return prune(_raise_to_steps(shifted, inner))


def _raise_to_steps(line: Line, steps: Floats) -> Line:
    """Pointwise maximum of a function and a constant for each of its intervals."""
    times, values = line
    raised = values.copy()
    np.maximum(raised[:-1], steps, out=raised[:-1])
    np.maximum(raised[1:], steps, out=raised[1:])
    a, b = values[:-1] - steps, values[1:] - steps
    left = np.flatnonzero(a * b < 0)
    share = a[left] / (a[left] - b[left])
    return insert((times, raised), (times[left] + share * np.diff(times)[left], steps[left]))
