"""A mesh follows its markers: they are met, the lips part, what is far stays."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.engines.motion.skin import Skin, bind_skin, interpolation, mouth_sides
from tests.character.sheets import HALF, sheet

FACE = sheet({}, columns=41)
POINTS = FACE.positions.astype(np.float64)
TRIANGLES = FACE.triangles.astype(np.intp)
UPPER = np.arange(len(POINTS)) < len(POINTS) // 2
ON_LINE = np.abs(POINTS[:, 1]) < 1e-9
BETWEEN = np.abs(POINTS[:, 0]) < HALF - 1e-6


def one_sheet() -> tuple[np.ndarray, np.ndarray]:
    """The sheet's points with those beside the slit welded, and each vertex's point."""
    kept = np.where(ON_LINE & ~BETWEEN, 0, UPPER + 1)
    keys = np.column_stack([np.round(POINTS, 7), kept])
    _, first, place = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    return first, place.reshape(-1)


FIRST, PLACE = one_sheet()
SIDES = mouth_sides(
    POINTS[FIRST],
    PLACE[TRIANGLES],
    PLACE[np.flatnonzero(ON_LINE & BETWEEN & UPPER)],
    PLACE[np.flatnonzero(ON_LINE & BETWEEN & ~UPPER)],
)[PLACE]


def nearest(x: float, y: float, upper: bool) -> int:
    rows = np.flatnonzero(upper == UPPER)
    return int(rows[np.argmin(np.abs(POINTS[rows, :2] - (x, y)).sum(axis=1))])


MARKERS = [nearest(x, 0.005, True) for x in (-0.015, 0.0, 0.015)]
MARKERS += [nearest(x, -0.005, False) for x in (-0.015, 0.0, 0.015)]
MARKERS += [nearest(x, 0.0, True) for x in (-0.0275, 0.0275)]
MARKERS += [nearest(x, 0.02, True) for x in (-0.02, 0.02)]
MARKERS += [nearest(x, -0.02, False) for x in (-0.02, 0.02)]


@pytest.fixture(scope="module")
def skin() -> Skin:
    return bind_skin(POINTS, SIDES, POINTS[MARKERS], SIDES[MARKERS])


def test_sides_part_at_the_lips_and_meet_beside_the_mouth() -> None:
    lips = ON_LINE & (np.abs(POINTS[:, 0]) < 0.9 * HALF)
    assert (SIDES[lips & UPPER] == 1).all()
    assert (SIDES[lips & ~UPPER] == 0).all()
    beside = ON_LINE & (np.abs(POINTS[:, 0]) > 1.3 * HALF)
    assert SIDES[beside] == pytest.approx(0.5, abs=0.02)
    line = [SIDES[nearest(1.5 * HALF, y, y > 0)] for y in np.linspace(-0.02, 0.02, 9)]
    assert (np.diff(line) >= -1e-9).all()


@given(st.integers(0, 2**32 - 1))
def test_markers_are_met(skin: Skin, seed: int) -> None:
    moves = np.random.default_rng(seed).normal(scale=0.01, size=(len(MARKERS), 3))
    assert skin.moved(moves)[MARKERS] == pytest.approx(moves, abs=1e-5)


def test_no_lip_follows_the_markers_of_the_other(skin: Skin) -> None:
    upper, lower = SIDES[MARKERS] == 1, SIDES[MARKERS] == 0
    assert upper.sum() >= 3
    assert lower.sum() >= 3
    assert (skin.weights[np.ix_(SIDES == 1, lower)] == 0).all()
    assert (skin.weights[np.ix_(SIDES == 0, upper)] == 0).all()
    drop = np.where(lower[:, None], (0.0, -0.01, 0.0), 0.0)
    moved = skin.moved(drop)
    middle = ON_LINE & (np.abs(POINTS[:, 0]) < 0.5 * HALF)
    assert (moved[middle & UPPER] == 0).all()
    assert (moved[middle & ~UPPER, 1] < -0.007).all()


def test_skin_between_markers_that_move_alike_moves_like_them(skin: Skin) -> None:
    near = np.abs(POINTS[:, :2]).max(axis=1) < 0.02
    moved = skin.moved(np.tile((0.001, 0.002, -0.003), (len(MARKERS), 1)))
    assert moved[near] == pytest.approx(np.tile((0.001, 0.002, -0.003), (near.sum(), 1)), abs=1e-6)


def test_the_edge_of_a_lip_moves_as_the_markers_beside_it() -> None:
    line = POINTS[ON_LINE & UPPER & (np.abs(POINTS[:, 0]) < HALF)]
    skin = bind_skin(POINTS, SIDES, POINTS[MARKERS], SIDES[MARKERS], line)
    lower = np.flatnonzero(SIDES[MARKERS] == 0)
    moves = np.zeros((len(MARKERS), 3))
    moves[lower] = (0.0, -0.01, 0.0)
    assert skin.moved(moves)[MARKERS] == pytest.approx(moves, abs=1e-5)
    edge = ON_LINE & ~UPPER & (np.abs(POINTS[:, 0]) < 0.5 * HALF)
    assert skin.moved(moves)[edge, 1] == pytest.approx(-0.01, abs=0.001)
    assert (skin.weights[np.ix_(SIDES == 1, lower)] == 0).all()


def test_what_is_far_does_not_move() -> None:
    away = np.concatenate([POINTS, POINTS - (0.0, 0.0, 0.4)])
    sides = np.concatenate([SIDES, np.full(len(POINTS), 0.5)])
    weights = bind_skin(away, sides, POINTS[MARKERS], SIDES[MARKERS]).weights
    assert (weights[len(POINTS) :] == 0).all()


def test_targets_add_up_to_what_markers_do(skin: Skin) -> None:
    rng = np.random.default_rng(1)
    basis, amounts = rng.normal(size=(4, len(MARKERS), 3)), rng.normal(size=4)
    whole = np.tensordot(amounts, skin.targets(basis), 1)
    assert whole == pytest.approx(skin.moved(np.tensordot(amounts, basis, 1)), abs=1e-5)


def test_two_markers_at_one_place_share_it() -> None:
    markers = POINTS[[*MARKERS, MARKERS[0]]]
    weights = interpolation(POINTS, markers)
    assert np.isfinite(weights).all()
    assert weights[MARKERS[0], [0, -1]] == pytest.approx(0.5, abs=1e-3)
