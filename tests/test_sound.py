"""Sound in memory: its length, other rates, and the WAV that it becomes."""

import io
import wave

import numpy as np
import pytest

from lipwright.errors import SoundError
from lipwright.sound import Sound


def tone(rate: int, seconds: float = 0.5) -> Sound:
    time = np.arange(round(rate * seconds)) / rate
    return Sound((0.5 * np.sin(2 * np.pi * 440 * time)).astype(np.float32), rate)


def test_the_length_is_in_seconds() -> None:
    assert tone(8000).duration == 0.5


@pytest.mark.parametrize(("rate", "to"), [(8000, 16000), (48000, 16000), (44100, 16000)])
def test_another_rate_keeps_the_sound(rate: int, to: int) -> None:
    resampled = tone(rate).resampled(to)
    wanted = tone(to).samples
    assert resampled.rate == to
    assert resampled.samples.dtype == np.float32
    assert len(resampled.samples) == len(wanted)
    inner = slice(200, -200)
    assert np.abs(resampled.samples[inner] - wanted[inner]).max() < 0.01


def test_its_own_rate_is_the_sound_itself() -> None:
    sound = tone(16000)
    assert sound.resampled(16000) is sound


def test_resampling_stays_within_one() -> None:
    square = np.sign(tone(44100).samples).astype(np.float32)
    assert np.abs(Sound(square, 44100).resampled(16000).samples).max() <= 1.0


@pytest.mark.parametrize(
    ("samples", "rate", "words"),
    [
        (np.zeros((2, 8), np.float32), 16000, r"samples of shape \(2, 8\); expected one channel"),
        (np.zeros(8, np.float32), 0, "0 samples per second"),
    ],
)
def test_what_is_no_sound_is_refused(
    samples: np.ndarray[tuple[int, ...], np.dtype[np.float32]], rate: int, words: str
) -> None:
    with pytest.raises(SoundError, match=words):
        Sound(samples, rate)


def test_wav_is_clipped_not_wrapped_and_the_same_every_time() -> None:
    sound = Sound(np.array([0, 0.5, 1, 1.7, -1, -9], np.float32), 22050)
    with wave.open(io.BytesIO(sound.wav_bytes())) as file:
        assert (file.getnchannels(), file.getsampwidth(), file.getframerate()) == (1, 2, 22050)
        written = np.frombuffer(file.readframes(99), "<i2")
    assert written.tolist() == [0, 16384, 32767, 32767, -32767, -32767]
    assert sound.wav_bytes() == sound.wav_bytes()
