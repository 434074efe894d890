"""The features that the acoustic model was trained on: mel cepstra and their changes.

The front end of CMU Sphinx with the settings of its American English model: windows of
25.6 ms, 25 mel bands from 130 to 6800 Hz, tracked noise taken out (after Doblinger 1995
and Kim's power-normalised cepstra), cosine transform, lifter 22, mean over the line taken
out, and changes over ± 20 and ± 30 ms as second and third streams.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

RATE = 16000
HOP = 160  # samples between frames
BANDS = 25
CEPSTRA = 13
_WINDOW = 410
_FFT = 512
_LOWEST, _HIGHEST = 130.0, 6800.0
_LIFTER = 22
_REACH = 3  # frames that a second change looks to either side


def cepstra(samples: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return mel cepstra; their mean is still in them.

    Parameters
    ----------
    samples : (N,) float32
        Sound at 16 kHz, in -1..1.

    Returns
    -------
    (T, 13) float32
        Frame t is centred on ``t * 10 ms``.
    """
    # A floor of always the same noise: digital silence has no logarithm.
    scaled = samples * 32767.0 + np.random.default_rng(0).normal(0.0, 1.0, len(samples))
    sharpened = np.append(scaled[:1], scaled[1:] - 0.97 * scaled[:-1])
    padded = np.pad(sharpened, (_WINDOW // 2, _WINDOW))
    windows = np.lib.stride_tricks.sliding_window_view(padded, _WINDOW)[::HOP]
    windows = windows[: len(samples) // HOP + 1]
    power = np.abs(np.fft.rfft(windows * np.hamming(_WINDOW), _FFT)) ** 2
    bands = _without_noise(power @ _mel_bands().T)
    return np.asarray(np.log(bands + 1e-4) @ _cosines().T, np.float32)


def with_changes(cepstra: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return the three feature streams.

    Parameters
    ----------
    cepstra : (T, 13) float32

    Returns
    -------
    (3, T, 13) float32
        The cepstra without their mean, their changes, and the changes of those.
    """
    level = cepstra - cepstra.mean(axis=0)
    count = len(level)
    edged = np.pad(level, ((_REACH, _REACH), (0, 0)), mode="edge")

    def at(offset: int) -> NDArray[np.float32]:
        return edged[_REACH + offset : _REACH + offset + count]

    return np.stack([level, at(2) - at(-2), (at(3) - at(-1)) - (at(1) - at(-3))])


def _without_noise(bands: NDArray[np.float64]) -> NDArray[np.float64]:
    """Weigh each band by how far it stands above its tracked floor."""
    most = 20.0
    if not len(bands):
        return bands
    power = bands[0].copy()
    noise, floor = power / most, power / most
    peak = np.zeros_like(power)
    gains = np.empty_like(bands)
    for t, frame in enumerate(bands):
        power = 0.7 * power + 0.3 * frame
        noise = _lower_envelope(power, noise)
        signal = np.maximum(power - noise, 1.0)
        floor = _lower_envelope(signal, floor)
        peak = 0.85 * peak
        masked = np.where(signal < 0.85 * peak, 0.2 * peak, signal)
        peak = np.maximum(peak, signal)
        gains[t] = np.maximum(masked, floor) / power
    gains = np.clip(gains, 1 / most, most)
    return bands * (gains @ _neighbours().T)


def _lower_envelope(value: NDArray[np.float64], floor: NDArray[np.float64]) -> NDArray[np.float64]:
    keep = np.where(value >= floor, 0.995, 0.5)
    return np.asarray(keep * floor + (1 - keep) * value)


@cache
def _neighbours() -> NDArray[np.float64]:
    apart = np.abs(np.subtract.outer(np.arange(BANDS), np.arange(BANDS)))
    near = (apart <= 4).astype(np.float64)
    return np.asarray(near / near.sum(axis=1, keepdims=True))


@cache
def _mel_bands() -> NDArray[np.float64]:
    lowest, highest = (2595 * np.log10(1 + f / 700) for f in (_LOWEST, _HIGHEST))
    mel = np.linspace(lowest, highest, BANDS + 2)
    bin_width = RATE / _FFT
    edges = np.round(700 * (10 ** (mel / 2595) - 1) / bin_width) * bin_width
    low, middle, high = (edges[i : BANDS + i, None] for i in range(3))
    frequency = np.arange(_FFT // 2 + 1) * bin_width
    rising = (frequency - low) / (middle - low)
    falling = (high - frequency) / (high - middle)
    return np.asarray(np.maximum(0.0, np.minimum(rising, falling)) * 2 / (high - low))


@cache
def _cosines() -> NDArray[np.float64]:
    order = np.arange(CEPSTRA)[:, None]
    basis = np.cos(np.pi / BANDS * order * (np.arange(BANDS) + 0.5)) * np.sqrt(2 / BANDS)
    basis[0] *= np.sqrt(0.5)
    lifter = 1 + _LIFTER / 2 * np.sin(np.pi * order / _LIFTER)
    return np.asarray(basis * lifter)
