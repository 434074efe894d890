"""The head's net: rows around the head, with a window for the mouth and one for each eye.

Columns run down the head and gather where the face has detail; a window's edge is the
outermost of the loops that :mod:`.lips` and :mod:`.lids` lay inside it. One half is laid
out and mirrored, so that both sides are equal to the bit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.relief import relief
from lipwright.character.head.surface import SECTION_COUNT, angle_at, loft, section_at

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

# Where the front columns run: height, then the breadth of each column (mm).
_COLUMNS = np.array(
    [
        [58.0, 0.0, 6.5, 13.0, 20.0, 27.0, 34.0, 40.5, 46.5, 52.5, 58.5, 64.0, 68.5],
        [30.0, 0.0, 5.0, 9.5, 14.5, 20.5, 27.0, 33.5, 40.5, 48.5, 55.5, 62.0, 67.5],
        [17.0, 0.0, 4.0, 8.0, 12.0, 18.0, 25.0, 32.0, 40.0, 48.5, 55.5, 62.0, 67.0],
        [0.0, 0.0, 3.2, 6.6, 10.0, 18.0, 25.0, 32.0, 40.0, 53.5, 58.5, 62.5, 66.5],
        [-20.0, 0.0, 3.4, 6.8, 10.5, 16.5, 23.5, 31.0, 39.0, 48.0, 54.0, 59.5, 64.5],
        [-33.0, 0.0, 3.4, 6.8, 10.3, 14.3, 19.5, 25.5, 33.0, 42.0, 49.5, 56.0, 62.0],
        [-42.0, 0.0, 3.2, 6.4, 9.8, 13.5, 17.2, 20.8, 28.0, 38.0, 46.5, 53.5, 60.0],
        [-48.0, 0.0, 3.2, 6.6, 10.2, 14.5, 19.0, 23.5, 30.0, 38.0, 46.0, 53.0, 59.0],
        [-68.0, 0.0, 4.5, 9.0, 14.0, 19.5, 25.0, 31.0, 36.5, 41.5, 47.0, 52.0, 56.5],
        [-94.0, 0.0, 3.8, 7.8, 12.0, 16.5, 21.2, 26.2, 31.2, 36.4, 41.0, 45.5, 49.5],
        [-107.0, 0.0, 3.6, 7.4, 11.4, 15.6, 20.0, 24.6, 29.4, 34.4, 39.0, 43.5, 47.5],
    ]
)
_FRONT = _COLUMNS.shape[1] - 1
_BEHIND = 7  # columns from the last front one to the middle of the back
_FRONT_ROWS = (
    *(79.0, 66.0, 54.0, 42.0, 32.0, 24.5),  # forehead
    *(18.5, 13.0, 7.5, 1.5, -5.0, -12.0, -19.5),  # the eyes' window
    *(-25.5, -31.0, -35.3, -38.8, -41.8, -44.3, -46.6),  # nose
    *(-50.0, -54.0, -58.5, -63.0, -68.0, -73.5, -79.5, -86.5, -94.0),  # the mouth's window
    *(-100.5, -106.0, -110.0),  # chin
)
_CROWN_ROWS = (0.12, 0.45, 0.95, 1.55, 2.2, 2.85, 3.4)
_NECK_ROWS = (14.45, 15.0, 15.6, 16.2, 16.9, 17.7, 18.4, 19.0)
_MOUTH_ROWS, _MOUTH_COLUMNS = (20, 28), (0, 8)
_EYE_ROWS, _EYE_COLUMNS = (6, 12), (3, 8)


@dataclass(frozen=True, slots=True)
class Net:
    """One half (x >= 0) of the head's net, with its windows still open.

    Parameters
    ----------
    points : (V, 3) float64, metres
    quads : (Q, 4) intp
        Counter-clockwise from outside.
    cap : (T, 3) intp
        Triangles that close the crown.
    mouth : (2n + 1,) intp
        The half loop around the mouth's window, from above the middle to below it.
    eye : (2n,) intp
        The loop around the eye's window, clockwise from its upper inner corner.
    """

    points: Floats
    quads: Indices
    cap: Indices
    mouth: Indices
    eye: Indices


def half_net() -> Net:
    """Lay out the half net on the loft with its relief."""
    angles, v = _layout()
    grid = np.arange(angles.size, dtype=np.intp).reshape(angles.shape)
    points = loft(angles.ravel(), v.ravel())
    points = points + relief(points)
    points[grid[:, [0, -1]].ravel(), 0] = 0.0
    quads = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=-1)
    kept = np.ones(quads.shape[:2], dtype=bool)
    first_front = len(_CROWN_ROWS)
    for (top, bottom), (left, right) in (
        (_MOUTH_ROWS, _MOUTH_COLUMNS),
        (_EYE_ROWS, _EYE_COLUMNS),
    ):
        kept[first_front + top : first_front + bottom, left:right] = False
    crown = np.full(angles.shape[1] - 1, grid.size)
    cap = np.stack([crown, grid[0, :-1], grid[0, 1:]], axis=1)
    points = np.concatenate([points, loft(0.0, 0.0)[None]])
    return Net(points, quads[kept], cap, _half_loop(grid, first_front), _loop(grid, first_front))


def _layout() -> tuple[Floats, Floats]:
    """Return (angle, section) of every node: (rows, columns) each."""
    rows = np.concatenate([_CROWN_ROWS, section_at(np.array(_FRONT_ROWS) * 1e-3), _NECK_ROWS])
    keys = section_at(_COLUMNS[:, 0] * 1e-3)
    key_angles = angle_at(_COLUMNS[:, 1:] * 1e-3, keys[:, None])
    even = np.linspace(0.0, 1.25, _FRONT)
    keys = np.concatenate([[0.0, 2.2], keys, [15.0, SECTION_COUNT - 1.0]])
    key_angles = np.concatenate([[even, even], key_angles, [even, even]])
    ahead = np.stack([np.interp(rows, keys, column) for column in key_angles.T], axis=1)
    share = np.linspace(0.0, 1.0, _BEHIND + 1)[1:]
    behind = ahead[:, -1:] + (np.pi - ahead[:, -1:]) * share
    angles = np.concatenate([ahead, behind], axis=1)
    return angles, np.broadcast_to(rows[:, None], angles.shape).copy()


def _half_loop(grid: Indices, first: int) -> Indices:
    top, bottom = first + _MOUTH_ROWS[0], first + _MOUTH_ROWS[1]
    right = _MOUTH_COLUMNS[1]
    return np.concatenate([grid[top, :right], grid[top:bottom, right], grid[bottom, right::-1]])


def _loop(grid: Indices, first: int) -> Indices:
    top, bottom = first + _EYE_ROWS[0], first + _EYE_ROWS[1]
    left, right = _EYE_COLUMNS
    return np.concatenate(
        [
            grid[top, left:right],
            grid[top:bottom, right],
            grid[bottom, right:left:-1],
            grid[bottom:top:-1, left],
        ]
    )
