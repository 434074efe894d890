"""The ears: an outline with rim, fold and hollow, standing off the side of the head."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

# The left ear's outline seen from its side (mm): backward, upward of where it hangs.
_OUTLINE = np.array(
    [
        [1.0, 2.0],
        [-0.5, 12.0],
        [3.0, 23.0],
        [11.0, 30.5],
        [21.0, 30.0],
        [28.5, 23.0],
        [31.0, 12.0],
        [29.0, 0.0],
        [24.0, -10.0],
        [18.5, -19.0],
        [13.0, -27.0],
        [6.5, -29.5],
        [1.0, -25.0],
        [-1.0, -16.0],
        [-0.5, -6.0],
    ]
)
_HOLLOW = np.array([9.0, -3.0])  # the middle of the concha
_AROUND = 22
# From behind the ear to the middle of the hollow: share of the outline, height at the
# rim's back and at its front edge (mm), where the ear runs into the cheek.
_LOOPS = np.array(
    [
        [0.60, -14.0, -12.0],
        [0.88, -4.0, -8.0],
        [0.99, -0.6, -4.0],
        [1.00, 1.2, -2.4],
        [0.93, 2.4, -0.6],
        [0.83, 1.0, 0.6],
        [0.74, -0.2, 0.6],
        [0.60, 1.3, 0.8],
        [0.47, 0.6, -0.4],
        [0.36, -3.4, -2.8],
        [0.18, -5.2, -4.6],
    ]
)
_PLACE = (0.0742, -0.0135, -0.0105)
_TILT, _STAND_OFF = np.radians(9.0), np.radians(21.0)


def ears() -> tuple[Floats, Indices]:
    """Return both ears: vertices (V, 3) in metres, triangles (F, 3)."""
    outline = _smooth_loop(_OUTLINE, _AROUND)
    away = outline - _HOLLOW
    # 1 along the back and the top, 0 where the ear grows out of the head.
    behind = np.clip((away[:, 0] + 8.0) / 12.0, 0.0, 1.0)
    lobe = np.exp(-(((outline[:, 1] + 27.0) / 9.0) ** 2))
    layers = []
    for share, back, ahead in _LOOPS:
        flat = _HOLLOW + away * share
        height = ahead + (back - ahead) * behind
        height = height * (1 - 0.8 * lobe * (share > 0.4) * (share < 1.0))
        layers.append(np.column_stack([flat, height]))
    local = np.concatenate([*layers, [[*_HOLLOW, -5.4]]]) * 1e-3
    points = _placed(local)
    grid = np.arange(len(_LOOPS) * _AROUND).reshape(len(_LOOPS), _AROUND)
    following = np.roll(grid, -1, axis=1)
    a, b, c, d = grid[:-1], grid[1:], following[1:], following[:-1]
    sheets = [np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))]
    middle = np.full(_AROUND, grid.size)
    left = np.concatenate([*sheets, np.stack([grid[-1], middle, following[-1]], axis=1)])
    return (
        np.concatenate([points, points * (-1.0, 1.0, 1.0)]),
        np.concatenate([left, left[:, ::-1] + len(points)]),
    )


def _placed(local: Floats) -> Floats:
    """Turn (backward, up, outward) into the head's axes."""
    back = local[:, 0] * np.cos(_TILT) + local[:, 1] * np.sin(_TILT)
    up = -local[:, 0] * np.sin(_TILT) + local[:, 1] * np.cos(_TILT)
    out = local[:, 2] * np.cos(_STAND_OFF) + back * np.sin(_STAND_OFF)
    back = back * np.cos(_STAND_OFF) - local[:, 2] * np.sin(_STAND_OFF)
    return np.column_stack([out, up, -back]) + _PLACE


def _smooth_loop(corners: Floats, count: int) -> Floats:
    """Return `count` points on the smooth closed curve through `corners`."""
    at = np.arange(count) * len(corners) / count
    first = at.astype(np.intp)
    t = (at - first)[:, None]
    before, here, there, after = (corners[(first + k) % len(corners)] for k in (-1, 0, 1, 2))
    bend = 2 * before - 5 * here + 4 * there - after
    return np.asarray(
        here + 0.5 * t * (there - before + t * (bend + t * (3 * (here - there) + after - before))),
        np.float64,
    )
