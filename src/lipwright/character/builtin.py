"""From the parts of a built-in character to a glTF model.

One node and mesh per part under a root node, smooth normals (each triangle counts by its
area), morph targets with displacements of positions and normals, stored sparse where few
vertices move. What the parts are, their makers know.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.character.mesh import Material, Part
from lipwright.gltf import TRIANGLES, VERTICES, Gltf, GltfWriter

Floats = NDArray[np.float32]
Doubles = NDArray[np.float64]

_STILL = 1e-6
"""A vertex that moves by less is still, in metres."""
_UNTURNED = 2e-3
"""A normal that turns by less is left, in radians."""


def to_glb(parts: Sequence[Part], name: str, keep: Collection[str] | None = None) -> bytes:
    """Return parts as the bytes of a GLB file; see :func:`to_gltf`."""
    return to_gltf(parts, name, keep).to_glb()


def to_gltf(parts: Sequence[Part], name: str, keep: Collection[str] | None = None) -> Gltf:
    """Return parts as a glTF model.

    Parameters
    ----------
    parts : sequence of Part
        The surfaces, in metres.
    name : str
        The name of the root node.
    keep : collection of str, optional
        The morph targets to keep; None keeps all.

    Returns
    -------
    Gltf
        The model; the names of morph targets are in ``extras.targetNames`` of each mesh.
    """
    writer = GltfWriter()
    materials: dict[Material, int] = {}
    nodes = []
    for part in parts:
        if part.material not in materials:
            materials[part.material] = writer.add("materials", _material(part.material))
        mesh = writer.add("meshes", _mesh(writer, part, materials[part.material], keep))
        nodes.append(writer.add("nodes", {"name": part.name, "mesh": mesh}))
    root = writer.add("nodes", {"name": name, "children": nodes})
    writer.json["scene"] = writer.add("scenes", {"name": name, "nodes": [root]})
    return writer.finish()


def _material(material: Material) -> dict[str, Any]:
    surface = {
        "baseColorFactor": [float(value) for value in material.color],
        "metallicFactor": float(material.metallic),
        "roughnessFactor": float(material.roughness),
    }
    made: dict[str, Any] = {"name": material.name, "pbrMetallicRoughness": surface}
    if material.double_sided:
        made["doubleSided"] = True
    if material.color[3] < 1:
        made["alphaMode"] = "BLEND"
    return made


def _mesh(
    writer: GltfWriter, part: Part, material: int, keep: Collection[str] | None
) -> dict[str, Any]:
    shading = _Shading.of(part.positions, part.triangles)
    attributes = {
        "POSITION": writer.accessor(part.positions, limits=True, target=VERTICES),
        "NORMAL": writer.accessor(shading.normals, target=VERTICES),
    }
    if part.colors is not None:
        attributes["COLOR_0"] = writer.accessor(part.colors.astype(np.float32), target=VERTICES)
    index = np.uint16 if len(part.positions) < 1 << 16 else np.uint32
    triangles = part.triangles.astype(index).ravel()
    primitive: dict[str, Any] = {
        "attributes": attributes,
        "indices": writer.accessor(triangles, target=TRIANGLES),
        "material": material,
    }
    mesh: dict[str, Any] = {"name": part.name, "primitives": [primitive]}
    names = [name for name in part.morphs if keep is None or name in keep]
    if names:
        primitive["targets"] = [_target(writer, part.morphs[name], shading) for name in names]
        mesh["weights"] = [0] * len(names)
        mesh["extras"] = {"targetNames": names}
    return mesh


def _target(writer: GltfWriter, moves: Floats, shading: _Shading) -> dict[str, int]:
    moving = _length(moves) >= _STILL
    moves = np.where(moving[:, None], moves, np.float32(0))
    return {
        "POSITION": writer.sparse(moves, limits=True, target=VERTICES),
        "NORMAL": writer.sparse(shading.turns(moves, moving), target=VERTICES),
    }


@dataclass(frozen=True, slots=True, eq=False)
class _Shading:
    """Smooth normals of a part at rest, and what is needed to bring them up to date."""

    positions: Floats
    triangles: NDArray[np.uint32]
    faces: Doubles
    sums: Doubles
    normals: Floats

    @classmethod
    def of(cls, positions: Floats, triangles: NDArray[np.uint32]) -> _Shading:
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
        turns[_length(turns) < _UNTURNED] = 0
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
    lengths = _length(vectors)
    flat = lengths < 1e-20
    unit = vectors / np.where(flat, 1.0, lengths)[:, None]
    unit[flat] = (0.0, 0.0, 1.0)
    return unit.astype(np.float32)


def _length(vectors: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
    x, y, z = vectors.T
    length: NDArray[np.floating[Any]] = np.sqrt(x * x + y * y + z * z)
    return length
