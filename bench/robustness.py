"""Alignment of recordings made worse: how far the figures fall, and whether any fails.

Each condition changes the sound of the labelled recordings beside the project, and the
hand's times where it changes the speed. Noise is drawn from a fixed seed.
"""

import time
from collections.abc import Callable

import numpy as np
import soxr
from numpy.typing import NDArray

from bench.measure import say
from bench.recordings import DATA, is_damaged, matched, starts
from lipwright import pipeline
from lipwright.errors import LipwrightError
from lipwright.sound import Sound
from lipwright.sound_files import read_sound

Samples = NDArray[np.float32]
Spectra = NDArray[np.complex128]
_WINDOW, _HOP = 512, 128


def noisy(decibels: float) -> Callable[[Samples, int], Samples]:
    """White noise that far below the mean power of the recording."""

    def worsen(samples: Samples, rate: int) -> Samples:
        noise = np.random.default_rng(1).normal(0.0, 1.0, len(samples))
        level = np.sqrt(np.mean(np.square(samples, dtype=np.float64))) * 10 ** (-decibels / 20)
        return np.asarray(samples + level * noise, np.float32)

    return worsen


def telephone(samples: Samples, rate: int) -> Samples:
    """300 to 3400 Hz, at 8 kHz."""
    spectrum = np.fft.rfft(samples)
    hertz = np.fft.rfftfreq(len(samples), 1 / rate)
    spectrum[(hertz < 300) | (hertz > 3400)] = 0
    narrow = np.fft.irfft(spectrum, len(samples)).astype(np.float32)
    return np.asarray(soxr.resample(soxr.resample(narrow, rate, 8000), 8000, rate), np.float32)


def stretched(samples: Samples, factor: float) -> Samples:
    """Make a sound so many times as long, at the same pitch: a phase vocoder."""
    spectra = _spectra(samples)
    at = np.arange(0, len(spectra) - 1, 1 / factor)
    first = at.astype(int)
    part = (at - first)[:, None]
    size = (1 - part) * np.abs(spectra[first]) + part * np.abs(spectra[first + 1])
    steps = np.angle(spectra[first + 1] / (spectra[first] + 1e-12) + 1e-12)
    phase = np.cumsum(np.vstack([np.angle(spectra[:1]), steps[:-1]]), axis=0)
    return _sound(size * np.exp(1j * phase))


def child(samples: Samples, rate: int) -> Samples:
    """Pitch and formants a quarter higher, as slow as before."""
    return np.asarray(soxr.resample(stretched(samples, 1.25), 1.25, 1.0), np.float32)


def whisper(samples: Samples, rate: int) -> Samples:
    """The envelope of the spectrum on noise: no voice is left."""
    spectra = _spectra(samples)
    cepstrum = np.fft.irfft(np.log(np.abs(spectra) + 1e-6))
    cepstrum[:, 30:-29] = 0  # what repeats faster than 1.9 ms is the voice
    envelope = np.exp(np.fft.rfft(cepstrum).real)
    noise = _spectra(np.random.default_rng(1).normal(0, 1, len(samples) + _WINDOW))
    return _sound(envelope * noise[: len(envelope)] / np.abs(noise).mean())


def _spectra(samples: NDArray[np.floating]) -> Spectra:
    padded = np.pad(samples, (_WINDOW // 2, _WINDOW))
    windows = np.lib.stride_tricks.sliding_window_view(padded, _WINDOW)[::_HOP]
    return np.asarray(np.fft.rfft(windows * np.hanning(_WINDOW)), np.complex128)


def _sound(spectra: Spectra) -> Samples:
    result = np.zeros(len(spectra) * _HOP + _WINDOW)
    for index, part in enumerate(np.fft.irfft(spectra) * np.hanning(_WINDOW)):
        result[index * _HOP : index * _HOP + _WINDOW] += part
    return (result[_WINDOW // 2 :] / 1.5).astype(np.float32)


def unchanged(samples: Samples, rate: int) -> Samples:
    """The recording as it is."""
    return samples


# name: (what is done to the sound, by how much its times grow)
CONDITIONS: dict[str, tuple[Callable[[Samples, int], Samples], float]] = {
    "as recorded": (unchanged, 1.0),
    "noise at 20 dB": (noisy(20.0), 1.0),
    "noise at 10 dB": (noisy(10.0), 1.0),
    "telephone": (telephone, 1.0),
    "20 % faster": (lambda samples, rate: stretched(samples, 1 / 1.2), 1 / 1.2),
    "20 % slower": (lambda samples, rate: stretched(samples, 1 / 0.8), 1 / 0.8),
    "child": (child, 1.0),
    "whisper": (whisper, 1.0),
}


def measure(name: str) -> None:
    """Print one line of the table."""
    worsen, slower = CONDITIONS[name]
    off: list[float] = []
    failed, phones, seconds, length, sure = 0, 0, 0.0, 0.0, []
    for path in sorted((DATA / "timit").glob("*/*.flac")):
        sound = read_sound(path)
        if is_damaged(sound.samples):
            continue
        text = path.with_suffix(".txt").read_text().split(maxsplit=2)[2]
        hand = starts(pipeline.from_labels(path.with_suffix(".phn")).phones)
        worse = Sound(worsen(sound.samples, sound.rate), sound.rate)
        before = time.process_time()
        try:
            ours = pipeline.align(worse, text)
        except LipwrightError:
            failed += 1
            continue
        seconds += time.process_time() - before
        length += worse.duration
        sure.append(ours.confidence or 0.0)
        phones += len(hand)
        off += matched(starts(ours.phones), [(label, slower * start) for label, start in hand])
    apart = np.abs(off)
    say(
        f"align TIMIT: {name}",
        recordings=len(sure) + failed,
        failed=failed,
        within_20_ms=round(float(np.mean(apart <= 0.020)), 3),
        within_50_ms=round(float(np.mean(apart <= 0.050)), 3),
        median_ms=round(1e3 * float(np.median(apart)), 1),
        matched=round(len(off) / phones, 3),
        median_confidence=round(float(np.median(sure)), 2),
        cpu_per_second_of_sound=round(seconds / length, 4),
    )


if __name__ == "__main__":
    if (DATA / "timit").is_dir():
        for condition in CONDITIONS:
            measure(condition)
