"""Eyes on stalks, with lids; they look ahead, a little inward. Millimetres."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lipwright.character.clusters import step
from lipwright.character.crab.forms import Limb, Solid, ball

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

RADIUS = 22.0
CENTERS = {1: np.array([38.0, 93.0, 38.0]), -1: np.array([-38.0, 99.0, 36.0])}
"""The middle of the left (1) and the right (-1) eyeball: the right one is held higher."""
_ROOTS = {1: (29.0, 50.0, 22.0), -1: (-29.0, 50.0, 22.0)}
_CASING = 1.13
_INSIDE = 1.005
_COLUMNS = 26
_CORNER = 74.0  # degrees to the side where the opening ends
# The casing's rows, in degrees over the top from the front; it is open in front. The first
# and the last turn inside to the ball.
_ROWS = np.concatenate(
    [
        (43.0, 41.0, 44.0, 50.0, 60.0, 72.0, 86.0, 104.0, 124.0, 146.0),
        (170.0, 195.0, 220.0, 244.0, 262.0, 276.0, 288.0, 297.0, 303.0, 306.0, 304.0),
    ]
)
_MEET = 353.0  # where the lids meet
_OVERLAP = 3.0  # by how much each goes on beyond
# The eyeball's rings, in degrees from its front: pupil, iris, white.
RINGS = np.concatenate(
    [
        (4.0, 7.5, 11.0, 14.5, 18.0, 20.0, 21.0, 25.0, 30.0),
        (34.0, 36.2, 38.0, 46.0, 60.0, 78.0, 105.0, 140.0),
    ]
)
PUPIL, IRIS = 20.5, 36.0
_SIDES = 32
_LOOK = {1: (-5.0, -3.0), -1: (6.0, -5.0)}
"""How far each eye is turned to the left and up at rest, degrees."""


class Eye(NamedTuple):
    """One eye.

    Parameters
    ----------
    ball, stalk : Solid
    casing : Solid
        The lids, in one piece around the back of the ball.
    closing : (V,) float64, degrees
        How far each point of the casing turns down about the ball to close it.
    """

    ball: Solid
    stalk: Solid
    casing: Solid
    closing: Floats


def eye(side: int) -> Eye:
    """Return the left (1) or the right (-1) eye."""
    center = CENTERS[side]
    globe = ball(center, RADIUS, RINGS, _SIDES)
    globe = globe._replace(points=_looking(globe.points - center, *_LOOK[side]) + center)
    root = np.array(_ROOTS[side])
    middle = 0.5 * (root + center) + np.array([2.0 * side, -4.0, 1.0])
    way = [[*root, 10.5], [*middle, 7.6], [*(center - [0.0, 15.0, 2.0]), 9.5]]
    stalk = Limb(way, rings=12, sides=14).solid()
    casing, closing = _lids(center)
    return Eye(globe, stalk, casing, closing)


def _looking(points: Floats, left: float, up: float) -> Floats:
    a, b = np.radians([left, up])
    across = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    high = np.array([[1, 0, 0], [0, np.cos(b), np.sin(b)], [0, -np.sin(b), np.cos(b)]])
    return np.asarray(points @ (across @ high).T, np.float64)


def _lids(center: Floats) -> tuple[Solid, Floats]:
    count = len(_ROWS)
    across = np.linspace(-90.0, 90.0, _COLUMNS + 2)[1:-1]
    over, sideways = np.radians(_narrowed(across)), np.radians(across)[None, :]
    size = np.full(count, RADIUS * _CASING)
    size[[0, -1]] = RADIUS * _INSIDE
    size[[1, -2]] = RADIUS * 0.5 * (_CASING + _INSIDE)
    size[[2, -3]] = RADIUS * (_CASING + 0.03)  # a swollen rim
    x = np.sin(sideways) + 0 * over
    y, z = np.cos(sideways) * np.sin(over), np.cos(sideways) * np.cos(over)
    points = np.stack([x, y, z], axis=-1) * size[:, None, None]
    ends = np.array([[-1.0, 0, 0], [1.0, 0, 0]]) * RADIUS * _CASING
    grid = np.arange(count * _COLUMNS).reshape(count, _COLUMNS)
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    faces = [np.stack(corners, -1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
    right, left = np.full(count - 1, grid.size), np.full(count - 1, grid.size + 1)
    faces.append(np.stack([right, grid[:-1, 0], grid[1:, 0]], axis=1))
    faces.append(np.stack([left, grid[1:, -1], grid[:-1, -1]], axis=1))
    triangles = np.concatenate(faces)
    solid = Solid(
        np.concatenate([points.reshape(-1, 3), ends]) + center,
        triangles,
        np.concatenate([np.repeat(_ROWS / 360.0, _COLUMNS), [0.5, 0.5]]),
        np.concatenate([np.tile(np.radians(across), count), [-np.pi / 2, np.pi / 2]]),
    )
    return solid, _closing(across)


def _narrowed(across: Floats) -> Floats:
    """Return each point's degrees over the top: the opening narrows to both its corners."""
    share = np.clip(1.0 - (across / _CORNER) ** 2, 0.0, 1.0) ** 0.6
    meet, back = _MEET - 360.0, _MEET - 180.0
    rows = _ROWS[:, None]
    upper, lower = (back - rows) / (back - _ROWS[1]), (rows - back) / (_ROWS[-2] - back)
    first = back - upper * (180.0 - (_ROWS[1] - meet) * share)
    last = back + lower * (180.0 - (_MEET - _ROWS[-2]) * share)
    return np.asarray(np.where(rows < back, first, last), np.float64)


def _closing(across: Floats) -> Floats:
    """Return how far each point turns (positive: down in front) to bring the rims together."""
    degrees = _narrowed(across)
    upper = step(150.0, 44.0, _ROWS)[:, None] * (degrees[1] - (_MEET - 360.0) + _OVERLAP)
    lower = -step(225.0, 302.0, _ROWS)[:, None] * (_MEET - degrees[-2] + _OVERLAP)
    rows = np.where(_ROWS[:, None] < 180.0, upper, lower)
    return np.concatenate([rows.ravel(), [0.0, 0.0]])
