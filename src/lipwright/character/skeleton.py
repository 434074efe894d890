"""The skeleton of a model: where its nodes stand at rest, and the joint that is its jaw.

A jaw is a joint of a skin (or a node with a mesh) by that name, or the one that a VRM file
calls so. How it must turn is found from the model: it opens about the axis from the head's
right to its left, through the joint, so that what it carries in front of it goes down.
glTF 2.0, sections 3.5 (nodes) and 3.7.3 (skins). It moves nothing itself.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.gltf import Gltf

Floats = NDArray[np.float64]

_JAW = re.compile(r"jaw|mandible|unterkiefer|kiefer", re.IGNORECASE)
_NO_JAW = re.compile(r"end$|nub$|tip$|target|ctrl|control|upper|[_. ](l|r|left|right)$", re.I)
_DEEPEST = 512


def parents(model: Gltf) -> dict[int, int]:
    """Return the parent of each node that has one."""
    return {
        child: index
        for index, node in enumerate(model.items("nodes"))
        for child in node.get("children", ())
    }


def world_matrices(model: Gltf) -> Floats:
    """Return where each node stands at rest, (N, 4, 4), from its own space to the world's."""
    nodes, above = model.items("nodes"), parents(model)
    local = [local_matrix(node) for node in nodes]
    found = np.tile(np.eye(4), (len(nodes), 1, 1))
    for index in range(len(nodes)):
        for step in path_up(index, above):
            found[index] = local[step] @ found[index]
    return found


def path_up(index: int, above: dict[int, int]) -> Iterator[int]:
    """Yield a node, its parent, and so on to the root; a circle ends where it closes."""
    seen: set[int] = set()
    while index not in seen and len(seen) < _DEEPEST:
        seen.add(index)
        yield index
        if index not in above:
            return
        index = above[index]


def below(model: Gltf, root: int) -> set[int]:
    """Return a node and all that hang on it."""
    above = parents(model)
    return {i for i in range(len(model.items("nodes"))) if root in path_up(i, above)}


def local_matrix(node: dict[str, Any]) -> Floats:
    """Return the transform of a node in its parent, (4, 4)."""
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    made = np.eye(4)
    made[:3, :3] = rotation_of(node.get("rotation", (0, 0, 0, 1))) * np.array(
        node.get("scale", (1, 1, 1)), np.float64
    )
    made[:3, 3] = node.get("translation", (0, 0, 0))
    return made


def rotation_of(quaternion: Any) -> Floats:
    """Return the rotation matrix of a quaternion x, y, z, w."""
    x, y, z, w = np.array(quaternion, np.float64) / (np.linalg.norm(quaternion) or 1.0)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def turned(points: Floats, axis: Floats, angle: float) -> Floats:
    """Return points (N, 3) turned about a direction of unit length by radians (Rodrigues)."""
    across = np.cross(axis, points)
    along = np.outer(points @ axis, axis)
    moved: Floats = points * np.cos(angle) + across * np.sin(angle) + along * (1 - np.cos(angle))
    return moved


def jaw_names(model: Gltf) -> tuple[str, ...]:
    """Return the names of all joints that look like a jaw."""
    nodes = model.items("nodes")
    return tuple(dict.fromkeys(str(nodes[i].get("name", f"node {i}")) for i in _candidates(model)))


def find_jaw(model: Gltf) -> int | None:
    """Return the node that is the jaw: VRM's, else the first by name that hangs on no other."""
    said = _vrm_jaw(model)
    if said is not None:
        return said
    nodes, above = model.items("nodes"), parents(model)
    candidates = list(_candidates(model))
    plain = [i for i in candidates if not _NO_JAW.search(str(nodes[i].get("name", "")))]
    for index in plain or candidates:
        if not any(up in plain for up in list(path_up(index, above))[1:]):
            return index
    return None


def _candidates(model: Gltf) -> Iterator[int]:
    nodes = model.items("nodes")
    joints = {index for skin in model.items("skins") for index in skin.get("joints", ())}
    for index, node in enumerate(nodes):
        carries = index in joints or bool(node.get("children"))
        if carries and "mesh" not in node and _JAW.search(str(node.get("name", ""))):
            yield index


def _vrm_jaw(model: Gltf) -> int | None:
    extensions = model.json.get("extensions")
    if not isinstance(extensions, dict):
        return None
    found: Any = None
    bones = _inside(extensions, "VRM", "humanoid").get("humanBones")
    if isinstance(bones, list):
        rows = [bone for bone in bones if isinstance(bone, dict) and bone.get("bone") == "jaw"]
        found = rows[0].get("node") if rows else None
    else:
        found = _inside(extensions, "VRMC_vrm", "humanoid", "humanBones", "jaw").get("node")
    inside = isinstance(found, int) and 0 <= found < len(model.items("nodes"))
    return int(found) if inside else None


def _inside(value: Any, *keys: str) -> dict[str, Any]:
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else None
    return value if isinstance(value, dict) else {}
