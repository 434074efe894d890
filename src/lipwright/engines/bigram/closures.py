"""Closures that fall between two frames are not lost (DESIGN section 4, stage 7).

At 24 frames per second a /p/ can lie between two frames, or its peak can. The frame of
its interval that is closest to the peak, or the nearest frame where the interval holds
none, takes the value that the curve reaches within the phone.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from lipwright.engines.bigram.polyline import Floats, range_max
from lipwright.engines.bigram.preparation import Spans
from lipwright.engines.bigram.stages import Stages


def keep_closures(
    values: Floats,
    spans: Spans,
    stages: Stages,
    reach: Mapping[str, int],
    first: float,
    rate: float,
) -> None:
    """Raise single samples so that each phone reaches the shape that its class must.

    Parameters
    ----------
    values : (P, T) float64
        Samples, changed in place.
    spans : Spans
    stages : Stages
        Whose constrained curves say how far each phone's shape goes.
    reach : mapping of str to int
        Number of the pose that a class must reach.
    first, rate : float
        Sample ``k`` lies at ``first + k / rate``.
    """
    count = values.shape[1]
    for pose in set(reach.values()):
        mine = np.flatnonzero([reach.get(label) == pose for label in spans.labels])
        if not len(mine):
            continue
        starts, ends = spans.heard[mine].T
        peaks = _peaks(stages, pose, starts, ends)
        for start, end, peak in zip(starts.tolist(), ends.tolist(), peaks.tolist(), strict=True):
            low = math.ceil((start - first) * rate - 1e-9)
            high = math.ceil((end - first) * rate - 1e-9)
            if high <= low:  # no frame within: the nearest one
                low = round((0.5 * (start + end) - first) * rate)
                high = low + 1
            low, high = max(low, 0), min(high, count)
            if low >= high:
                continue
            best = low + int(values[pose, low:high].argmax())
            if values[pose, best] < peak:
                values[pose, best] = peak


def _peaks(stages: Stages, pose: int, starts: Floats, ends: Floats) -> Floats:
    """Greatest value of a pose's curve within each interval, before it is held."""
    times, values = stages.axis.own(stages.constrained, pose)
    low = np.searchsorted(times, starts, side="left")
    high = np.searchsorted(times, ends, side="right")
    edges = np.maximum(np.interp(starts, times, values), np.interp(ends, times, values))
    return np.maximum(range_max(values, low, high), edges)
