"""What is seen of a mesh from in front: rays along -z and where they hit."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def first_hit(points: Floats, triangles: NDArray[np.uint32], across: Floats) -> Floats:
    """Return the depth at which rays at (x, y) first hit triangles that face them; -inf: none."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = a.T, b.T, c.T
    x, y = across[:, :1], across[:, 1:]
    area = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    with np.errstate(divide="ignore", invalid="ignore"):
        v = ((x - ax) * (cy - ay) - (cx - ax) * (y - ay)) / area
        w = ((bx - ax) * (y - ay) - (x - ax) * (by - ay)) / area
        hit = (v >= 0) & (w >= 0) & (v + w <= 1) & (area > 0)
        depth = np.where(hit, az + v * (bz - az) + w * (cz - az), -np.inf)
    return np.asarray(depth.max(axis=1), np.float64)
