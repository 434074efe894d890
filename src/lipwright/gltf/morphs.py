"""Morph targets: which meshes have them, by which names, and which nodes show them.

glTF leaves the names to ``extras.targetNames`` of a mesh (section 3.7.2.2, implementation
note); some exporters write them on the first primitive. Targets without a name get the
mesh's name and their place. Characters and exporters both ask here, so that they agree.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from lipwright.errors import FileFormatError
from lipwright.gltf.container import Gltf, structure


@dataclass(frozen=True, slots=True)
class MorphMesh:
    """A mesh with morph targets.

    Parameters
    ----------
    index : int
        Its place among the meshes.
    name : str
        Its name, or ``"mesh 3"``.
    targets : tuple of str
        The names of its morph targets, in order.
    nodes : tuple of int
        The nodes that show it.
    weights : tuple of tuple of float
        For each of these nodes, the weight of each target at rest.
    named : bool
        Whether the names are the file's own.
    """

    index: int
    name: str
    targets: tuple[str, ...]
    nodes: tuple[int, ...]
    weights: tuple[tuple[float, ...], ...]
    named: bool


def morph_meshes(model: Gltf) -> tuple[MorphMesh, ...]:
    """Return the meshes of a model that have morph targets.

    Raises
    ------
    FileFormatError
        If primitives of one mesh differ in their number of targets, or the structure of
        meshes and nodes is broken.
    """
    with structure(model.where):
        return tuple(_morph_meshes(model))


def _morph_meshes(model: Gltf) -> Iterator[MorphMesh]:
    nodes = model.items("nodes")
    for index, mesh in enumerate(model.items("meshes")):
        name = str(mesh.get("name") or f"mesh {index}")
        count = _target_count(mesh, f"{model.where}, mesh {name!r}")
        if not count:
            continue
        names = _target_names(mesh, count)
        users = tuple(i for i, node in enumerate(nodes) if node.get("mesh") == index)
        rest = tuple(_weights(nodes[i].get("weights", mesh.get("weights")), count) for i in users)
        targets = names or tuple(f"{name}[{target}]" for target in range(count))
        yield MorphMesh(index, name, targets, users, rest, names is not None)


def _target_count(mesh: dict[str, Any], where: str) -> int:
    primitives = mesh.get("primitives")
    if not isinstance(primitives, list) or not all(isinstance(p, dict) for p in primitives):
        raise FileFormatError("has no primitives", where=where)
    counts = {len(primitive.get("targets") or ()) for primitive in primitives}
    if len(counts) > 1:
        raise FileFormatError(
            f"its primitives have {' and '.join(map(str, sorted(counts)))} morph targets",
            where=where,
            expected="the same number",
        )
    return counts.pop() if counts else 0


def _target_names(mesh: dict[str, Any], count: int) -> tuple[str, ...] | None:
    for holder in (mesh, mesh["primitives"][0]):
        extras = holder.get("extras")
        names = extras.get("targetNames") if isinstance(extras, dict) else None
        if (
            isinstance(names, list)
            and len(names) == count
            and all(isinstance(n, str) for n in names)
        ):
            return tuple(names)
    return None


def _weights(given: Any, count: int) -> tuple[float, ...]:
    numbers = isinstance(given, list) and all(isinstance(w, int | float) for w in given)
    if numbers and len(given) == count:
        return tuple(map(float, given))
    return (0.0,) * count
