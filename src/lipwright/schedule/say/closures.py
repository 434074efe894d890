"""Closures of stops: the silence before a burst belongs to the stop.

espeak-ng labels a stop from its burst on, and counts the closure, for which the lips
are shut, in the phone before. Here the silence at the end of that phone is moved into
the stop; a stop after a pause takes the last of the pause.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

_QUIET = 0.1  # of the preceding phone's peak: 20 dB down, above the echo that some voices have
_SHORTEST = 0.004  # seconds; a glottal period of low voices has gaps below this
_AFTER_PAUSE = 0.06  # seconds; the closure of a stop that begins a phrase
_KEPT = 0.25  # what the preceding phone keeps at least of its time


def begin_stops_at_closure(
    samples: NDArray[np.float32],
    rate: int,
    labels: Sequence[str],
    edges: Sequence[int],
    *,
    is_stop: Callable[[str], bool],
    silence: str,
) -> list[int]:
    """Return the phones' edges with each closure inside its stop.

    Parameters
    ----------
    samples : (N,) float32
        The sound.
    rate : int
        Samples per second.
    labels : sequence of str
        P phones.
    edges : sequence of int
        P + 1 samples: where each phone begins, and where the last one ends.
    is_stop : function
        Whether a label begins with a closure.
    silence : str
        The label of a pause.
    """
    result = list(edges)
    for index in range(1, len(labels)):
        if not is_stop(labels[index]):
            continue
        start, burst = result[index - 1], edges[index]
        if labels[index - 1] == silence:
            result[index] = burst - min(round(_AFTER_PAUSE * rate), (burst - start) // 2)
        else:
            result[index] = _closure(samples, start, burst, rate)
    return result


def _closure(samples: NDArray[np.float32], start: int, burst: int, rate: int) -> int:
    sound = np.abs(samples[start:burst])
    if sound.size == 0 or not (peak := float(sound.max())):
        return burst
    end = start + int(np.flatnonzero(sound > _QUIET * peak)[-1]) + 1
    end = max(end, start + round(_KEPT * (burst - start)))
    return end if burst - end >= _SHORTEST * rate else burst
