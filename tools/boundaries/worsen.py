"""Synthesised speech made less clean: other speakers, rooms, microphones, noise, levels."""

from __future__ import annotations

import numpy as np
import soxr
from numpy.typing import NDArray

from lipwright.schedule.align.features import RATE

_OCTAVES = np.linspace(0.0, 7.1, 8)  # above 60 Hz


def worsened(
    samples: NDArray[np.float32], rate: int, rng: np.random.Generator
) -> tuple[NDArray[np.float32], float]:
    """Return sound at 16 kHz, and by what its times are divided.

    Played faster or slower, it is another speaker's; then equalised, in a room in three
    of five cases, with noise 15 to 55 dB below it.
    """
    faster = float(rng.uniform(0.85, 1.18))
    result = np.asarray(soxr.resample(samples, rate * faster, RATE), np.float64)
    result = equalised(result, rng)
    if rng.random() < 0.6:
        result = in_a_room(result, rng)
    result = result + _noise(result, rng)
    level = rng.uniform(0.05, 0.5) / np.abs(result).max()
    return (level * result).astype(np.float32), faster


def equalised(samples: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
    """Return a sound as another microphone would have it."""
    hertz = np.maximum(np.fft.rfftfreq(len(samples), 1 / RATE), 60.0)
    decibels = np.interp(np.log2(hertz / 60), _OCTAVES, rng.normal(0, 4, len(_OCTAVES)))
    decibels += rng.normal(0, 1.5) * np.log2(hertz / 1000)
    return np.fft.irfft(np.fft.rfft(samples) * 10 ** (decibels / 20), len(samples))


def in_a_room(samples: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
    """Return a sound with the echo of a room."""
    length = int(RATE * rng.uniform(0.05, 0.25))
    response = rng.normal(0, 1, length) * np.exp(-5 * np.arange(length) / length)
    response *= rng.uniform(0.05, 0.4) / np.sqrt(np.square(response).sum())
    response[0] += 1
    size = len(samples) + length
    both = np.fft.rfft(samples, size) * np.fft.rfft(response, size)
    return np.fft.irfft(both, size)[: len(samples)]


def _noise(samples: NDArray[np.float64], rng: np.random.Generator) -> NDArray[np.float64]:
    spectrum = np.fft.rfft(rng.normal(0, 1, len(samples)))
    turn = np.exp(-2j * np.pi * np.fft.rfftfreq(len(samples)))
    noise = np.fft.irfft(spectrum / (1 - rng.uniform(0, 0.95) * turn), len(samples))
    below = 10 ** (-rng.uniform(15, 55) / 20)
    return np.asarray(noise * below * np.sqrt(np.square(samples).mean() / np.square(noise).mean()))
