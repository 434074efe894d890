"""Morph targets added to a model, behind those that it has.

Every primitive of a mesh gets as many, as glTF wants it (3.7.2.2). Normals are written where
the mesh's own targets have them, or where it has none: viewers want them of all or none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.character.plain.surfaces import Surface as PlainSurface
from lipwright.character.shading import Shading
from lipwright.character.surfaces import Surface
from lipwright.errors import CharacterError
from lipwright.gltf import (
    VERTICES,
    Gltf,
    GltfWriter,
    MorphMesh,
    morph_meshes,
    read_accessor,
    structure,
)
from lipwright.marker_faces.face_mesh import FaceMesh

Floats = NDArray[np.float64]

_STILL = 5e-5
"""Of the mouth's width: a vertex that moves by less is still."""


def with_targets(face: FaceMesh, names: Sequence[str], moves: Floats) -> Gltf:
    """Return a face's model with morph targets added.

    Parameters
    ----------
    face : FaceMesh
    names : sequence of str
        K names that the model has not.
    moves : (K, N, 3) float64
        The displacements of all vertices, in the head's axes.

    Raises
    ------
    CharacterError
        If the model has one of the names.
    """
    with structure(face.model.where):
        return _written(face, names, moves)


def _written(face: FaceMesh, names: Sequence[str], moves: Floats) -> Gltf:
    known = {mesh.index: mesh for mesh in morph_meshes(face.model)}
    twice = [name for mesh in known.values() for name in mesh.targets if name in names]
    if twice:
        raise CharacterError(
            f"has a morph target {twice[0]!r} already",
            where=face.name,
            expected="a model that no markers drive yet",
            cure="take the model that it was made from",
        )
    writer = GltfWriter(face.model)
    parts: dict[tuple[int, int], tuple[Surface, Floats]] = {}
    for part, start in zip(face.surfaces.parts, face.surfaces.starts, strict=True):
        own = moves[:, start : start + len(part.points)]
        if part.place not in parts:  # a mesh that two nodes show moves as the first of them
            parts[part.place] = (part, _local(face, part, own))
    for mesh in sorted({place[0] for place, (_, own) in parts.items() if own.any()}):
        _add(writer, mesh, known.get(mesh), names, parts)
        if mesh in known:
            _lengthen(writer, face.model, known[mesh], len(names))
    return writer.finish()


def _lengthen(writer: GltfWriter, model: Gltf, mesh: MorphMesh, added: int) -> None:
    """Give the model's own animations of a mesh a weight of 0 for each new target."""
    for animation in writer.json.get("animations", ()):
        numbers = {
            channel["sampler"]
            for channel in animation["channels"]
            if channel["target"].get("path") == "weights"
            and channel["target"].get("node") in mesh.nodes
        }
        for number in sorted(numbers):
            sampler = animation["samplers"][number]
            old = read_accessor(model, sampler["output"]).astype(np.float32)
            rows = np.pad(old.reshape(-1, len(mesh.targets)), ((0, 0), (0, added)))
            sampler["output"] = writer.accessor(rows.ravel())


def _local(face: FaceMesh, part: Surface, moves: Floats) -> Floats:
    """Return displacements (K, V, 3) in the mesh's own space."""
    moves = np.where((np.linalg.norm(moves, axis=2) < _STILL * face.width)[:, :, None], 0.0, moves)
    matrices = (part.still + part.turning)[:, :3, :3]
    if len(matrices) and (matrices == matrices[0]).all():
        back = np.linalg.pinv(matrices[0]) @ face.surfaces.axes.T
        return np.asarray(moves @ back.T)
    return np.asarray(
        np.einsum("vij,kvj->kvi", np.linalg.pinv(matrices), moves @ face.surfaces.axes)
    )


def _add(
    writer: GltfWriter,
    mesh: int,
    known: MorphMesh | None,
    names: Sequence[str],
    parts: dict[tuple[int, int], tuple[Surface, Floats]],
) -> None:
    document = writer.json["meshes"][mesh]
    for order, primitive in enumerate(document["primitives"]):
        before = primitive.get("targets", [])
        normals = "NORMAL" in primitive["attributes"] and all("NORMAL" in one for one in before)
        if (mesh, order) in parts:
            added = _targets(writer, *parts[mesh, order], normals=normals)
        else:
            count = writer.json["accessors"][primitive["attributes"]["POSITION"]]["count"]
            added = _nothing(writer, count, len(names), normals=normals)
        primitive["targets"] = [*before, *added]
    old = known.targets if known else ()
    nodes = [node for node in writer.json["nodes"] if node.get("mesh") == mesh]
    for holder in (document, *(node for node in nodes if "weights" in node)):
        rest = holder.get("weights", [0] * len(old))
        holder["weights"] = [*rest, *[0] * len(names)]
    extras = document.get("extras")
    kept = extras if isinstance(extras, dict) else {}
    document["extras"] = {**kept, "targetNames": [*old, *names]}


def _targets(
    writer: GltfWriter, part: Surface, moves: Floats, *, normals: bool
) -> list[dict[str, Any]]:
    plain = PlainSurface((), part.points, part.triangles, 0, 0, np.eye(3))
    first, place = plain.welded
    shading = Shading.of(
        part.points[first].astype(np.float32), place[part.triangles].astype(np.uint32)
    )
    found = []
    for move in moves.astype(np.float32):
        target = {"POSITION": writer.sparse(move, limits=True, target=VERTICES)}
        if normals:
            turns = shading.turns(move[first], move[first].any(axis=1))[place]
            target["NORMAL"] = writer.sparse(turns, target=VERTICES)
        found.append(target)
    return found


def _nothing(
    writer: GltfWriter, count: int, targets: int, *, normals: bool
) -> list[dict[str, Any]]:
    zeros = np.zeros((count, 3), np.float32)
    whole = {"POSITION": writer.sparse(zeros, limits=True, target=VERTICES)}
    if normals:
        whole["NORMAL"] = writer.sparse(zeros, target=VERTICES)
    return [dict(whole) for _ in range(targets)]
