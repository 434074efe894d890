"""From the parts of a built-in character to a glTF model.

One node and mesh per part under a root node, smooth normals (each triangle counts by its
area), morph targets with displacements of positions and normals, stored sparse where few
vertices move. What the parts are, their makers know.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.character.mesh import Material, Part
from lipwright.character.shading import Shading, length
from lipwright.gltf import TRIANGLES, VERTICES, Gltf, GltfWriter

Floats = NDArray[np.float32]

_STILL = 1e-6
"""A vertex that moves by less is still, in metres."""


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
    shading = Shading.of(part.positions, part.triangles)
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


def _target(writer: GltfWriter, moves: Floats, shading: Shading) -> dict[str, int]:
    moving = length(moves) >= _STILL
    moves = np.where(moving[:, None], moves, np.float32(0))
    return {
        "POSITION": writer.sparse(moves, limits=True, target=VERTICES),
        "NORMAL": writer.sparse(shading.turns(moves, moving), target=VERTICES),
    }
