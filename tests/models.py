"""Small models for tests: a square with morph targets, as GLB, and what may be added to it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from lipwright.character.builtin import to_gltf
from lipwright.character.mesh import Material, Part
from lipwright.gltf import Gltf

SKIN = Material("Skin", (0.8, 0.6, 0.5, 1.0))


def square(name: str, targets: Sequence[str], size: int = 6) -> Part:
    """Return a flat sheet of ``size`` by ``size`` vertices; each target lifts one of them."""
    across = np.linspace(-0.05, 0.05, size, dtype=np.float32)
    x, y = np.meshgrid(across, across)
    positions = np.stack((x, y, np.zeros_like(x)), axis=-1).reshape(-1, 3)
    numbers = np.arange(size * size).reshape(size, size)
    a, b, c, d = numbers[:-1, :-1], numbers[:-1, 1:], numbers[1:, 1:], numbers[1:, :-1]
    triangles = np.stack((a, b, c, a, c, d), axis=-1).reshape(-1, 3).astype(np.uint32)
    morphs = {}
    for index, target in enumerate(targets):
        moves = np.zeros_like(positions)
        moves[index % len(moves)] = (0, 0, 0.01)
        morphs[target] = moves
    return Part(name, positions, triangles, SKIN, morphs, None)


def model(targets: Sequence[str] = ("jawOpen", "mouthPucker"), **changes: Any) -> Gltf:
    """Return a model of one square, with parts of its document replaced."""
    made = to_gltf([square("Face", targets)], "Head")
    return Gltf({**made.json, **changes}, made.binary, "face.glb")
