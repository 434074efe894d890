"""A face that is a bent sheet with a slit for a mouth: its lips, corners and width are known."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.character.builtin import to_gltf
from lipwright.character.mesh import Material, Part
from lipwright.character.skeleton import world_matrices
from lipwright.gltf import Gltf, GltfWriter

Doubles = NDArray[np.float64]
Moves = Mapping[str, Callable[[Doubles, Doubles], Doubles]]

HALF = 0.025
"""Half the mouth's width."""
SKIN = Material("Skin", (0.8, 0.6, 0.5, 1.0))


def slit(points: Doubles) -> Doubles:
    """Return how much of a lip is free to move, 0 at the corners and 1 in the middle."""
    return np.sqrt(np.clip(1.0 - (points[:, 0] / HALF) ** 2, 0.0, 1.0))


def dropped(by: float) -> Callable[[Doubles, Doubles], Doubles]:
    """The lower lip goes down by so much in the middle."""
    return lambda points, upper: np.outer((1 - upper) * slit(points), (0.0, -by, 0.0))


def met(by: float) -> Callable[[Doubles, Doubles], Doubles]:
    """The lips go towards each other, each by so much."""
    return lambda points, upper: np.outer((1 - 2 * upper) * slit(points), (0.0, by, 0.0))


def widened(share: float) -> Callable[[Doubles, Doubles], Doubles]:
    """Everything goes outwards by a share of how far out it is."""
    return lambda points, upper: points * (share, 0.0, 0.0)


def sheet(moves: Moves, gap: float = 0.0, size: float = 1.0, columns: int = 41) -> Part:
    """Return the face, looking along +z; ``gap`` is between the lips at rest, in metres."""
    across = np.linspace(-2 * HALF, 2 * HALF, columns)
    down = np.linspace(0.0, 0.04, 9)
    halves = []
    for sign in (1.0, -1.0):
        x, y = np.meshgrid(across, sign * down)
        halves.append(np.stack((x, y, 0.02 - 8 * x**2), axis=-1).reshape(-1, 3))
    points = np.concatenate(halves)
    upper = np.repeat((1.0, 0.0), len(halves[0]))
    points[:, 1] += np.where(upper > 0, 0.5, -0.5) * gap * slit(points)
    numbers = np.arange(len(points)).reshape(2, len(down), columns)
    rows = []
    for half, grid in enumerate(numbers):
        a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
        corners = (a, d, c, a, c, b) if half else (a, b, c, a, c, d)
        rows.append(np.stack(corners, axis=-1).reshape(-1, 3))
    morphs = {name: (size * move(points, upper)).astype(np.float32) for name, move in moves.items()}
    triangles = np.concatenate(rows).astype(np.uint32)
    return Part("Face", (size * points).astype(np.float32), triangles, SKIN, morphs, None)


def face(moves: Moves, **how: Any) -> Gltf:
    """Return the model of a :func:`sheet`."""
    return to_gltf([sheet(moves, **how)], "Head")


def jawed(
    moves: Moves, joint: Mapping[str, Any] | None = None, name: str = "Jaw", facing: float = 1.0
) -> Gltf:
    """Return a face whose lower lip hangs on a jaw joint, 9 cm behind the lips.

    Parameters
    ----------
    moves : mapping
        Morph targets beside the jaw.
    joint : mapping, optional
        How the joint stands: its glTF properties, in place of its translation.
    name : str
        The joint's name.
    facing : float
        1 looks along +z, -1 along -z.
    """
    part = sheet(moves)
    turn = np.array((facing, 1.0, facing), np.float32)
    morphs = {name: made * turn for name, made in part.morphs.items()}
    part = Part("Face", part.positions * turn, part.triangles, SKIN, morphs, None)
    base = to_gltf([part], "Head")
    writer = GltfWriter(base)
    points = sheet({}).positions.astype(np.float64)
    lower = np.arange(len(points)) >= len(points) // 2
    weight = np.where(lower, slit(points), 0.0).astype(np.float32)
    places = {"translation": [0.0, 0.02, -0.07 * facing], **(joint or {})}
    head = writer.add("nodes", {"name": "HeadBone"})
    jaw = writer.add("nodes", {"name": name, **places})
    writer.json["nodes"][head]["children"] = [jaw]
    # A skinned mesh is to stand at the root of its scene.
    writer.json["nodes"][1]["children"] = [head]
    writer.json["scenes"][0]["nodes"] = [0, 1]
    joints = np.zeros((len(points), 4), np.uint16)
    joints[:, 1] = weight > 0
    weights = np.stack((1 - weight, weight, 0 * weight, 0 * weight), axis=1).astype(np.float32)
    attributes = writer.json["meshes"][0]["primitives"][0]["attributes"]
    attributes["JOINTS_0"] = writer.accessor(joints, target=34962)
    attributes["WEIGHTS_0"] = writer.accessor(weights, target=34962)
    made = writer.finish()
    inverse = np.linalg.inv(world_matrices(made)[[head, jaw]])
    again = GltfWriter(made)
    columns = inverse.transpose(0, 2, 1).reshape(2, 16).astype(np.float32)
    columns[:, [3, 7, 11]], columns[:, 15] = 0, 1
    matrices = {"bufferView": again.view(columns.tobytes()), "componentType": 5126}
    bind = again.add("accessors", {**matrices, "count": 2, "type": "MAT4"})
    skin = again.add("skins", {"joints": [head, jaw], "inverseBindMatrices": bind})
    again.json["nodes"][0]["skin"] = skin
    return again.finish()
