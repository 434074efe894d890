"""The surfaces of a model in the world, and where morph targets and one joint take them.

All nodes' transforms and skins are applied, so that parts of a face that come as several
meshes lie where a viewer draws them. A joint's turn is exact, not its chord: each vertex is
the sum of what stays and what turns with the joint (linear blend skinning, glTF 2.0, 3.7.3).
Distances are the model's own. Compressed geometry is not unpacked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.character.between import between_values
from lipwright.character.skeleton import below, turned, world_matrices
from lipwright.gltf import Gltf, morph_meshes, read_accessor, structure
from lipwright.performance import JointTurn

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """Some vertices of one primitive, at rest in the world.

    Parameters
    ----------
    name : str
        Of node, mesh and material, to tell teeth from skin.
    color : tuple of 3 float
        The material's, linear.
    model : Gltf
    still, turning : (V, 4, 4) float64
        From the mesh's space to the world, what stays and what turns with the joint: their
        sum places a vertex at rest, and their last number is each one's share.
    points : (V, 3) float64
        In the mesh's space.
    triangles : (F, 3) int
    targets : dict of str to int
        The accessor of each morph target's displacements.
    rows : (V,) int, optional
        Which of the primitive's vertices these are; None means all.
    place : tuple of int
        The mesh, and which of its primitives.
    """

    name: str
    color: tuple[float, float, float]
    model: Gltf
    still: Floats
    turning: Floats
    points: Floats
    triangles: Indices
    targets: dict[str, int]
    rows: Indices | None = None
    place: tuple[int, int] = (0, 0)
    _kept: dict[str, Floats] = field(default_factory=dict)

    def moves(self, target: str) -> Floats:
        """Return the displacements (V, 3) of a morph target that it has, in the mesh's space."""
        if target not in self._kept:
            found = read_accessor(self.model, self.targets[target]).astype(np.float64)
            self._kept[target] = found if self.rows is None else found[self.rows]
        return self._kept[target]

    def taken(self, rows: Indices) -> Surface:
        """Return it with some of its vertices, and no triangles."""
        before = rows if self.rows is None else self.rows[rows]
        kept = {name: moves[rows] for name, moves in self._kept.items()}
        return replace(
            self,
            still=self.still[rows],
            turning=self.turning[rows],
            points=self.points[rows],
            triangles=np.zeros((0, 3), np.intp),
            rows=before,
            _kept=kept,
        )


@dataclass(frozen=True, slots=True, eq=False)
class Surfaces:
    """Surfaces together, their vertices numbered on from one to the next.

    Parameters
    ----------
    parts : sequence of Surface
    axes : (3, 3) float64
        The head's left, up and front, as rows, in the world.
    turns : dict of str to JointTurn
        The channels that turn joints; only the first is heard.
    pivot, axis : (3,) float64
        Of the first, in the world.
    """

    parts: Sequence[Surface]
    axes: Floats
    turns: Mapping[str, JointTurn]
    pivot: Floats
    axis: Floats

    @property
    def count(self) -> int:
        """The number of vertices."""
        return sum(len(part.points) for part in self.parts)

    @property
    def starts(self) -> list[int]:
        """The number of the first vertex of each part."""
        lengths = [len(part.points) for part in self.parts]
        return [0, *np.cumsum(lengths)[:-1].tolist()]

    @property
    def triangles(self) -> Indices:
        """All triangles, (F, 3), numbered on."""
        rows = [part.triangles + start for part, start in zip(self.parts, self.starts, strict=True)]
        return np.concatenate(rows) if rows else np.zeros((0, 3), np.intp)

    @property
    def part_of(self) -> Indices:
        """The part of each vertex, (N,)."""
        return np.repeat(np.arange(len(self.parts)), [len(part.points) for part in self.parts])

    def positions(self, values: Mapping[str, float]) -> Floats:
        """Return where all vertices are, (N, 3): left, up, front of the head."""
        whole = {**values, **between_values(values, self._targets())}
        return np.concatenate([self._of(part, whole) for part in self.parts]) @ self.axes.T

    def _targets(self) -> set[str]:
        return {name for part in self.parts for name in part.targets}

    def taken(self, vertices: Indices) -> Surfaces:
        """Return it with some vertices, given in rising order."""
        edges = [*self.starts, self.count]
        cut = np.searchsorted(vertices, edges)
        parts = [
            part.taken(vertices[cut[i] : cut[i + 1]] - edges[i])
            for i, part in enumerate(self.parts)
            if cut[i + 1] > cut[i]
        ]
        return replace(self, parts=parts)

    def _of(self, part: Surface, values: Mapping[str, float]) -> Floats:
        points = np.ones((len(part.points), 4))
        points[:, :3] = part.points
        for name, value in values.items():
            if value and name in part.targets:
                points[:, :3] += value * part.moves(name)
        stays = _placed(part.still, points)
        if not self.turns:
            return stays
        goes = _placed(part.turning, points)
        for name, turn in list(self.turns.items())[:1]:
            angle = np.radians(turn.degrees) * values.get(name, 0.0)
            centre = part.turning[:, 3, 3:] * self.pivot
            goes = turned(goes - centre, self.axis, angle) + centre
        return np.asarray(stays + goes)


def _placed(matrices: Floats, points: Floats) -> Floats:
    """Return points (V, 4) placed by matrices (V, 4, 4) that may be one and the same."""
    if len(matrices) and matrices.strides[0] == 0:
        return np.asarray(points @ matrices[0, :3].T)
    return np.asarray(np.einsum("vij,vj->vi", matrices[:, :3], points))


def read_surfaces(model: Gltf, turns: Mapping[str, JointTurn], front: Floats) -> Surfaces:
    """Return all surfaces that some node shows.

    Parameters
    ----------
    model : Gltf
    turns : mapping of str to JointTurn
        Channels that turn joints.
    front : (3,) float64
        Where the face looks, in the world.
    """
    with structure(model.where):
        return _read(model, turns, front)


def _read(model: Gltf, turns: Mapping[str, JointTurn], front: Floats) -> Surfaces:
    world = world_matrices(model)
    turn = next(iter(turns.values()), None)
    carried = below(model, turn.node) if turn else set()
    targets = {mesh.index: mesh.targets for mesh in morph_meshes(model)}
    parts = []
    for index, node in enumerate(model.items("nodes")):
        if "mesh" not in node:
            continue
        for order, primitive in enumerate(model.items("meshes")[node["mesh"]]["primitives"]):
            if primitive.get("mode", 4) != 4 or "POSITION" not in primitive["attributes"]:
                continue
            frames = _frames(model, node, primitive, world, carried, index)
            surface = _surface(model, node, primitive, frames, targets.get(node["mesh"], ()))
            parts.append(replace(surface, place=(node["mesh"], order)))
    up = np.array([0.0, 1.0, 0.0])
    axes = np.stack([np.cross(up, front), up, front])
    pivot, axis = np.zeros(3), np.array([1.0, 0.0, 0.0])
    if turn:
        pivot = world[turn.node][:3, 3]
        axis = world[turn.node][:3, :3] @ np.array(turn.axis)
        axis = axis / (np.linalg.norm(axis) or 1.0)
    return Surfaces(parts, axes, turns, pivot, axis)


def _frames(
    model: Gltf,
    node: dict[str, Any],
    primitive: dict[str, Any],
    world: Floats,
    carried: set[int],
    index: int,
) -> tuple[Floats, Floats]:
    """Return the matrices of what stays and of what turns, each (V, 4, 4)."""
    count = model.items("accessors")[primitive["attributes"]["POSITION"]]["count"]
    nothing = np.broadcast_to(np.zeros((4, 4)), (count, 4, 4))
    attributes = primitive["attributes"]
    if "skin" not in node or "JOINTS_0" not in attributes:
        whole = np.broadcast_to(world[index], (count, 4, 4))
        return (nothing, whole) if index in carried else (whole, nothing)
    skin = model.items("skins")[node["skin"]]
    joints = list(skin["joints"])
    bind = world[joints]
    if "inverseBindMatrices" in skin:
        inverse = read_accessor(model, skin["inverseBindMatrices"]).astype(np.float64)
        bind = bind @ inverse.reshape(-1, 4, 4).transpose(0, 2, 1)
    goes = np.array([joint in carried for joint in joints])
    still, turning = nothing, nothing
    for number in range(8):
        if f"JOINTS_{number}" not in attributes:
            break
        at = read_accessor(model, attributes[f"JOINTS_{number}"]).astype(np.intp)
        weights = read_accessor(model, attributes[f"WEIGHTS_{number}"]).astype(np.float64)
        for corner in range(4):
            part = weights[:, corner, None, None] * bind[at[:, corner]]
            moving = goes[at[:, corner]][:, None, None]
            still, turning = still + part * ~moving, turning + part * moving
    return still, turning


def _surface(
    model: Gltf,
    node: dict[str, Any],
    primitive: dict[str, Any],
    frames: tuple[Floats, Floats],
    names: Sequence[str],
) -> Surface:
    mesh = model.items("meshes")[node["mesh"]]
    material: dict[str, Any] = {}
    if "material" in primitive:
        material = model.items("materials")[primitive["material"]]
    color = material.get("pbrMetallicRoughness", {}).get("baseColorFactor", (0.8, 0.7, 0.65))
    points = read_accessor(model, primitive["attributes"]["POSITION"]).astype(np.float64)
    if "indices" in primitive:
        corners = read_accessor(model, primitive["indices"]).astype(np.intp)
    else:
        corners = np.arange(len(points))
    accessors = {
        name: target["POSITION"]
        for name, target in zip(names, primitive.get("targets", ()), strict=False)
        if "POSITION" in target
    }
    return Surface(
        " ".join(str(each.get("name", "")) for each in (node, mesh, material)),
        (float(color[0]), float(color[1]), float(color[2])),
        model,
        *frames,
        points,
        corners[: len(corners) // 3 * 3].reshape(-1, 3),
        accessors,
    )
