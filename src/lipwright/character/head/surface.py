"""The head's smooth outside: a loft through cross-sections, and relief on its front.

The sections give the large form (crown, forehead, jaw, neck) from average adult
proportions: eyes at half the height, the mouth a third of the way from nose to chin.
The relief adds nose, orbits, cheekbones, muzzle and chin as displacements of the front.
Lips and eyelids are not made here (:mod:`.lips`, :mod:`.lids`); they blend into it.

The origin lies between the eyes in the axis of the head; metres.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


class _Section(NamedTuple):
    """A closed curve around the head, in millimetres; exponents of a superellipse (2: ellipse)."""

    front_y: float
    front_z: float
    side_x: float
    side_y: float
    side_z: float
    back_y: float
    back_z: float
    front_power: float
    back_power: float


_SECTIONS = (
    # front_y, front_z, side_x, side_y, side_z, back_y, back_z, front_power, back_power
    _Section(113.5, -8.0, 0.0, 113.5, -8.0, 113.5, -8.0, 2.0, 2.0),
    _Section(111.0, 17.0, 20.0, 111.0, -8.0, 111.0, -33.0, 2.0, 2.0),
    _Section(103.5, 42.0, 39.0, 103.0, -9.0, 102.0, -58.0, 2.05, 2.0),
    _Section(91.0, 63.0, 55.0, 90.0, -10.0, 88.0, -78.0, 2.1, 2.0),
    _Section(74.0, 78.5, 66.5, 72.0, -12.0, 68.0, -92.0, 2.15, 2.0),
    _Section(54.0, 87.5, 73.0, 51.0, -13.0, 45.0, -100.0, 2.2, 2.0),
    _Section(35.0, 91.5, 75.0, 32.0, -13.0, 22.0, -102.5, 2.2, 2.0),
    _Section(18.0, 92.0, 74.0, 16.0, -12.0, 2.0, -101.0, 2.2, 2.0),
    _Section(0.0, 87.5, 71.5, -1.0, -10.0, -16.0, -96.5, 2.2, 2.0),
    _Section(-20.0, 87.0, 69.5, -19.0, -8.0, -32.0, -89.5, 2.1, 2.0),
    _Section(-45.0, 88.5, 65.5, -40.0, -6.0, -49.0, -82.0, 2.05, 2.0),
    _Section(-68.0, 89.0, 61.0, -57.0, -4.0, -63.0, -77.0, 2.0, 2.0),
    _Section(-88.0, 87.5, 57.0, -70.0, -4.0, -74.0, -74.0, 2.0, 2.0),
    _Section(-102.0, 86.5, 53.5, -80.0, -5.0, -83.0, -72.5, 2.0, 2.0),
    _Section(-111.0, 79.0, 50.0, -88.0, -8.0, -92.0, -71.5, 2.0, 2.0),
    _Section(-116.0, 61.0, 47.5, -97.0, -14.0, -101.0, -71.0, 2.0, 2.0),
    _Section(-122.0, 45.0, 48.0, -108.0, -18.0, -111.0, -71.0, 2.0, 2.0),
    _Section(-138.0, 35.0, 48.5, -126.0, -20.0, -126.0, -72.0, 2.0, 2.0),
    _Section(-160.0, 31.0, 51.0, -150.0, -21.0, -147.0, -75.0, 2.0, 2.0),
    _Section(-182.0, 31.0, 58.0, -175.0, -22.0, -172.0, -80.0, 2.0, 2.0),
)
SECTION_COUNT = len(_SECTIONS)
_ROWS = np.array(_SECTIONS) * np.array([1e-3] * 7 + [1.0, 1.0])


def _natural_spline(values: Floats) -> Floats:
    """Return the second derivatives of the natural cubic through rows at 0, 1, 2, ..."""
    count = len(values)
    matrix = np.eye(count)
    inner = np.arange(1, count - 1)
    matrix[inner, inner] = 4.0
    matrix[inner, inner - 1] = matrix[inner, inner + 1] = 1.0
    right = np.zeros_like(values)
    right[1:-1] = 6.0 * (values[2:] - 2.0 * values[1:-1] + values[:-2])
    return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)


_BENDS = _natural_spline(_ROWS)


def _section(v: Floats) -> Floats:
    """Return the section at `v` (0..SECTION_COUNT - 1): (9, ...)."""
    low = np.clip(v.astype(np.intp), 0, SECTION_COUNT - 2)
    b = (v - low)[..., None]
    a = 1.0 - b
    value = a * _ROWS[low] + b * _ROWS[low + 1]
    value = value + ((a**3 - a) * _BENDS[low] + (b**3 - b) * _BENDS[low + 1]) / 6.0
    return np.asarray(np.moveaxis(value, -1, 0), dtype=np.float64)


_FINE_V = np.linspace(0.0, SECTION_COUNT - 1.0, 761)
_FINE_Y = _section(_FINE_V)[0]


def section_at(front_y: ArrayLike) -> Floats:
    """Return the section number whose front lies at the height `front_y`."""
    found = np.interp(-np.asarray(front_y, dtype=np.float64), -_FINE_Y, _FINE_V)
    return np.asarray(found, dtype=np.float64)


def loft(angle: ArrayLike, v: ArrayLike) -> Floats:
    """Return points of the loft.

    Parameters
    ----------
    angle : array
        Around the head, 0 (front) .. pi (back), on the left side.
    v : array
        The section, 0 (crown) .. SECTION_COUNT - 1 (end of the neck).

    Returns
    -------
    (..., 3) float64, metres
    """
    angle, v = np.broadcast_arrays(np.asarray(angle, np.float64), np.asarray(v, np.float64))
    front_y, front_z, side_x, side_y, side_z, back_y, back_z, front_n, back_n = _section(v)
    ahead = angle <= np.pi / 2
    power = 2.0 / np.where(ahead, front_n, back_n)
    sine, cosine = np.abs(np.sin(angle)), np.abs(np.cos(angle))
    x = side_x * sine**power
    z = side_z + (np.where(ahead, front_z, back_z) - side_z) * cosine**power
    y = side_y + (np.where(ahead, front_y, back_y) - side_y) * cosine**2
    return np.stack([x, y, z], axis=-1)


def angle_at(x: ArrayLike, v: ArrayLike) -> Floats:
    """Return the angle, 0..pi/2, at which section `v` has the breadth `x` (metres)."""
    section = _section(np.asarray(v, np.float64))
    ratio = np.clip(np.abs(np.asarray(x, np.float64)) / np.maximum(section[2], 1e-9), 0.0, 1.0)
    return np.asarray(np.arcsin(ratio ** (section[7] / 2.0)), dtype=np.float64)


def front(x: ArrayLike, y: ArrayLike) -> Floats:
    """Return the loft's point in front at (x, y), without relief: (..., 3), metres."""
    x, y = np.broadcast_arrays(np.asarray(x, np.float64), np.asarray(y, np.float64))
    height = y.copy()
    for _ in range(5):
        v = section_at(height)
        height = height + y - loft(angle_at(x, v), v)[..., 1]
    v = section_at(height)
    point = loft(angle_at(x, v), v)
    point[..., 0], point[..., 1] = x, y
    return point
