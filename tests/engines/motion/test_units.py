"""Takes are cut at their phones; principal components keep what they promise."""

import numpy as np
import pytest

from lipwright.engines.motion.components import components
from lipwright.engines.motion.units import at_points, at_positions, cut, seams, whole_frames
from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.timeline import Tier


def track(*phones: tuple[str, float, float]) -> PhoneTrack:
    return PhoneTrack(Tier.of(*phones))


def test_spans_touch_and_gaps_are_silence() -> None:
    phones = track(("b", 0.0, 0.1), ("aa", 0.104, 0.2), ("t", 0.3, 0.4))
    made = cut(phones, 10, 25.0, 0.0, "take")
    assert made.labels == ("b", "aa", "sil", "t")
    assert made.spans.ravel() == pytest.approx([0, 2.55, 2.55, 5, 5, 7.5, 7.5, 10], abs=1e-4)
    assert (made.spans[1:, 0] == made.spans[:-1, 1]).all()


def test_what_lies_outside_the_motion_is_left_out() -> None:
    phones = track(("sil", 0.0, 0.9), ("b", 0.9, 1.1), ("aa", 1.1, 1.3), ("t", 1.4, 1.6))
    made = cut(phones, 5, 25.0, 1.0, "take")
    assert made.labels == ("b", "aa")
    assert made.spans.tolist() == [[0.0, 2.5], [2.5, 5.0]]


def test_no_phone_within_the_motion_is_refused() -> None:
    with pytest.raises(InputError, match=r"take: no phone falls into its motion.*0.00 to 0.50 s"):
        cut(track(("b", 0.0, 0.5)), 10, 25.0, 2.0, "take")


def test_a_unit_has_the_frames_whose_instants_it_holds_and_at_least_one() -> None:
    spans = np.array([[0.0, 2.5], [2.5, 2.9], [2.9, 3.4], [3.4, 5.0]])
    first, last = whole_frames(spans, 5)
    assert first.tolist() == [0, 2, 3, 3]
    assert last.tolist() == [2, 3, 4, 5]


def test_values_between_frames_lie_on_the_line_and_hold_at_the_ends() -> None:
    values = np.array([[0.0], [1.0], [3.0]], np.float32)
    at = at_positions(values, np.array([-1.0, 0.5, 1.0, 2.25, 9.0]))
    assert at[:, 0].tolist() == [0.0, 0.0, 0.5, 2.5, 3.0]
    assert at_positions(values[:1], np.array([0.0, 4.0]))[:, 0].tolist() == [0.0, 0.0]


def test_spans_of_any_length_compare() -> None:
    slow = np.linspace(0, 1, 41, dtype=np.float32)[:, None]
    points = at_points(slow, np.array([[0.5, 40.5], [0.5, 20.5]]), 4)
    assert points[0, :, 0] == pytest.approx([0.125, 0.375, 0.625, 0.875], abs=1e-6)
    assert points[1, :, 0] == pytest.approx(points[0, :, 0] / 2, abs=1e-6)


def test_a_seam_is_value_and_velocity() -> None:
    ramp = (0.1 * np.arange(10, dtype=np.float32))[:, None]
    state = seams(ramp, np.array([[2.0, 5.0], [5.0, 8.0]]), step=2.0)
    assert state[0] == pytest.approx(np.array([[0.15, 0.2], [0.45, 0.2]]), abs=1e-6)
    assert (state[0, 1] == state[1, 0]).all()


def test_components_keep_the_share_of_variance_that_is_asked() -> None:
    rng = np.random.default_rng(2)
    values = (rng.normal(size=(500, 12)) * 2.0 ** -np.arange(12) + 3.0).astype(np.float32)
    for keep, least in ((0.95, 1), (0.95, 5), (0.9999, 1), (1.0, 1)):
        made = components([values[:200], values[200:]], keep, least)
        assert made.variance.sum() >= keep * made.total - 1e-9
        if len(made.variance) > least:
            assert made.variance[:-1].sum() < keep * made.total
        assert made.basis @ made.basis.T == pytest.approx(np.eye(len(made.basis)), abs=1e-9)
        assert made.mean == pytest.approx(values.mean(axis=0), abs=1e-5)
        assert made.total == pytest.approx(values.var(axis=0).sum(), rel=1e-5)
        back = made.project(values) @ made.basis + made.mean
        lost = ((values - back) ** 2).sum() / (len(values) * made.total)
        assert lost == pytest.approx(1 - made.variance.sum() / made.total, abs=1e-5)


def test_few_channels_and_no_motion_are_no_trouble() -> None:
    still = components([np.ones((4, 3), np.float32)])
    assert (len(still.basis), still.total) == (3, 0.0)
    assert still.project(np.ones((2, 3), np.float32)).tolist() == [[0.0] * 3] * 2
