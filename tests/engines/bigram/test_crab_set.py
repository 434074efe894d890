"""The crab's set: whole, readable, in its own poses, and true to its promises."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipwright.engines.bigram import BigramEngine, load_set
from lipwright.phones import PhoneTrack, load_phone_set
from lipwright.speech import Speech
from lipwright.timeline import Tier
from tests.engines.bigram.random_lines import random_track
from tests.engines.bigram.test_promises import check_stages

SET = load_set("crab")
CLASSES = load_phone_set("common").labels
CLOSING = {"bmp": "mandibles_in", "f": "bite"}
VOWELS = ("ah", "aa", "ao", "eh", "er", "ih", "w", "ow", "aw", "oy", "ay")


def level(label: str, pose: str) -> float:
    keys = SET.bigrams["sil", label].curves.get(pose)
    return float(keys.values.max()) if keys is not None else 0.0


def test_levels_keep_what_a_listener_expects_to_see() -> None:
    assert level("aa", "mouth_open") > level("eh", "mouth_open") > level("ih", "mouth_open")
    assert level("w", "mouth_OO") > level("ao", "mouth_OO") > level("aa", "mouth_OO")
    assert level("ih", "smile") > level("eh", "smile") > level("aa", "smile")
    assert level("z", "bare_teeth") > 0.6 < level("er", "frown")
    for label, pose in (("d", "tongue_up"), ("kg", "tongue_back"), ("th", "tongue_out")):
        assert level(label, pose) > 0.6


@pytest.mark.parametrize("rate", [24.0, 30.0, 60.0])
@settings(max_examples=60, deadline=None, print_blob=True)
@given(st.integers(0, 2**32 - 1))
def test_every_closure_is_in_a_frame(rate: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    labels = (*rng.choice(CLASSES, 6), "bmp", "f", "bmp")
    engine = BigramEngine(SET)
    track = random_track(rng, labels)
    animation = engine.animate(Speech(track), rate)
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
    for high, low, threshold in engine.rules.bounds():
        room = np.maximum(0, 1 - animation.control(high.name) / threshold)
        assert np.all(animation.control(low.name) <= room + 1e-6)


@settings(max_examples=40, deadline=None, print_blob=True)
@given(st.integers(0, 2**32 - 1))
def test_stage_5_keeps_its_promises(seed: int) -> None:
    engine = BigramEngine(SET)
    check_stages(engine, engine.solve(random_track(np.random.default_rng(seed))))


@pytest.mark.parametrize("vowel", VOWELS)
def test_each_vowel_moves_the_mouth_which_rests_in_silence(vowel: str) -> None:
    track = PhoneTrack(
        Tier.of(("sil", 0, 1), ("d", 1, 1.08), (vowel, 1.08, 1.28), ("d", 1.28, 1.36)), "common"
    )
    animation = BigramEngine(SET).animate(Speech(track))
    heard = animation.at([0.5, 1.18])
    assert np.all(heard[0] == 0)
    rim = [animation.controls.index(pose) for pose in ("mouth_open", "mouth_OO", "smile")]
    assert heard[1, rim].max() > 0.15


def test_the_published_preset_runs_the_same_line() -> None:
    track = PhoneTrack(Tier.of(("p", 0, 0.1), ("aa", 0.1, 0.4), ("p", 0.4, 0.5)))
    animation = BigramEngine(SET, "published").animate(Speech(track))
    assert 0.2 < animation.keys["mouth_open"].values.max() <= 0.5
    assert not animation.values[[0, -1]].any()
