"""Phones by ear as a user meets them: where speech is, where none is, what is refused."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright import pipeline
from lipwright.errors import SoundError
from lipwright.phones import PhoneTrack, load_phone_set
from lipwright.schedule.by_ear import NOTE, hear
from lipwright.sound import Sound
from lipwright.speech import Speech

RATE = 16000
LINES = {
    "de": "Könnten Sie das bitte wiederholen?",
    "cmn": "今天天气很好。",
    "en-us": "Maybe they will take us.",
}
MOMENT = np.arange(2 * RATE) / RATE


def spoken(language: str) -> Sound:
    sound = pipeline.say(LINES[language], voice=language).sound
    assert sound is not None
    return sound.resampled(RATE)


def silent(seconds: float) -> NDArray[np.float32]:
    """What a quiet room sounds like."""
    return np.random.default_rng(2).normal(0, 1e-4, int(seconds * RATE)).astype(np.float32)


def stretches(track: PhoneTrack, pause: float = 0.15) -> list[tuple[float, float]]:
    """Where phones are, from pause to pause."""
    found: list[tuple[float, float]] = []
    for phone in track:
        if phone.label == "sil":
            continue
        if found and phone.start - found[-1][1] < pause:
            found[-1] = (found[-1][0], phone.end)
        else:
            found.append((phone.start, phone.end))
    return found


def loud(samples: NDArray[np.float32]) -> tuple[float, float]:
    """Where a sound is within 35 dB of its loudest, first and last."""
    power = np.convolve(samples.astype(np.float64) ** 2, np.ones(160) / 160, "same")
    above = np.flatnonzero(power > power.max() * 10**-3.5) / RATE
    return float(above[0]), float(above[-1])


@pytest.mark.parametrize("language", LINES)
def test_phones_are_where_speech_is_and_silence_where_none_is(language: str) -> None:
    line = spoken(language).samples
    samples = np.concatenate((silent(0.6), line, silent(0.8), line, silent(0.6)))
    heard = hear(Sound(samples, RATE))
    first, last = loud(line)
    again = 0.6 + len(line) / RATE + 0.8
    found = stretches(heard.phones, 0.4)
    assert len(found) == 2
    for (start, end), at in zip(found, (0.6, again), strict=True):
        assert start == pytest.approx(at + first, abs=0.06)
        assert end == pytest.approx(at + last, abs=0.06)


@pytest.mark.parametrize("language", LINES)
def test_many_phones_come_out_whose_classes_are_often_right(language: str) -> None:
    said = pipeline.say(LINES[language], voice=language)
    assert said.sound is not None
    heard = hear(said.sound)
    assert 0.6 < len(heard.phones) / len(said.phones) < 1.6
    assert set(heard.phones.tier.labels) <= set(load_phone_set("arpabet").labels) | {"sil"}
    right = [bool(set(near(heard, phone.middle)) & set(near(said, phone.middle)))
             for phone in said.phones]  # fmt: skip
    assert np.mean(right) > 0.4


def near(speech: Speech, time: float) -> tuple[str, ...]:
    """The classes of mouth at a moment."""
    from lipwright.phones import load_reduction

    rows, _ = load_reduction(speech.phones.phone_set).rows(speech.phones)
    return tuple(label for label, start, end in rows if start <= time < end) or ("sil",)


def test_what_is_heard_says_that_it_is_doubtful() -> None:
    sound = spoken("de")
    heard = hear(sound)
    assert (heard.source, heard.confidence, heard.text) == ("ear", 0.0, "")
    assert heard.notes == (NOTE,)
    assert not len(heard.words)
    assert heard.phones.phone_set == "arpabet"
    assert heard.phones.tier.start == 0.0
    assert heard.phones.tier.end == sound.duration
    assert {phone.confidence for phone in heard.phones} <= {0.0, None}
    assert hear(sound).phones == heard.phones


def test_rate_and_loudness_change_little() -> None:
    sound = spoken("de")
    plain = hear(sound).phones.tier.labels
    assert hear(Sound(0.05 * sound.samples, RATE)).phones.tier.labels == plain
    other = stretches(hear(sound.resampled(44100)).phones, 0.4)
    for one, same in zip(stretches(hear(sound).phones, 0.4), other, strict=True):
        assert one == pytest.approx(same, abs=0.06)


def test_a_long_sound_is_heard_piece_by_piece() -> None:
    line = np.concatenate((spoken("de").samples, silent(0.5)))
    count = int(70 * RATE / len(line))
    seen: list[float] = []
    heard = hear(Sound(np.tile(line, count), RATE), progress=seen.append)
    assert len(seen) > 1
    assert seen[-1] == 1.0
    assert len(stretches(heard.phones, 0.4)) == count
    assert all(one.end == next_.start for one, next_ in pairwise(heard.phones))


def test_a_word_of_one_syllable_is_speech() -> None:
    sound = pipeline.say("Go!").sound
    assert sound is not None
    assert len(stretches(hear(sound).phones)) == 1


def a_hum() -> NDArray[np.float64]:
    parts = [np.sin(2 * np.pi * 50 * k * MOMENT) / k for k in range(1, 20)]
    return np.asarray(0.1 * np.sum(parts, axis=0))


BAD = {
    "empty": (np.zeros(0), "no samples"),
    "one sample": (np.ones(1), "no speech in it"),
    "50 ms": (np.random.default_rng(1).normal(0, 0.1, RATE // 20), "no speech in it"),
    "silence": (np.zeros(RATE), "silent"),
    "not a number": (np.full(RATE, np.nan), "not numbers"),
    "noise": (np.random.default_rng(0).normal(0, 0.1, 2 * RATE), "no speech in it"),
    "gusts": (np.random.default_rng(0).normal(0, 0.1, 2 * RATE) * np.sin(6 * MOMENT) ** 2,
              "no speech in it"),
    "tone": (0.3 * np.sin(2 * np.pi * 100 * MOMENT), "no speech in it"),
    "hum": (a_hum(), "no speech in it"),
    "clicks": (0.5 * (np.arange(2 * RATE) % 8000 < 20), "no speech in it"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_a_sound_without_speech_is_refused(name: str) -> None:
    samples, words = BAD[name]
    with pytest.raises(SoundError, match=words):
        hear(Sound(np.asarray(samples, np.float32), RATE))
