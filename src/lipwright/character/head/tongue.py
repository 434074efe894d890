"""The tongue: a flattened tube along a drawn spine, from the root to the tip."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

# Depth, height of the back (top), half-breadth, thickness (mm), from the root to the tip.
_SPINE = np.array(
    [
        [20.0, -78.0, 15.0, 15.0],
        [27.0, -73.0, 17.5, 15.0],
        [35.0, -70.3, 19.0, 14.0],
        [43.0, -69.6, 19.3, 12.5],
        [51.0, -70.0, 18.6, 11.0],
        [58.0, -71.0, 17.2, 9.4],
        [64.0, -72.2, 15.0, 7.8],
        [69.0, -73.3, 12.4, 6.4],
        [73.0, -74.3, 9.2, 5.0],
        [75.4, -75.2, 5.8, 3.3],
        [76.5, -76.2, 2.4, 1.4],
    ]
)
_AROUND = 14


def tongue() -> tuple[Floats, Indices, Floats]:
    """Return vertices (V, 3) in metres, triangles (F, 3) and each vertex's share of the length.

    The share is 0 at the root and 1 at the tip.
    """
    turn = np.arange(_AROUND) * 2 * np.pi / _AROUND
    z, top, half, thick = (column[:, None] for column in _SPINE.T)
    side, up = np.sin(turn), np.cos(turn)
    x = half * np.sign(side) * np.abs(side) ** 0.85
    y = top - thick / 2 + thick / 2 * np.sign(up) * np.abs(up) ** 0.8
    # A groove along the middle of the back.
    groove = 0.09 * thick * np.exp(-((x / (0.35 * half)) ** 2)) * (up > 0)
    points = np.stack([x, y - groove, np.broadcast_to(z, x.shape)], axis=-1).reshape(-1, 3)
    stations = len(_SPINE)
    grid = np.arange(stations * _AROUND).reshape(stations, _AROUND)
    a, b = grid[:-1], grid[1:]
    c, d = np.roll(b, -1, axis=1), np.roll(a, -1, axis=1)
    sides = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    tip, root = len(points), len(points) + 1
    ends = np.array([[0.0, _SPINE[-1, 1] - 0.5, 77.2], [0.0, -86.0, 18.0]])
    last, first = grid[-1], grid[0]
    caps = np.concatenate(
        [
            np.stack([last, np.full_like(last, tip), np.roll(last, -1)], axis=1),
            np.stack([np.roll(first, -1), np.full_like(first, root), first], axis=1),
        ]
    )
    share = np.concatenate([np.repeat(np.linspace(0.0, 1.0, stations), _AROUND), [1.0, 0.0]])
    return np.concatenate([points, ends]) * 1e-3, np.concatenate([sides, caps]), share
