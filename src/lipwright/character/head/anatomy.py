"""Where each vertex belongs: the fields over a part from which the poses take their clusters.

A field is a weight per vertex. ``jaw`` is how much a vertex goes with the lower jaw; the
others say where it lies about the mouth and the eyes. Poses are written in these fields,
so that any part that lies on the face (skin, brows) moves with it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lipwright.character.clusters import step
from lipwright.character.head.lids import EYE_CENTER, FIRST_TURN, rim_turn
from lipwright.character.head.lids import RIM as LID_RIM
from lipwright.character.head.lips import CONTACT, CORNER, RED, half_turns
from lipwright.character.head.skin import Skin

Floats = NDArray[np.float64]

_MOUTH_Y = CORNER[1]
# Loops of the mouth from the window's edge inward: how far `side` is counted along the loop.
_ALONG = np.array([0.0, 0.3, 0.6, 0.85, 0.97, *[1.0] * 12])[:, None]
# ... how red they are,
_REDNESS = np.concatenate([np.zeros(RED + 2), np.array([1, 2, 3]) / 3, np.ones(8)])[:, None]
# ... and how the loops behind the contact follow the lips, less and less.
_FOLLOW = np.array([1.0, 0.95, 0.7, 0.3, 0.06, 0.0, 0.0, 0.0])[:, None]
# Loops of the lids, from the window's edge to behind the rim: how far they close.
_CLOSING = np.array([0.0, 0.10, 0.32, 0.62, 0.88, 1.0, 1.0, 1.0])[:, None]


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
    line = -0.040 - 0.35 * z
    cheek = step(0.014, -0.030, y - line)
    back = step(-0.022, 0.022, z + 0.35 * np.minimum(y + 0.07, 0.0))
    neck = step(-0.158, -0.112, y)
    far = cheek * back * neck
    lips = _lip_jaw(side) * step(-0.044, -0.056, y - 0.25 * np.maximum(np.abs(x) - 0.02, 0.0))
    mixed = step(1.1, 2.6, away)
    return lips * (1.0 - mixed) + far * mixed


def of_skin(skin: Skin) -> Anatomy:
    """Return the fields of the skin, which also knows its loops around mouth and eyes."""
    face = on_face(skin.points)
    loops = skin.mouth
    turn = half_turns(loops.shape[1] // 2 + 1)
    around = np.cos(np.pi * np.concatenate([turn, turn[-2:0:-1]]))
    side, near, wide, jaw = (field.copy() for field in (face.side, face.near, face.wide, face.jaw))
    red, flap, outside = np.zeros(len(side)), np.zeros(len(side)), face.skin.copy()
    side[loops] = side[loops] * (1 - _ALONG) + around * _ALONG
    jaw[loops] = jaw[loops] * (1 - _ALONG) + _lip_jaw(around) * _ALONG
    # At a corner all loops meet in a point and go one way, the contact's.
    lip = np.clip(np.abs(around) * 3.0, 0.0, 1.0)
    lips, inner = slice(RED + 1, None), slice(CONTACT + 2, None)
    red[loops[lips]] = 1.0 + (_REDNESS[lips] - 1.0) * lip
    near[loops[lips]] = wide[loops[lips]] = 1.0
    near[loops[inner]] = wide[loops[inner]] = _FOLLOW
    deep = step(1.0, 4.0, np.arange(len(_FOLLOW), dtype=np.float64))[:, None]
    jaw[loops[inner]] = _lip_jaw(around) * (1 - deep) + (0.5 - 0.5 * around) * deep
    flap[loops[CONTACT + 3]] = np.clip(-around, 0.0, 1.0) ** 0.5
    outside[loops[inner]] = 0.0
    near[skin.back] = wide[skin.back] = outside[skin.back] = 0.0
    jaw[skin.back] = 0.5
    changed = {"jaw": jaw, "near": near, "wide": wide, "side": side, "red": red, "flap": flap}
    return replace(face, **changed, skin=outside, lid=_lids(skin))


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
        turns[eye][loops] = _CLOSING * (pitch - meeting)
    return turns
