"""The learnt low-pass: what it keeps, what it takes away, and its ends."""

import numpy as np
import pytest

from lipwright.engines.motion.lowpass import cut_offs, low_pass

RATE = 120.0
T = np.arange(1200) / RATE
INSIDE = slice(120, -120)


def test_cut_off_is_the_edge_of_99_percent() -> None:
    big, small = np.cos(2 * np.pi * 3 * T), np.cos(2 * np.pi * 20 * T)
    take = np.stack([big + 0.05 * small, big + 0.2 * small, 0 * T + 4], axis=1)
    found = cut_offs([take], RATE)
    assert found[0] == pytest.approx(3, abs=0.2)
    assert found[1] == pytest.approx(20, abs=0.2)
    assert found[2] == RATE / 2


def test_energy_is_gathered_over_takes_of_any_length() -> None:
    slow = np.cos(2 * np.pi * 2 * T)[:, None]
    quick = np.cos(2 * np.pi * 15 * T)[:, None]
    assert cut_offs([slow, 0.01 * quick], RATE)[0] < 3
    assert cut_offs([slow[:700], quick[:500], quick[:1]], RATE)[0] == pytest.approx(15, abs=0.3)


def test_take_means_do_not_count() -> None:
    quick = np.cos(2 * np.pi * 15 * T)[:, None]
    assert cut_offs([quick + 100], RATE)[0] == pytest.approx(15, abs=0.2)


def test_slow_passes_and_fast_goes_without_delay() -> None:
    slow, fast = np.cos(2 * np.pi * 2 * T), np.cos(2 * np.pi * 30 * T)
    found = low_pass((slow + fast)[:, None], RATE, np.array([8.0]))[:, 0]
    assert np.abs(found - slow)[INSIDE].max() < 0.005


def test_each_component_has_its_own_cut_off() -> None:
    both = np.tile(np.cos(2 * np.pi * 10 * T)[:, None], 2)
    found = low_pass(both, RATE, np.array([3.0, 30.0]))
    assert np.abs(found[INSIDE, 0]).max() < 0.01
    np.testing.assert_allclose(found[INSIDE, 1], both[INSIDE, 1], atol=1e-3)


@pytest.mark.parametrize("count", [1, 2, 7, 480])
def test_a_held_face_stays_and_ends_do_not_ring(count: int) -> None:
    np.testing.assert_allclose(low_pass(np.full((count, 1), 3.0), RATE, np.array([6.0])), 3.0)
    ramp = np.linspace(0, 1, count)[:, None]
    found = low_pass(ramp, RATE, np.array([6.0]))
    assert found.min() > -0.01
    assert found.max() < 1.01


def test_a_step_overshoots_by_little() -> None:
    step = (T > 5).astype(float)[:, None]
    found = low_pass(step, RATE, np.array([6.0]))
    assert found.max() < 1.15
    assert found.min() > -0.15
