"""Closures: met, no further than needed, at natural speed, and left alone where they are."""

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright.engines.motion import closures
from lipwright.engines.motion.closures import Closing, close, learn_closing, opening_of
from lipwright.engines.motion.recorded import Recorded
from tests.engines.motion.tiny_database import Tiny

Floats = NDArray[np.float64]
RATE = 120.0


def spoken(rate: float = RATE) -> Tiny:
    """Twenty takes of aa p iy: the first component opens the jaw and is small in p."""
    data = Tiny.of([[("aa", 15), ("p", 12), ("iy", 13)]] * 20, rate)
    data.basis, data.mean = np.eye(2, dtype=np.float32), np.zeros(2, np.float32)
    rng = np.random.default_rng(5)
    for take in range(20):
        t = np.linspace(-1, 1, 40)
        depth = 0.5 - 0.02 * rng.uniform(-1, 1)
        data.frames[40 * take : 40 * take + 40, 0] = 0.55 - depth * np.exp(-((t / 0.25) ** 2))
        data.frames[40 * take : 40 * take + 40, 1] = rng.uniform(0, 1) + 0.1 * np.sin(3 * t)
    return data


def openings(motion: Floats) -> Floats:
    """The jaw's, the first of two channels; the other is rounding."""
    return motion[:, 0]


def learnt(data: Recorded) -> Closing:
    return learn_closing(data, openings)


def closed(
    data: Tiny, frames: Floats, phones: list[tuple[str, float, float]]
) -> tuple[Floats, int]:
    result = frames.copy()
    pulled = close(result, RATE, phones, learnt(data), openings)
    return result, pulled


def test_closed_is_what_half_of_the_recorded_closures_reach() -> None:
    data = spoken()
    (kind,) = learnt(data).kinds
    assert kind.labels == ("p", "b", "m")
    assert kind.level == pytest.approx(0.05, abs=0.02)
    assert 8 <= len(kind.frames) <= 12
    assert (openings(kind.frames) <= kind.level + 1e-9).all()


def test_closed_is_learnt_from_the_recording_not_from_its_components() -> None:
    class Coarse(Tiny):
        """The components leave out half of the closing."""

        @property
        def values(self) -> NDArray[np.float32]:
            return self.frames - np.array([0.04, 0], np.float32)

    data = spoken()
    coarse = Coarse(**vars(data))
    assert learnt(coarse).kinds[0].level == pytest.approx(learnt(data).kinds[0].level - 0.04)


def test_an_open_p_closes_just_so_and_smoothly() -> None:
    data = spoken()
    t = np.arange(80) / RATE
    frames = np.stack((0.4 + 0.05 * np.cos(20 * t), 0.6 + 0 * t), axis=1)
    found, pulled = closed(data, frames, [("aa", 0, 0.25), ("p", 0.25, 0.35), ("iy", 0.35, 0.66)])
    level = learnt(data).kinds[0].level
    inside = slice(30, 42)
    assert pulled == 1
    assert openings(found)[inside].min() == pytest.approx(level, abs=0.025)
    assert openings(found)[inside].min() <= level
    np.testing.assert_array_equal(found[:10], frames[:10])
    np.testing.assert_array_equal(found[-10:], frames[-10:])
    speed = np.abs(np.diff(found[:, 0])) * RATE
    assert speed.max() <= max(learnt(data).speeds[0], np.abs(np.diff(frames[:, 0])).max() * RATE)
    # No corner: the acceleration stays of the size that recorded closures have.
    bend, recorded = (np.abs(np.diff(x, 2)).max() for x in (found[:, 0], data.frames[:40, 0]))
    assert bend < 2.5 * recorded


def test_the_closed_face_most_like_it_is_taken() -> None:
    data = spoken()
    for rounding in (0.1, 0.9):
        frames = np.tile([0.4, rounding], (60, 1))
        found, _ = closed(data, frames, [("p", 0.2, 0.3)])
        assert np.abs(found[:, 1] - rounding).max() < 0.2


def test_what_is_closed_or_need_not_be_is_untouched() -> None:
    data = spoken()
    frames = data.frames[:40].astype(np.float64)
    frames[:, 0] -= 0.1
    found, pulled = closed(data, frames, [("p", 15 / RATE, 27 / RATE)])
    assert pulled == 0
    np.testing.assert_array_equal(found, frames)
    found, pulled = closed(data, frames + 0.3, [("aa", 0, 0.1), ("f", 0.1, 0.2)])
    assert pulled == 0


@pytest.mark.parametrize(("start", "end"), [(0.0, 0.03), (0.301, 0.303), (0.6, 0.7), (-0.1, 0.001)])
def test_short_phones_and_those_at_the_ends_close_in_their_nearest_frame(
    start: float, end: float
) -> None:
    data = spoken()
    frames = np.tile([0.4, 0.5], (80, 1))
    found, pulled = closed(data, frames, [("b", start, end)])
    assert pulled == 1
    best = (int(openings(found).argmin()) + 0.5) / RATE
    assert start - 1 / RATE <= best <= max(end, 0) + 1 / RATE
    assert openings(found).min() <= learnt(data).kinds[0].level


def test_a_deep_closure_takes_the_time_that_it_needs() -> None:
    kind = closures.Closed(("m",), 0.05, np.array([[0.05, 0.5]]))
    slow = Closing((kind,), np.array([8.0, 8.0]), RATE)
    widths = []
    for level in (0.2, 0.9):
        frames = np.tile([level, 0.5], (120, 1))
        close(frames, RATE, [("m", 0.45, 0.55)], slow, openings)
        assert openings(frames).min() <= 0.05 + 1e-9
        assert np.abs(np.diff(frames[:, 0])).max() * RATE <= 8.0
        widths.append(int((frames[:, 0] < level).sum()))
    assert widths[1] > widths[0]
    assert widths[1] <= 2 * max(closures.WIDTHS) * RATE + 1


def test_an_unsure_p_is_closed_only_where_the_motion_is_nearly_closed() -> None:
    data = spoken()
    dip = np.exp(-(((np.arange(80) - 36) / 8) ** 2))
    for depth, expected in ((0.1, 0), (0.4, 1)):
        frames = np.stack((0.5 - depth * dip, np.full(80, 0.5)), axis=1)
        found = frames.copy()
        phones = [("p", 0.27, 0.33)]
        assert close(found, RATE, phones, learnt(data), openings, unsure=True) == expected
        assert (found == frames).all() == (not expected)
        assert close(frames, RATE, phones, learnt(data), openings) == 1


def test_opening_knows_the_names_of_arkit_in_any_case() -> None:
    opening = opening_of(["JawOpen", "mouthclose", "MouthLowerDownLeft", "browInnerUp"])
    assert opening is not None
    assert opening(np.array([[0.6, 0.2, 0.4, 1.0]]))[0] == pytest.approx(0.5)
    assert opening_of(["chin.x", "chin.y"]) is None


def test_of_poses_each_kind_closes_by_its_own() -> None:
    opening = opening_of(["PBM", "W", "open", "FV"])
    assert opening is not None
    apart = opening(np.array([[1.0, 0.5, 0.1, 0.0], [0.0, 0.5, 0.1, 0.8]]))
    np.testing.assert_allclose(apart, [[-0.9, 0.1], [0.1, -0.7]])
    assert opening_of(["open", "PBM"]) is None


@pytest.mark.parametrize("rate", [24.0, 30.0, 60.0])
def test_neighbours_that_close_in_two_ways_do_not_undo_each_other(rate: float) -> None:
    kinds = (
        closures.Closed(("p", "b", "m"), -0.95, np.array([[0.0, 1.0, 0.0]])),
        closures.Closed(("f", "v"), -0.95, np.array([[0.0, 0.0, 1.0]])),
    )
    closing = Closing(kinds, np.full(3, 20.0), 25.0)
    opening = opening_of(["open", "PBM", "FV"])
    assert opening is not None
    frames = np.tile([0.4, 0.3, 0.3], (round(rate), 1))
    phones = [("m", 0.30, 0.37), ("f", 0.37, 0.45), ("b", 0.45, 0.53), ("ah", 0.53, 0.6)]
    assert close(frames, rate, phones, closing, opening) == 3
    times = (np.arange(len(frames)) + 0.5) / rate
    for label, start, end in phones[:3]:
        inside = (times >= start) & (times < end)
        assert opening(frames[inside])[:, int(label == "f")].min() <= -0.95 + 1e-9, label
