"""Eyebrows: strips that lie on the skin and move with it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.relief import face_at

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

# Along the brow: x, height of the lower edge, breadth, thickness (mm).
_BROW = np.array(
    [
        [12.5, 17.6, 2.0, 0.1],
        [14.0, 17.0, 4.0, 0.6],
        [18.0, 17.4, 4.8, 0.9],
        [24.0, 18.6, 4.9, 1.0],
        [31.0, 20.2, 4.5, 1.0],
        [38.0, 21.4, 3.8, 0.9],
        [44.0, 21.0, 3.0, 0.8],
        [49.0, 19.0, 2.2, 0.6],
        [53.0, 16.6, 1.3, 0.4],
        [55.5, 14.8, 0.5, 0.0],
    ]
)
_ACROSS = np.array([[0.0, -0.6], [0.18, 0.75], [0.5, 1.0], [0.82, 0.75], [1.0, -0.6]])


def brows() -> tuple[Floats, Indices]:
    """Return both eyebrows: vertices (V, 3) in metres, triangles (F, 3)."""
    fine = np.linspace(0.0, len(_BROW) - 1.0, 19)
    x, low, breadth, thick = (np.interp(fine, np.arange(len(_BROW)), c) for c in _BROW.T)
    share, out = _ACROSS[:, :1], _ACROSS[:, 1:]
    y = low + breadth * share
    x = x - 0.10 * (y - low)  # leaning outward
    points = face_at(np.stack([x, y], axis=-1).reshape(-1, 2) * 1e-3)
    points[:, 2] += (np.maximum(out, -0.6) * thick).ravel() * 1e-3
    grid = np.arange(x.size).reshape(x.shape)
    a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
    left = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    return (
        np.concatenate([points, points * (-1.0, 1.0, 1.0)]),
        np.concatenate([left, left[:, ::-1] + len(points)]),
    )
