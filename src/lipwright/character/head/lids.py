"""The eyelids: loops from the window's edge to the eyeball, for the left eye."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.relief import face_at

Floats = NDArray[np.float64]

EYE_CENTER = np.array([0.0318, 0.0, 0.0648])
EYE_RADIUS = 0.0135
_INNER = (0.0172, -0.0020)  # corners of the opening
_OUTER = (0.0464, 0.0012)
_UPPER_RISE, _LOWER_FALL = 0.0049, 0.0053
_LID_THICKNESS = 0.0021
_SOFTNESS = 0.0035  # how smoothly skin and ball blend
_SHARES = (0.28, 0.50, 0.68, 0.83)  # of the way from the window's edge to the lid's rim
FIRST_TURN = 3  # loop vertices from the inner corner to the window's upper inner corner
RIM = len(_SHARES)  # the lid's front rim, counted from the first loop made here


def rim_turn(count: int) -> Floats:
    """Return each loop vertex's turn: 0 at the inner corner, 0.5 at the outer one."""
    return np.asarray((np.arange(count) + FIRST_TURN) / count % 1.0, np.float64)


def opening(count: int) -> Floats:
    """Return the lids' rim, clockwise from the upper inner side: (n, 2), metres."""
    turn = rim_turn(count)
    along = 0.5 - 0.5 * np.cos(2 * np.pi * turn)
    x = _INNER[0] + (_OUTER[0] - _INNER[0]) * along
    y = _INNER[1] + (_OUTER[1] - _INNER[1]) * along
    upper = turn < 0.5
    high = _UPPER_RISE * np.sin(np.pi * along**0.92) ** 0.75
    low = -_LOWER_FALL * np.sin(np.pi * along**1.15) ** 0.85
    return np.stack([x, y + np.where(upper, high, low)], axis=1)


def ball_front(xy: Floats, radius: Floats) -> Floats:
    """Return the eyeball's depth at (x, y), going on smoothly beside the ball."""
    away = _away(xy) * EYE_RADIUS / radius
    inside = np.sqrt(np.maximum(1.0 - np.minimum(away, 0.8) ** 2, 0.0))
    return np.asarray(
        EYE_CENTER[2] + radius * np.where(away < 0.8, inside, 0.6 - (away - 0.8) / 0.75), np.float64
    )


def left_lids(edge: Floats) -> Floats:
    """Lay the loops inside the eye's window with the edge `edge`: (L, n, 3), metres."""
    rim = opening(len(edge))
    center = rim.mean(axis=0)
    share = np.array(_SHARES)[:, None, None]
    lids = _over_ball(edge[:, :2] * (1 - share) + rim * share)
    front_rim = center + (rim - center) * [1.01, 1.10]
    rims = np.stack([front_rim, rim, _behind(rim, center)])
    return np.concatenate([lids, _on_ball(rims, np.array([0.0018, 0.0006, -0.0009])[:, None])])


def _away(xy: Floats) -> Floats:
    """Return the distance from the eyeball's middle, in radii."""
    away = np.hypot(xy[..., 0] - EYE_CENTER[0], xy[..., 1] - EYE_CENTER[1]) / EYE_RADIUS
    return np.asarray(away, np.float64)


def _behind(rim: Floats, center: Floats) -> Floats:
    """Return a loop inside the ball: behind the lids, and before the ball's rim at the corners."""
    corner = np.clip((_away(rim) - 0.75) / 0.3, 0.0, 1.0)[:, None]
    lids = center + (rim - center) * [1.02, 1.25]
    return np.asarray(lids * (1 - corner) + (center + (rim - center) * 0.82) * corner, np.float64)


def _on_ball(xy: Floats, above: Floats) -> Floats:
    """Return points `above` the ball; towards the nose they rise to the skin's depth."""
    depth = ball_front(xy, EYE_RADIUS + above)
    inner = np.clip((_away(xy) - 0.86) / 0.22, 0.0, 1.0) * (xy[..., 0] < EYE_CENTER[0])
    raised = np.maximum(depth, face_at(xy)[..., 2] - 0.0012 + 0.3 * above)
    return np.concatenate([xy, (depth + (raised - depth) * inner)[..., None]], axis=-1)


def _over_ball(xy: Floats) -> Floats:
    """Return the skin's points, which the ball pushes forward where it would come through."""
    points = face_at(xy)
    ball = ball_front(xy, np.full(xy.shape[:-1], EYE_RADIUS + _LID_THICKNESS))
    gap = points[..., 2] - ball
    points[..., 2] = ball + 0.5 * (gap + np.sqrt(gap**2 + _SOFTNESS**2)) - 0.3 * _SOFTNESS
    return points
