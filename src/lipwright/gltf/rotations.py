"""Rotations of nodes: quaternions x, y, z, w, as glTF stores them (section 3.5.3).

A node that is placed by a matrix must not be animated (section 3.11): it is given its
translation, rotation and scale instead. Shear, which these cannot say, is lost.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def rest_rotation(node: dict[str, Any]) -> tuple[float, float, float, float]:
    """Return a node's rotation at rest; where it has a matrix, replace that by its parts."""
    if "matrix" in node:
        _split(node)
    x, y, z, w = map(float, node.get("rotation", (0.0, 0.0, 0.0, 1.0)))
    return x, y, z, w


def after_rest(rest: Floats, vectors: Floats) -> Floats:
    """Return the rotations (T, 4) that turn a node, within its own space, away from rest.

    Parameters
    ----------
    rest : (4,) float64
        The quaternion at rest.
    vectors : (T, 3) float64, radians
        Axis times angle of each turn.
    """
    angles = np.linalg.norm(vectors, axis=1)
    # sin(a / 2) / a, which is 1 / 2 at no angle.
    share = 0.5 * np.sinc(angles / (2 * np.pi))
    turn, w = vectors * share[:, None], np.cos(angles / 2)
    own, last = rest[:3], rest[3]
    made = np.empty((len(vectors), 4))
    made[:, :3] = last * turn + w[:, None] * own + np.cross(own, turn)
    made[:, 3] = last * w - turn @ own
    unit: Floats = made / np.linalg.norm(made, axis=1, keepdims=True)
    return unit


def _split(node: dict[str, Any]) -> None:
    matrix = np.array(node.pop("matrix"), np.float64).reshape(4, 4).T
    scale = np.linalg.norm(matrix[:3, :3], axis=0)
    scale[2] *= np.sign(np.linalg.det(matrix[:3, :3])) or 1.0
    axes = matrix[:3, :3] / np.where(scale == 0, 1.0, scale)
    node["translation"] = matrix[:3, 3].tolist()
    node["rotation"] = _quaternion(axes).tolist()
    node["scale"] = scale.tolist()


def _quaternion(axes: Floats) -> Floats:
    """Return the quaternion of a rotation matrix: the greatest eigenvector of Bar-Itzhack."""
    (a, b, c), (d, e, f), (g, h, i) = axes
    table = np.array(
        [
            [a - e - i, b + d, c + g, h - f],
            [b + d, e - a - i, f + h, c - g],
            [c + g, f + h, i - a - e, d - b],
            [h - f, c - g, d - b, a + e + i],
        ]
    )
    found = np.linalg.eigh(table)[1][:, -1]
    unit: Floats = found * (np.sign(found[3]) or 1.0)
    return unit
