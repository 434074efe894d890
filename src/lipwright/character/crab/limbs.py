"""Claws on arms, and walking legs: the big claw is the left one. Millimetres."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lipwright.character.crab.forms import Limb, Solid, joined, mirrored

Floats = NDArray[np.float64]
Rows = list[list[float]]


class Claw(NamedTuple):
    """One arm with its claw.

    Parameters
    ----------
    arm, hand, finger, teeth : Solid
        The arm; palm and fixed finger; the finger that moves; the small teeth of both.
    moving : (V,) bool
        Which points of `teeth` are on the moving finger.
    wrist : (3,) float64
    """

    arm: Solid
    hand: Solid
    finger: Solid
    teeth: Solid
    moving: NDArray[np.bool_]
    wrist: Floats


# Stations of (x, y, z, radius) of a claw that stands upright on its wrist, its moving finger
# on the side of the body.
_PALM: Rows = [[0, -5, 0, 8], [1, 10, 0, 17], [3, 28, 0, 24], [5, 44, 0, 22], [7, 55, 0, 15]]
_FIXED: Rows = [[15, 40, 0, 14], [23, 58, 0, 12.5], [21, 76, 0, 8.5], [9, 93, 0, 3]]
_MOVING: Rows = [[-11, 42, 1, 11], [-23, 58, 1, 10], [-22, 74, 1, 7.5], [-9, 90, 1, 2.6]]
_KNUCKLE = np.array([-10.0, 44.0, 0.0])
_ACROSS = (1.0, 0.0, 0.0)
_FLAT = 0.66
# Small teeth: where on the finger, and how far they stand out.
_BITES = ((11.5, 62.0, -1.0, 4.2), (13.0, 71.0, -1.0, 3.4), (9.5, 80.0, -1.0, 2.6))
_MOVING_BITES = ((-14.5, 60.0, 1.0, 3.8), (-15.0, 69.0, 1.0, 3.2), (-13.0, 78.0, 1.0, 2.4))

_ARMS: dict[int, Rows] = {
    1: [[78, -20, 26, 13], [98, -44, 46, 11], [106, -51, 56, 12.5], [115, -42, 64, 10.5]],
    -1: [[78, -18, 26, 11], [95, -37, 44, 9], [103, -42, 53, 10], [110, -32, 60, 8]],
}
_HANDS = {1: (1.08, (116.0, -34.0, 65.0), -7.0), -1: (0.68, (110.0, -26.0, 61.0), -14.0)}
"""Of each side: size, wrist, and how far the claw leans outward (degrees)."""

# Hip, thigh, knee, shin and foot of each left leg, from the front.
_LEGS: tuple[Rows, ...] = (
    [
        [60, -36, 20, 10],
        [88, -54, 28, 9.5],
        [106, -54, 30, 8.5],
        [118, -70, 31, 6.4],
        [122, -86, 33, 1.6],
    ],
    [
        [64, -34, 0, 11],
        [98, -42, -2, 10],
        [124, -40, -3, 8.8],
        [138, -62, -4, 6.4],
        [143, -85, -4, 1.6],
    ],
    [
        [62, -28, -22, 10],
        [100, -24, -34, 9.4],
        [128, -20, -40, 8.2],
        [146, -50, -46, 6],
        [151, -82, -48, 1.5],
    ],
)


def claw(side: int) -> Claw:
    """Return the left (1) or the right (-1) arm and claw."""
    size, wrist, lean = _HANDS[side]
    place = _placing(size, np.array(wrist), lean)
    hand = joined(
        [
            Limb(_PALM, _FLAT, _ACROSS, 16, 18).solid(),
            Limb(_FIXED, _FLAT, _ACROSS, 14, 14).solid(),
        ]
    )
    finger = Limb(_MOVING, _FLAT, _ACROSS, 14, 14).solid()
    teeth = joined([_bite(*bite) for bite in (*_BITES, *_MOVING_BITES)])
    moving = np.arange(len(teeth.points)) >= len(teeth.points) // 2
    arm = Limb(_ARMS[side], 0.92, rings=18, sides=16).solid()
    solids = [arm, *(_moved(solid, place) for solid in (hand, finger, teeth))]
    if side < 0:
        solids = [mirrored(solid) for solid in solids]
    flip = np.array([side, 1.0, 1.0])
    return Claw(solids[0], solids[1], solids[2], solids[3], moving, np.array(wrist) * flip)


def knuckle(side: int) -> Floats:
    """Return the point about which a claw's moving finger turns."""
    size, wrist, lean = _HANDS[side]
    place = _placing(size, np.array(wrist), lean)
    return np.asarray(place(_KNUCKLE[None])[0] * (side, 1.0, 1.0), np.float64)


def _bite(x: float, y: float, side: float, out: float) -> Solid:
    way = [[x - 3 * side, y, 0, 4.2], [x, y, 0, 3.2], [x + out * side, y, 0, 0.9]]
    return Limb(way, hint=(0.0, 1.0, 0.0), rings=4, sides=7).solid()


def _placing(size: float, wrist: Floats, lean: float) -> Callable[[Floats], Floats]:
    angle = np.radians(lean)
    turn = np.array(
        [[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]]
    )

    def place(points: Floats) -> Floats:
        return np.asarray(size * points @ turn.T + wrist, np.float64)

    return place


def _moved(solid: Solid, place: Callable[[Floats], Floats]) -> Solid:
    return solid._replace(points=place(solid.points))


def legs() -> Solid:
    """Return the walking legs of both sides."""
    left = [Limb(_jointed(leg), 0.8, rings=18, sides=10).solid() for leg in _LEGS]
    return joined([*left, *(mirrored(leg) for leg in left)])


def _jointed(stations: Rows) -> Floats:
    """Return a leg with thinner places beside its knees."""
    rows = np.array(stations, np.float64)
    middles = 0.5 * (rows[:-1] + rows[1:])
    middles[:, 3] *= [0.86, 1.0, 1.06, 1.04]
    woven = np.empty((2 * len(rows) - 1, 4))
    woven[::2], woven[1::2] = rows, middles
    return woven
