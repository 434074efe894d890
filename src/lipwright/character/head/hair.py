"""Short hair: a shell over the scalp with the flow of strands, swept to one side."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.surface import loft, section_at

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

# The hairline: angle around the head (degrees), height on the left and on the right (mm).
# The hair is parted on the left and swept to the right.
_LINE = np.array(
    [
        [0.0, 74.0, 74.0],
        [10.0, 78.0, 71.0],
        [17.0, 81.5, 68.5],
        [25.0, 79.0, 65.0],
        [35.0, 72.0, 60.5],
        [46.0, 61.0, 54.0],
        [56.0, 46.0, 44.0],
        [65.0, 28.0, 28.0],
        [70.0, 14.0, 14.0],
        [75.0, 0.0, 0.0],
        [80.0, -6.0, -6.0],
        [84.0, -3.0, -3.0],
        [88.0, 10.0, 10.0],
        [94.0, 22.0, 22.0],
        [103.0, 25.0, 25.0],
        [113.0, 8.0, 8.0],
        [121.0, -24.0, -24.0],
        [131.0, -56.0, -56.0],
        [150.0, -66.0, -66.0],
        [180.0, -68.0, -68.0],
    ]
)
_COLUMNS = 60
# From the hairline to the crown: share of the way, and share of the full thickness.
_ROWS = np.array(
    [
        [0.0, -0.14],
        [0.015, 0.30],
        [0.06, 0.62],
        [0.14, 0.86],
        [0.25, 0.97],
        [0.38, 1.0],
        [0.52, 1.0],
        [0.66, 1.0],
        [0.80, 1.0],
        [0.92, 1.0],
    ]
)


def hair() -> tuple[Floats, Indices, Floats]:
    """Return the hair: vertices (V, 3) in metres, triangles (F, 3), colours (V, 3)."""
    turn = np.arange(_COLUMNS) * 2 * np.pi / _COLUMNS
    angle = np.where(turn <= np.pi, turn, 2 * np.pi - turn)
    sign = np.where(turn <= np.pi, 1.0, -1.0)
    left, right = (np.interp(np.degrees(angle), _LINE[:, 0], line) for line in _LINE.T[1:])
    low = np.where(sign > 0, left, right) * 1e-3
    # Towards the back sections tilt: a line's height is that of its own side.
    bottom = _section_of(angle, low)
    share, fullness = _ROWS[:, :1], _ROWS[:, 1:]
    v = bottom * (1 - share)
    base = loft(np.broadcast_to(angle, v.shape), v)
    thick = fullness * _thickness(base, sign, v)
    strands = _strands(angle * sign, v)
    points = (
        base
        + _outward(base) * ((thick + 0.9 * strands * np.clip(fullness, 0.0, 1.0)) * 1e-3)[..., None]
    )
    points[..., 0] *= sign
    crown = loft(0.0, 0.0)
    crown[1] += 0.0125
    grid = np.arange(points[..., 0].size).reshape(points.shape[:2])
    following = np.roll(grid, -1, axis=1)
    a, b, c, d = grid[1:], grid[:-1], following[:-1], following[1:]
    sheets = [np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))]
    top = np.full(_COLUMNS, grid.size)
    cap = np.stack([top, grid[-1], following[-1]], axis=1)
    return (
        np.concatenate([points.reshape(-1, 3), crown[None]]),
        np.concatenate([*sheets, cap]),
        np.concatenate([1.0 + 0.35 * strands.reshape(-1, 1), [[1.0]]]) * 0.7 * np.ones(3),
    )


def _section_of(angle: Floats, height: Floats) -> Floats:
    """Return the section that has the height at the angle."""
    front_y = height.copy()
    for _ in range(8):
        front_y = front_y + height - loft(angle, section_at(front_y))[..., 1]
    return section_at(front_y)


def _outward(base: Floats) -> Floats:
    """Return directions away from the middle of the skull."""
    away = base - (0.0, 0.02, -0.008)
    away[..., 1] = np.where(away[..., 1] < 0, away[..., 1] * 0.2, away[..., 1])
    return np.asarray(away / np.linalg.norm(away, axis=-1, keepdims=True), np.float64)


def _thickness(base: Floats, sign: Floats, v: Floats) -> Floats:
    """Return the hair's full thickness (mm): most over the forehead, least at the nape."""
    x = base[..., 0] * sign * 1e3
    top = np.clip((base[..., 1] * 1e3 - 25.0) / 65.0, 0.0, 1.0)
    ahead = np.clip((base[..., 2] * 1e3 + 5.0) / 60.0, 0.0, 1.0)
    swept = np.exp(-(((x + 14.0) / 30.0) ** 2))
    parting = np.exp(-(((x - 24.0) / 5.0) ** 2)) * ahead * top
    return np.asarray(4.5 + 6.0 * top + 10.0 * top * ahead * swept - 5.0 * parting, np.float64)


def _strands(turn: Floats, v: Floats) -> Floats:
    """Return the ridges of strands, -1..1, which fall from the parting and the crown."""
    flow = turn * 9.0 + 1.1 * v
    return np.asarray(0.6 * np.sin(flow) + 0.4 * np.sin(2.7 * flow + 1.0), np.float64)
