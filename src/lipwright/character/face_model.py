"""The face model of the publications: expressions as moves of clusters of vertices.

Each vertex of a cluster has a translation of its own and a rotation of its own about the
cluster's axis, both scaled by an intensity 0..1; expressions are mixed and scaled
(DESIGN 7). At a fixed intensity a mixture is a displacement per vertex: a morph target.

A linear target draws a rotation's arc as its chord; :func:`flattening` says how far off
it is. This module knows no particular face.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_NO_TURN = (1.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class Move:
    """How one cluster moves at intensity 1.

    Parameters
    ----------
    translation : (V, 3) float64, metres
        Each vertex's own; zero outside the cluster.
    turn : (V,) float64, radians, optional
        Each vertex's own angle about the axis.
    axis, pivot : tuple of 3 float
        The rotation's direction (unit length) and a point on it.
    """

    translation: Floats
    turn: Floats | None = None
    axis: tuple[float, float, float] = _NO_TURN
    pivot: tuple[float, float, float] = (0.0, 0.0, 0.0)


def displacement(positions: Floats, moves: Iterable[Move], intensity: float = 1.0) -> Floats:
    """Return how far each vertex is moved: (V, 3), metres.

    Parameters
    ----------
    positions : (V, 3) float64, metres
        The neutral face.
    moves : iterable of Move
        An expression; its clusters' moves are added.
    intensity : float
        0 (neutral) .. 1.
    """
    total = np.zeros_like(positions)
    for move in moves:
        total += intensity * move.translation
        if move.turn is not None:
            total += _turned(positions, move, move.turn, intensity)
    return total


def mixture(expressions: Iterable[tuple[float, Sequence[Move]]], positions: Floats) -> Floats:
    """Return the displacement of expressions mixed by their intensities: (V, 3), metres."""
    total = np.zeros_like(positions)
    for intensity, moves in expressions:
        total += displacement(positions, moves, intensity)
    return total


def flattening(positions: Floats, moves: Sequence[Move], intensity: float = 0.5) -> float:
    """Return the greatest distance between a linear target and the true expression (metres)."""
    linear = intensity * displacement(positions, moves)
    true = displacement(positions, moves, intensity)
    return float(np.linalg.norm(linear - true, axis=1).max())


def _turned(positions: Floats, move: Move, turn: Floats, intensity: float) -> Floats:
    """Return the displacement of the rotation alone (Rodrigues' formula)."""
    total = np.zeros_like(positions)
    turning = np.flatnonzero(turn)
    angle = (intensity * turn[turning])[:, None]
    axis = np.array(move.axis)
    cross = np.cross(axis, np.eye(3))  # rows times this: axis x row
    across = (positions[turning] - move.pivot) @ cross
    total[turning] = across * np.sin(angle) + (across @ cross) * (1.0 - np.cos(angle))
    return total
