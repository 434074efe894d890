"""The curves through the keys: what each promises, against slow readings of it."""

import numpy as np
import pytest

from lipwright.engines.bigram.model import Pose
from lipwright.engines.bigram.polyline import Axis, Floats, Line
from lipwright.engines.bigram.softening import sample

PEAK: Line = (np.array([0, 1.0, 1.2, 1.4, 4]), np.array([0, 0, 1.0, 0, 0]))
AXIS = Axis(0, 4, 1)


def one(line: Line, kind: str, softness: float = 0.1, rate: float = 1000.0) -> Floats:
    values: Floats = sample(line, AXIS, (Pose("a", 1, softness=softness),), 0, 3900, rate, kind)[0]
    return values


def random_line(seed: int) -> Line:
    rng = np.random.default_rng(seed)
    times = np.concatenate(([0.0], np.sort(rng.uniform(0.3, 3.6, 14)), [4.0]))
    values = rng.uniform(0, 1, 16)
    values[[0, 1, -2, -1]] = 0
    return times, values


@pytest.mark.parametrize("seed", range(10))
def test_softening_is_convolution_with_a_triangle(seed: int) -> None:
    line = random_line(seed)
    half = 0.1
    offsets = np.linspace(-half, half, 4001)
    kernel = (half - np.abs(offsets)) / half**2 * (offsets[1] - offsets[0])
    times = np.arange(0, 3900, 50) / 1000
    expected = [np.sum(kernel * np.interp(t - offsets, *line)) for t in times]
    assert one(line, "soften")[::50] == pytest.approx(expected, abs=1e-5)


@pytest.mark.parametrize("seed", range(10))
def test_softening_keeps_range_and_slope(seed: int) -> None:
    line = random_line(seed)
    values = one(line, "soften")
    steepest = np.abs(np.diff(line[1]) / np.diff(line[0])).max()
    assert values.min() >= 0
    assert values.max() <= line[1].max()
    assert np.abs(np.diff(values)).max() * 1000 <= steepest + 1e-9


def test_a_bspline_takes_a_lone_peak_down_to_two_thirds() -> None:
    even: Line = (np.arange(0, 4.1, 0.2), np.zeros(21))
    even[1][6] = 1.0
    assert one(even, "bspline").max() == pytest.approx(2 / 3, abs=1e-6)


@pytest.mark.parametrize("seed", range(10))
def test_pchip_goes_through_the_keys_without_overshoot(seed: int) -> None:
    line = random_line(seed)
    on_grid: Line = (np.round(line[0], 3), line[1])
    values = one(on_grid, "pchip")
    assert values.max() <= line[1].max() + 1e-12
    assert values.min() >= -1e-12
    inside = on_grid[0] < 3.899
    indices = np.round(on_grid[0][inside] * 1000).astype(int)
    assert values[indices] == pytest.approx(line[1][inside], abs=1e-9)


def test_linear_is_the_keys() -> None:
    assert one(PEAK, "linear")[[1000, 1100, 1200, 1300]] == pytest.approx([0, 0.5, 1, 0.5])


def test_every_pose_has_its_own_softness() -> None:
    times = np.concatenate((PEAK[0][:-1], PEAK[0] + 4))
    both: Line = (times, np.concatenate((PEAK[1][:-1], PEAK[1])))
    poses = (Pose("a", 1, softness=0.0), Pose("b", 2, softness=0.1))
    values = sample(both, Axis(0, 4, 2), poses, 0, 3900, 1000.0, "soften")
    assert values[0].max() == pytest.approx(1)
    # The mean of a tent of slope 5 under a triangle of half-width 0.1: 1 - 5 * 0.1 / 3.
    assert values[1].max() == pytest.approx(1 - 5 * 0.1 / 3)
