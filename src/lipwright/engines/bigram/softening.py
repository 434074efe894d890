"""Stage 6 and 7: from keys to a smooth curve, sampled at a rate (DESIGN section 4).

``soften`` convolves the keys with a triangle, the linear B-spline kernel, of a half-width
per pose: the result is a cubic spline with two continuous derivatives, it keeps ranges
and slope limits exactly, and is computed in closed form: each key adds, within one
half-width, ``(bend / 6 h^2) * (h - |t - key|)^3``, where ``bend`` is the change of slope.

``bspline`` takes the keys as the control polygon of a cubic B-spline, as published: a
lone peak of 1 becomes 0.67. ``pchip`` goes through the keys, shape preserved (Fritsch and
Carlson 1980). ``linear`` is the keys themselves.
"""

from __future__ import annotations

import numpy as np

from lipwright.engines.bigram.model import Pose
from lipwright.engines.bigram.polyline import Axis, Floats, Ints, Line

HALVINGS = 30


def sample(
    line: Line,
    axis: Axis,
    poses: tuple[Pose, ...],
    first: float,
    count: int,
    rate: float,
    kind: str,
) -> Floats:
    """Return the curve near the keys at ``first + k / rate``, (P, T).

    Parameters
    ----------
    line : pair of (N,) float64
        Keys of all poses on the axis.
    axis : Axis
    poses : tuple of Pose
        Of the axis' blocks.
    first : float
        Seconds of the first sample.
    count : int
        T, how many samples.
    rate : float
        Samples per second.
    kind : {"soften", "bspline", "pchip", "linear"}
    """
    grid = _Grid(axis, first - axis.base, count, rate)
    if kind == "pchip":
        return _pchip(line, grid)
    if kind == "bspline":
        return _bspline(line, grid)
    values = _linear(line, grid)
    if kind == "soften":
        half = np.array([pose.softness for pose in poses])
        values += _bends(line, grid, half)
        np.clip(values, 0.0, 1.0, out=values)
    return values


class _Grid:
    """Sample times on the axis, the same in every block."""

    def __init__(self, axis: Axis, offset: float, count: int, rate: float) -> None:
        self.axis, self.offset, self.count, self.rate = axis, offset, count, rate

    def times(self) -> Floats:
        """All sample times on the axis, (P * T,)."""
        own = self.offset + np.arange(self.count) / self.rate
        blocks = np.arange(self.axis.count) * self.axis.width
        return (blocks[:, None] + own[None, :]).ravel()

    def counts(self, times: Floats) -> Ints:
        """How many samples lie in each interval between neighbouring keys."""
        block = self.axis.block_of(times)
        own = times - block * self.axis.width - self.offset
        index = np.ceil(own * self.rate - 1e-9).clip(0, self.count).astype(np.int64)
        firsts = block * self.count + index
        firsts[0], firsts[-1] = 0, self.axis.count * self.count
        return np.diff(firsts)

    def shaped(self, values: Floats) -> Floats:
        """Reshape to (P, T)."""
        return values.reshape(self.axis.count, self.count)


def _linear(line: Line, grid: _Grid) -> Floats:
    times, values = line
    counts = grid.counts(times)
    slope = np.diff(values) / np.diff(times)
    level = values[:-1] - slope * times[:-1]
    sampled = grid.times()
    sampled *= np.repeat(slope, counts)
    sampled += np.repeat(level, counts)
    return grid.shaped(sampled)


def _bends(line: Line, grid: _Grid, half: Floats) -> Floats:
    """What convolution with each pose's triangle adds to the samples."""
    times, values = line
    slope = np.diff(values) / np.diff(times)
    bend = np.diff(slope)
    times = times[1:-1]
    block = grid.axis.block_of(times)
    width = half[block]
    own = times - block * grid.axis.width - grid.offset
    low = np.ceil((own - width) * grid.rate).clip(0, grid.count).astype(np.int64)
    high = (np.floor((own + width) * grid.rate) + 1).clip(0, grid.count).astype(np.int64)
    counts = np.where((width > 0) & (np.abs(bend) > 1e-12), high - low, 0)
    scale = np.divide(bend, 6 * width**2, out=np.zeros_like(bend), where=width > 0)
    # Each key's samples one after the other; in place, since memory is what costs here.
    shift = low - (np.cumsum(counts) - counts)
    index = np.arange(counts.sum())
    depth: Floats = index / grid.rate
    depth += np.repeat(shift / grid.rate - own, counts)
    np.abs(depth, out=depth)
    np.subtract(np.repeat(width, counts), depth, out=depth)
    np.maximum(depth, 0.0, out=depth)
    added: Floats = depth * depth
    added *= depth
    added *= np.repeat(scale, counts)
    index += np.repeat(shift + block * grid.count, counts)
    total = grid.axis.count * grid.count
    summed = np.bincount(index, weights=added, minlength=total)
    return grid.shaped(summed.astype(np.float64, copy=False))


def _pchip(line: Line, grid: _Grid) -> Floats:
    times, values = line
    step = np.diff(times)
    slope = np.diff(values) / step
    tangent = np.zeros_like(values)
    before, after = slope[:-1], slope[1:]
    near, far = 2 * step[1:] + step[:-1], step[1:] + 2 * step[:-1]
    product = before * after
    np.divide(
        (near + far) * product,
        near * after + far * before,
        out=tangent[1:-1],
        where=product > 0,
    )
    left = np.repeat(np.arange(len(step)), grid.counts(times))
    t = grid.times() - times[left]
    square = (3 * slope - 2 * tangent[:-1] - tangent[1:]) / step
    cube = (tangent[:-1] - 2 * slope + tangent[1:]) / step**2
    return grid.shaped(values[left] + t * (tangent[left] + t * (square[left] + t * cube[left])))


def _bspline(line: Line, grid: _Grid) -> Floats:
    """Uniform cubic B-spline with the keys as control points, solved for time."""
    times, values = line
    x = np.concatenate((times[:1], times[:1], times, times[-1:], times[-1:]))
    y = np.concatenate((values[:1], values[:1], values, values[-1:], values[-1:]))
    joints = (x[:-2] + 4 * x[1:-1] + x[2:]) / 6
    where = grid.times()
    left = np.clip(np.searchsorted(joints, where, side="right") - 1, 0, len(joints) - 2)
    u = _solve(x, left, where)
    return grid.shaped(np.clip(_cubic(y, left, u), 0.0, 1.0))


def _cubic(points: Floats, left: Ints, u: Floats) -> Floats:
    a, b, c, d = (points[left + i] for i in range(4))
    v = 1 - u
    return (v**3 * a + (3 * u**3 - 6 * u**2 + 4) * b + (3 * v**3 - 6 * v**2 + 4) * c + u**3 * d) / 6


def _solve(x: Floats, left: Ints, where: Floats) -> Floats:
    """Bisection on the monotone x(u); 30 halvings reach 1e-9 of an interval."""
    low, high = np.zeros(len(where)), np.ones(len(where))
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        before = _cubic(x, left, middle) < where
        low = np.where(before, middle, low)
        high = np.where(before, high, middle)
    return 0.5 * (low + high)
