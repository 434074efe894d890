"""What stands on the shell: spines around its edge, knobs, freckles, two feelers. Millimetres."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.crab.body import BAG_LOOPS, EDGE, LINES, SIDES, Body
from lipwright.character.crab.forms import Limb, Solid, ball, joined, mirrored

Floats = NDArray[np.float64]

# Along the edge, as degrees from the left corner of the mouth upward: angle and length.
_SPINES = ((-14, 9), (3, 13), (19, 17), (34, 14), (47, 10), (58, 7))
# On the shell: degrees along a loop, the loop's line, height and radius.
_FRECKLES = 64
_KNOBS = (
    (38, 4.30, 4.5, 7.5),
    (62, 4.26, 3.5, 6.0),
    (25, 4.5, 5, 8),
    (52, 4.5, 5, 7.5),
    (78, 4.42, 4, 6.0),
    (40, 4.7, 4.5, 8),
)


def spines(body: Body) -> Solid:
    """Return the spines of both sides; `along` runs to their tips."""
    made = []
    for degrees, length in _SPINES:
        for angle in (degrees, 180 - degrees):
            foot, away = _foot(body, angle, EDGE)
            way = [[*(foot - 6 * away), 6.5], [*foot, 5.4], [*(foot + length * away), 0.9]]
            made.append(Limb(way, 0.75, (0.0, 1.0, 0.0), 6, 8).solid())
    return joined(made)


def knobs(body: Body) -> Solid:
    """Return the blunt knobs on the shell."""
    made = []
    for degrees, line, height, radius in _KNOBS:
        for angle in (degrees, 180 - degrees):
            foot, away = _foot(body, angle, line)
            way = [
                [*(foot - 5 * away), radius],
                [*foot, radius * 0.9],
                [*(foot + away * (height - 3)), 3.0],
            ]
            made.append(Limb(way, 1.0, (1.0, 0.3, 0.0), 4, 10).solid())
    return joined(made)


def freckles(body: Body) -> Solid:
    """Return the freckles: flat round drops on the shell, scattered the same way every time."""
    number = np.arange(_FRECKLES)
    # Multiples of three unrelated fractions fill a box evenly, without a pattern.
    degrees = 12.0 + 156.0 * ((0.5 + number * 0.8191725) % 1.0)
    lines = 3.97 + 0.78 * ((0.5 + number * 0.6710436) % 1.0) ** 1.5
    sizes = 2.4 + 3.4 * ((0.5 + number * 0.5497005) % 1.0)
    standing = [_foot(body, angle, row[1])[0] for row in _KNOBS for angle in (row[0], 180 - row[0])]
    made = []
    for angle, line, size in zip(degrees.tolist(), lines.tolist(), sizes.tolist(), strict=True):
        foot, away = _foot(body, angle, line)
        near = np.linalg.norm(np.array(standing) - foot, axis=1).min()
        if near > size + 7.0:
            made.append(_drop(foot, away, size))
            standing.append(foot)
    return joined(made)


def _drop(foot: Floats, away: Floats, size: float) -> Solid:
    """Return a round drop that lies flat on the shell."""
    drop = ball((0.0, 0.0, 0.0), 1.0, (28.0, 56.0, 84.0, 125.0), 10)
    across = np.cross(away, (0.0, 0.0, 1.0) if abs(away[2]) < 0.9 else (1.0, 0.0, 0.0))
    across /= np.linalg.norm(across)
    frame = np.stack([across * size, np.cross(away, across) * size, away * (0.6 + 0.18 * size)])
    return drop._replace(points=foot - 0.2 * away + drop.points @ frame)


def feelers() -> Solid:
    """Return the two short feelers above the face; `along` runs to their tips."""
    left = [
        [8, 33, 60, 3.6],
        [11, 42, 73, 2.9],
        [17, 54, 80, 2.3],
        [26, 62, 78, 1.9],
        [32, 62, 73, 2.6],
    ]
    feeler = Limb(left, rings=16, sides=8).solid()
    return joined([feeler, mirrored(feeler)])


def _foot(body: Body, degrees: float, line: float) -> tuple[Floats, Floats]:
    """Return a point of the shell and the way out of it."""
    loop = BAG_LOOPS + int(np.argmin(np.abs(LINES - line)))
    number = round(degrees / 360 * SIDES) % SIDES
    rows = body.points[body.loops]
    along = rows[loop, (number + 1) % SIDES] - rows[loop, number - 1]
    across = rows[loop + 1, number] - rows[loop - 1, number]
    away = np.cross(across, along)
    return rows[loop, number], away / np.linalg.norm(away)
