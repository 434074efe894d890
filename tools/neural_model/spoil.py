"""Clean speech made as recordings are: other throats, rooms, microphones, noises, levels."""

from __future__ import annotations

import numpy as np
import soxr
from numpy.typing import NDArray

from tools.boundaries.worsen import equalised, in_a_room

Floats = NDArray[np.float64]
RATE = 16000


def spoilt(
    samples: NDArray[np.int16], rng: np.random.Generator, others: Floats
) -> tuple[Floats, float]:
    """Return a line as some microphone in some room would hear some speaker.

    Parameters
    ----------
    samples : (N,) int16
        At 16 kHz.
    rng : Generator
    others : (M,) float64
        Other speech, for voices behind the speaker.

    Returns
    -------
    sound : float64
        At 16 kHz, speech at about -20 dB of full scale, before :func:`levelled`.
    faster : float
        By what its times are divided.
    """
    faster = float(np.exp(rng.uniform(np.log(0.82), np.log(1.22))))
    sound = soxr.resample(samples.astype(np.float64) / 32768.0, RATE * faster, RATE)
    if rng.random() < 0.85:
        sound = equalised(sound, rng)
    if rng.random() < 0.5:
        sound = in_a_room(sound, rng)
    if rng.random() < 0.12:
        sound = narrowed(sound, rng)
    sound = sound * (0.1 / max(_loud(sound), 1e-6))
    if rng.random() < 0.85:
        below = 10 ** (-rng.uniform(8, 50) / 20)
        sound = sound + 0.1 * below * noise(len(sound), rng, others)
    return sound, faster


def narrowed(sound: Floats, rng: np.random.Generator) -> Floats:
    """Return a sound as a telephone passes it on."""
    spectrum = np.fft.rfft(sound)
    hertz = np.fft.rfftfreq(len(sound), 1 / RATE)
    high = rng.uniform(3300, 6000)
    spectrum[hertz > high] *= 1e-3
    spectrum[hertz < rng.uniform(50, 300)] *= 0.05
    return np.fft.irfft(spectrum, len(sound))


def levelled(sound: Floats, rng: np.random.Generator) -> NDArray[np.float32]:
    """Return a sound at a random level, with a little hiss, clipped where it is too loud."""
    level = 10 ** (rng.uniform(-28, 16) / 20)
    hiss = rng.normal(0, 10 ** (rng.uniform(-96, -66) / 20), len(sound))
    return np.clip(level * sound + hiss, -1.0, 1.0).astype(np.float32)


def noise(count: int, rng: np.random.Generator, others: Floats) -> Floats:
    """Return a noise of power 1: a hiss, a fan, voices, music, or knocks."""
    kind = rng.choice(("coloured", "fan", "voices", "music", "knocks"), p=(0.3, 0.2, 0.2, 0.2, 0.1))
    if kind == "coloured":
        made = coloured(count, rng, rng.uniform(-0.3, 1.6))
    elif kind == "fan":
        made = fan(count, rng)
    elif kind == "voices":
        made = voices(count, rng, others)
    elif kind == "music":
        made = music(count, rng)
    else:
        made = knocks(count, rng) + 0.3 * coloured(count, rng, 1.0)
    return made / max(float(np.sqrt(np.square(made).mean())), 1e-9)


def coloured(count: int, rng: np.random.Generator, slope: float) -> Floats:
    """Return noise whose power falls with frequency to the ``slope``."""
    spectrum = np.fft.rfft(rng.normal(0, 1, count))
    hertz = np.maximum(np.fft.rfftfreq(count, 1 / RATE), 30.0)
    return np.fft.irfft(spectrum * hertz ** (-slope / 2), count)


def fan(count: int, rng: np.random.Generator) -> Floats:
    """Return a fan: a rush of air and a hum with its overtones."""
    rush = coloured(count, rng, rng.uniform(0.8, 2.0))
    rush /= max(float(rush.std()), 1e-9)
    time = np.arange(count) / RATE
    base = rng.uniform(40, 240)
    hum = sum(
        rng.uniform(0, 1) / number * np.sin(2 * np.pi * base * number * time + rng.uniform(0, 6.3))
        for number in range(1, 7)
    )
    slow = 1 + rng.uniform(0, 0.3) * np.sin(2 * np.pi * rng.uniform(0.1, 4) * time)
    return np.asarray((rush + rng.uniform(0, 1.5) * hum) * slow)


def voices(count: int, rng: np.random.Generator, others: Floats) -> Floats:
    """Return several people who talk at once, somewhere behind."""
    made = np.zeros(count)
    for _ in range(int(rng.integers(3, 8))):
        first = int(rng.integers(0, max(len(others) - count, 1)))
        part = others[first : first + count]
        made[: len(part)] += rng.uniform(0.3, 1) * part
    return made


def music(count: int, rng: np.random.Generator) -> Floats:
    """Return music without singing: chords, a bass, a melody, drums."""
    made = np.zeros(count)
    beat = int(RATE * 60 / rng.uniform(60, 170))
    key = rng.uniform(100, 220)
    scale = (
        np.array((0, 2, 4, 5, 7, 9, 11)) if rng.random() < 0.6 else np.array((0, 2, 3, 5, 7, 8, 10))
    )
    overtones = int(rng.integers(2, 12))
    bright, decay, vibrato = rng.uniform(0.8, 2.0), rng.uniform(0.5, 8), rng.uniform(0, 0.01)
    for start in range(0, count, beat):
        length = min(2 * beat, count - start)
        time = np.arange(length) / RATE
        root = int(rng.integers(0, 7))
        steps = [root, root + 2, root + 4, int(rng.integers(7, 14))]
        if rng.random() < 0.7:
            envelope = (
                np.exp(-decay * time)
                * np.minimum(time / 0.01, 1)
                * np.minimum((length / RATE - time) / 0.02, 1)
            )
            for step in steps[: int(rng.integers(1, 5))]:
                hertz = key * 2 ** ((scale[step % 7] + 12 * (step // 7)) / 12)
                phase = 2 * np.pi * hertz * (time + vibrato / 5 * np.sin(2 * np.pi * 5 * time))
                made[start : start + length] += envelope * sum(
                    np.sin(n * phase) / n**bright for n in range(1, overtones) if n * hertz < 7800
                )
        if rng.random() < 0.5:
            strike = rng.normal(0, rng.uniform(0, 1.5), length) * np.exp(
                -rng.uniform(15, 60) * time
            )
            made[start : start + length] += strike
    return made


def knocks(count: int, rng: np.random.Generator) -> Floats:
    """Return knocks, clicks and typing."""
    made = np.zeros(count)
    for start in rng.integers(0, count, max(1, int(count / RATE * rng.uniform(0.5, 6)))):
        length = min(int(RATE * rng.uniform(0.003, 0.08)), count - int(start))
        fade = np.exp(-np.arange(length) / max(length / 5, 1))
        made[start : start + length] += rng.normal(0, rng.uniform(0.3, 3), length) * fade
    return made


def _loud(sound: Floats) -> float:
    blocks = sound[: len(sound) // 400 * 400].reshape(-1, 400)
    if not len(blocks):
        return 0.0
    return float(np.sqrt(np.percentile(np.square(blocks).mean(axis=1), 90)))
