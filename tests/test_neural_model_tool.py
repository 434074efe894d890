"""What the live nets are taught: lines that are spoken, spoilt and heard, faces in step."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from tools.neural_model import closing
from tools.neural_model.closing import met_and_true
from tools.neural_model.hearing import SILENCE, Heard, hear_lines, order_of, read_heard
from tools.neural_model.lines import foreign, lines
from tools.neural_model.shape import WHOLE
from tools.neural_model.spoil import levelled, noise, spoilt
from tools.neural_model.spoken import CLASSES, Spoken, read_spoken, spoken, write_spoken

from lipwright.engines.neural import mel
from tests.engines.neural.tiny import tiny

COUNTS = {"english": 5, "others": 3, "flite": 2, "festival": 2}


@pytest.fixture(scope="module")
def said() -> list[Spoken]:
    wanted = lines(np.random.default_rng(3), {"english": 5, "others": 1})
    found = [spoken(line) for line in wanted]
    return [one for one in found if one is not None]


def test_the_same_seed_asks_for_the_same_lines() -> None:
    one, other = (lines(np.random.default_rng(1), COUNTS) for _ in range(2))
    assert one == other
    assert lines(np.random.default_rng(2), COUNTS) != one
    assert Counter(line.engine for line in one) == {"espeak": 8, "flite": 2, "festival": 2}
    assert all(line.text and 120 <= line.rate <= 230 for line in one)
    assert len(foreign()) > 30
    assert not {"en", "he", "th"} & set(foreign())


def test_faces_are_as_long_as_their_sound(said: list[Spoken], tmp_path: Path) -> None:
    assert len(said) >= 5
    for line in said:
        assert len(line.poses) == len(line.classes) == len(line.samples) // 160
        assert 0 <= line.poses.min() < line.poses.max() <= 1
    write_spoken(tmp_path / "s", said)
    assert [one.voice for one in read_spoken(tmp_path / "s")] == [one.voice for one in said]


def test_what_is_spoilt_stays_in_step_with_its_face(said: list[Spoken], tmp_path: Path) -> None:
    write_spoken(tmp_path / "s", said)
    heard = hear_lines(tmp_path / "s", seed=1, workers=1)
    heard.save(tmp_path / "h.npz")
    read = read_heard(tmp_path / "h.npz")
    assert np.array_equal(read.powers, heard.powers)
    assert heard.lengths.sum() == len(heard.powers) == len(heard.poses) == len(heard.classes)
    assert len(heard.lengths) == len(said) + len(said) // 5
    loud = mel.loudness(np.exp(heard.powers.astype(np.float64)))
    vowels = np.isin(heard.classes, [CLASSES.index(name) for name in ("aa", "eh", "ih", "ah")])
    ends = np.cumsum(heard.lengths)
    louder = []
    for start, end in zip(ends - heard.lengths, ends, strict=True):
        own, still = vowels[start:end], heard.classes[start:end] == SILENCE
        if own.any() and still.any():
            louder.append(loud[start:end][own].mean() - loud[start:end][still].mean())
        elif still.all():  # a noise alone
            assert heard.poses[start:end].max() == 0
    assert np.median(louder) > 6


def test_lines_are_found_again_among_what_was_heard(said: list[Spoken], tmp_path: Path) -> None:
    write_spoken(tmp_path / "s", said)
    heard = hear_lines(tmp_path / "s", seed=2, workers=1)
    order = order_of(len(said), 2)
    assert sorted(order.tolist()) == [-1] * (len(said) // 5) + list(range(len(said)))
    noises = heard.only(order < 0)
    assert len(noises.lengths) == len(said) // 5
    assert noises.poses.max() == 0
    for number in range(len(said)):
        one = heard.only(order == number)
        assert len(one.powers) == len(one.classes) == int(one.lengths[0])
        there = set(said[number].classes.tolist())
        assert set(one.classes.tolist()) <= there | {SILENCE}


def test_closures_are_met_within_two_frames() -> None:
    ours, meant = np.zeros((2, 40), bool)
    meant[5:8] = meant[20:23] = True
    ours[10:12] = ours[30:33] = True
    assert met_and_true(ours, meant) == (0.0, 0.0)
    ours[9] = True
    assert met_and_true(ours, meant) == (0.5, 0.5)
    assert met_and_true(meant, meant) == (1.0, 1.0)


def test_a_closure_is_shown_from_where_as_many_are_missed_as_made_up(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rng = np.random.default_rng(0)
    meant = np.arange(6000) % 20 < 4
    doubtful = np.arange(6000) % 20 == 12
    likely = np.where(meant, 0.85, np.where(doubtful, 0.6, 0.1)) + rng.uniform(-0.1, 0.1, 6000)
    monkeypatch.setattr(closing, "closures", lambda *_: (likely, meant))
    heard = Heard(
        np.zeros((0, 40), np.float16),
        np.zeros((0, 9), np.float16),
        np.zeros(0, np.int8),
        np.zeros(0, np.int64),
    )
    shown = closing.with_closing(tiny(), WHOLE, heard).closing
    assert shown is not None
    limit = shown.doubted + closing.SHUT * (shown.sure - shown.doubted)
    assert 0.69 < limit < 0.8
    assert shown.control == "PBM"


def test_noises_have_one_power_and_levels_are_those_of_recordings(said: list[Spoken]) -> None:
    rng = np.random.default_rng(0)
    others = np.concatenate([line.samples for line in said]) / 32768
    for _ in range(20):
        made = noise(16000, rng, others)
        assert np.isfinite(made).all()
        assert np.square(made).mean() == pytest.approx(1.0, abs=1e-6)
    for line in said:
        sound, faster = spoilt(line.samples, rng, others)
        assert len(sound) == pytest.approx(len(line.samples) / faster, abs=2)
        assert 0.8 < faster < 1.25
        assert np.abs(levelled(sound, rng)).max() <= 1
