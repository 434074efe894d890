"""Spikes: a marker that leaves its path for a few frames, alone, and comes back.

A marker is a spike where it is farther from the median of the seven frames around it than
its noise explains, and the markers next to it are not: lips that burst open move together.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.capture.around import Indices, neighbours, shared
from lipwright.engines.motion.capture.head import median
from lipwright.engines.motion.capture.motion import Floats

HALF = 3
"""Frames on either side; a spike may last as long."""
FARTHEST = 1e-3
"""Metres from the median that are never a spike, at 60 frames per second or more."""
BEYOND_NOISE = 8.0
_FEWEST, _ONE_SIDED = 2, 4.0
_AT_ONCE = 2048


def find_spikes(points: Floats, rate: float) -> NDArray[np.bool_]:
    """Tell which places are spikes.

    Parameters
    ----------
    points : (T, M, 3) float64
        On a still head, metres; NaN where a marker was not seen.
    rate : float
        Frames per second.

    Returns
    -------
    (T, M) bool
    """
    around = neighbours(median(points))
    off = np.concatenate(
        [_off(points, around, at, at + _AT_ONCE) for at in range(0, len(points), _AT_ONCE)]
    )
    limit = np.maximum(FARTHEST * max(1.0, 60.0 / rate), BEYOND_NOISE * 1.4826 * median(off))
    with np.errstate(invalid="ignore"):
        return np.asarray(off > limit)


def _off(points: Floats, around: Indices, first: int, last: int) -> Floats:
    """Return how far markers are off their medians, against those around them (frames, M)."""
    last = min(last, len(points))
    low, high = first - HALF, last + HALF
    wide = np.full((high - low, *points.shape[1:]), np.nan)
    inside = slice(max(low, 0), min(high, len(points)))
    wide[inside.start - low : inside.stop - low] = points[inside]
    windows = np.lib.stride_tricks.sliding_window_view(wide, 2 * HALF + 1, axis=0)
    off = points[first:last] - median(np.moveaxis(windows, 3, 0))
    seen = np.isfinite(windows[:, :, 0])
    sides = np.minimum(seen[..., :HALF].sum(axis=2), seen[..., HALF + 1 :].sum(axis=2))
    one_sided = sides < _FEWEST  # there the median lags behind what moves
    far = np.linalg.norm(off - shared(off, around), axis=2)
    return np.asarray(np.where(one_sided, far / _ONE_SIDED, far))
