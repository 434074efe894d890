"""Nets that learn in a blink, and their files."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.engines.neural.engine import NeuralEngine, smooth
from lipwright.engines.neural.lessons import Lesson
from lipwright.engines.neural.model import Model, read_model
from lipwright.engines.neural.training import train
from lipwright.errors import FileFormatError, InputError, MissingExtraError
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Tier

RATE = 16000


def lesson(seconds: float = 6.0, seed: int = 0, controls: tuple[str, ...] = ("hi", "lo")) -> Lesson:
    """High and low tones by turns, and a control that each of them moves."""
    rng = np.random.default_rng(seed)
    times = np.arange(int(seconds * RATE)) / RATE
    high = np.repeat(rng.random(int(seconds * 5) + 1) > 0.5, RATE // 5)[: len(times)]
    tone = np.sin(2 * np.pi * np.where(high, 2500, 400) * times)
    samples = (0.3 * tone + rng.normal(0, 0.01, len(times))).astype(np.float32)
    frames = np.arange(int(seconds * 25))
    on = high[frames * (RATE // 25)].astype(np.float32)
    values = np.stack([on, 0.05 * (1 - on)], axis=1)[:, : len(controls)]
    return Lesson(Sound(samples, RATE), Animation(controls, values, 25.0), f"lesson {seed}")


@pytest.fixture(scope="module")
def model() -> Model:
    return train([lesson(), lesson(seed=1)])


def test_what_a_tone_moves_is_learnt(model: Model) -> None:
    unseen = lesson(seed=7)
    speech = Speech(PhoneTrack(Tier()), sound=unseen.sound)
    made = NeuralEngine(model, "m").animate(speech, 25.0)
    for name in ("hi", "lo"):
        wanted = unseen.animation.control(name)
        assert np.corrcoef(made.control(name)[: len(wanted)], wanted)[0, 1] > 0.9
    assert model.network.shape == (243, 18, 2)
    assert made.report["net"] == "243-18-2"
    assert made.report["unlike_training"] < 0.1
    assert made.engine == "neural"
    assert 0 <= made.values.min() <= made.values.max() <= 1


def test_another_sound_is_told_from_the_training(model: Model) -> None:
    noise = np.random.default_rng(3).normal(0, 0.1, 2 * RATE).astype(np.float32)
    speech = Speech(PhoneTrack(Tier()), sound=Sound(noise, RATE))
    assert NeuralEngine(model).animate(speech).report["unlike_training"] > 0.9


def test_the_same_training_gives_the_same_bytes() -> None:
    one, other = train([lesson(2.0)]), train([lesson(2.0)])
    assert one.to_bytes() == other.to_bytes()
    assert train([lesson(2.0)], seed=1).to_bytes() != one.to_bytes()


def test_a_model_comes_back_bit_for_bit(model: Model, tmp_path: Path) -> None:
    path = tmp_path / "a model"
    model.save(path)
    again = read_model(path)
    assert again.to_bytes() == path.read_bytes() == model.to_bytes()
    heard = np.random.default_rng(0).normal(size=(9, 243))
    assert (again.outputs(heard) == model.outputs(heard)).all()


def test_several_hidden_layers_and_one_control() -> None:
    made = train([lesson(2.0, controls=("hi",))], hidden=(6, 4))
    assert made.network.shape == (243, 6, 4, 1)
    assert "2.0 s" in made.about["notes"][0]


def test_controls_beyond_1_keep_their_range() -> None:
    one = lesson(2.0)
    wide = Animation(one.animation.controls, 40 * one.animation.values - 5, 25.0)
    made = train([Lesson(one.sound, wide, "wide")])
    assert made.low.tolist() == [-5, -5]
    assert made.high.tolist() == [35, 1]


def test_constant_controls_stay_and_are_told() -> None:
    one = lesson(2.0)
    values = one.animation.values.copy()
    values[:, 1] = 0.25
    made = train([Lesson(one.sound, Animation(("hi", "lo"), values, 25.0), "half")])
    assert made.about["constant"] == ["lo"]
    given = NeuralEngine(made).animate(Speech(PhoneTrack(Tier()), sound=one.sound))
    assert np.abs(given.control("lo") - 0.25).max() < 0.01


def still(one: Lesson) -> Lesson:
    values = np.full_like(one.animation.values, 0.5)
    return Lesson(one.sound, Animation(one.animation.controls, values, 25.0), one.name)


def longer(one: Lesson) -> Lesson:
    return Lesson(lesson(9.0).sound, one.animation, one.name)


def other(one: Lesson) -> Lesson:
    return Lesson(one.sound, Animation(("a", "b"), one.animation.values, 25.0), "another")


@pytest.mark.parametrize(
    ("lessons", "hidden", "words"),
    [
        ([], 18, "nothing to learn from"),
        ([lesson(0.5)], 18, r"0\.48 s to learn from"),
        ([still(lesson(2.0))], 18, "lesson 0: no control moves"),
        ([longer(lesson(6.0))], 18, r"0\.00 to 6\.00 s beside 9\.00 s of sound"),
        ([lesson(2.0), other(lesson(2.0))], 18, "another: has the controls a, b; expected"),
        ([lesson(2.0)], 0, r"hidden units \[0\]"),
    ],
)
def test_what_cannot_be_learnt_from(lessons: list[Lesson], hidden: int, words: str) -> None:
    with pytest.raises(InputError, match=words):
        train(lessons, hidden=(hidden,))


def test_without_the_extra_training_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "sklearn.neural_network", None)
    with pytest.raises(MissingExtraError, match=r"lipwright\[train\]"):
        train([lesson(2.0)])


# ---- files that are not what they should be -------------------------------------------------


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda d: d.update(version=2), "version 2; expected version 1 or older"),
        (lambda d: d.update(format="lipwright/animation"), "expected a file of format"),
        (lambda d: d["layers"].pop(), "at low: 2 numbers; expected 18"),
        (lambda d: d["layers"].clear(), "no layers"),
        (lambda d: d["layers"][0]["weights"].pop(), "layer 1: 242 x 18 weights; expected 243 x 18"),
        (lambda d: d["layers"][0]["weights"][3].pop(), "layer 1: rows of different lengths"),
        (lambda d: d["mean"].pop(), "at mean: 242 numbers; expected 243"),
        (lambda d: d["controls"].append("more"), "at controls: 3 numbers; expected 2"),
        (lambda d: d.update(controls=["hi", "hi"]), "of the same name"),
        (lambda d: d["deviation"].__setitem__(0, 0), "a deviation of 0"),
        (lambda d: d["mean"].__setitem__(0, 1e60), "beyond what a weight can be"),
        (lambda d: d["mean"].__setitem__(0, "x"), r"at mean\[0\]"),
        (lambda d: d["hearing"].update(scale="pitch"), "at hearing.scale"),
        (lambda d: d["hearing"].update(hop=0), "at hearing"),
        (lambda d: d["hearing"].update(rate=10**9), "at hearing"),
        (lambda d: d.pop("layers"), "layers"),
        (lambda d: d["about"].update(seconds="long"), "at about.seconds"),
    ],
)
def test_broken_models_are_refused(model: Model, tmp_path: Path, change, words: str) -> None:  # type: ignore[no-untyped-def]
    document = json.loads(model.to_bytes())
    change(document)
    path = tmp_path / "model.json"
    path.write_text(json.dumps(document))
    with pytest.raises(FileFormatError, match=words) as caught:
        read_model(path)
    assert "model.json" in str(caught.value)


@pytest.mark.parametrize("share", [0.0, 0.001, 0.3, 0.9, 0.999])
def test_models_that_were_cut_are_refused(model: Model, tmp_path: Path, share: float) -> None:
    data = model.to_bytes()
    path = tmp_path / "model.json"
    path.write_bytes(data[: int(share * len(data))])
    with pytest.raises(FileFormatError, match=r"model\.json"):
        read_model(path)


def test_a_model_with_nan_is_refused(model: Model, tmp_path: Path) -> None:
    path = tmp_path / "model.json"
    path.write_bytes(model.to_bytes().replace(b'"mean": [', b'"mean": [NaN, ', 1))
    with pytest.raises(FileFormatError, match="NaN"):
        read_model(path)


def test_between_frames_nothing_overshoots() -> None:
    rng = np.random.default_rng(0)
    times, values = np.arange(50, dtype=np.float64) * 0.04, rng.random((50, 3))
    fine = np.linspace(0.0, 1.96, 4000, dtype=np.float64)
    found = smooth(times, values, fine)
    left = np.minimum((fine / 0.04).astype(int), 48)
    low, high = (
        np.minimum(values[left], values[left + 1]),
        np.maximum(values[left], values[left + 1]),
    )
    assert (found >= low - 1e-9).all()
    assert (found <= high + 1e-9).all()
    assert smooth(times, values, times) == pytest.approx(values)
    slopes = np.diff(found, axis=0) / (fine[1] - fine[0])
    assert np.abs(np.diff(slopes, axis=0)).max() < 3  # no corners
