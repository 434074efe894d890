"""The face model: clusters that move and turn, mixed and scaled."""

from __future__ import annotations

import numpy as np
import pytest

from lipwright.character.face_model import Move, displacement, flattening, mixture

POINTS = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [0.3, -0.2, 0.5]])
STILL = np.zeros((3, 3))
QUARTER = Move(STILL, np.array([np.pi / 2, 0.0, np.pi / 2]), axis=(1.0, 0.0, 0.0))


def test_each_vertex_turns_by_its_own_angle() -> None:
    moved = POINTS + displacement(POINTS, [QUARTER])
    expected = np.array([[0.0, -1.0, 0.0], [0.0, 0.0, 2.0], [0.3, -0.5, -0.2]])
    np.testing.assert_allclose(moved, expected, atol=1e-12)


def test_a_turn_keeps_the_distance_to_its_axis() -> None:
    axis, pivot = np.array([0.6, 0.0, 0.8]), (0.1, 0.2, 0.3)
    turn = Move(STILL, np.array([0.4, 1.0, -2.0]), axis=(0.6, 0.0, 0.8), pivot=pivot)
    before = POINTS - pivot
    after = before + displacement(POINTS, [turn])
    np.testing.assert_allclose(after @ axis, before @ axis, atol=1e-12)
    np.testing.assert_allclose(
        np.linalg.norm(after, axis=1), np.linalg.norm(before, axis=1), atol=1e-12
    )


@pytest.mark.parametrize("intensity", [0.0, 0.25, 1.0])
def test_intensity_scales_translation_and_angle(intensity: float) -> None:
    move = Move(np.full((3, 3), 0.2), np.array([1.0, 0.5, 0.0]), axis=(0.0, 1.0, 0.0))
    scaled = Move(intensity * move.translation, intensity * np.array([1.0, 0.5, 0.0]), move.axis)
    np.testing.assert_allclose(
        displacement(POINTS, [move], intensity), displacement(POINTS, [scaled]), atol=1e-15
    )


def test_expressions_are_mixed_by_adding() -> None:
    shifted = [Move(np.full((3, 3), 0.1))]
    mixed = mixture([(0.5, [QUARTER]), (2.0, shifted)], POINTS)
    apart = displacement(POINTS, [QUARTER], 0.5) + 0.2
    np.testing.assert_allclose(mixed, apart, atol=1e-15)


def test_flattening_is_the_sagitta_of_the_arc() -> None:
    arc = Move(STILL, np.array([np.pi / 2, 0.0, 0.0]))
    assert flattening(POINTS, [arc]) == pytest.approx(1.0 - np.sqrt(0.5))
    assert flattening(POINTS, [Move(np.ones((3, 3)))]) == 0.0
