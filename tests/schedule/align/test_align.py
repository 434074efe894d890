"""Alignment as a user meets it: on speech whose times the synthesiser knows."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import soxr

from lipwright.errors import SoundError
from lipwright.schedule.align import align
from lipwright.schedule.say import say
from lipwright.sound import Sound
from lipwright.speech import Speech

TEXT = "Peter Piper picked a peck of pickled peppers. Where is the peck that Peter picked?"


@pytest.fixture(scope="module")
def peter() -> Speech:
    return say(TEXT)


def sound_of(speech: Speech) -> Sound:
    assert speech.sound is not None
    return speech.sound


def starts(speech: Speech) -> list[float]:
    return [word.start for word in speech.words]


def noise(seconds: float, rate: int = 16000) -> Sound:
    samples = np.random.default_rng(1).normal(0.0, 0.1, int(seconds * rate))
    return Sound(samples.astype(np.float32), rate)


def test_words_lie_where_they_were_spoken(peter: Speech) -> None:
    aligned = align(sound_of(peter), TEXT)
    assert aligned.words.labels == peter.words.labels
    apart = np.abs(np.subtract(starts(aligned), starts(peter)))
    assert np.median(apart) < 0.03
    assert apart.max() < 0.12


def test_phones_cover_the_sound_without_gaps(peter: Speech) -> None:
    aligned = align(sound_of(peter), TEXT)
    tier = aligned.phones.tier
    assert aligned.phones.phone_set == "arpabet"
    assert aligned.phones.normalised().tier.labels == tier.labels
    assert tier.start == 0.0
    assert tier.end == sound_of(peter).duration
    assert all(a.end == b.start for a, b in zip(tier, tier.intervals[1:], strict=False))
    assert tier.labels[:5] == ("sil", "p", "iy", "t", "er")
    assert all(p.confidence is None for p in tier if p.label == "sil")
    assert all(0 <= (p.confidence or 0) <= 1 for p in tier)


def test_a_pause_between_sentences_becomes_silence(peter: Speech) -> None:
    aligned = align(sound_of(peter), TEXT)
    gap = aligned.phones.tier.at(aligned.words[7].end)
    assert gap is not None
    assert gap.label == "sil"
    assert gap.end == aligned.words[8].start
    assert gap.duration > 0.1


def test_what_was_aligned_before_changes_nothing(peter: Speech) -> None:
    first = align(sound_of(peter), TEXT)
    align(noise(1.0), "something else")
    assert align(sound_of(peter), TEXT).phones == first.phones


@pytest.mark.parametrize("rate", [8000, 44100, 96000])
def test_any_rate_gives_the_same_times(peter: Speech, rate: int) -> None:
    sound = sound_of(peter)
    other = Sound(soxr.resample(sound.samples, sound.rate, rate), rate)
    apart = np.subtract(starts(align(other, TEXT)), starts(align(sound, TEXT)))
    assert np.median(np.abs(apart)) < 0.011


def test_wrong_words_are_told_from_right_ones(peter: Speech) -> None:
    right = align(sound_of(peter), TEXT)
    wrong = align(sound_of(peter), "Nobody will ever guess what kind of music we heard tonight.")
    assert (right.confidence or 0) > (wrong.confidence or 0) + 0.2
    assert any("may not be what is spoken" in note for note in wrong.notes)


def test_sound_beyond_the_words_is_named(peter: Speech) -> None:
    aligned = align(sound_of(peter), "Peter Piper picked")
    assert any("s of sound without words" in note for note in aligned.notes)


def test_a_token_of_many_words_is_one_interval() -> None:
    text = "On 11/21/2026 it cost $5.25."
    speech = say("On november twenty first, twenty twenty six, it cost five dollars twenty five.")
    words = align(sound_of(speech), text).words
    assert words.labels == ("On", "11/21/2026", "it", "cost", "$5.25")
    said = {word.label: word for word in speech.words}
    assert words[1].start == pytest.approx(said["november"].start, abs=0.08)
    assert words[2].start == pytest.approx(said["it"].start, abs=0.08)


def test_guessed_words_are_named_to_the_user() -> None:
    speech = say("The blorptangle is here.")
    assert any(
        "blorptangle" in n for n in align(sound_of(speech), "The blorptangle is here.").notes
    )


def test_noise_gives_an_alignment_that_says_it_is_unsure() -> None:
    aligned = align(noise(2.0), "hello there")
    assert aligned.words.labels == ("hello", "there")
    assert (aligned.confidence or 0) < 0.1


@pytest.mark.parametrize(
    ("sound", "text", "message"),
    [
        (Sound(np.zeros(0, np.float32), 16000), "hi", "no samples"),
        (Sound(np.zeros(16000, np.float32), 16000), "hi", "no speech in it"),
        (Sound(np.full(16000, np.nan, np.float32), 16000), "hi", "not numbers"),
        (noise(0.05), "one two three four", "0.05 s is too short for 4 words; expected"),
        (noise(2.0), "word " * 500, "2 s is too short for 500 words"),
    ],
)
def test_sounds_that_cannot_be_aligned(sound: Sound, text: str, message: str) -> None:
    with pytest.raises(SoundError, match=message):
        align(sound, text)


def test_a_short_sound_of_one_word_is_aligned() -> None:
    aligned = align(noise(0.05), "a")
    assert aligned.phones.tier.end == 0.05


def test_a_lexicon_decides_how_a_word_sounds(tmp_path: Path) -> None:
    path = tmp_path / "mine.dict"
    path.write_text("blorp  P IY T ER\n", encoding="utf-8")
    aligned = align(sound_of(say("Peter.")), "blorp", lexicon=path)
    assert aligned.phones.tier.labels[1:5] == ("p", "iy", "t", "er")


@pytest.fixture(scope="module")
def lines() -> list[Speech]:
    openings = ["The old sailor", "My younger sister", "Every good farmer", "Our best teacher"]
    endings = [
        "walked along the river before breakfast.",
        "bought seven apples at the market on Sunday.",
        "never believed what the newspapers said.",
        "found a silver coin under the kitchen table.",
        "wanted to hear the story one more time.",
    ]
    return [say(f"{a} {b}") for a in openings for b in endings]


def joined(lines: list[Speech]) -> tuple[Sound, list[float]]:
    rate = sound_of(lines[0]).rate
    quiet = np.zeros(rate // 5, np.float32)
    parts: list[np.ndarray[tuple[int], np.dtype[np.float32]]] = []
    starts: list[float] = []
    at = 0.0
    for line in lines:
        starts += [at + word.start for word in line.words]
        parts += [sound_of(line).samples, quiet]
        at += sound_of(line).duration + 0.2
    return Sound(np.concatenate(parts), rate), starts


def test_all_words_of_a_long_sound_lie_where_they_were_spoken(lines: list[Speech]) -> None:
    sound, spoken = joined(lines)
    told: list[float] = []
    aligned = align(sound, " ".join(line.text for line in lines), progress=told.append)
    apart = np.abs(np.subtract(starts(aligned), spoken))
    assert sound.duration > 60
    assert np.mean(apart < 0.05) > 0.9
    assert told == sorted(told)
    assert told[-1] == 1.0
    assert len(told) > 1


def test_words_that_are_not_in_the_sound_are_named(lines: list[Speech]) -> None:
    sound, _ = joined(lines[:6] + lines[10:])
    aligned = align(sound, " ".join(line.text for line in lines))
    assert any("not found in the sound" in note for note in aligned.notes)
    last = aligned.words[len(aligned.words) - 1]
    assert last.label == "time"
    assert last.end > sound.duration - 1.0


def test_words_of_something_else_still_come_back(lines: list[Speech]) -> None:
    sound, _ = joined(lines)
    aligned = align(sound, "Completely different things were written here. " * 20)
    assert len(aligned.words) > 50
    assert (aligned.confidence or 0) < 0.5
    assert aligned.phones.tier.end == sound.duration


def test_the_sound_itself_is_kept(peter: Speech) -> None:
    sound = replace(sound_of(peter))
    aligned = align(sound, TEXT)
    assert aligned.sound is sound
    assert (aligned.text, aligned.language, aligned.source) == (TEXT, "en-us", "align")
