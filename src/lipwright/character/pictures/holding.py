"""From smooth controls to pictures that are held: the cheapest sequence of drawings.

Which shape is shown when is found by dynamic programming over the whole line: each drawing
costs the distance between its picture and the curves, each change of shape costs a little,
and no shape is shown for less than the shortest hold. What sounds demand (closed lips, teeth
on the lip, rest) goes before the hold: where two closures are too near for it, the drawing
between them is shorter. Linear in the frames.
"""

from __future__ import annotations

import math
from functools import partial

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.character.pictures.drawing import pictures_of
from lipwright.character.pictures.picture_file import PictureCharacter, Shape
from lipwright.character.pictures.sounds import Grid, Sounds, required
from lipwright.performance import Cues
from lipwright.phones import SILENCE

Floats = NDArray[np.float64]

CHANGE = 0.0008
"""What a change of shape costs: squared weights times seconds."""
ELSEWHERE = 0.4
"""What a shape costs, per second, where none of the sounds is that it is drawn for."""
TENSE = 0.1
"""What a shape costs, per second, in a pause in which it would relax."""
SAMPLES = 100.0
"""At how many instants per second the curves are looked at."""
_SHORT, _NEVER = 1e6, 1e12


def hold(animation: Animation, of: PictureCharacter, end: float) -> Cues:
    """Return the shapes of a line, held.

    Parameters
    ----------
    animation : Animation
        The controls that the shapes lie among, with the line's phones.
    of : PictureCharacter
    end : float
        The end of the line in seconds; the cues go on to the end of the drawing there.

    Raises
    ------
    CharacterError
        If the shapes do not lie among the animation's controls.
    """
    of.check_controls(animation.controls)
    timing = of.timing
    step = timing.on / timing.fps
    count = max(1, math.ceil(end / step - 1e-6))
    grid = Grid(count, step, timing.seconds(timing.lead))
    sounds = Sounds.of(animation)
    must, lost = required(of, sounds, grid)
    costs = _costs(animation, of, sounds, grid)
    for place, label in must.items():
        costs[place, [name != label for name in of.drawn]] = _NEVER
    starts, shapes = cheapest(costs, min(timing.drawings(), count))
    return Cues(
        of.name,
        tuple(of.drawn[shape] for shape in shapes),
        tuple(start * timing.on for start in starts),
        count * timing.on,
        timing.fps,
        of.shown_for(of.rest),
        partial(pictures_of, of),
        lost,
    )


def _costs(animation: Animation, of: PictureCharacter, sounds: Sounds, grid: Grid) -> Floats:
    """Return what each drawn shape costs in each place, (N, S)."""
    each = int(max(2, math.ceil(grid.step * SAMPLES)))
    times: Floats = grid.lead + grid.step * (np.arange(grid.count * each) + 0.5) / each
    near = animation.at(times).reshape(grid.count, each, -1)
    means, squares = near.mean(axis=1), (near**2).mean(axis=1)
    edges: Floats = grid.lead + grid.step * np.arange(grid.count + 1, dtype=np.float64)
    quiet = sounds.coverage([SILENCE], edges, grid.end) if sounds.known else None
    costs = np.full((grid.count, len(of.drawn)), np.inf)
    for shape in of.shapes:
        cost = _distance(shape, animation.controls, of, means, squares)
        if sounds.known and shape.only:
            cost += ELSEWHERE * (1 - sounds.coverage(shape.only, edges, grid.end))
        if quiet is not None and of.relax.get(shape.label, shape.label) != shape.label:
            cost += TENSE * quiet
        column = of.drawn.index(of.shown_for(shape.label))
        np.minimum(costs[:, column], cost, out=costs[:, column])
    return costs * grid.step


def _distance(
    shape: Shape, controls: tuple[str, ...], of: PictureCharacter, means: Floats, squares: Floats
) -> Floats:
    """Return the mean squared distance of the curves from the nearest of a shape's points."""
    named = {control for one in of.shapes for point in one.at for control in point}
    weights = np.array([of.weights.get(c, 1.0) if c in named else 0.0 for c in controls])
    points = np.array([[point.get(control, 0.0) for control in controls] for point in shape.at])
    distances = (squares @ weights)[:, None] - 2 * means @ (weights * points).T
    nearest: Floats = (distances + (points**2 @ weights)).min(axis=1)
    return nearest


def cheapest(costs: Floats, shortest: int) -> tuple[list[int], list[int]]:
    """Return the cheapest sequence of shapes.

    Parameters
    ----------
    costs : (N, S) float64
        What each shape costs in each place.
    shortest : int
        Places that a shape is held at least; it is held for less only where costs of
        :data:`_NEVER` leave no other way.

    Returns
    -------
    starts : list of int
        The place at which each shape starts.
    shapes : list of int
        Each one's column of ``costs``; neighbours differ.
    """
    count, width = costs.shape
    # A row for each age of a shape: held for 1, 2, ... and at least `shortest` places.
    old, new = np.full((shortest, width), np.inf), np.empty((shortest, width))
    old[0] = costs[0]
    lacking = _SHORT * np.arange(shortest - 1, -1, -1.0)[:, None]
    begun = np.zeros((count, width), np.int32)  # when those of the last row began
    leaving = np.zeros(count, np.int32)
    for place in range(1, count):
        left = (old + lacking).ravel()
        leaving[place] = best = int(left.argmin())
        enter = left[best] + CHANGE
        ripe = old[-2] if shortest > 1 else enter
        np.minimum(old[-1], ripe, out=new[-1])
        begun[place] = np.where(old[-1] <= ripe, begun[place - 1], place - shortest + 1)
        if shortest > 1:
            new[1:-1] = old[:-2]
            new[0] = enter
        new += costs[place] - enter  # counted from the best, so that sums stay small
        old, new = new, old
    return _trace(old + lacking, begun, leaving)


def _trace(
    held: Floats, begun: NDArray[np.int32], leaving: NDArray[np.int32]
) -> tuple[list[int], list[int]]:
    """Return starts and shapes, followed back from the end."""
    shortest, width = held.shape
    starts: list[int] = []
    shapes: list[int] = []
    place, best = len(begun) - 1, int(held.argmin())
    while True:
        age, shape = divmod(best, width)
        start = place - age if age < shortest - 1 else int(begun[place, shape])
        starts.append(start)
        shapes.append(shape)
        if start == 0:
            return starts[::-1], shapes[::-1]
        place, best = start - 1, int(leaving[start])
