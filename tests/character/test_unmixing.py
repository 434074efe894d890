"""Shapes told as poses: known mixtures come back, what cannot be seen is left out."""

from itertools import product

import numpy as np
import pytest

from lipwright.character.head import build_head, landmarks, measure
from lipwright.character.unmixing import nonnegative, unmixing
from lipwright.errors import CharacterError

POSES = ("open", "W", "ShCh", "PBM", "FV", "wide", "tBack", "tRoof", "tTeeth")


def test_what_the_tongue_does_is_not_seen() -> None:
    way = unmixing(("jawOpen", "mouthPucker", "eyeBlinkLeft", "headYaw"), POSES)
    assert way.poses == POSES[:6]
    assert way.channels == ("jawOpen", "mouthPucker")


def test_poses_as_channels_come_back_as_themselves() -> None:
    way = unmixing(POSES[:6], POSES)
    weights = np.random.default_rng(0).uniform(0, 0.8, (40, 6))
    weights[::3, 2:] = 0.0
    assert np.abs(way.weights(weights) - weights).max() < 0.03


def test_the_lips_look_the_same() -> None:
    names = ("jawOpen", "mouthPucker", "mouthStretchLeft", "mouthStretchRight")
    way, rng = unmixing(names, POSES), np.random.default_rng(1)
    values = rng.uniform(0, 0.5, (50, 4))
    values[:, 3] = values[:, 2]
    skin = [part for part in build_head() if part.name == "skin"]
    recorded = measure(skin, landmarks(), dict(zip(way.channels, values.T, strict=True)))
    told = measure(skin, landmarks(), dict(zip(way.poses, way.weights(values).T, strict=True)))
    assert np.corrcoef(recorded.opening, told.opening)[0, 1] > 0.95
    assert np.corrcoef(recorded.breadth, told.breadth)[0, 1] > 0.95


def test_least_squares_against_every_choice() -> None:
    """Slow and sure: each weight at 0, free, or at 1."""
    rng = np.random.default_rng(2)
    moves = rng.normal(size=(4, 9))
    squares, products = moves @ moves.T, rng.normal(size=(20, 4)) * 4
    found = nonnegative(squares, products)
    assert found.min() >= 0
    assert found.max() <= 1

    def cost(x: np.ndarray, b: np.ndarray) -> float:
        return float(0.5 * x @ squares @ x - b @ x)

    for b, x in zip(products, found, strict=True):
        best = np.inf
        for states in product((0, 1, None), repeat=4):
            free = np.array([state is None for state in states])
            y = np.array([float(state or 0) for state in states])
            if free.any():
                rest = b[free] - squares[np.ix_(free, ~free)] @ y[~free]
                y[free] = np.linalg.solve(squares[np.ix_(free, free)], rest)
            if y.min() >= 0 and y.max() <= 1:
                best = min(best, cost(y, b))
        assert cost(x, b) == pytest.approx(best, abs=1e-6)


@pytest.mark.parametrize(
    ("channels", "poses", "words"),
    [
        (("headYaw",), POSES, "none of the channels .headYaw. moves the head's lips"),
        (("jawOpen",), ("tRoof",), "none of the poses .tRoof. moves the head's lips"),
    ],
)
def test_nothing_in_common(channels: tuple[str, ...], poses: tuple[str, ...], words: str) -> None:
    with pytest.raises(CharacterError, match=words):
        unmixing(channels, poses)
