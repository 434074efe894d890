"""RASTA-PLP: nine numbers a frame that say what was spoken, whatever the microphone.

Perceptual linear prediction (Hermansky 1990, equations 1 to 8) with the RASTA filter
between (Hermansky and Morgan 1994, equation 1): power in critical bands on the Bark scale,
its logarithm, a band-pass filter over time in each band alone, back from the logarithm,
the ear's equal loudness, the cube root of the power law of hearing, an all-pole model of
order 8, and its cepstra with the gain first.

A fixed gain in a band, which is what microphones and rooms differ by, is a constant in
that band's logarithm, and the filter takes constants away: the features do not change. So
that this holds in pauses too, the floor under a band's power is a share of its own peak.

The filter is published for 100 frames per second and is applied at that rate; the result is
brought to the rate of a motion afterwards. The published filter looks 40 ms ahead, which
puts its answer 20 ms before the sound: here it looks 20 ms ahead and both are in step.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import SoundError
from lipwright.sound import Sound

Floats = NDArray[np.float64]

RATE = 16000
"""Samples per second that every sound is brought to: bands must mean the same everywhere."""
ANALYSED = 100.0
"""Frames per second of the analysis."""
PARAMETERS = 9
POLE = 0.98
_HOP = 160
_WINDOW = 400
_FFT = 512
_ORDER = PARAMETERS - 1
_LIFTER = 0.6  # exponent that brings the cepstra to like spreads
_FLOOR = 1e-6  # of a band's peak: 60 dB below it
_BLOCK = 4096  # frames at a time: half an hour must not be windowed all at once


@dataclass(frozen=True, slots=True, eq=False)
class Features:
    """Features of a sound over time.

    Parameters
    ----------
    values : (T, 9) float32
        Frame k holds what is heard at ``start + (k + 0.5) / rate``.
    rate : float
        Frames per second.
    start : float
        Seconds.
    """

    values: NDArray[np.float32]
    rate: float
    start: float = 0.0


def rasta_plp(
    sound: Sound, rate: float = ANALYSED, start: float = 0.0, count: int | None = None
) -> Features:
    """Return the features of a sound at a motion's frames.

    Parameters
    ----------
    sound : Sound
        Any rate; its first sample is at 0 s.
    rate : float
        Frames per second wanted. Below 100, a frame is the mean over its time.
    start : float
        Seconds at which the first frame begins; what is outside the sound is as its ends.
    count : int, optional
        Frames wanted; as many as the sound is long, by default.

    Raises
    ------
    SoundError
        If the sound has no samples.
    """
    if not len(sound.samples):
        raise SoundError("a sound without samples", expected="sound to take features from")
    if count is None:
        count = max(1, round((sound.duration - start) * rate))
    analysed = from_bands(band_power(sound.resampled(RATE).samples))
    parts = max(1, int(np.ceil(ANALYSED / rate - 1e-9)))
    times = start + (np.arange(count * parts) + 0.5) / (parts * rate)
    values = between(analysed, times * ANALYSED).reshape(count, parts, PARAMETERS).mean(axis=1)
    return Features(values.astype(np.float32), rate, start)


def band_power(samples: NDArray[np.float32]) -> Floats:
    """Return the power in critical bands, (T, 21); frame t is centred on ``t * 10 ms``.

    Parameters
    ----------
    samples : (N,) float32
        Sound at 16 kHz.
    """
    padded = np.pad(samples.astype(np.float64), _WINDOW // 2, mode="symmetric")
    windows = np.lib.stride_tricks.sliding_window_view(padded, _WINDOW)[::_HOP]
    weights, shape = _critical_bands().T, np.hamming(_WINDOW)
    blocks = [
        (np.abs(np.fft.rfft(windows[first : first + _BLOCK] * shape, _FFT)) ** 2) @ weights
        for first in range(0, len(windows), _BLOCK)
    ]
    return np.concatenate(blocks)


def from_bands(power: Floats) -> Floats:
    """Return the features of powers in critical bands.

    Parameters
    ----------
    power : (T, B) float64
        At 100 frames per second, the bands evenly apart on the Bark scale up to 8 kHz.

    Returns
    -------
    (T, 9) float64
    """
    peak = power.max(axis=0)
    floored = power + np.where(peak > 0, _FLOOR * peak, 1.0)
    filtered = np.exp(rasta(np.log(floored)))
    heard = np.cbrt(filtered * _equal_loudness(power.shape[1]))
    heard[:, 0], heard[:, -1] = heard[:, 1], heard[:, -2]  # bands whose skirts are cut off
    mirrored = np.concatenate((heard, heard[:, -2:0:-1]), axis=1)
    correlation = np.fft.rfft(mirrored).real[:, : _ORDER + 1] / mirrored.shape[1]
    cepstra = _cepstra(*_all_pole(correlation))
    cepstra[:, 1:] *= np.arange(1, PARAMETERS) ** _LIFTER
    return cepstra


def rasta(curves: Floats, pole: float = POLE) -> Floats:
    """Band-pass curves over time: ``0.1 z^2 (2 + z^-1 - z^-3 - 2 z^-4) / (1 - pole z^-1)``.

    Parameters
    ----------
    curves : (T, B) float64
        At 100 frames per second; taken as constant before the first and after the last.
    pole : float
        Memory of the filter, as published 0.98: half a second.
    """
    edged = np.pad(curves, ((2, 2), (0, 0)), mode="edge")
    count = len(curves)
    ahead, near = edged[4:] - edged[:count], edged[3:-1] - edged[1 : count + 1]
    total: Floats = 0.2 * ahead + 0.1 * near
    # y[t] = x[t] + pole y[t - 1], in steps that double: each adds a sum as long as itself.
    step, gain = 1, pole
    while step < count and gain > 1e-18:
        total[step:] = total[step:] + gain * total[:-step]
        step, gain = 2 * step, gain * gain
    return total


def between(values: NDArray[np.floating], positions: NDArray[np.floating]) -> Floats:
    """Return rows at fractional positions, linearly between; the ends beyond the ends.

    Parameters
    ----------
    values : (T, C)
    positions : (N,) float64
    """
    held = np.clip(positions, 0, len(values) - 1)
    below = np.minimum(held.astype(np.int64), max(len(values) - 2, 0))
    share = (held - below)[:, None]
    above = np.minimum(below + 1, len(values) - 1)
    result: Floats = values[below] * (1 - share) + values[above] * share
    return result


def _bark(hertz: NDArray[np.floating]) -> Floats:
    return np.asarray(6 * np.arcsinh(hertz / 600))


def _centres(count: int) -> Floats:
    """Middles of the bands in Bark, from 0 to half the sample rate."""
    return np.linspace(0.0, float(_bark(np.array(RATE / 2))), count)


@cache
def _critical_bands() -> Floats:
    """Weights of each frequency in each band, (21, 257): about one band per Bark."""
    count = int(np.ceil(_bark(np.array(RATE / 2)))) + 1
    bark = _bark(np.arange(_FFT // 2 + 1) * (RATE / _FFT))
    # Masking: the curve over the distance of the band from the frequency.
    apart = _centres(count)[:, None] - bark[None, :]
    rising = 10 ** (2.5 * (apart + 0.5))
    falling = 10 ** (-(apart - 0.5))
    weights = np.minimum(1.0, np.minimum(rising, falling))
    return np.where((apart >= -1.3) & (apart <= 2.5), weights, 0.0)


@cache
def _equal_loudness(count: int) -> Floats:
    """The ear's sensitivity in each band, near 40 dB (Hermansky 1990, equation 7)."""
    square = (2 * np.pi * 600 * np.sinh(_centres(count) / 6)) ** 2
    return np.asarray((square + 56.8e6) * square**2 / ((square + 6.3e6) ** 2 * (square + 0.38e9)))


def _all_pole(correlation: Floats) -> tuple[Floats, Floats]:
    """Predictor (T, 9), its first 1, and what it leaves (T,): Levinson and Durbin."""
    predictor = np.zeros_like(correlation)
    predictor[:, 0] = 1.0
    left = correlation[:, 0].copy()
    for order in range(1, correlation.shape[1]):
        past = correlation[:, order:0:-1]
        reflection = -(predictor[:, :order] * past).sum(axis=1) / left
        mirrored = predictor[:, order - 1 :: -1][:, :order]
        predictor[:, 1 : order + 1] += reflection[:, None] * mirrored
        left *= 1 - reflection**2
    return predictor, left


def _cepstra(predictor: Floats, gain: Floats) -> Floats:
    """Cepstra of the all-pole model, by recursion; the logarithm of the gain first."""
    cepstra = np.empty_like(predictor)
    cepstra[:, 0] = np.log(gain)
    for n in range(1, predictor.shape[1]):
        m = np.arange(1, n)
        before = (m * cepstra[:, 1:n] * predictor[:, n - m]).sum(axis=1) / n
        cepstra[:, n] = -predictor[:, n] - before
    return cepstra
