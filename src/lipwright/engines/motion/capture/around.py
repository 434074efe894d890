"""The markers next to each marker, and what they have in common: flesh moves together."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.capture.head import median
from lipwright.engines.motion.capture.motion import Floats

Indices = NDArray[np.intp]

COUNT = 6


def distances(face: Floats) -> Floats:
    """Return the distances of all markers of a face (M, M); infinite to itself."""
    apart: Floats = np.linalg.norm(face[:, None] - face[None], axis=2)
    apart[~np.isfinite(apart)] = np.inf
    np.fill_diagonal(apart, np.inf)
    return apart


def neighbours(face: Floats) -> Indices:
    """Return the nearest markers of each, (M, 6) or as many as there are."""
    return np.argsort(distances(face), axis=1)[:, : min(COUNT, len(face) - 1)]


def shared(values: Floats, around: Indices) -> Floats:
    """Return the median of ``values`` (T, M, 3) over the neighbours; 0 where none is known."""
    found = median(np.moveaxis(values[:, around], 2, 0))
    return np.where(np.isfinite(found), found, 0.0)
