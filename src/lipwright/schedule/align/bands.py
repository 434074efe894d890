"""The spectrum in fine steps: what boundaries between phones are looked for in.

Logarithms of the power in 18 mel bands every 5 ms, over 16 ms, without their mean over
the sound: finer in time than the features of the acoustic model (:mod:`.features`), and
with nothing tracked from frame to frame.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lipwright.schedule.align.features import RATE

STEP = 80  # samples between frames
BANDS = 18
_WINDOW = 256
_LOWEST, _HIGHEST = 80.0, 7500.0
_FLOOR = 1e-5  # of the mean power: digital silence is like a quiet room's
_SCALE = 0.4  # brings the values near to -1..1
# First and last frame of each mean, from the boundary: wider further away from it.
_EDGES = (-14, -10, -7, -5, -3, -2, -1, 0, 1, 2, 3, 5, 7, 10, 14)
CONTEXT = BANDS * (len(_EDGES) - 1)


def bands(samples: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the level of each band in each frame.

    Parameters
    ----------
    samples : (N,) float32
        Sound at 16 kHz.

    Returns
    -------
    (N // 80, 18) float32
        Frame t covers ``5 t`` to ``5 (t + 1)`` ms.
    """
    sharpened = np.append(samples[:1], samples[1:] - np.float32(0.97) * samples[:-1])
    padded = np.pad(sharpened, ((_WINDOW - STEP) // 2, _WINDOW))
    windows = np.lib.stride_tricks.sliding_window_view(padded, _WINDOW)[::STEP]
    windows = windows[: len(samples) // STEP]
    spectrum = np.fft.rfft(windows * np.hanning(_WINDOW).astype(np.float32))
    power = (np.square(spectrum.real) + np.square(spectrum.imag)) @ _mel_bands().T
    level = np.log(power + _FLOOR * power.mean() + 1e-20)
    return np.asarray(_SCALE * (level - level.mean(axis=0)), np.float32)


def contexts(frames: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return what surrounds each instant between two frames.

    Parameters
    ----------
    frames : (T, 18) float32

    Returns
    -------
    (T + 1, 252) float32
        Means over 14 stretches of the 70 ms before and after ``5 t`` ms.
    """
    reach, count = _EDGES[-1], len(frames) + 1
    padded = np.pad(frames.astype(np.float64), ((reach, reach), (0, 0)), mode="edge")
    sums = np.vstack([np.zeros((1, BANDS)), np.cumsum(padded, axis=0)])
    means = [
        (sums[reach + last : reach + last + count] - sums[reach + first : reach + first + count])
        / (last - first)
        for first, last in pairwise(_EDGES)
    ]
    return np.concatenate(means, axis=1).astype(np.float32)


@cache
def _mel_bands() -> NDArray[np.float32]:
    lowest, highest = (2595 * np.log10(1 + f / 700) for f in (_LOWEST, _HIGHEST))
    edges = 700 * (10 ** (np.linspace(lowest, highest, BANDS + 2) / 2595) - 1)
    low, middle, high = (edges[i : BANDS + i, None] for i in range(3))
    frequency = np.arange(_WINDOW // 2 + 1) * RATE / _WINDOW
    rising = (frequency - low) / (middle - low)
    falling = (high - frequency) / (high - middle)
    weights = np.maximum(0.0, np.minimum(rising, falling))
    for band in np.flatnonzero(weights.sum(axis=1) < 1e-6):  # narrower than a bin
        weights[band, round(float(edges[band + 1]) * _WINDOW / RATE)] = 1.0
    return np.asarray(weights / weights.sum(axis=1, keepdims=True), np.float32)
