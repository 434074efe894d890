"""Smooth normals of a surface, and how they turn when its vertices move.

Each triangle counts by its area. Vertices are shared where triangles share their numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Doubles = NDArray[np.float64]

_UNTURNED = 2e-3
"""A normal that turns by less is left, in radians."""


@dataclass(frozen=True, slots=True, eq=False)
class Shading:
    """Smooth normals of a part at rest, and what is needed to bring them up to date.

    Parameters
    ----------
    positions : (V, 3) float32, metres
    triangles : (F, 3) uint32
    faces : (F, 3) float64
        The normal of each triangle, as long as twice its area.
    sums : (V, 3) float64
        Of the normals of a vertex's triangles.
    normals : (V, 3) float32
        Of unit length.
    """

    positions: Floats
    triangles: NDArray[np.uint32]
    faces: Doubles
    sums: Doubles
    normals: Floats

    @classmethod
    def of(cls, positions: Floats, triangles: NDArray[np.uint32]) -> Shading:
        """Return the shading of a surface at rest."""
        faces = _faces(positions, triangles)
        sums = _gather(triangles, faces, len(positions))
        return cls(positions, triangles, faces, sums, _unit(sums))

    def turns(self, moves: Floats, moving: NDArray[np.bool_]) -> Floats:
        """Return how the normals change when vertices move, (V, 3)."""
        a, b, c = moving[self.triangles].T
        touched = a | b | c
        triangles = self.triangles[touched]
        change = _faces(self.positions + moves, triangles) - self.faces[touched]
        sums = self.sums + _gather(triangles, change, len(moves))
        turns = _unit(sums) - self.normals
        turns[length(turns) < _UNTURNED] = 0
        return turns


def _faces(positions: Floats, triangles: NDArray[np.uint32]) -> Doubles:
    """Return the normal of each triangle, (F, 3), as long as twice its area."""
    a, b, c = (positions.astype(np.float64)[corner] for corner in triangles.T)
    (ax, ay, az), (bx, by, bz) = (b - a).T, (c - a).T
    return np.stack((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx), axis=1)


def _gather(triangles: NDArray[np.uint32], faces: Doubles, count: int) -> Doubles:
    """Sum over each vertex what its triangles bring: larger ones count for more."""
    corners = triangles.T.ravel()
    columns = [np.bincount(corners, np.tile(face, 3), count) for face in faces.T]
    return np.stack(columns, axis=1)


def _unit(vectors: Doubles) -> Floats:
    lengths = length(vectors)
    flat = lengths < 1e-20
    unit = vectors / np.where(flat, 1.0, lengths)[:, None]
    unit[flat] = (0.0, 0.0, 1.0)
    return unit.astype(np.float32)


def length(vectors: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
    """Return the length of each row, (V,)."""
    x, y, z = vectors.T
    length: NDArray[np.floating[Any]] = np.sqrt(x * x + y * y + z * z)
    return length
