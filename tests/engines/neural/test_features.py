"""What the net hears, beside the publication's words taken literally, one step after another."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.engines.neural.features import (
    Hearing,
    Scale,
    area_edges,
    audible,
    features,
    frame_times,
)
from lipwright.errors import SoundError
from lipwright.sound import Sound

RATE = 16000


def voice(seconds: float, rate: int = RATE, seed: int = 0) -> Sound:
    """Something like speech: a buzz and noise that come and go."""
    times = np.arange(int(seconds * rate)) / rate
    buzz = np.sign(np.sin(2 * np.pi * 120 * times)) * (np.sin(2 * np.pi * 3 * times) > 0)
    noise = np.random.default_rng(seed).normal(0, 0.05, len(times))
    return Sound((0.2 * buzz + noise).astype(np.float32), rate)


def literal(sound: Sound, frame: int) -> list[float]:
    """One frame, sample by sample and line by line."""
    hearing = Hearing()
    samples = audible(sound, hearing)
    edges = area_edges(hearing)
    window = [0.54 - 0.46 * math.cos(2 * math.pi * n / 511) for n in range(512)]
    norm = sum(w * w for w in window)
    found = []
    for segment in range(9):
        middle = frame * 640 + (segment - 4) * 160
        piece = [
            float(samples[n]) if 0 <= n < len(samples) else 0.0
            for n in range(middle - 256, middle + 256)
        ]
        mean = sum(piece) / 512
        spectrum = np.fft.fft([(x - mean) * w for x, w in zip(piece, window, strict=True)])
        logs = [math.log(abs(line) ** 2 / norm + hearing.floor) for line in spectrum]
        for low, high in pairwise(edges):
            found.append(sum(logs[low:high]) / (high - low))
    return found


def test_as_published_step_by_step() -> None:
    sound = voice(0.5)
    heard = features(sound)
    assert heard.shape == (13, 27 * 9)
    for frame in (0, 1, 6, 12):
        assert heard[frame] == pytest.approx(literal(sound, frame), abs=1e-9)


def test_a_context_is_112_ms_every_40_ms() -> None:
    hearing = Hearing()
    assert hearing.context == pytest.approx(0.112)
    assert hearing.frame == pytest.approx(0.04)
    assert hearing.inputs == 243
    click = np.zeros(RATE, np.float32)
    click[RATE // 2] = 1.0
    noise = np.random.default_rng(0).normal(0, 1e-3, RATE).astype(np.float32)
    with_click, without = (features(Sound(noise + c, RATE)) for c in (click, 0 * click))
    # Both are brought to one loudness by their own noise: only frames near differ much.
    apart = np.abs(with_click - without).max(axis=1)
    near = np.abs(frame_times(Sound(noise, RATE), hearing) - 0.5) < 0.056
    assert apart[near].min() > 1
    assert apart[~near][3:-3].max() < 0.2  # at the ends the click's own mean is seen


@pytest.mark.parametrize("scale", ["linear", "mel", "bark", "octave"])
def test_areas_are_27_and_lie_one_beside_the_other(scale: Scale) -> None:
    edges = area_edges(Hearing(scale=scale))
    assert len(edges) == 28
    assert (np.diff(edges) > 0).all()
    assert edges[-1] == 256


@given(st.floats(0.02, 5.0), st.floats(-0.2, 0.2), st.integers(0, 99))
def test_loudness_and_offset_change_nothing(gain: float, offset: float, seed: int) -> None:
    sound = voice(0.4, seed=seed)
    other = Sound(sound.samples * np.float32(gain) + np.float32(offset), RATE)
    assert np.abs(features(other) - features(sound)).max() < 0.05


def test_8_khz_lacks_only_what_it_cannot_have() -> None:
    sound = voice(1.0)
    low = features(sound.resampled(8000))
    edges = area_edges(Hearing())
    held = np.flatnonzero(edges[1:] * 31.25 < 3500)
    apart = np.abs(low - features(sound)).reshape(-1, 9, 27)[2:-2, :, held]
    assert np.median(apart) < 0.3
    assert low.min() >= math.log(Hearing().floor) - 1e-9


def test_a_net_that_looks_back_hears_nothing_later() -> None:
    back = Hearing(ahead=-0.056)
    sound = voice(0.6)
    later = sound.samples.copy()
    later[RATE // 2 :] *= -0.9
    one, other = features(sound, back), features(Sound(later, RATE), back)
    before = frame_times(sound, back) <= 0.5 - 1e-9
    assert np.abs(one - other)[before].max() < 0.2  # the loudness is the whole line's
    assert np.abs(one - other)[~before].max() > 0.2


def test_half_an_hour_is_heard_in_blocks() -> None:
    sound = voice(60.0)
    whole = features(sound)
    start = 25 * 30
    part = Sound(sound.samples[RATE * 29 :], RATE)
    alike = features(part)[25:100]
    assert np.abs(whole[start : start + 75] - alike).max() < 0.05


@pytest.mark.parametrize(
    ("samples", "words"),
    [
        (np.zeros(0), "0 samples"),
        (np.ones(1), "1 samples"),
        (np.zeros(RATE), "silent"),
        (np.full(RATE, 0.3), "silent"),
        (np.r_[np.ones(RATE), np.nan], "not numbers"),
    ],
)
def test_sounds_that_cannot_be_heard(samples: np.ndarray, words: str) -> None:
    with pytest.raises(SoundError, match=words):
        features(Sound(samples.astype(np.float32), RATE))
