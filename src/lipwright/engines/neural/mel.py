"""What the live net hears: 40 mel bands, a hundred times a second, at one loudness.

A frame is a Hann window of 25 ms. Its loudness is followed as the ear does: at once upwards,
slowly downwards; bands are told in relation to it, with a floor far below, so that a quieter
copy of a sound is the same sound, and what lies under the voice is none. An instant hears
nothing that comes later than its own window; :func:`settled` looks both ways, for recordings.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

RATE = 16000
HOP = 160
"""Samples from frame to frame."""
WINDOW = 400
BANDS = 40
_FFT = 512
_LOWEST, _HIGHEST = 60.0, 7600.0
QUIETEST = -62.0
"""dB of full scale; what stays below it all the time is silence."""
DEPTH = 60.0
"""dB below the loudness under which our nets hear nothing: many recordings are dark, and little of
the upper bands would be left at 45."""
_FALL = 4.0
"""dB by which the loudness falls per second."""
_TENTHS = np.log(10.0) / 10.0


def powers(samples: NDArray[np.float32], frames: int) -> Floats:
    """Return the power in each band of each frame.

    Parameters
    ----------
    samples : (N,) float32
        At 16 kHz; frame ``k`` is cut from sample ``160 k`` on.
    frames : int
        How many; N is at least ``160 (frames - 1) + 400``.

    Returns
    -------
    (frames, 40) float64
        1 is the power of a full-scale sine.
    """
    window, bands = _hann(), _bands()
    pieces = np.lib.stride_tricks.sliding_window_view(samples, WINDOW)[::HOP][:frames]
    lines = np.fft.rfft(pieces * window, _FFT, axis=1)
    lines -= lines[:, :1] * _of_offset()  # an offset is not speech
    power = np.square(lines.real) + np.square(lines.imag)
    # One product per frame, always of the same shape: a frame's bits do not depend on how
    # many frames are asked for together.
    return np.asarray(np.matmul(power[:, None, :], bands)[:, 0], np.float64)


@cache
def _hann() -> Floats:
    window = 0.5 - 0.5 * np.cos(2.0 * np.pi * (np.arange(WINDOW) + 0.5) / WINDOW)
    return np.asarray(window * (2.0 / window.sum()))


@cache
def _of_offset() -> NDArray[np.complex128]:
    """Return the spectrum of an offset whose first line is 1."""
    lines = np.fft.rfft(_hann(), _FFT)
    return np.asarray(lines / lines[0])


@cache
def _bands() -> Floats:
    """Return the triangles, (lines, bands), equally wide in mel."""

    def mel(hertz: NDArray[np.floating[Any]]) -> Floats:
        return np.asarray(2595.0 * np.log10(1.0 + hertz / 700.0), np.float64)

    ends = mel(np.array([_LOWEST, _HIGHEST]))
    edges = np.linspace(ends[0], ends[1], BANDS + 2)
    at = mel(np.arange(_FFT // 2 + 1) * (RATE / _FFT))[:, None]
    rising = (at - edges[:-2]) / (edges[1:-1] - edges[:-2])
    falling = (edges[2:] - at) / (edges[2:] - edges[1:-1])
    return np.ascontiguousarray(np.maximum(0.0, np.minimum(rising, falling)))


def loudness(power: Floats) -> Floats:
    """Return how loud each frame is in itself, dB of full scale, (T,)."""
    whole = np.matmul(power[:, None, :], np.ones((BANDS, 1)))[:, 0, 0]
    return np.asarray(np.log(whole + 1e-12) / _TENTHS)


def followed(loud: Floats, before: float = QUIETEST) -> Floats:
    """Return the loudness that is followed: up at once, down by 4 dB a second.

    Parameters
    ----------
    loud : (T,) float64
        dB, of each frame in itself.
    before : float
        What was followed up to the frame before.

    Returns
    -------
    (T,) float64
        dB, at least :data:`QUIETEST`.
    """
    fall = _FALL * HOP / RATE
    found = np.empty(len(loud))
    level = before
    for place, own in enumerate(loud.tolist()):
        level = max(level - fall, own, QUIETEST)
        found[place] = level
    return found


def settled(loud: Floats) -> Floats:
    """Return the loudness of a recording, which may be followed from both its ends."""
    return np.maximum(followed(loud), followed(loud[::-1])[::-1])


def told(power: Floats, level: Floats, depth: float = DEPTH) -> Floats:
    """Return bands in relation to a loudness: 0 at the floor, 1 at the loudness itself.

    Parameters
    ----------
    power : (T, 40) float64
    level : (T,) float64
        dB.
    depth : float
        dB from the loudness down to the floor.

    Returns
    -------
    (T, 40) float64
    """
    base = np.exp(_TENTHS * (level - depth))[:, None]
    return np.asarray(np.log(power / base + 1.0) / (_TENTHS * depth))
