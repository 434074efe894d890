"""Time warps: the least of all allowed ones, with ends tied and a bounded pace."""

from itertools import product

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from lipwright.engines.motion import warping

EVEN = np.linspace(0, 1, warping.KNOTS)


def words(count: int, seed: int) -> NDArray[np.float64]:
    """Smooth features, as speech has."""
    rng = np.random.default_rng(seed)
    t = np.linspace(0, 1, count)[:, None]
    return np.asarray(np.sin(2 * np.pi * (t * rng.uniform(0.3, 1.2, 9) + rng.uniform(0, 1, 9))))


@pytest.mark.parametrize("seed", range(5))
def test_finds_the_least_of_all_paths(seed: int) -> None:
    rng = np.random.default_rng(seed)
    cost = rng.uniform(0, 2, (1, 6, 11))
    best = min(
        (
            cost[0, 0, 0]
            + sum(
                cost[0, k, i] + warping.PRICE * abs(s - 2)
                for k, (i, s) in enumerate(zip(np.cumsum(steps), steps, strict=True), 1)
            ),
            (0, *np.cumsum(steps)),
        )
        for steps in product((1, 2, 3, 4), repeat=5)
        if sum(steps) == 10
    )
    assert tuple(warping._least_path(cost)[0]) == best[1]


def test_finds_a_known_warp() -> None:
    t = np.linspace(0, 1, 60)[:, None]
    late = t + 0.12 * np.sin(np.pi * t)

    def heard(x: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(np.sin(np.arange(1, 10) * 2 * x + np.arange(9)))

    found = warping.warp(heard(late), heard(t))
    true = EVEN + 0.12 * np.sin(np.pi * EVEN)
    assert np.abs(found - true).max() < 0.03
    assert np.abs(found - EVEN).max() > 0.08


@pytest.mark.parametrize(("m", "n"), [(30, 40), (30, 10), (3, 60), (1, 1), (2, 1), (1, 7)])
def test_ends_are_tied_and_the_pace_is_bounded(m: int, n: int) -> None:
    rng = np.random.default_rng(m * n)
    found = warping.warp(rng.normal(size=(m, 9)), rng.normal(size=(n, 9)))
    assert found[0] == 0.0
    assert found[-1] == 1.0
    pace = np.diff(found) * (warping.KNOTS - 1)
    assert pace.min() >= 0.5 - 1e-9
    assert pace.max() <= 2.0 + 1e-9


@given(st.integers(2, 50), st.integers(2, 50), st.integers(0, 20))
def test_the_same_sound_faster_or_slower_is_no_warp(m: int, n: int, seed: int) -> None:
    whole = words(400, seed)
    taken = [whole[((np.arange(k) + 0.5) / k * 400).astype(int)] for k in (m, n)]
    found = warping.warp(taken[0], taken[1])
    assert np.abs(found - EVEN).max() < 0.2 + 0.5 / min(m, n)
    if m == n:
        np.testing.assert_allclose(found, EVEN, atol=1e-12)


def test_no_sound_and_a_held_sound_are_even() -> None:
    sound = words(12, 0)
    held = np.tile(sound[:1], (20, 1))
    for wanted, recorded in [
        (sound, np.zeros((9, 9))),
        (np.zeros((9, 9)), sound),
        (held, held[:7]),
        (held, held[:7] + 1e-7),
    ]:
        np.testing.assert_allclose(warping.warp(wanted, recorded), EVEN, atol=1e-12)


def test_many_at_once_are_as_each_alone() -> None:
    wanted = [words(12, seed) for seed in range(6)]
    recorded = [words(20, seed + 10) for seed in range(6)]
    together = warping.warps(
        warping.knots(np.stack(wanted), warping.KNOTS),
        warping.knots(np.stack(recorded), 2 * warping.KNOTS - 1),
    )
    alone = [warping.warp(a, b) for a, b in zip(wanted, recorded, strict=True)]
    np.testing.assert_array_equal(together, alone)
