"""A collar and the beginning of the shoulders, so that the neck ends in something."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

# From inside the collar outward: front y, z; side x, y, z; back y, z (mm).
_ROWS = np.array(
    [
        [-170.0, 30.0, 52.0, -158.0, -22.0, -146.0, -74.0],
        [-163.0, 35.5, 55.5, -149.0, -22.0, -135.0, -79.5],
        [-162.5, 38.0, 57.8, -147.5, -22.0, -133.5, -82.0],
        [-164.5, 39.5, 59.5, -149.5, -22.0, -136.0, -84.5],
        [-172.0, 42.5, 65.0, -155.0, -22.0, -145.0, -89.0],
        [-182.0, 50.0, 84.0, -163.0, -23.0, -158.0, -96.0],
        [-196.0, 62.0, 112.0, -175.0, -24.0, -176.0, -102.0],
        [-213.0, 73.0, 136.0, -190.0, -25.0, -198.0, -105.0],
        [-226.0, 79.0, 148.0, -204.0, -25.0, -214.0, -105.0],
    ]
)
_AROUND = 30


def shirt() -> tuple[Floats, Indices]:
    """Return the shirt: vertices (V, 3) in metres, triangles (F, 3)."""
    turn = np.arange(_AROUND) * 2 * np.pi / _AROUND
    front_y, front_z, side_x, side_y, side_z, back_y, back_z = (c[:, None] for c in _ROWS.T)
    sine, cosine = np.sin(turn), np.cos(turn)
    end_y = np.where(cosine > 0, front_y, back_y)
    end_z = np.where(cosine > 0, front_z, back_z)
    y = side_y + (end_y - side_y) * cosine**2
    z = side_z + (end_z - side_z) * np.abs(cosine)
    points = np.stack([side_x * sine, y, z], axis=-1).reshape(-1, 3) * 1e-3
    grid = np.arange(len(points)).reshape(len(_ROWS), _AROUND)
    following = np.roll(grid, -1, axis=1)
    a, b, c, d = grid[:-1], grid[1:], following[1:], following[:-1]
    sheets = [np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))]
    return points, np.concatenate(sheets)
