"""Smoothing: a low-pass per component, whose cut-off is learnt from the recordings.

The cut-off is the highest frequency of the range that holds 99 % of a component's energy
over all takes (Cao et al. 2004, section 6.3); the takes' means are no motion and do not
count. Takes and results are continued as in a mirror at both ends, for measuring and for
filtering: nothing wraps around, nothing rings where a line starts. The filter has no phase:
a Butterworth response of order 4 there and back, which halves the cut-off frequency itself
and overshoots by little.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

SHARE = 0.99
ORDER = 4
_BINS = 2000  # from 0 to half the frame rate


def cut_offs(takes: Iterable[NDArray[np.floating]], rate: float, share: float = SHARE) -> Floats:
    """Return the frequency below which each component keeps a share of its energy.

    Parameters
    ----------
    takes : iterable of (T, K)
        Components of each take.
    rate : float
        Frames per second of the takes.
    share : float
        Of the energy, 0..1.

    Returns
    -------
    (K,) float64
        Hz; half the rate where a component never moves.
    """
    energy = np.zeros((_BINS, 0))
    for take in takes:
        if not energy.shape[1]:
            energy = np.zeros((_BINS, take.shape[1]))
        if len(take) > 1:
            _add_energy(energy, take)
    gathered = np.cumsum(energy, axis=0)
    reached = (gathered < share * gathered[-1]).sum(axis=0)
    edges: Floats = (reached + 1) * (rate / 2 / _BINS)
    return np.where(gathered[-1] > 0, edges, rate / 2)


def low_pass(frames: Floats, rate: float, cut_off: Floats) -> Floats:
    """Return frames without what is faster than each component's cut-off.

    Parameters
    ----------
    frames : (T, K) float64
    rate : float
        Frames per second.
    cut_off : (K,) float64
        Hz.
    """
    spectrum = np.fft.rfft(_mirrored(frames), axis=0)
    frequency = np.arange(len(spectrum))[:, None] * (rate / (2 * len(frames)))
    spectrum /= 1 + (frequency / cut_off[None, :]) ** (2 * ORDER)
    return np.fft.irfft(spectrum, 2 * len(frames), axis=0)[: len(frames)]


def _mirrored(frames: NDArray[np.floating]) -> Floats:
    return np.concatenate((frames, frames[::-1]), dtype=np.float64)


def _add_energy(energy: Floats, take: NDArray[np.floating]) -> None:
    """Add the take's energy at each frequency, without its mean, to the bins."""
    spectrum = np.abs(np.fft.rfft(_mirrored(take), axis=0)[1:]) ** 2 / len(take)
    share = np.arange(1, len(spectrum) + 1) / len(take)
    where = np.minimum(np.ceil(share * _BINS).astype(np.int64) - 1, _BINS - 1)
    for component in range(take.shape[1]):
        energy[:, component] += np.bincount(where, spectrum[:, component], _BINS)
