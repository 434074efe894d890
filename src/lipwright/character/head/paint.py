"""The skin's colours per vertex: lips, the dark of the mouth, nostrils, and a little blood."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.lids import RIM as LID_RIM
from lipwright.character.head.lids import rim_turn
from lipwright.character.head.lips import CONTACT, RED
from lipwright.character.head.skin import Skin

Floats = NDArray[np.float64]

_LIP = np.array([0.78, 0.44, 0.44])
# Loops behind the contact: the mouth's lining, ever darker, as no light comes there.
_LINING = np.array(
    [
        [0.66, 0.34, 0.34],
        [0.55, 0.23, 0.23],
        [0.42, 0.14, 0.14],
        [0.20, 0.060, 0.060],
        [0.13, 0.036, 0.036],
        [0.085, 0.022, 0.022],
        [0.045, 0.011, 0.011],
        [0.020, 0.005, 0.005],
    ]
)
_BLUSH = (  # x, y, radius (mm), strength
    (40.0, -30.0, 17.0, 0.16),
    (0.0, -38.0, 11.0, 0.14),
    (13.0, -41.0, 6.0, 0.12),
    (0.0, -99.0, 13.0, 0.07),
)


def paint_skin(skin: Skin) -> Floats:
    """Return each vertex's colour, to be multiplied with the material's: (V, 3), linear."""
    x, y = np.abs(skin.points[:, 0]) * 1e3, skin.points[:, 1] * 1e3
    ahead = np.clip(skin.points[:, 2] / 0.03, 0.0, 1.0)
    colors = np.ones_like(skin.points)
    for across, height, radius, strength in _BLUSH:
        share = strength * ahead * np.exp(-((x - across) ** 2 + (y - height) ** 2) / radius**2)
        colors *= 1.0 - share[:, None] * np.array([0.15, 1.0, 0.85])
    nostril = np.exp(-(((x - 6.6) / 2.1) ** 2) - ((y + 44.6) / 1.3) ** 2) * ahead
    colors *= 1.0 - nostril[:, None] * np.array([0.72, 0.82, 0.82])
    _paint_lips(skin, colors)
    for loops in skin.eyes:
        _paint_lids(loops, colors)
    return colors


def shade(points: Floats, back: float, ahead: float) -> Floats:
    """Return grey per vertex for what lies in the mouth: dark at depth `back`, light ahead."""
    share = np.clip((points[:, 2] - back) / (ahead - back), 0.0, 1.0)
    return np.repeat((0.10 + 0.85 * share**1.3)[:, None], 3, axis=1)


def _paint_lips(skin: Skin, colors: Floats) -> None:
    count = skin.mouth.shape[1]
    middle = np.abs(np.cos(2 * np.pi * np.arange(count) / count))
    paling = (0.15 + 0.85 * np.clip(middle / 0.35, 0.0, 1.0))[:, None]
    for number in range(RED + 1, CONTACT + 2):
        share = (0.6, 1.0, 1.0, 1.0)[number - RED - 1]
        colors[skin.mouth[number]] *= 1.0 - share * paling * (1.0 - _LIP)
    colors[skin.mouth[CONTACT + 1]] *= 0.88
    for number, lining in enumerate(_LINING):
        colors[skin.mouth[CONTACT + 2 + number]] = lining
    colors[skin.back] = _LINING[-1]


def _paint_lids(loops: NDArray[np.intp], colors: Floats) -> None:
    """Darken the rims where lashes grow, most on the upper lid; leave the corners pink."""
    turn = rim_turn(loops.shape[1])
    upper = turn < 0.5
    lash = np.abs(np.sin(2 * np.pi * turn)) * np.where(upper, 1.0, 0.45)
    dark = np.array([[0.90, 0.82, 0.82], [0.34, 0.22, 0.20], [0.16, 0.09, 0.08], [0.2, 0.1, 0.1]])
    pink = np.array(
        [[0.96, 0.90, 0.89], [0.88, 0.70, 0.67], [0.80, 0.48, 0.45], [0.70, 0.36, 0.33]]
    )
    for number in range(4):
        rim = pink[number] + (dark[number] - pink[number]) * lash[:, None]
        colors[loops[LID_RIM + number]] *= rim
