"""The words that every built-in character's poses share: shifts and turns of weighted vertices.

Each returns one :class:`~lipwright.character.face_model.Move` of a cluster; lengths in
millimetres and angles in degrees, as an animator would say them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.face_model import Move

Floats = NDArray[np.float64]


def step(low: float, high: float, values: Floats) -> Floats:
    """Return 0 below `low`, 1 above `high`, smooth between (either order)."""
    share = np.clip((values - low) / (high - low), 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share), np.float64)


def shift(weight: Floats, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Move:
    """Move a cluster by (x, y, z) mm."""
    return Move(weight[:, None] * np.array([x, y, z]) * 1e-3)


def turn(
    weight: Floats,
    degrees: float,
    axis: tuple[float, float, float],
    pivot: tuple[float, float, float],
) -> Move:
    """Turn a cluster about an axis through a pivot (metres)."""
    return Move(np.zeros((len(weight), 3)), weight * np.radians(degrees), axis, pivot)
