"""Frames of a database at any instant, and beyond the ends of takes."""

import numpy as np

from lipwright.engines.motion import recorded
from tests.engines.motion.tiny_database import Tiny


def test_whole_positions_are_the_frames_themselves() -> None:
    data = Tiny.made()
    low, high = np.zeros(40, np.int64), np.full(40, 40)
    found = recorded.at(data, np.arange(40.0), low, high)
    np.testing.assert_array_equal(found, data.frames[:40])


def test_between_frames_a_line_stays_a_line() -> None:
    data = Tiny.made()
    data.frames[:40] = np.arange(40.0)[:, None]
    positions = np.linspace(1, 37.5, 100)
    low, high = np.zeros(100, np.int64), np.full(100, 40)
    found = recorded.at(data, positions, low, high)
    np.testing.assert_allclose(found[:, 0], positions, atol=1e-6)


def test_beyond_a_take_velocity_goes_on_and_dies_down() -> None:
    data = Tiny.made(rate=100.0)
    data.frames[:40] = np.arange(40.0)[:, None]
    positions = np.arange(39.0, 80.0)
    low, high = np.zeros(41, np.int64), np.full(41, 40)
    found = recorded.at(data, positions, low, high)[:, 0]
    steps = np.diff(found)
    assert 0.85 < steps[0] < 1.0
    assert (np.diff(steps) < 0).all()
    assert found[-1] - found[0] < recorded.FADE * 100 + 1e-6
    before = recorded.at(data, -positions + 39, low, high)[:, 0]
    np.testing.assert_allclose(before, 39 - found, atol=1e-5)


def test_neighbouring_takes_are_not_touched() -> None:
    data = Tiny.made()
    low, high = recorded.take_bounds(data, np.array([0, 9]))
    assert (low[0], high[1]) == (0, len(data.frames))
    assert high[0] == low[1]
    seam = int(high[0])
    one = recorded.at(data, np.array([seam - 0.4]), low[:1], high[:1])
    data.frames[seam:] += 100
    np.testing.assert_array_equal(recorded.at(data, np.array([seam - 0.4]), low[:1], high[:1]), one)


def test_takes_are_told_apart() -> None:
    data = Tiny.made()
    parts = recorded.takes(data)
    assert [len(part) for part in parts] == [40, 35]
    np.testing.assert_array_equal(np.concatenate(parts), data.frames)
