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
from tools.neural_model.shape import LIVE, WHOLE, Shape
from tools.neural_model.shown import Lessons, recorded, shifted, stretches
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


def told(seed: int) -> np.ndarray[tuple[int, int, int], np.dtype[np.float32]]:
    """Bands as nets hear them, 50 stretches: sounds of all levels, and nothing."""
    bands = np.random.default_rng(seed).uniform(0, 1.1, (50, 30, mel.BANDS)).astype(np.float32)
    bands[:, 10:20] = 0.0
    return bands


def test_other_recordings_keep_silence_and_the_order_of_levels() -> None:
    bands = told(1)
    heard = recorded(bands, np.random.default_rng(2))
    assert heard.dtype == np.float32
    assert np.median(heard[:, 10:20]) < 0.001
    assert np.quantile(heard[:, 10:20], 0.9) < 0.05
    order = np.argsort(bands, axis=1)  # of a band, over time
    assert np.diff(np.take_along_axis(heard, order, axis=1), axis=1).min() > -1e-5


def test_other_recordings_lie_higher_and_lower_wider_and_narrower() -> None:
    heard = recorded(np.full((400, 1, mel.BANDS), 0.5, np.float32), np.random.default_rng(3))
    middle = heard[:, 0, mel.BANDS // 2]
    assert 0.09 < middle.std() < 0.15
    tilt = heard[:, 0, -1] - heard[:, 0, 0]
    assert 0.15 < tilt.std() < 0.25
    assert abs(middle.mean() - 0.5) < 0.03
    assert abs(tilt.mean()) < 0.03


def test_throats_move_what_is_heard_along_the_scale() -> None:
    bands = np.zeros((200, 1, mel.BANDS), np.float32)
    bands[..., 20] = 1.0
    moved = shifted(bands, 1.5, np.random.default_rng(4))
    places = (moved * np.arange(mel.BANDS)).sum(-1) / moved.sum(-1)
    assert 16.5 < places.min() < 18.5
    assert 21.5 < places.max() < 23.5
    assert np.allclose(shifted(bands, 0.0, np.random.default_rng(4)), bands)


@pytest.mark.parametrize("shape", [WHOLE, LIVE])
def test_faces_are_shown_beside_what_is_heard_of_them(shape: Shape) -> None:
    times = np.arange(4000)
    loud = (times // 75 % 2).astype(np.float16)  # a sound and a pause in turn
    lessons = Lessons(
        np.repeat(0.8 * loud[:, None], mel.BANDS, axis=1),
        np.repeat(loud[:, None], 9, axis=1),
        loud.astype(np.int8),
    )
    bands, poses, classes = next(stretches(lessons, shape, 0.0, np.random.default_rng(5)))
    assert bands.shape == (32, 2 * (250 + shape.ahead) + 2, mel.BANDS)
    assert poses.shape == (32, 250, 9)
    assert 0.4 < classes.mean() < 0.6
    assert np.array_equal(classes, poses[..., 0])
    own = np.median(bands[:, 4 : 4 + 500 : 2], axis=2)  # two more bands' frames come first
    assert np.array_equal(own > 0.25, poses[..., 0] > 0.5)
