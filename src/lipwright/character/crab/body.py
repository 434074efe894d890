"""The crab's body: one closed surface of loops around the mouth, from its bag to the back.

A loop is a closed line around the mouth, counted from the left corner over the upper edge.
Loops are laid out on a flat chart (angles from the front: the middle of a loop that is the
whole back lies pi away) between a few drawn lines: the contact of upper edge and lower
plate, their rims, the plate's groove, the edge of the shell. Then the chart is wrapped over
a squat superellipsoid, and relief is added. Millimetres; the origin is the body's middle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.character.clusters import step

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

SIDES = 112
MOUTH = (50.0, -15.0)
"""Half the mouth's breadth, and its height."""
_BREADTH, _UP, _DOWN, _FRONT, _BACK, _POWER = 97.0, 64.0, 56.0, 63.0, 74.0, 2.35

# Where loops lie: share of the way through the drawn lines (0 contact, 1 rim of the lips,
# 2 groove around plate and upper edge, 3 inside of the shell's edge, 4 its outside, 5 back).
EDGE = 4.0
_AT = (
    (0.0, 0.18, 0.42, 0.7, 1.0, 1.2, 1.45, 1.7, 1.9),
    (2.0, 2.1, 2.3, 2.5, 2.7, 2.86, 3.0, 3.3, 3.65),
    (4.0, 4.03, 4.06, 4.10, 4.14, 4.18, 4.22, 4.26, 4.3, 4.34, 4.38, 4.42, 4.46),
    (4.5, 4.54, 4.59, 4.64, 4.7, 4.77, 4.84, 4.9, 4.95),
)
LINES = np.concatenate(_AT)

# The bag behind the contact: half breadth, top, bottom, depth in the middle and at the sides.
_BAG = np.array(
    [
        [54.0, 9.0, -27.0, 50.0, 30.0],
        [53.0, 14.0, -39.0, 36.0, 18.0],
        [45.0, 13.0, -41.0, 14.0, 4.0],
        [30.0, 6.0, -34.0, -6.0, -9.0],
        [14.0, -4.0, -24.0, -14.0, -14.0],
    ]
)
# Behind the contact: how far apart, and how deep (mm).
_INNER = np.array([[0.4, 2.4], [3.0, 6.5]])
BAG_LOOPS = len(_BAG) + len(_INNER)


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """The body's surface and its loops.

    Parameters
    ----------
    points : (V, 3) float64, millimetres
    triangles : (F, 3) intp
    loops : (L, SIDES) intp
        From the bag's end outward; the last two points close the bag and the back.
    line : (V,) float64
        On which of the drawn lines each point lies; below 0 inside the mouth.
    turn : (V,) float64, radians
        Where along its loop: 0 at the left corner, pi / 2 at the top.
    """

    points: Floats
    triangles: Indices
    loops: Indices
    line: Floats
    turn: Floats


def turns() -> Floats:
    """Return where along a loop each of its points lies, radians."""
    return np.arange(SIDES) * 2 * np.pi / SIDES


def contact_height(x: Floats) -> Floats:
    """Return the height of the line where the mouth closes: at rest the crab smiles a little."""
    share = np.clip(np.abs(x) / MOUTH[0], 0.0, 1.2)
    return np.asarray(MOUTH[1] - 3.0 + 9.0 * share**2.2, np.float64)


def surface(chart: Floats) -> Floats:
    """Wrap a chart, (..., 2) radians from the front, over the body's form: (..., 3)."""
    away = np.linalg.norm(chart, axis=-1)
    flat = np.sin(away) / np.maximum(away, 1e-9)
    way = np.stack([chart[..., 0] * flat, chart[..., 1] * flat, np.cos(away)], axis=-1)
    up = step(-0.25, 0.25, way[..., 1])
    ahead = step(-0.4, 0.4, way[..., 2])
    size = np.stack(
        [
            np.full(up.shape, _BREADTH),
            _DOWN + (_UP - _DOWN) * up,
            _BACK + (_FRONT - _BACK) * ahead,
        ],
        axis=-1,
    )
    reach = (np.abs(way / size) ** _POWER).sum(axis=-1) ** (-1.0 / _POWER)
    return np.asarray(way * reach[..., None], np.float64)


def front(x: Floats, y: Floats) -> Floats:
    """Return the smooth body's depth in front at (x, y)."""
    up = step(-0.25, 0.25, y / 64.0)
    high = _DOWN + (_UP - _DOWN) * up
    left = 1.0 - np.abs(x / _BREADTH) ** _POWER - np.abs(y / high) ** _POWER
    return np.asarray(_FRONT * np.maximum(left, 0.0) ** (1.0 / _POWER), np.float64)


def chart_at(x: Floats, y: Floats) -> Floats:
    """Return the chart's place of a point in front."""
    z = front(x, y)
    across = np.hypot(x, y)
    away = np.arctan2(across, z) / np.maximum(across, 1e-9)
    return np.stack([x * away, y * away], axis=-1)


def _drawn() -> Floats:
    """Return the drawn lines on the chart: (6, SIDES, 2)."""
    turn = turns()
    cos, sin = np.cos(turn), np.sin(turn)
    half, level = MOUTH
    upper = sin >= 0
    x = half * cos
    meet = np.stack([x, contact_height(x)], axis=1)
    rim = np.stack([(half + 4.0) * cos, contact_height(x) + np.where(upper, 5.5, 6.0) * sin], 1)
    groove = np.stack(
        [(half + 13.0) * cos, level + 4.0 * cos**2 + np.where(upper, 20.0, 28.0) * sin], 1
    )
    near = [chart_at(*line.T) for line in (meet, rim, groove)]
    edge = [np.stack([a * cos, b + np.where(upper, u, d) * sin], 1) for a, b, u, d in _EDGES]
    back = np.pi * np.stack([cos, sin], 1)
    return np.stack([*near, *edge, back])


# Inside and outside of the shell's edge: half breadth, height, rise above, fall below (rad).
_EDGES = ((1.36, 0.06, 0.36, 1.62), (1.52, 0.10, 0.50, 1.86))


def build_body() -> Body:
    """Build the body at rest."""
    drawn = _drawn()
    low = np.clip(LINES.astype(np.intp), 0, len(drawn) - 2)
    share = (LINES - low)[:, None, None]
    chart = drawn[low] * (1.0 - share) + drawn[low + 1] * share
    turn = turns()
    outside = _with_relief(surface(chart), LINES, turn)
    meet = outside[0]
    inside = np.concatenate([_bag(turn)[::-1], _inner(meet, turn)[::-1]])
    points = np.concatenate([inside, outside])
    loops = np.arange(points[..., 0].size).reshape(points.shape[:2])
    line = np.concatenate([np.arange(-BAG_LOOPS, 0, dtype=np.float64), LINES])
    ends = np.array([[0.0, -14.0, -17.0], [0.0, 2.0, -_BACK * 1.01]])
    count = loops.size
    return Body(
        np.concatenate([points.reshape(-1, 3), ends]),
        _faces(loops, count),
        loops,
        np.concatenate([np.repeat(line, SIDES), [-BAG_LOOPS - 1.0, 5.0]]),
        np.concatenate([np.tile(turn, len(line)), [0.0, np.pi / 2]]),
    )


def _faces(loops: Indices, inner_end: int) -> Indices:
    a, b = loops[:-1], loops[1:]
    c, d = np.roll(b, -1, axis=1), np.roll(a, -1, axis=1)
    faces = [np.stack(corners, -1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
    first, last = loops[0], loops[-1]
    bag, back = np.full(SIDES, inner_end), np.full(SIDES, inner_end + 1)
    faces.append(np.stack([bag, first, np.roll(first, -1)], axis=1))
    faces.append(np.stack([last, back, np.roll(last, -1)], axis=1))
    return np.concatenate(faces)


def _with_relief(points: Floats, line: Floats, turn: Floats) -> Floats:
    """Push the loops out and in: rims, groove, the shell's edge, its bumps."""
    rim = np.interp(line, [0.0, 0.18, 0.45, 0.75, 1.0, 1.2], [-1.0, 1.8, 3.2, 3.0, 0.2, 0.0])
    plate = np.interp(line, [1.0, 1.3, 1.7, 1.9, 2.0, 2.1, 2.35], [0, 1.2, 1.6, 0.8, -1.8, 0, 0])
    edge = np.interp(line, [2.3, 2.86, 3.0, 3.3, 3.65, 4.0, 4.3], [0, -1.0, -1.5, 3.0, 7.5, 8.5, 7])
    edge *= np.interp(line, [4.0, 4.9], [1.0, 0.5])
    sine = np.sin(turn)
    corners = np.clip(np.abs(sine) / 0.35, 0.0, 1.0) ** 0.7
    below = 1.0 - 0.65 * step(-0.35, -0.8, sine)
    out = rim[:, None] * corners + plate[:, None] * (0.4 + 0.6 * corners) + edge[:, None] * below
    shell = step(4.0, 4.3, line)[:, None, None] * (points[..., 1:2] > -30)
    away = points / np.linalg.norm(points, axis=-1, keepdims=True)
    raised = points + away * out[..., None]
    return np.asarray(raised + shell * away * _bumps(raised)[..., None], np.float64)


def _bumps(points: Floats) -> Floats:
    """Return the shell's relief: a hump on each side, a furrow between, a little unrest."""
    x, y, z = np.moveaxis(points, -1, 0)
    humps = 4.5 * np.exp(-(((np.abs(x) - 38.0) / 22.0) ** 2) - ((z + 12.0) / 26.0) ** 2)
    middle = 3.0 * np.exp(-((x / 15.0) ** 2) - ((z + 28.0) / 20.0) ** 2)
    furrow = -2.4 * np.exp(-(((np.abs(x) - 17.0 - 0.15 * z) / 5.5) ** 2)) * step(35.0, 5.0, z)
    unrest = 0.8 * np.sin(x * 0.17 + 1.0) * np.sin(z * 0.19 + y * 0.13)
    return np.asarray((humps + middle + furrow + unrest) * step(0.0, 25.0, y), np.float64)


def _inner(meet: Floats, turn: Floats) -> Floats:
    """Return the loops behind the contact, first the one next to it."""
    sine = np.sin(turn)
    apart, deep = _INNER[:, :1], _INNER[:, 1:]
    middle = np.clip(np.abs(sine) / 0.35, 0.0, 1.0)
    loops = np.repeat(meet[None], len(_INNER), axis=0)
    loops[..., 1] += apart * np.sign(sine) * middle
    loops[..., 2] -= deep * (0.4 + 0.6 * middle)
    return loops


def _bag(turn: Floats) -> Floats:
    """Return the loops of the bag around teeth and tongue, from the front to its end."""
    half, top, bottom, middle, side = (column[:, None] for column in _BAG.T)
    cos, sin = np.cos(turn), np.sin(turn)
    level = contact_height(half * cos)
    x = half * np.sign(cos) * np.abs(cos) ** 0.9
    rise = np.where(sin > 0, top - MOUTH[1], MOUTH[1] - bottom)
    y = level * 0.5 + MOUTH[1] * 0.5 + rise * sin
    z = middle + (side - middle) * np.abs(cos) ** 2.2
    return np.stack([x, y, z], axis=-1)
