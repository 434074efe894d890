"""Eyeballs: the front of a ball in rings, with pupil, iris and its dark rim as colours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.lids import EYE_CENTER, EYE_RADIUS

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_AROUND = 24
_PUPIL = (0.004, 0.004, 0.004)
_IRIS_INNER = (0.20, 0.115, 0.055)
_IRIS = (0.095, 0.052, 0.027)
_RIM = (0.020, 0.012, 0.008)
_WHITE = (0.78, 0.75, 0.72)
_PINK = (0.55, 0.33, 0.28)
# Angle from the middle of the pupil (degrees), colour, and how deep the ring lies (mm).
_RINGS: tuple[tuple[float, tuple[float, float, float], float], ...] = (
    (9.8, _PUPIL, 0.0),
    (10.6, _IRIS_INNER, 0.0),
    (15.0, _IRIS_INNER, 0.0),
    (21.0, _IRIS, 0.0),
    (24.6, _IRIS, 0.0),
    (26.2, _RIM, 0.0),
    (28.2, _WHITE, 0.0),
    (40.0, _WHITE, 0.0),
    (58.0, _WHITE, 0.0),
    (88.0, _PINK, 0.0),
)


def eyeball(side: float) -> tuple[Floats, Indices, Floats]:
    """Return vertices (V, 3) in metres, triangles (F, 3), colours (V, 3) of an eyeball.

    Parameters
    ----------
    side : float
        1 for the left eye, -1 for the right one.
    """
    away = np.radians([ring[0] for ring in _RINGS])[:, None]
    turn = (np.arange(_AROUND) * 2 * np.pi / _AROUND)[None]
    unit = np.stack(
        [np.sin(away) * np.cos(turn), np.sin(away) * np.sin(turn), np.cos(away) + 0 * turn], -1
    )
    points = np.concatenate([[[0.0, 0.0, 1.0]], unit.reshape(-1, 3)]) * EYE_RADIUS
    points += EYE_CENTER * (side, 1.0, 1.0)
    grid = 1 + np.arange(unit[..., 0].size).reshape(unit.shape[:2])
    following = np.roll(grid, -1, axis=1)
    quads = (grid[:-1], grid[1:], following[1:], following[:-1])
    pupil = np.stack([np.zeros_like(grid[0]), grid[0], following[0]], axis=1)
    a, b, c, d = quads
    sheet = [np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))]
    colors = np.concatenate([[_PUPIL], np.repeat([ring[1] for ring in _RINGS], _AROUND, axis=0)])
    # The upper lid shades the ball.
    height = (points[:, 1] - EYE_CENTER[1]) / EYE_RADIUS
    colors = colors * (1.0 - 0.45 * np.clip((height - 0.1) / 0.5, 0.0, 1.0))[:, None]
    return points, np.concatenate([pupil, *sheet]), colors
