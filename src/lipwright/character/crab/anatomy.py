"""Where each vertex belongs: the fields over a part from which the poses take their clusters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.character.clusters import step
from lipwright.character.crab.body import BAG_LOOPS, Body

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Anatomy:
    """The fields of one part; each (V,), 0..1 unless said otherwise.

    Parameters
    ----------
    points : (V, 3) float64, metres
    plate : 0..1
        How much the vertex goes with the lower plate of the mouth.
    near : 0..1
        1 on the rims of the mouth, falling over the face around them.
    above, below, corner : 0..1
        1 in the middle of the upper edge, of the lower plate's edge, at the corners.
    rim : 0..1
        1 where upper edge and plate meet, and inside; 0 on the outside.
    flap : 0..1
        The inner side of the plate's edge, which presses up behind the upper edge.
    mandible : -1..1
        1 on the left mandible, -1 on the right one, less at their roots.
    teeth : -1, 0, 1
        1 on the upper row of teeth, -1 on the lower one.
    tongue : 0..1
        Share of the tongue's length, 1 at the tip; NaN elsewhere.
    stalk : (2, V) 0..1
        How much the vertex goes with the left and the right eye.
    ball : -1, 0, 1
        1 on the left eyeball, -1 on the right one.
    lid : (2, V) float64, degrees
        How far the vertex turns about its eyeball to close the eye.
    arm : (2, V) 0..1
        How much the vertex goes with the left and the right claw.
    finger : (2, V) 0..1
        The moving finger of each claw.
    """

    points: Floats
    plate: Floats
    near: Floats
    above: Floats
    below: Floats
    corner: Floats
    rim: Floats
    flap: Floats
    mandible: Floats
    teeth: Floats
    tongue: Floats
    stalk: Floats
    ball: Floats
    lid: Floats
    arm: Floats
    finger: Floats


def part_of(points: Floats, **fields: Floats | float) -> Anatomy:
    """Return the fields of a part (points in metres); those that are not given are 0."""
    count = len(points)
    two = {"stalk", "lid", "arm", "finger"}
    made = {
        name: np.zeros((2, count) if name in two else count)
        for name in Anatomy.__dataclass_fields__
        if name != "points"
    }
    made["tongue"] = np.full(count, np.nan)
    for name, value in fields.items():
        made[name] = np.broadcast_to(np.asarray(value, np.float64), made[name].shape)
    return Anatomy(points, **made)


def of_body(body: Body) -> Anatomy:
    """Return the fields of the body, which knows its loops around the mouth."""
    line, sine = body.line, np.sin(body.turn)
    inside = line < 0
    deep = np.clip(-line, 0.0, BAG_LOOPS + 1.0)
    # At the corners both halves are one point, which goes one way.
    upper, lower = np.clip(sine, 0.0, 1.0), np.clip(-sine, 0.0, 1.0)
    near = np.where(inside, step(5.0, 1.0, deep), 1.0 - step(0.9, 3.0, line))
    rim = np.where(inside, 1.0, 1.0 - step(0.2, 1.0, line))
    corner = np.abs(np.cos(body.turn)) ** 3.0
    flap = np.where((line == -2.0) | (line == -1.0), lower, 0.0)
    return part_of(
        body.points * 1e-3,
        plate=_plate(body),
        near=near,
        above=near * upper,
        below=near * lower,
        corner=near * corner,
        rim=rim,
        flap=flap,
    )


def _plate(body: Body) -> Floats:
    """Return how much the body goes with the plate: rigid to its groove, then giving way."""
    line, sine = body.line, np.sin(body.turn)
    edge = np.where(
        sine < 0, 0.35 + 0.65 * step(0.0, 0.75, -sine), 0.35 * (1.0 - step(0.0, 0.5, sine))
    )
    outside = np.interp(line, [0.0, 1.9, 2.1, 2.6, 3.2, 4.0, 4.4], [1, 1, 0.9, 0.62, 0.3, 0.06, 0])
    deep = step(2.0, 6.0, -line)
    bag = edge * (1 - deep) + (0.5 - 0.5 * sine) * deep
    bag[line < -BAG_LOOPS] = 0.5
    return np.asarray(np.where(line < 0, bag, edge * outside), np.float64)
