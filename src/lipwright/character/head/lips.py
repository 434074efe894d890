"""The lips and the bag of the mouth: loops from the window's edge inward, one half.

From outside to inside: skin, the border of the red, the red, the contact where upper and
lower lip meet vertex for vertex, the inner lip, and a closed bag around teeth and tongue.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.relief import face_at

Floats = NDArray[np.float64]

CORNER = (0.0255, -0.0682)
_SKIN_SHARES = (0.24, 0.46, 0.66, 0.84)  # of the way from the window's edge to the red
_RED_SHARES = (0.3, 0.62)  # of the way from the red's border to the contact
RED = len(_SKIN_SHARES)  # number of the loop on the border, counted from the first made here
CONTACT = RED + 1 + len(_RED_SHARES)

# The loops behind the contact (mm): half breadth, top, bottom, depth in the middle and at
# the sides of the mouth (the dental arch between them is curved), and how much farther
# forward the upper half lies in the middle.
_BAG = np.array(
    [
        [28.0, -61.5, -76.5, 88.2, 73.0, 2.8],
        [31.2, -51.5, -85.0, 84.6, 64.0, 4.0],
        [30.9, -50.8, -89.5, 71.0, 57.0, 3.0],
        [29.6, -52.8, -87.6, 52.0, 47.0, 0.0],
        [24.0, -56.5, -85.5, 33.0, 32.0, 0.0],
        [12.0, -64.0, -81.0, 21.0, 21.0, 0.0],
    ]
)
# The loops between: how far above and below the contact, and how far behind it (mm).
_INNER_LIP = ((0.10, 0.35), (2.0, 4.6))
BACK = (0.0, -0.074, 0.017)


def half_turns(count: int) -> Floats:
    """Return each loop vertex's turn: 0 above the middle, 0.5 at the corner, 1 below."""
    return np.linspace(0.0, 1.0, count)


def contact(turn: Floats) -> Floats:
    """Return the line where the closed lips meet: (n, 3), metres."""
    x = CORNER[0] * np.sin(np.pi * turn) ** 0.92
    share = x / CORNER[0]
    # The upper lip's middle hangs a little; the line rises beside it and falls to the corner.
    y = -0.0678 - 0.0007 * np.exp(-((share / 0.22) ** 2)) - 0.0004 * share**4
    skin = face_at(np.stack([x, y], axis=1))
    skin[:, 2] += 0.0016 + 0.0012 * share**2 - 0.0036 * share**5
    return skin


def red_border(turn: Floats) -> Floats:
    """Return the border between the red and the skin: (n, 2), metres."""
    upper = turn <= 0.5
    x = (CORNER[0] + 0.0004) * np.sin(np.pi * turn) ** np.where(upper, 0.95, 0.9)
    share = np.clip(x / CORNER[0], 0.0, 1.0)
    bow = 0.0007 * np.cos(np.clip(share / 0.27, 0.0, 2.0) * np.pi)  # Cupid's
    above = -0.0606 - bow - 0.0074 * np.clip((share - 0.2) / 0.8, 0.0, 1.0) ** 1.35
    below = -0.0684 - 0.0103 * np.clip(1.0 - share**2.3, 0.0, 1.0) ** 0.85
    return np.stack([x, np.where(upper, above, below)], axis=1)


@dataclass(frozen=True, slots=True)
class Lips:
    """The loops inside the mouth's window, one half.

    Parameters
    ----------
    loops : (L, n, 3) float64, metres
        From the first inside the window to the last of the bag.
    back : (3,) float64, metres
        The bag's end.
    """

    loops: Floats
    back: Floats


def half_lips(edge: Floats) -> Lips:
    """Lay the loops inside the window whose half edge is `edge`, (n, 3) metres."""
    turn = half_turns(len(edge))
    border, meet = red_border(turn), contact(turn)
    share = np.array([*_SKIN_SHARES, 1.0])[:, None]
    skin = face_at(edge[:, :2] * (1 - share[..., None]) + border * share[..., None])
    skin[..., 2] += _edge_lift(turn) * share**2.5
    red = [_red(skin[-1], meet, turn, part) for part in _RED_SHARES]
    inner = [_inner_lip(turn, meet, rise, depth) for rise, depth in _INNER_LIP]
    bag = [_bag(turn, row) for row in _BAG * 1e-3]
    loops = np.stack([*skin, *red, meet, *inner, *bag])
    loops[:, [0, -1], 0] = 0.0
    return Lips(loops, np.array(BACK))


def _edge_lift(turn: Floats) -> Floats:
    """Return how far the red's border stands out of the skin (metres)."""
    middle = np.abs(np.cos(np.pi * turn))
    return np.where(turn < 0.5, 0.0018, 0.0008) * middle


def _red(outer: Floats, meet: Floats, turn: Floats, share: float) -> Floats:
    """Return a loop on the red, which bulges between its border and the contact."""
    points = outer * (1 - share) + meet * share
    middle = np.abs(np.cos(np.pi * turn)) ** 0.8
    bulge = np.where(turn < 0.5, 0.0021, 0.0040) * np.sin(np.pi * share) ** 0.8 * middle
    points[:, 2] += bulge
    return points


def _inner_lip(turn: Floats, meet: Floats, rise: float, depth: float) -> Floats:
    """Return a loop on the lips' inner side, behind the contact."""
    cosine = np.cos(np.pi * turn)
    middle = np.abs(cosine)
    return np.column_stack(
        [
            meet[:, 0] + 0.0003 * (1.0 - middle) * (meet[:, 0] > 0),
            meet[:, 1] + rise * 1e-3 * np.sign(cosine) * middle**0.7,
            meet[:, 2] - depth * 1e-3 * (0.35 + 0.65 * middle),
        ]
    )


def _bag(turn: Floats, row: Floats) -> Floats:
    """Return a loop of the bag around teeth and tongue."""
    breadth, top, bottom, middle_z, side_z, ahead = row
    cosine = np.cos(np.pi * turn)
    x = breadth * np.sin(np.pi * turn) ** 0.9
    level = CORNER[1]
    y = level + np.where(cosine > 0, top - level, level - bottom) * cosine
    z = middle_z + (side_z - middle_z) * (x / breadth) ** 2
    z = z + ahead * np.clip(cosine, 0.0, 1.0)
    return np.stack([x, y, z], axis=1)
