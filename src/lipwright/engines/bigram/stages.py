"""The stages of the bigram engine on keys: Figures 6 to 10 of Xu et al. 2013.

placed (red) → stitched (green, blue) → smoothed (yellow) → constrained (cyan) → limited
(magenta). All work exactly on piecewise-linear curves, all poses of a level at once
(:mod:`~lipwright.engines.bigram.polyline`). Softening and sampling follow in
:mod:`~lipwright.engines.bigram.softening`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from lipwright.engines.bigram.model import Pose, Rules
from lipwright.engines.bigram.polyline import (
    FLAT,
    Axis,
    Floats,
    Ints,
    Line,
    combine,
    crossings,
    hold,
    insert,
    maxima,
    merge_equal,
    prune,
    steepest_above,
    steepest_below,
)
from lipwright.engines.bigram.table import Placed

MARGIN = 0.05


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """Poses in the order in which they are solved.

    Poses of one level do not bound each other; a level is bounded only by those before
    it. Within a level those that widen come first.

    Parameters
    ----------
    poses : tuple of Pose
    levels : tuple of (first, middle, last)
        Numbers of the poses of each level: ``first..middle`` widen, ``middle..last`` are cut.
    bounds : tuple of (a, b, C)
        Pose number ``a`` bounds pose number ``b``.
    """

    poses: tuple[Pose, ...]
    levels: tuple[tuple[int, int, int], ...]
    bounds: tuple[tuple[int, int, float], ...]

    @classmethod
    def of(cls, rules: Rules) -> Plan:
        """Order a set's poses."""
        bounds = rules.bounds()
        level: dict[str, int] = {}
        for pose in sorted(rules.poses, key=lambda pose: -pose.priority):
            above = [level[high.name] for high, low, _ in bounds if low is pose]
            level[pose.name] = 1 + max(above) if above else 0

        def widens(pose: Pose) -> bool:
            # What a higher pose bounds cannot promise its peaks: it is cut like others.
            return pose.meets == "widen" and level[pose.name] == 0

        poses = sorted(rules.poses, key=lambda p: (level[p.name], not widens(p), -p.priority))
        levels = []
        for number in range(max(level.values()) + 1):
            members = [i for i, pose in enumerate(poses) if level[pose.name] == number]
            first, last = members[0], members[-1] + 1
            levels.append((first, first + sum(map(widens, poses[first:last])), last))
        names = [pose.name for pose in poses]
        numbered = tuple((names.index(a.name), names.index(b.name), c) for a, b, c in bounds)
        return cls(tuple(poses), tuple(levels), numbered)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the poses in this order."""
        return tuple(pose.name for pose in self.poses)

    def margin(self) -> float:
        """Seconds of room a block needs on each side for windows and slopes."""
        slowest = max((1 / pose.limit for pose in self.poses if pose.meets == "widen"), default=0)
        widest = max(max(pose.window, 2 * pose.softness) for pose in self.poses)
        return MARGIN + float(slowest) + widest


@dataclass(frozen=True, slots=True, eq=False)
class Stages:
    """Every stage's result for one line, all poses on one axis.

    Attributes
    ----------
    axis : Axis
    placed : Placed
    stitched, smoothed, constrained, limited : pair of (N,) float64
        Key times on the axis and weights.
    """

    axis: Axis
    placed: Placed
    stitched: Line
    smoothed: Line
    constrained: Line
    limited: Line


def run(
    placed: Placed,
    start: float,
    end: float,
    plan: Plan,
    rules: Rules,
    *,
    room: float = 0.0,
    added: Callable[[Axis], Iterable[Line]] = lambda axis: (),
) -> Stages:
    """Take placed keys through all stages.

    Parameters
    ----------
    placed : Placed
        Keys of ``plan``'s poses.
    start, end : float
        Seconds that the keys lie in.
    plan : Plan
        Of ``rules``.
    rules : Rules
    room : float
        Seconds before and after that edits may need.
    added : function
        Returns further curves on the axis, stitched in like those of bigrams.
    """
    margin = plan.margin() + room
    axis = Axis(start - margin, end - start + 2 * margin, len(plan.poses))
    stitched = stitch(placed, axis)
    for times, values in added(axis):
        edge = np.array([0.0]), np.array([axis.count * axis.width])
        line = np.concatenate((edge[0], times, edge[1])), np.concatenate(([0.0], values, [0.0]))
        stitched = combine(stitched, line)
    smoothed = smooth(stitched, axis, plan, rules)
    constrained, limited = bound(smoothed, axis, plan, rules)
    return Stages(axis, placed, stitched, smoothed, constrained, limited)


def _edges(axis: Axis) -> tuple[Floats, Floats]:
    """First and last instant of every block."""
    starts = np.arange(axis.count, dtype=np.float64) * axis.width
    return starts, starts + axis.width * (1 - 1e-9)


def stitch(placed: Placed, axis: Axis) -> Line:
    """Return the pointwise maximum of all placed curves (Figure 7).

    Bigrams overlap only their direct neighbours: the even ones and the odd ones are two
    functions without overlap.
    """
    edges, ends = _edges(axis)
    blocks = np.arange(axis.count, dtype=np.int16)
    lanes = []
    for parity in (0, 1):
        mine = (placed.bigram & 1) == parity
        pose = np.concatenate((blocks, placed.pose[mine], blocks))
        times = np.concatenate(
            (edges, placed.times[mine] - axis.base + placed.pose[mine] * axis.width, ends)
        )
        values = np.concatenate((0 * edges, placed.values[mine], 0 * ends))
        # Within a lane keys are in order of time already: only poses must be sorted.
        order = np.argsort(pose, kind="stable")
        lanes.append(merge_equal(times[order], values[order]))
    return _pruned(combine(lanes[0], lanes[1]), axis)


def _pruned(line: Line, axis: Axis) -> Line:
    """Drop keys on a straight line, but for the zeros at both ends of each block."""
    ends = np.sort(np.concatenate(_edges(axis)))
    return insert(prune(line), (ends, 0 * ends))


def smooth(stitched: Line, axis: Axis, plan: Plan, rules: Rules) -> Line:
    """Join maxima that lie close together by their chord (Figure 8)."""
    parts: list[Line] = []
    for first, _, last in plan.levels:
        line = axis.cut(stitched, first, last)
        stops: list[Line] = []
        if rules.settings.chords == "stop":
            stops = [
                _stop(parts, axis, a, b, threshold)
                for a, b, threshold in plan.bounds
                if first <= b < last
            ]
        windows = np.array([pose.window for pose in plan.poses])
        parts.append(_smooth(line, axis, windows, stops, rules.settings.valleys))
    return _joined(parts)


def _joined(parts: list[Line]) -> Line:
    return np.concatenate([p[0] for p in parts]), np.concatenate([p[1] for p in parts])


def _stop(parts: list[Line], axis: Axis, a: int, b: int, threshold: float) -> Line:
    """Stretches (starts, ends), on pose b's block, in which pose a is above half of C."""
    times, values = axis.onto(_joined(parts), a, b)
    gap = values - 0.5 * threshold
    up = np.flatnonzero((gap[:-1] <= 0) & (gap[1:] > 0))
    down = np.flatnonzero((gap[:-1] > 0) & (gap[1:] <= 0))
    crossed = []
    for left in (up, down):
        share = gap[left] / (gap[left] - gap[left + 1])
        crossed.append(times[left] + share * (times[left + 1] - times[left]))
    return crossed[0], crossed[1]


def _smooth(line: Line, axis: Axis, windows: Floats, stops: list[Line], valleys: str) -> Line:
    while True:
        times, values = line
        firsts, lasts = maxima(values)
        left, right = times[lasts[:-1]], times[firsts[1:]]
        block = axis.block_of(left)
        near = (right - left <= windows[block]) & (block == axis.block_of(right))
        near &= firsts[1:] > lasts[:-1] + 1  # a valley has keys
        for starts, ends in stops:
            before = np.searchsorted(ends, left, side="right")
            near &= np.searchsorted(starts, right, side="left") <= before
        lifted = _lift(line, lasts[:-1][near], firsts[1:][near], valleys)
        if lifted is None:
            return line
        line = lifted


def _lift(line: Line, lefts: Ints, rights: Ints, valleys: str) -> Line | None:
    """Draw the chords from keys ``lefts`` to keys ``rights`` at once; None if all are drawn."""
    times, values = line
    counts = rights - lefts + 1
    gap = np.repeat(np.arange(len(lefts)), counts)
    keys = lefts[gap] + np.arange(len(gap)) - np.repeat(np.cumsum(counts) - counts, counts)
    slope = (values[rights] - values[lefts]) / (times[rights] - times[lefts])
    chord = values[lefts][gap] + slope[gap] * (times[keys] - times[lefts][gap])
    below = chord - values[keys]
    below[(keys == lefts[gap]) | (keys == rights[gap])] = 0.0
    away = below > FLAT if valleys == "lift" else np.abs(below) > FLAT
    if not away.any():
        return None
    keep = np.ones(len(times), dtype=bool)
    keep[keys[away]] = False
    drawn = times[keep], values[keep]
    if valleys == "replace":
        return drawn
    cross = np.flatnonzero((below[1:] * below[:-1] < 0) & (gap[1:] == gap[:-1]))
    share = below[cross] / (below[cross] - below[cross + 1])
    here, there = keys[cross], keys[cross + 1]
    when = times[here] + share * (times[there] - times[here])
    height = values[here] + share * (values[there] - values[here])
    return insert(drawn, (when, height))


def bound(
    smoothed: Line, axis: Axis, plan: Plan, rules: Rules, *, held: bool = False
) -> tuple[Line, Line]:
    """Keep poses apart that exclude each other, and slopes below their limits.

    Sections 3.2.2 and 3.2.3, Figures 9 and 10. ``together``: in falling priority each pose
    takes the bound that the finished higher ones leave it, then a pose that widens becomes
    the least function above its curve that keeps the limit, held by its softness; any other
    the greatest below. ``in turn``: all bounds, then all limits, as published.

    Parameters
    ----------
    smoothed : Line
    axis : Axis
    plan : Plan
    rules : Rules
    held : bool
        Whether closures are held already, as when an edited line is solved again.

    Returns
    -------
    constrained, limited : Line
    """
    if rules.settings.solve == "in turn":
        constrained = _joined(_constrain_in_turn(smoothed, axis, plan, rules))
        limits = np.array([pose.limit for pose in plan.poses])
        return constrained, _pruned(steepest_below(constrained, axis, limits, 0), axis)
    finished: list[Line] = []
    bounded: list[Line] = []
    softens = rules.settings.spline == "soften" and not held
    for first, middle, last in plan.levels:
        wide = axis.cut(smoothed, first, middle)
        if middle > first:
            bounded.append(wide)
            finished.append(_widened(wide, axis, plan.poses[first:middle], first, softens))
        if last > middle:
            cut = _bounded(smoothed, finished, axis, plan, rules, middle, last)
            bounded.append(cut)
            limits = np.array([pose.limit for pose in plan.poses[middle:last]])
            finished.append(steepest_below(cut, axis, limits, middle))
    return _joined(bounded), _pruned(_joined(finished), axis)


def _widened(line: Line, axis: Axis, poses: tuple[Pose, ...], first: int, softens: bool) -> Line:
    limits = np.array([pose.limit for pose in poses])
    line = steepest_above(line, axis, limits, first)
    if not (softens and any(pose.softness for pose in poses)):
        return line
    held = []
    for number, pose in enumerate(poses, first):
        times, values = hold(axis.cut(line, number, number + 1), pose.softness)
        own = (times >= number * axis.width) & (times < (number + 1) * axis.width)
        held.append((times[own], values[own]))
    return merge_equal(*_joined(held))


def _bounded(
    smoothed: Line,
    finished: list[Line],
    axis: Axis,
    plan: Plan,
    rules: Rules,
    first: int,
    last: int,
) -> Line:
    """The blocks ``first..last`` under the bounds that finished poses leave them."""
    if not any(first <= b < last for _, b, _ in plan.bounds):
        return axis.cut(smoothed, first, last)
    above = _joined(finished)
    parts = []
    for number in range(first, last):
        line = axis.cut(smoothed, number, number + 1)
        for a, b, threshold in plan.bounds:
            if b == number:
                room = _room(axis.onto(above, a, b), threshold, rules.settings.bound)
                line = combine(line, room, "min")
        parts.append(line)
    return _joined(parts)


def _room(higher: Line, threshold: float, kind: str) -> Line:
    """What a pose of higher priority leaves to a lower one, on keys."""
    times, values = higher
    room = 1 - values / threshold if kind == "ramp" else threshold - values
    line = insert((times, room), crossings(times, room, np.zeros(len(times))))
    return line[0], np.maximum(line[1], 0.0)


def _constrain_in_turn(smoothed: Line, axis: Axis, plan: Plan, rules: Rules) -> list[Line]:
    parts = [axis.cut(smoothed, n, n + 1) for n in range(axis.count)]
    for a, b, threshold in plan.bounds:
        times, values = parts[a]
        moved = (times + (b - a) * axis.width, values)
        parts[b] = combine(parts[b], _room(moved, threshold, rules.settings.bound), "min")
    return parts
