"""From a face file to a model with morph targets (DESIGN section 7).

Each expression becomes a morph target: the displacement of the published face model at
intensity 1. A target is a straight line; what it loses of a rotation is met by
*in-betweens*: further targets, named ``open@50`` for the intensity 0.5, that hold the
difference there (:mod:`lipwright.character.between` drives them). What is lost with and
without them is measured on the mesh and reported.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lipwright.character.between import between_name, hats, morph_targets
from lipwright.character.builtin import to_gltf
from lipwright.character.face_model import Move, displacement, mixture
from lipwright.character.mesh import Part
from lipwright.character.plain.face_file import ClusterMove, FaceFile, read_face
from lipwright.character.plain.obj_file import read_obj
from lipwright.character.plain.regions import weights
from lipwright.character.plain.surfaces import Floats, Surface, surfaces
from lipwright.character.shading import Shading
from lipwright.errors import CharacterError, LipwrightError
from lipwright.gltf import VERTICES, Gltf, GltfWriter, read_gltf

_STILL = 1e-7
"""Metres: a vertex that moves by less is still."""
_CHECKED = np.linspace(0.0, 1.0, 21)


@dataclass(frozen=True, slots=True)
class Loss:
    """What one expression is as a morph target.

    Parameters
    ----------
    name : str
    vertices : int
        How many it moves.
    farthest : float
        How far it moves one at most, metres.
    linear, with_between : float
        The greatest distance of a vertex from its true arc, at any intensity, without and
        with in-betweens, metres.
    """

    name: str
    vertices: int
    farthest: float
    linear: float
    with_between: float


@dataclass(frozen=True, slots=True, eq=False)
class BuiltFace:
    """A model that has learnt to move.

    Parameters
    ----------
    name : str
    model : Gltf
    losses : tuple of Loss
        One for each expression and mixture.
    """

    name: str
    model: Gltf
    losses: tuple[Loss, ...]


def build_face(path: str | Path) -> BuiltFace:
    """Build the model of a face file.

    Parameters
    ----------
    path : str or Path
        A face file.

    Returns
    -------
    BuiltFace
        In metres; a GLB, glTF or VRM file keeps all that it holds.

    Raises
    ------
    InputError
        If a file cannot be read.
    FileFormatError
        If a file breaks its format.
    CharacterError
        If an expression moves nothing, or the model has its name already.
    """
    face = read_face(path)
    source = Path(path).parent / face.model
    if source.suffix.lower() == ".obj":
        parts = [_in_metres(part, face.unit) for part in read_obj(source)]
        model, unit = to_gltf(parts, face.name), face.unit
    else:
        model, unit = read_gltf(source), face.unit
    try:
        return _build(face, model, unit)
    except LipwrightError as error:
        raise error if error.where else error.at(str(path)) from None


def _in_metres(part: Part, unit: float) -> Part:
    points = (part.positions.astype(np.float64) * unit).astype(np.float32)
    return Part(part.name, points, part.triangles, part.material, part.morphs, part.colors)


def _build(face: FaceFile, model: Gltf, unit: float) -> BuiltFace:
    """Work in the file's own unit; the scene of a model is in metres."""
    found = [_in_unit(surface, unit) for surface in surfaces(model)]
    sculpted = [_Sculpted.of(face, surface, found) for surface in found]
    losses = tuple(
        _loss(name, face, sculpted, unit) for name in (*face.expressions, *face.mixtures)
    )
    for loss in losses:
        if not loss.vertices:
            raise CharacterError(
                f"the expression {loss.name!r} moves nothing",
                expected="clusters that lie on the model",
                cure="check unit, places and parts: they are those of the model's scene",
            )
    writer = GltfWriter(model)
    for mesh in sorted({surface.mesh for surface in found}):
        _write(writer, mesh, [one for one in sculpted if one.surface.mesh == mesh], unit, model)
    return BuiltFace(face.name, writer.finish(), losses)


def _in_unit(surface: Surface, unit: float) -> Surface:
    points = surface.points / unit
    return Surface(
        surface.names, points, surface.triangles, surface.mesh, surface.primitive, surface.local
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Sculpted:
    """A surface with its moves."""

    surface: Surface
    moves: dict[str, list[Move]]
    targets: dict[str, Floats]

    @classmethod
    def of(cls, face: FaceFile, surface: Surface, model: Sequence[Surface]) -> _Sculpted:
        clusters = {
            name: weights(regions, surface, model) for name, regions in face.clusters.items()
        }
        moves = {
            name: [_move(one, clusters[one.cluster], face, surface) for one in rows]
            for name, rows in face.expressions.items()
        }
        points = surface.points
        targets = morph_targets(points, moves, face.between)
        for name, mixed in face.mixtures.items():
            targets[name] = mixture(((share, moves[one]) for one, share in mixed.items()), points)
        return cls(surface, moves, targets)


def _move(row: ClusterMove, weight: Floats, face: FaceFile, surface: Surface) -> Move:
    translation = weight[:, None] * np.array(row.shift or (0.0, 0.0, 0.0))
    if row.scale is not None:
        away = surface.points - np.array(row.scale.center)
        translation += weight[:, None] * away * (np.array(row.scale.factors) - 1.0)
    degrees = weight * (row.turn.degrees if row.turn is not None else 0.0)
    region = face.clusters[row.cluster][0]
    if region.vertices is not None and region.part in surface.names:
        if row.shifts is not None:
            translation[region.vertices] += np.array(row.shifts)
        if row.degrees is not None:
            degrees[region.vertices] = row.degrees
    if row.turn is None:
        return Move(translation)
    axis = np.array(row.turn.axis) / np.linalg.norm(row.turn.axis)
    return Move(translation, np.radians(degrees), tuple(axis.tolist()), row.turn.pivot)


def _loss(name: str, face: FaceFile, sculpted: Sequence[_Sculpted], unit: float) -> Loss:
    farthest = linear = bent = 0.0
    moved = 0
    steps = face.between.get(name, [])
    for one in sculpted:
        whole = one.targets[name] * unit
        lengths = np.linalg.norm(whole, axis=1)
        moved += int(np.count_nonzero(lengths > _STILL))
        farthest = max(farthest, float(lengths.max()))
        if name in face.mixtures:
            continue
        moving = np.flatnonzero(lengths > _STILL)
        if not len(moving):
            continue
        ramps = zip(_CHECKED.tolist(), *hats(_CHECKED, steps), strict=True)
        for intensity, *shares in ramps:
            true = unit * displacement(one.surface.points, one.moves[name], intensity)[moving]
            straight = intensity * whole[moving]
            linear = max(linear, float(np.linalg.norm(true - straight, axis=1).max()))
            for step, share in zip(steps, shares, strict=True):
                straight = straight + share * unit * one.targets[between_name(name, step)][moving]
            bent = max(bent, float(np.linalg.norm(true - straight, axis=1).max()))
    return Loss(name, moved, farthest, linear, bent)


def _write(
    writer: GltfWriter, mesh: int, sculpted: Sequence[_Sculpted], unit: float, model: Gltf
) -> None:
    names = [
        name
        for name in sculpted[0].targets
        if any(np.abs(one.targets[name]).max() * unit > _STILL for one in sculpted)
    ]
    if not names:
        return
    document = writer.json["meshes"][mesh]
    known = _known_targets(document, len(document["primitives"][0].get("targets", ())))
    twice = sorted(set(known) & set(names))
    if twice:
        raise CharacterError(
            f"has a morph target {twice[0]!r} already", where=model.where, cure="name it otherwise"
        )
    by_primitive = {one.surface.primitive: one for one in sculpted}
    for order, primitive in enumerate(document["primitives"]):
        if order not in by_primitive:
            raise CharacterError(
                "a mesh of triangles and lines cannot take morph targets", where=model.where
            )
        added = [_target(writer, by_primitive[order], name, unit, primitive) for name in names]
        primitive["targets"] = [*primitive.get("targets", ()), *added]
    document["weights"] = [*document.get("weights", [0] * len(known)), *[0] * len(names)]
    document["extras"] = {**document.get("extras", {}), "targetNames": [*known, *names]}


def _known_targets(document: dict[str, object], count: int) -> list[str]:
    extras = document.get("extras")
    names = extras.get("targetNames") if isinstance(extras, dict) else None
    if isinstance(names, list) and len(names) == count:
        return [str(name) for name in names]
    return [f"target {number}" for number in range(count)]


def _target(
    writer: GltfWriter, one: _Sculpted, name: str, unit: float, primitive: dict[str, object]
) -> dict[str, int]:
    """Write positions, and normals if the surface has its own; others must have the same."""
    surface = one.surface
    first, place = surface.welded
    moves = (one.targets[name] * unit).astype(np.float32)
    moves[np.linalg.norm(moves, axis=1) < _STILL] = 0
    own = (moves @ surface.local).astype(np.float32)
    made = {"POSITION": writer.sparse(own, limits=True, target=VERTICES)}
    attributes = json.loads(json.dumps(primitive["attributes"]))
    if "NORMAL" in attributes:
        shading = Shading.of(
            (surface.points[first] * unit).astype(np.float32),
            place[surface.triangles].astype(np.uint32),
        )
        turns = shading.turns(moves[first], np.abs(moves[first]).max(axis=1) > 0)[place]
        made["NORMAL"] = writer.sparse((turns @ surface.local).astype(np.float32), target=VERTICES)
    return made
