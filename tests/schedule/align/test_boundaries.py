"""Boundaries found in the sound, and how their network is learnt."""

import numpy as np
import pytest
from tools.boundaries.learn import Examples, learnt
from tools.boundaries.lines import Request, speak_all
from tools.boundaries.worsen import worsened

from lipwright.phones import load_phone_set
from lipwright.schedule.align.bands import BANDS, CONTEXT, bands, contexts
from lipwright.schedule.align.boundaries import DATA, as_bytes, load_network, located


def noise(seconds: float) -> np.ndarray[tuple[int], np.dtype[np.float32]]:
    return np.random.default_rng(0).normal(0, 0.1, int(seconds * 16000)).astype(np.float32)


def test_bands_hear_when_a_sound_begins() -> None:
    samples = noise(1.0)
    samples[:8000] *= 0.01
    level = bands(samples).mean(axis=1)
    assert level.shape == (200,)
    assert np.abs(np.diff(level)).argmax() == pytest.approx(99, abs=2)


def test_bands_do_not_hear_the_gain() -> None:
    np.testing.assert_allclose(bands(noise(0.5)), bands(0.1 * noise(0.5)), atol=1e-3)


def test_the_context_is_before_and_after_the_instant() -> None:
    frames = np.zeros((40, BANDS), np.float32)
    frames[20:] = 1.0
    around = contexts(frames)
    assert around.shape == (41, CONTEXT)
    halves = around[20].reshape(2, -1)
    assert (halves[0] == 0).all()
    assert (halves[1] == 1).all()


def test_digital_silence_moves_boundaries_no_further_than_its_reach() -> None:
    edges = np.array([0.01, 0.3, 0.49])
    moved = located(["sil", "ah", "m", "sil"], edges, np.zeros(8000, np.float32))
    assert np.abs(moved - edges).max() < 0.055


@pytest.mark.parametrize("error", [-0.025, 0.025])
def test_boundaries_that_are_off_are_put_right(error: float) -> None:
    line = speak_all([Request("She saw seven fish in the soup.", "en-us", 170.0, None)])[0]
    samples, faster = worsened(line.samples, line.rate, np.random.default_rng(7))
    off = [
        located([before, after], np.array([time / faster + error]), samples)[0] - time / faster
        for before, after, time in line.boundaries
    ]
    assert len(off) > 15
    assert np.median(np.abs(off)) < 0.4 * abs(error)


def examples(count: int) -> Examples:
    """Boundaries that lie where the first value of the sound jumps."""
    rng = np.random.default_rng(0)
    at = rng.integers(0, 5, count)
    around = rng.normal(0, 0.1, (count, 5, 3)).astype(np.float32)
    around[np.arange(count), at, 0] += 1.0
    target = np.eye(5, dtype=np.float32)[at]
    return Examples(around, rng.integers(0, 2, count), rng.integers(0, 2, count), target)


def test_learning_finds_what_marks_a_boundary_and_repeats_itself() -> None:
    found = examples(600)
    network, again = (
        learnt(("a", "b"), found, np.random.default_rng(1), widths=(8, 4), rounds=100)
        for _ in range(2)
    )
    scores = network.scores(found.around @ network.sound, found.left, found.right)
    assert np.mean(scores.argmax(axis=1) == found.target.argmax(axis=1)) > 0.95
    assert as_bytes(network) == as_bytes(again)


def test_the_network_knows_every_phone_and_is_small() -> None:
    network = load_network()
    assert set(network.phones) == set(load_phone_set("arpabet").labels) - {"ax"}
    assert DATA.stat().st_size < 100_000
