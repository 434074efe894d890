"""What lies in and before the crab's mouth: mandibles, two rows of teeth, a tongue. Millimetres."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.clusters import step
from lipwright.character.crab.body import contact_height, front
from lipwright.character.crab.forms import Limb, Solid, joined, mirrored

Floats = NDArray[np.float64]
Rows = list[list[float]]

MANDIBLE_ROOT = np.array([50.0, -46.0, 48.0])
_MANDIBLE: Rows = [
    [48, -46, 36, 8],
    [59, -38, 54, 10],
    [66, -20, 63, 9.5],
    [60, -2, 67, 7.5],
    [49, 7, 68, 3.0],
]
_DENTS = ((56.5, -20.0, 64.0, 4.6), (54.0, -8.0, 67.0, 4.2))  # x, y, z, size: the inner edge

# Teeth: middle, breadth and length of each, from the right; one is missing.
_UPPER = (
    (-37, 8, 9),
    (-28, 9, 12),
    (-10, 10, 14),
    (0.5, 10, 15),
    (11, 10, 14),
    (21, 9.5, 13),
    (30, 9, 11),
    (38, 8, 9),
)
_LOWER = (
    (-32, 8, 9),
    (-23, 9, 11),
    (-13.5, 9, 12),
    (-4, 9, 12),
    (5.5, 9, 12),
    (15, 9, 12),
    (24, 8.5, 10),
    (32, 8, 9),
)
_TONGUE: Rows = [
    [0, -36, -8, 12],
    [0, -31, 8, 17],
    [0, -28, 20, 19],
    [0, -27, 31, 15],
    [0, -27, 38, 9],
]


def mandible(side: int) -> Solid:
    """Return the left (1) or the right (-1) mandible, with the teeth on its inner edge."""
    horn = Limb(_MANDIBLE, 0.8, (1.0, 0.0, 0.0), 20, 18).solid()
    dents = [
        Limb(
            [[x + 5, y, z, 4.4], [x, y, z, 3.4], [x - s, y + 0.5, z, 0.9]], rings=4, sides=8
        ).solid()
        for x, y, z, s in _DENTS
    ]
    # What lies on the horn has the shade of its middle.
    dents = [dent._replace(along=0.5 + 0.5 * dent.along) for dent in dents]
    solid = joined([horn, *dents])
    return solid if side > 0 else mirrored(solid)


def swinging(horn: Solid) -> Floats:
    """Return how much of a mandible swings: its root stays on the face."""
    return step(-0.05, 0.30, horn.along)


def upper_teeth() -> Solid:
    """Return the upper row; it hangs from the body."""
    return joined([_tooth(x, wide, long, 1.0) for x, wide, long in _UPPER])


def lower_teeth() -> Solid:
    """Return the lower row, which goes with the plate."""
    return joined([_tooth(x, wide, long, -1.0) for x, wide, long in _LOWER])


def _tooth(x: float, breadth: float, length: float, up: float) -> Solid:
    level = float(contact_height(np.array(x)))
    depth = float(front(np.array(x), np.array(level))) - (10.5 if up > 0 else 13.0)
    edge = level + (0.0 if up > 0 else 1.0)
    half = 0.5 * breadth
    way = [
        [x, edge + up * (length + 6.0), depth - 5.0, half * 0.8],
        [x, edge + up * length * 0.75, depth - 1.0, half * 0.97],
        [x, edge + up * 2.5, depth, half * 0.86],
    ]
    return Limb(way, 0.62, (1.0, 0.0, 0.0), 5, 10).solid()


def tongue() -> Solid:
    """Return the tongue; `along` runs from its root to its tip."""
    solid = Limb(_TONGUE, 0.42, (1.0, 0.0, 0.0), 16, 18).solid()
    x, y, z = solid.points.T
    groove = 1.8 * np.exp(-((x / 4.5) ** 2)) * (y > np.interp(z, [-8, 38], [-35, -26]))
    return solid._replace(points=np.stack([x, y - groove, z], axis=1))
