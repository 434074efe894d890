"""The default English set: whole, readable, plausible, and true to its promises."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipwright.engines.bigram import BigramEngine, load_set
from lipwright.phones import PhoneTrack, load_phone_set
from lipwright.speech import Speech
from lipwright.timeline import Tier
from tests.engines.bigram.random_lines import random_track

SET = load_set("english")
CLASSES = load_phone_set("common").labels
CLOSING = {"bmp": "PBM", "f": "FV"}
VOWELS = ("ah", "aa", "ao", "eh", "er", "ih", "ow", "aw", "oy", "ay")


def level(label: str, pose: str) -> float:
    keys = SET.bigrams["sil", label].curves.get(pose)
    return float(keys.values.max()) if keys is not None else 0.0


def test_levels_follow_phonetics() -> None:
    assert level("aa", "open") > level("eh", "open") > level("ih", "open") > level("w", "open")
    assert level("ih", "wide") > level("eh", "wide") > level("aa", "wide")
    assert level("w", "W") > level("ao", "W") > level("aa", "W")
    assert level("sh", "ShCh") > 0.6 > level("z", "ShCh")
    for label, pose in (("d", "tRoof"), ("l", "tRoof"), ("kg", "tBack"), ("th", "tTeeth")):
        assert level(label, pose) > 0.6


def test_rounding_is_anticipated_across_a_consonant() -> None:
    def rounding(vowel: str) -> float:
        keys = SET.bigrams["d", vowel].curves.get("W")
        return float(keys.at([0.25])[0]) if keys is not None else 0.0

    assert rounding("w") > 0.2  # the lips are round in the /t/ of "two" …
    assert rounding("ih") < 0.1  # … and hardly drawn in, as those of any /t/, in "tea"


@pytest.mark.parametrize("rate", [24.0, 30.0, 60.0])
@settings(max_examples=120, deadline=None, print_blob=True)
@given(st.integers(0, 2**32 - 1))
def test_every_closure_is_in_a_frame(rate: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    labels = (*rng.choice(CLASSES, 6), "bmp", "f", "bmp")
    track = random_track(rng, labels)
    animation = BigramEngine(SET).animate(Speech(track), rate)
    times = animation.times
    for phone in track:
        pose = CLOSING.get(phone.label)
        if pose is None:
            continue
        inside = (times >= phone.start - 1e-9) & (times < phone.end - 1e-9)
        if not inside.any():
            distance = np.maximum(phone.start - times, times - phone.end)
            inside = distance <= distance.min() + 1e-9
        assert animation.control(pose)[inside].max() >= 0.9, phone
    for high in ("PBM", "FV"):
        room = np.maximum(0, 1 - animation.control(high) / 0.5)
        assert np.all(animation.control("open") <= room + 1e-6)


@pytest.mark.parametrize("vowel", VOWELS)
def test_the_mouth_opens_in_vowels_and_rests_in_silence(vowel: str) -> None:
    track = PhoneTrack(
        Tier.of(("sil", 0, 1), ("d", 1, 1.08), (vowel, 1.08, 1.28), ("d", 1.28, 1.36)), "common"
    )
    animation = BigramEngine(SET).animate(Speech(track))
    heard = animation.at([0.5, 1.18])
    assert np.all(heard[0] == 0)
    assert heard[1, animation.controls.index("open")] > 0.15


def test_the_published_preset_runs_the_same_line() -> None:
    track = PhoneTrack(Tier.of(("p", 0, 0.1), ("aa", 0.1, 0.4), ("p", 0.4, 0.5)))
    animation = BigramEngine(SET, "published").animate(Speech(track))
    # Its literal bound caps the mouth at one half (DESIGN section 4, stage 4).
    assert 0.2 < animation.keys["open"].values.max() <= 0.5
    assert not animation.values[[0, -1]].any()
