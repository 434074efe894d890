"""Where each vertex belongs: the fields over a part from which the poses take their clusters.

A field is a weight per vertex. ``jaw`` is how much a vertex goes with the lower jaw; the
others say where it lies about the mouth and the eyes. Poses are written in these fields,
so that any part that lies on the face (skin, brows) moves with it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.lids import EYE_CENTER, FIRST_TURN, rim_turn
from lipwright.character.head.lids import RIM as LID_RIM
from lipwright.character.head.lips import CONTACT, CORNER, RED, half_turns
from lipwright.character.head.skin import Skin

Floats = NDArray[np.float64]

_MOUTH_Y = CORNER[1]
# Per loop from the window's edge inward: how far `side` is counted along the loop.
_ALONG = np.array([0.0, 0.3, 0.6, 0.85, 0.97] + [1.0] * 12)
# Loops behind the contact follow the lips less and less.
# Loops of the lids, from the window's edge to behind the rim.
_LID_SHARES = np.array([0.0, 0.10, 0.32, 0.62, 0.88, 1.0, 1.0, 1.0])
_FOLLOW = np.array([1.0, 0.95, 0.7, 0.3, 0.06, 0.0, 0.0, 0.0])


@dataclass(frozen=True, slots=True, eq=False)
class Anatomy:
    """The fields of one part; each (V,) unless said otherwise.

    Parameters
    ----------
    points : (V, 3) float64, metres
    jaw : 0..1
        How much the vertex goes with the lower jaw.
    near : 0..1
        1 on the lips, falling over the skin around them.
    wide : 0..1
        The same, reaching over the cheeks.
    side : -1..1
        1 above the middle of the mouth, 0 at its corners, -1 below.
    red : 0..1
        0 outside the red of the lips, 1 where they meet and inside.
    flap : 0..1
        The inner side of the lower lip, which presses up behind the upper lip.
    lid : (2, V) float64, degrees
        Of the left and right eye: how far the vertex turns about the eyeball to close it.
    skin : 0..1
        1 on the face's surface, 0 inside the mouth and on the eyeballs.
    ball : -1, 0, 1
        1 on the left eyeball, -1 on the right one.
    tongue : 0..1
        Share of the tongue's length, 1 at the tip; NaN elsewhere.
    """

    points: Floats
    jaw: Floats
    near: Floats
    wide: Floats
    side: Floats
    red: Floats
    flap: Floats
    lid: Floats
    skin: Floats
    ball: Floats
    tongue: Floats

    def with_jaw(self, jaw: Floats) -> Anatomy:
        """Return the same part with other weights of the jaw."""
        return replace(self, jaw=jaw)


def step(low: float, high: float, values: Floats) -> Floats:
    """Return 0 below `low`, 1 above `high`, smooth between (either order)."""
    share = np.clip((values - low) / (high - low), 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share), np.float64)


def rigid(
    points: Floats, jaw: float = 0.0, *, tongue: Floats | None = None, ball: float = 0.0
) -> Anatomy:
    """Return the fields of a part under the skin, which goes with the jaw by `jaw`."""
    none = np.zeros(len(points))
    lid = np.zeros((2, len(points)))
    share = np.full(len(points), np.nan) if tongue is None else tongue
    return Anatomy(points, none + jaw, none, none, none, none, none, lid, none, none + ball, share)


def on_face(points: Floats) -> Anatomy:
    """Return the fields of points on the face, from where they lie."""
    x, y = points[:, 0], points[:, 1]
    up = (y - _MOUTH_Y) / 0.0125
    away = np.hypot(x / 0.0262, up)
    side = up / np.maximum(np.hypot(x / 0.031, up), 1e-6)
    below_nose = 1.0 - step(-0.052, -0.046, y) * (1.0 - step(0.017, 0.030, np.abs(x)))
    ahead = step(0.0, 0.03, points[:, 2])
    near = np.exp(-((np.maximum(away - 1.0, 0.0) / 0.6) ** 2)) * below_nose * ahead
    wide = np.exp(-((np.maximum(away - 1.0, 0.0) / 1.2) ** 2)) * below_nose * ahead
    none = np.zeros(len(points))
    lid = np.zeros((2, len(points)))
    nan = np.full(len(points), np.nan)
    return Anatomy(
        points, _jaw(points, side, away), near, wide, side, none, none, lid, none + 1.0, none, nan
    )


def _lip_jaw(side: Floats) -> Floats:
    """Return how much lips go with the jaw: the corners hang between."""
    return np.where(side < 0, 0.40 - 0.60 * side, 0.40 * (1.0 - side)).clip(0.0, 1.0)


def _jaw(points: Floats, side: Floats, away: Floats) -> Floats:
    """Return how much the skin goes with the jaw."""
    x, y, z = points.T
    # Below a line from the ear's lobe to the corner of the mouth, in front of the ear,
    # above the middle of the neck.
    line = -0.040 + (z - 0.0) * (-0.028 / 0.08)
    cheek = step(0.014, -0.030, y - line)
    back = step(-0.022, 0.022, z + 0.35 * np.minimum(y + 0.07, 0.0))
    neck = step(-0.158, -0.112, y)
    far = cheek * back * neck
    lips = _lip_jaw(side) * step(-0.044, -0.056, y - 0.25 * np.maximum(np.abs(x) - 0.02, 0.0))
    mixed = step(1.1, 2.6, away) * step(0.0, 1.0, np.abs(away))
    return lips * (1.0 - mixed) + far * mixed


def of_skin(skin: Skin) -> Anatomy:
    """Return the fields of the skin, which also knows its loops around mouth and eyes."""
    face = on_face(skin.points)
    loops, count = skin.mouth.shape
    turn = half_turns(count // 2 + 1)
    around = np.cos(np.pi * np.concatenate([turn, turn[-2:0:-1]]))
    side, near, wide, jaw = (field.copy() for field in (face.side, face.near, face.wide, face.jaw))
    red, flap = np.zeros(len(side)), np.zeros(len(side))
    reds = np.concatenate(
        [np.zeros(RED + 2), np.linspace(0, 1, CONTACT - RED + 1)[1:], np.ones(len(_FOLLOW))]
    )
    for number in range(loops):
        ids = skin.mouth[number]
        side[ids] = face.side[ids] * (1 - _ALONG[number]) + around * _ALONG[number]
        jaw[ids] = face.jaw[ids] * (1 - _ALONG[number]) + _lip_jaw(around) * _ALONG[number]
        if number > RED:
            near[ids] = wide[ids] = 1.0
            # At a corner all loops meet in a point and go one way.
            lip = np.clip(np.abs(around) * 3.0, 0.0, 1.0)
            red[ids] = 0.5 + (reds[number] - 0.5) * lip
    for behind, follow in enumerate(_FOLLOW):
        ids = skin.mouth[CONTACT + 2 + behind]
        near[ids] = wide[ids] = follow
        deep = step(1.0, 4.0, np.full(count, float(behind)))
        jaw[ids] = _lip_jaw(around) * (1 - deep) + (0.5 - 0.5 * around) * deep
    flap[skin.mouth[CONTACT + 3]] = np.clip(-around, 0.0, 1.0) ** 0.5
    face.skin[skin.mouth[CONTACT + 2 :].ravel()] = 0.0
    last = np.argmin(np.abs(skin.points - (0.0, -0.074, 0.017)).sum(axis=1))
    near[last] = wide[last] = 0.0
    jaw[last] = 0.5
    return replace(
        face, jaw=jaw, near=near, wide=wide, side=side, red=red, flap=flap, lid=_lids(skin)
    )


def _lids(skin: Skin) -> Floats:
    """Return by how many degrees each vertex turns about the eyeball when the eye closes."""
    turns = np.zeros((2, len(skin.points)))
    for eye in range(2):
        loops = skin.eyes[eye]
        count = loops.shape[1]
        rim = skin.points[loops[LID_RIM + 2]] - EYE_CENTER * (1.0 - 2.0 * eye, 1.0, 1.0)
        pitch = np.degrees(np.arctan2(rim[:, 1], rim[:, 2]))
        other = pitch[(count - 2 * FIRST_TURN - np.arange(count)) % count]
        upper = rim_turn(count) < 0.5
        meeting = np.where(upper, 0.85 * other + 0.15 * pitch, 0.85 * pitch + 0.15 * other)
        turns[eye][loops] = _LID_SHARES[:, None] * (pitch - meeting)
    return turns
