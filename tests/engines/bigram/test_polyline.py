"""The algebra on keys against a slow reading of its definitions."""

import numpy as np
import pytest

from lipwright.engines.bigram.polyline import (
    Axis,
    Line,
    combine,
    hold,
    maxima,
    prune,
    steepest_above,
    steepest_below,
)

SEEDS = range(30)
FINE = np.linspace(0, 10, 4001)


def random_line(rng: np.random.Generator) -> Line:
    times = np.sort(rng.uniform(1, 9, int(rng.integers(3, 25))))
    values = rng.uniform(0, 1, len(times))
    values[[0, -1]] = 0
    return np.concatenate(([0.0], times, [10.0])), np.concatenate(([0.0], values, [0.0]))


@pytest.mark.parametrize("seed", SEEDS)
def test_combine_is_the_pointwise_maximum_and_minimum(seed: int) -> None:
    rng = np.random.default_rng(seed)
    one, other = random_line(rng), random_line(rng)
    a, b = np.interp(FINE, *one), np.interp(FINE, *other)
    assert np.interp(FINE, *combine(one, other, "max")) == pytest.approx(
        np.maximum(a, b), abs=1e-12
    )
    assert np.interp(FINE, *combine(one, other, "min")) == pytest.approx(
        np.minimum(a, b), abs=1e-12
    )


@pytest.mark.parametrize("seed", SEEDS)
def test_steepest_below_is_the_greatest_that_keeps_the_slope(seed: int) -> None:
    rng = np.random.default_rng(seed)
    line, limit = random_line(rng), float(rng.uniform(0.3, 5))
    found = steepest_below(line, Axis(0, 10, 1), np.array([limit]), 0)
    # The minimum over all s of f(s) + L |t - s| is taken at a key s, or at s = t.
    cones = line[1] + limit * np.abs(FINE[:, None] - line[0])
    expected = np.minimum(cones.min(axis=1), np.interp(FINE, *line))
    assert np.interp(FINE, *found) == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_steepest_above_is_the_least_that_keeps_the_slope(seed: int) -> None:
    rng = np.random.default_rng(seed)
    line, limit = random_line(rng), float(rng.uniform(0.3, 5))
    times, values = steepest_above(line, Axis(0, 10, 1), np.array([limit]), 0)
    cones = line[1] - limit * np.abs(FINE[:, None] - line[0])
    expected = np.maximum(cones.max(axis=1), np.interp(FINE, *line))
    # Outside the line there is nothing: the cones of its ends are cut at 0.
    assert np.interp(FINE, times, values) == pytest.approx(np.maximum(expected, 0), abs=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_hold_is_the_greatest_value_within_reach(seed: int) -> None:
    rng = np.random.default_rng(seed)
    line, by = random_line(rng), float(rng.uniform(0.01, 1))
    inside = np.abs(FINE[:, None] - line[0]) <= by
    peaks = np.where(inside, line[1], 0).max(axis=1)
    ends = np.maximum(np.interp(FINE - by, *line), np.interp(FINE + by, *line))
    found = np.interp(FINE, *hold(line, by))
    assert found == pytest.approx(np.maximum(peaks, ends), abs=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_prune_changes_nothing(seed: int) -> None:
    rng = np.random.default_rng(seed)
    line = random_line(rng)
    dense = combine(line, (FINE, np.interp(FINE, *line)))
    pruned = prune(dense)
    assert len(pruned[0]) < 0.75 * len(dense[0])
    assert np.interp(FINE, *pruned) == pytest.approx(np.interp(FINE, *line), abs=1e-9)


def test_maxima_are_peaks_and_plateaus_but_not_steps() -> None:
    values = np.array([0, 1, 0.5, 0.5, 0.2, 0.8, 0.8, 0.8, 0, 0.3, 0.3, 0.6])
    firsts, lasts = maxima(values)
    assert firsts.tolist() == [1, 5]
    assert lasts.tolist() == [1, 7]


def test_blocks_with_different_limits_do_not_touch() -> None:
    times = np.array([0, 1.0, 2, 10, 11, 12, 19])
    values = np.array([0, 1.0, 0, 0, 1, 0, 0])
    limits = np.array([0.5, 0.25])
    found = steepest_below((times, values), Axis(0, 10, 2), limits, 0)
    assert np.interp([1, 11], *found) == pytest.approx([0.5, 0.25])
