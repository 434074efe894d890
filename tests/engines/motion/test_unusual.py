"""What is usual for a phone between its neighbours, and what is not."""

from __future__ import annotations

import numpy as np

from lipwright.engines.motion.unusual import POINTS, unusual


def points(levels: list[float]) -> np.ndarray:
    """Units whose motion stands still at some levels."""
    return np.repeat(np.array(levels)[:, None, None], POINTS, axis=1)


def test_the_one_that_moves_otherwise_is_unusual() -> None:
    found = unusual(points([0.2] * 9 + [0.8]), np.zeros(10, int), np.arange(10))
    assert found.argmax() == 9
    assert found[9] > 5 * found[0]


def test_what_is_usual_depends_on_the_neighbours() -> None:
    # The phone 1 stands at 0 after 0 and at 1 after 2: neither is unusual there.
    labels = np.tile([0, 1, 2, 1], 50)
    takes = np.repeat(np.arange(100), 2)
    moves = points([0.5, 0.0, 0.5, 1.0] * 50)
    assert unusual(moves, labels, takes).max() < 0.2
    apart = unusual(moves, labels, np.arange(200))  # without neighbours both are
    assert apart[1::2].min() > 0.4


def test_a_lone_unit_is_as_usual_as_can_be_said() -> None:
    found = unusual(points([0.3]), np.zeros(1, int), np.zeros(1, int))
    assert found.tolist() == [0.0]
