"""The relief of the face: what stands out of, and lies below, the loft's smooth front.

Every feature is a displacement over the face's plane (x, y). Sizes in millimetres,
after average adult faces; the nose's ridge is a drawn profile.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.surface import front

Floats = NDArray[np.float64]


class _Bump(NamedTuple):
    """A smooth hill (or hollow) over an ellipse around (x, y), mirrored to the other side."""

    x: float
    y: float
    radius_x: float
    radius_y: float
    height: float
    sideways: float = 0.0
    upward: float = 0.0


_BUMPS = {
    "orbit": _Bump(31.0, 0.0, 19.0, 13.0, -6.5),
    "inner orbit": _Bump(14.5, 6.0, 7.5, 9.0, -2.2),
    "brow ridge": _Bump(27.0, 19.0, 20.0, 7.5, 2.8),
    "glabella": _Bump(0.0, 20.0, 12.0, 9.0, 1.0),
    "cheekbone": _Bump(45.0, -24.0, 17.0, 12.0, 3.2, 1.5),
    "front cheek": _Bump(31.0, -36.0, 16.0, 14.0, 2.2),
    "cheek hollow": _Bump(52.0, -60.0, 16.0, 18.0, -2.5, -1.0),
    "temple": _Bump(66.0, 22.0, 14.0, 16.0, -1.5, -1.5),
    "muzzle": _Bump(0.0, -64.0, 27.0, 19.0, 4.0),
    "chin crease": _Bump(0.0, -86.0, 17.0, 6.0, -2.9),
    "chin": _Bump(0.0, -101.0, 16.0, 10.5, 4.2),
    "beside chin": _Bump(27.0, -96.0, 10.0, 12.0, -1.5),
    "philtrum": _Bump(0.0, -54.0, 3.4, 7.5, -1.3),
    "philtrum ridge": _Bump(6.0, -55.0, 3.0, 8.0, 0.6),
    "corner of mouth": _Bump(30.0, -70.0, 7.0, 9.0, -1.2),
    "nose side": _Bump(11.0, -30.0, 7.0, 11.0, 2.2),
    "nose tip": _Bump(0.0, -37.5, 7.5, 5.5, 1.0),
    "columella": _Bump(0.0, -43.5, 3.6, 3.0, 1.0, 0.0, -0.9),
    "nose wing": _Bump(12.8, -40.6, 4.7, 4.9, 8.0, 1.0, -0.8),
    "wing crease": _Bump(19.6, -40.0, 3.0, 6.5, -1.4),
    "nostril": _Bump(6.8, -44.6, 2.6, 2.0, -2.2, 0.0, 1.3),
}

_RIDGE = np.array(
    [  # y, height above the loft, half-width
        [18.0, 0.0, 9.0],
        [10.0, 0.2, 6.6],
        [3.0, 2.0, 5.4],
        [-6.0, 6.4, 5.2],
        [-16.0, 11.4, 5.6],
        [-26.0, 16.2, 6.6],
        [-32.0, 20.8, 7.2],
        [-36.5, 23.0, 7.8],
        [-40.0, 20.6, 7.6],
        [-42.6, 16.2, 6.6],
        [-44.8, 10.8, 5.8],
        [-47.0, 5.4, 5.2],
        [-49.5, 1.8, 5.0],
        [-53.0, 0.0, 5.0],
    ]
)


def _hill(x: Floats, y: Floats, bump: _Bump) -> Floats:
    squared = ((np.abs(x) - bump.x) / bump.radius_x) ** 2 + ((y - bump.y) / bump.radius_y) ** 2
    return np.asarray(np.exp(-squared), dtype=np.float64)


def _drawn(y: Floats, column: int) -> Floats:
    """Return the ridge's drawn curve at `y`, by a cubic without overshoot."""
    knots, values = -_RIDGE[:, 0], _RIDGE[:, column]
    secants = np.diff(values) / np.diff(knots)
    slopes = np.zeros_like(values)
    same = secants[1:] * secants[:-1] > 0
    slopes[1:-1][same] = (2 * secants[1:] * secants[:-1] / (secants[1:] + secants[:-1]))[same]
    at = np.clip(-y, knots[0], knots[-1])
    low = np.clip(np.searchsorted(knots, at, side="right") - 1, 0, len(knots) - 2)
    width = (knots[1:] - knots[:-1])[low]
    b = (at - knots[low]) / width
    rise = b * b * (3 - 2 * b)
    return np.asarray(
        values[low] * (1 - rise)
        + values[low + 1] * rise
        + width * b * (1 - b) * (slopes[low] * (1 - b) - slopes[low + 1] * b),
        dtype=np.float64,
    )


def face_at(xy: Floats) -> Floats:
    """Return the points of the face, relief and all, in front of (x, y).

    Parameters
    ----------
    xy : (..., 2) float64, metres

    Returns
    -------
    (..., 3) float64, metres
    """
    points = front(xy[..., 0], xy[..., 1])
    return points + relief(points)


def relief(points: Floats) -> Floats:
    """Return the displacement of points of the loft's front.

    Parameters
    ----------
    points : (..., 3) float64, metres

    Returns
    -------
    (..., 3) float64, metres
    """
    x, y = points[..., 0] * 1e3, points[..., 1] * 1e3
    # Of the front alone: fades towards the ears.
    shown = np.clip(points[..., 2] / 0.02, 0.0, 1.0)
    total = np.zeros_like(points)
    for bump in _BUMPS.values():
        hill = _hill(x, y, bump) * shown
        total[..., 2] += bump.height * hill
        if bump.sideways:
            total[..., 0] += bump.sideways * hill * np.sign(x)
        if bump.upward:
            total[..., 1] += bump.upward * hill
    # The tip's underside rises to both sides of the columella.
    under = np.where(y < -36.0, y - 1.6 * np.minimum(np.abs(x) / 7.0, 1.6) ** 2, y)
    ridge = np.exp(-0.69 * np.abs(x / _drawn(y, 2)) ** 2.3)
    total[..., 2] += _drawn(under, 1) * ridge * shown
    return total * 1e-3
