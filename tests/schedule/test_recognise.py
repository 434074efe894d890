"""Recognition as a user meets it."""

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright.errors import SoundError
from lipwright.schedule.recognise import recognise
from lipwright.schedule.say import say
from lipwright.sound import Sound


def test_words_and_phones_come_out_of_a_sound() -> None:
    speech = say("Maybe they will take us.", rate=140)
    assert speech.sound is not None
    heard = recognise(speech.sound)
    assert heard.source == "recognise"
    assert heard.phones.tier.start == 0.0
    assert heard.phones.tier.end == speech.sound.duration
    assert heard.text == " ".join(heard.words.labels)
    assert {"will", "take", "us"} & set(heard.words.labels)
    assert all(0 <= (word.confidence or 0) <= 1 for word in heard.words)
    assert heard.confidence is not None


def test_what_was_heard_before_changes_nothing() -> None:
    speech = say("Maybe they will take us.", rate=140)
    assert speech.sound is not None
    first = recognise(speech.sound)
    with pytest.raises(SoundError):
        recognise(Sound(np.full(800, 0.1, np.float32), 16000))
    again = recognise(speech.sound)
    assert again.phones == first.phones
    assert again.words == first.words


@pytest.mark.parametrize(
    "samples",
    [
        np.zeros(0, np.float32),
        np.zeros(16000, np.float32),
        np.random.default_rng(0).normal(0, 0.1, 32000).astype(np.float32),
        (0.3 * np.sin(np.arange(32000) / 25)).astype(np.float32),
        np.ones(10, np.float32),
    ],
    ids=["empty", "silence", "noise", "hum", "ten samples"],
)
def test_a_sound_without_speech_is_refused(samples: NDArray[np.float32]) -> None:
    with pytest.raises(SoundError, match=r"no speech in it|no samples"):
        recognise(Sound(samples, 16000))
