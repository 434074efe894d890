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
    shading = _Shading.of(part.triangles, len(part.positions))
    normals = shading.normals(part.positions)
    attributes = {
        "POSITION": writer.accessor(part.positions, limits=True, target=VERTICES),
        "NORMAL": writer.accessor(normals, target=VERTICES),
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
    mesh = {"name": part.name, "primitives": [primitive]}
    names = [name for name in part.morphs if keep is None or name in keep]
    if names:
        primitive["targets"] = [
            _target(writer, part.positions, part.morphs[name], normals, shading) for name in names
        ]
        mesh["weights"] = [0] * len(names)
        mesh["extras"] = {"targetNames": names}
    return mesh


def _target(
    writer: GltfWriter, positions: Floats, moves: Floats, normals: Floats, shading: _Shading
) -> dict[str, int]:
    moves = np.where(np.abs(moves).max(axis=1, keepdims=True) < _STILL, np.float32(0), moves)
    turns = shading.normals(positions + moves) - normals
    turns[np.abs(turns).max(axis=1) < _UNTURNED] = 0
    return {
        "POSITION": writer.sparse(moves.astype(np.float32), limits=True),
        "NORMAL": writer.sparse(turns),
    }


@dataclass(frozen=True, slots=True, eq=False)
class _Shading:
    """Which triangles meet at each vertex, sorted once for all morph targets."""

    triangles: NDArray[np.uint32]
    meeting: NDArray[np.intp]
    starts: NDArray[np.intp]
    used: NDArray[np.intp]
    count: int

    @classmethod
    def of(cls, triangles: NDArray[np.uint32], count: int) -> _Shading:
        corners = triangles.ravel()
        order = np.argsort(corners, kind="stable")
        used, starts = np.unique(corners[order], return_index=True)
        return cls(triangles, order // 3, starts, used, count)

    def normals(self, positions: Floats) -> Floats:
        """Return smooth normals, (V, 3) of length 1."""
        a, b, c = (positions[self.triangles[:, corner]] for corner in range(3))
        # The cross product's length is twice the area: larger triangles count for more.
        faces = _cross(b - a, c - a)
        sums = np.zeros((self.count, 3))
        if len(self.used):
            sums[self.used] = np.add.reduceat(faces[self.meeting], self.starts, axis=0)
        lengths = np.linalg.norm(sums, axis=1)
        flat = lengths < 1e-20
        sums[flat], lengths[flat] = (0.0, 0.0, 1.0), 1.0
        return (sums / lengths[:, None]).astype(np.float32)


def _cross(a: Floats, b: Floats) -> NDArray[np.float64]:
    (ax, ay, az), (bx, by, bz) = a.T.astype(np.float64), b.T.astype(np.float64)
    return np.stack((ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx), axis=1)
