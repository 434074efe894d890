"""The words in which the head's poses are written, beside those that all characters share.

Each returns one :class:`~lipwright.character.face_model.Move` of a cluster; lengths in
millimetres and angles in degrees, as an animator would say them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.clusters import shift, step
from lipwright.character.face_model import Move
from lipwright.character.head.anatomy import Anatomy

Floats = NDArray[np.float64]

JAW_PIVOT = (0.0, -0.016, 0.004)


def gather(part: Anatomy, weight: Floats, share: float) -> Move:
    """Bring a cluster nearer to the middle by `share` of each vertex's distance."""
    translation = np.zeros_like(part.points)
    translation[:, 0] = -share * weight * part.points[:, 0]
    return Move(translation)


def spread(part: Anatomy, weight: Floats, x: float) -> Move:
    """Move a cluster outward by `x` mm on both sides, most at the corners of the mouth."""
    translation = np.zeros_like(part.points)
    translation[:, 0] = weight * x * 1e-3 * np.clip(part.points[:, 0] / 0.0255, -1.0, 1.0)
    return Move(translation)


def jaw(part: Anatomy, degrees: float, forward: float = 0.0, down: float = 0.0) -> list[Move]:
    """Open the jaw: it turns about its joints, which slide forward and down by mm."""
    slide = shift(part.jaw, 0.0, -down, forward).translation
    return [Move(slide, part.jaw * np.radians(degrees), (1.0, 0.0, 0.0), JAW_PIVOT)]


def half(part: Anatomy, side: int) -> Floats:
    """Return the weight of one side of the face: 1 left, -1 right; half in the middle."""
    return step(-0.011, 0.011, side * part.points[:, 0])


def upper(part: Anatomy, power: float = 1.0) -> Floats:
    """Return the upper lip: 1 in its middle, 0 at the corners; broader below a power of 1."""
    return part.near * _lip(part.side, power)


def lower(part: Anatomy, power: float = 1.0) -> Floats:
    """Return the lower lip: 1 in its middle, 0 at the corners; broader below a power of 1."""
    return part.near * _lip(-part.side, power)


def _lip(side: Floats, power: float) -> Floats:
    """Return a rise from 0 at the corners without a cleft there to 1 in the middle."""
    rise = np.clip(side, 0.0, 1.0)
    rise = rise * rise * (3.0 - 2.0 * rise)
    return np.asarray(1.0 - (1.0 - rise) ** (1.0 / power), np.float64)


def corner(part: Anatomy, power: float = 1.0) -> Floats:
    """Return the corners of the mouth: 1 there, 0 in the middle of the lips."""
    return part.near * (1.0 - np.clip(np.abs(part.side), 0.0, 1.0)) ** power
