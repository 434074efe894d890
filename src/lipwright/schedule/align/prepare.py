"""A sound made ready for the acoustic model: 16 kHz, audible, checked, cut in pieces."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import SoundError
from lipwright.schedule.align.features import RATE
from lipwright.sound import Sound

LONGEST = 45.0  # s that are taken at once; the decoder's memory grows with it
_CUT = (20.0, 32.0)  # s after which a longer sound is cut
_CHUNK = 1 << 20
_INAUDIBLE = 1e-4  # -80 dB of full scale
_QUIET = 0.1
_FLOOR = 10**-3.5  # of the mean power: noise that a quiet room has


def prepared(sound: Sound) -> NDArray[np.float32]:
    """Return the samples at 16 kHz, amplified where they are faint.

    Long sounds are resampled in pieces: no more is held than the result.

    Raises
    ------
    SoundError
        If there are no samples, they are not finite, or all is silence.
    """
    if not len(sound.samples):
        raise SoundError("the sound holds no samples", expected="speech")
    loudest = float(max(np.abs(part).max() for part in _parts(sound.samples)))
    if not np.isfinite(loudest):
        raise SoundError("the sound holds samples that are not numbers", expected="-1..1")
    if loudest < _INAUDIBLE:
        raise SoundError("no speech in it: the sound is silent", expected="speech")
    samples = _resampled(sound)
    return samples * np.float32(_QUIET / loudest) if loudest < _QUIET else samples


def with_noise_floor(samples: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return a sound that is nowhere more silent than a quiet room.

    The model was trained on recordings. In digital silence, as synthesisers and noise
    gates leave it, its features stray, and so does the confidence. Recordings that have
    their own noise stay as they are; the noise is the same in every run.

    Parameters
    ----------
    samples : (N,) float32
        At 16 kHz.
    """
    step = RATE // 100
    power = np.square(samples, dtype=np.float64)
    frames = power[: len(power) // step * step].reshape(-1, step).mean(axis=1)
    missing = _FLOOR * float(power.mean()) - (np.percentile(frames, 5) if len(frames) else 0.0)
    if missing <= 0:
        return samples
    noise = np.random.default_rng(0).standard_normal(len(samples), np.float32)
    return samples + np.float32(np.sqrt(missing)) * noise


def cut(samples: NDArray[np.float32], at: int) -> int:
    """Return where to cut a sound that goes on from ``at``.

    Parameters
    ----------
    samples : (N,) float32
        At 16 kHz; more than ``LONGEST`` seconds from ``at`` on.
    at : int
        A sample.

    Returns
    -------
    int
        The middle of the quietest 200 ms between 20 and 32 s later.
    """
    first, last = (at + int(seconds * RATE) for seconds in _CUT)
    step = RATE // 100
    power = np.square(samples[first:last].astype(np.float64))
    sums = power[: len(power) // step * step].reshape(-1, step).sum(axis=1)
    quietest = int(np.convolve(sums, np.ones(20), "valid").argmin())
    return first + (quietest + 10) * step


def pieces(samples: NDArray[np.float32]) -> Iterator[tuple[int, int]]:
    """Give first and last sample of pieces of at most 45 s, cut where it is quiet.

    Parameters
    ----------
    samples : (N,) float32
        At 16 kHz.
    """
    at = 0
    while len(samples) - at > LONGEST * RATE:
        stop = cut(samples, at)
        yield at, stop
        at = stop
    yield at, len(samples)


def _parts(samples: NDArray[np.float32]) -> list[NDArray[np.float32]]:
    return [samples[i : i + _CHUNK] for i in range(0, len(samples), _CHUNK)]


def _resampled(sound: Sound) -> NDArray[np.float32]:
    samples = np.ascontiguousarray(sound.samples, np.float32)
    if sound.rate == RATE:
        return samples
    import soxr  # only where the rates differ

    stream = soxr.ResampleStream(sound.rate, RATE, 1, dtype="float32")
    parts = _parts(samples)
    last = len(parts) - 1
    result = [stream.resample_chunk(part, last=index == last) for index, part in enumerate(parts)]
    return np.concatenate(result)
