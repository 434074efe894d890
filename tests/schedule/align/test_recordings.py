"""Recorded people: nothing fails, and boundaries lie where a hand put them."""

import csv
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
import soundfile

from lipwright.schedule.align import align
from lipwright.sound import Sound
from lipwright.speech import Speech

DATA = Path(__file__).parents[3] / "../shared/data"

pytestmark = [
    pytest.mark.shared_data,
    pytest.mark.skipif(not DATA.is_dir(), reason="the recordings are not here"),
]


def aligned(path: Path, text: str) -> Speech:
    samples, rate = soundfile.read(path, dtype="float32")
    return align(Sound(samples, rate), text)


def hand_marked_words(path: Path) -> Iterator[float]:
    for line in path.with_suffix(".wrd").read_text().splitlines():
        yield int(line.split()[0]) / 16000


def is_damaged(path: Path) -> bool:
    """Whether bytes were lost in the recording, which turns the rest into noise."""
    samples, _ = soundfile.read(path)
    return bool(np.mean(np.abs(samples) > 0.5) > 0.01)


def test_every_sentence_of_many_speakers_is_aligned() -> None:
    apart: list[float] = []
    for path in sorted((DATA / "timit").glob("*/*.flac")):
        speech = aligned(path, path.with_suffix(".txt").read_text().split(None, 2)[2])
        assert speech.phones.tier.end == speech.duration
        marked = list(hand_marked_words(path))
        if not is_damaged(path) and len(marked) == len(speech.words):
            assert (speech.confidence or 0) > 0.5
            apart += [w.start - m for w, m in zip(speech.words, marked, strict=True)]
    assert np.mean(np.abs(apart) < 0.05) > 0.9


def test_sentences_of_one_speaker_are_aligned() -> None:
    with (DATA / "grid/text.csv").open() as file:
        rows = list(csv.DictReader(file))[::12]
    for row in rows:
        speech = aligned(DATA / "grid/audio" / f"{row['sentence']}.flac", row["text"])
        assert " ".join(speech.words.labels) == row["text"]
        assert (speech.confidence or 0) > 0.5
