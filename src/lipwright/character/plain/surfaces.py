"""A plain model's surfaces, as they stand in the scene, and its morph targets to be.

Every primitive of a glTF mesh that some node shows is a surface; so is every group of an
OBJ. Vertices that a texture's seam has split are one point, so that it does not tear when the
surface moves: those on open edges, at the same place, that face the same way. Lips that
lie on each other stay apart.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.character.shading import Shading
from lipwright.errors import FileFormatError
from lipwright.gltf import Gltf, read_accessor, structure

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_POINTS, _TRIANGLES = 0, 4
_SAME_PLACE = 1e-6
"""Points nearer than this share of the surface's size are at one place."""
_SAME_WAY = 0.2
"""Cosine of the angle up to which vertices at one place face the same way."""


@dataclass(frozen=True, eq=False)
class Surface:
    """One surface of a model.

    Parameters
    ----------
    names : tuple of str
        By which a face file may call it: mesh, node, material, group.
    points : (V, 3) float64
        In the model's unit, as they stand in the scene.
    triangles : (F, 3) int
    mesh, primitive : int
        Where it lies in the model.
    local : (3, 3) float64
        Takes a displacement in the scene to one in the mesh's own axes: row times this.
    """

    names: tuple[str, ...]
    points: Floats
    triangles: Indices
    mesh: int
    primitive: int
    local: Floats

    @cached_property
    def welded(self) -> tuple[Indices, Indices]:
        """The first vertex of each point, and for each vertex the number of its point."""
        size = float(np.ptp(self.points, axis=0).max()) or 1.0
        grid = np.round(self.points / (size * _SAME_PLACE)).astype(np.int64)
        _, place = np.unique(grid, axis=0, return_inverse=True)
        key = np.stack((place.reshape(-1), self._sides(place.reshape(-1))), axis=1)
        _, first, point = np.unique(key, axis=0, return_index=True, return_inverse=True)
        return first, point.reshape(-1)

    def _sides(self, place: Indices) -> Indices:
        """Number, for vertices that share a place, those that are one point alike."""
        shading = Shading.of(self.points.astype(np.float32), self.triangles.astype(np.uint32))
        sides = np.zeros(len(place), np.intp)
        edge = self._on_open_edges()
        order = np.argsort(place, kind="stable")
        starts = np.flatnonzero(np.diff(place[order], prepend=-1))
        for group in np.split(order, starts[1:]):
            if len(group) > 1:
                ways = np.array(_ways(shading.normals[group]))
                inside = ~edge[group]
                ways[inside] = len(group) + np.flatnonzero(inside)
                sides[group] = ways
        return sides

    def _on_open_edges(self) -> NDArray[np.bool_]:
        """Return which vertices lie on an edge of one triangle only, (V,)."""
        edges = np.sort(self.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        unique, count = np.unique(edges, axis=0, return_counts=True)
        found = np.zeros(len(self.points), np.bool_)
        found[unique[count == 1]] = True
        return found


def _ways(normals: NDArray[np.float32]) -> list[int]:
    """Number directions, those less than about a right angle apart alike."""
    ways: list[NDArray[np.float32]] = []
    found = []
    for normal in normals:
        alike = [way for way, other in enumerate(ways) if float(normal @ other) > _SAME_WAY]
        if not alike:
            ways.append(normal)
        found.append(alike[0] if alike else len(ways) - 1)
    return found


def surfaces(model: Gltf) -> tuple[Surface, ...]:
    """Return the surfaces that a model shows.

    Raises
    ------
    FileFormatError
        If the model holds no triangles, or its structure is broken.
    """
    with structure(model.where):
        found = tuple(_surfaces(model))
    if not found:
        raise FileFormatError("shows no triangles", where=model.where, expected="a face")
    return found


def _surfaces(model: Gltf) -> Iterator[Surface]:
    nodes, places = model.items("nodes"), _places(model)
    meshes, materials = model.items("meshes"), model.items("materials")
    seen: set[int] = set()
    for index, node in enumerate(nodes):
        number = node.get("mesh")
        if number is None or number in seen:
            continue
        seen.add(number)
        mesh = meshes[number]
        # A skinned mesh stands where its joints put it; its node's place does not count.
        matrix = np.eye(4) if "skin" in node else places[index]
        for order, primitive in enumerate(mesh["primitives"]):
            if primitive.get("mode", _TRIANGLES) != _TRIANGLES:
                continue
            own = read_accessor(model, primitive["attributes"]["POSITION"]).astype(np.float64)
            material = primitive.get("material")
            called = [mesh.get("name"), node.get("name")]
            called += [materials[material].get("name")] if material is not None else []
            yield Surface(
                tuple(str(name) for name in called if name),
                own @ matrix[:3, :3].T + matrix[:3, 3],
                _triangles(model, primitive, len(own)),
                number,
                order,
                np.asarray(np.linalg.pinv(matrix[:3, :3]).T, np.float64),
            )


def _triangles(model: Gltf, primitive: dict[str, Any], count: int) -> Indices:
    if "indices" in primitive:
        numbers = read_accessor(model, primitive["indices"]).astype(np.intp)
    else:
        numbers = np.arange(count)
    triangles: Indices = numbers[: len(numbers) // 3 * 3].reshape(-1, 3)
    if len(triangles) and triangles.max() >= count:
        raise FileFormatError("a triangle has a vertex that does not exist", where=model.where)
    return triangles


def _places(model: Gltf) -> dict[int, Floats]:
    """Return each node's place in the scene as a matrix."""
    nodes = model.items("nodes")
    parents = {child: i for i, node in enumerate(nodes) for child in node.get("children", ())}
    places: dict[int, Floats] = {}
    for index in range(len(nodes)):
        chain = [index]
        while chain[-1] in parents and len(chain) <= len(nodes):
            chain.append(parents[chain[-1]])
        matrix = np.eye(4)
        for node in reversed(chain):
            matrix = matrix @ _matrix(nodes[node])
        places[index] = matrix
    return places


def _matrix(node: dict[str, Any]) -> Floats:
    if "matrix" in node:
        return np.array(node["matrix"], np.float64).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0.0, 0.0, 0.0, 1.0))
    turned = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = turned * np.array(node.get("scale", (1.0, 1.0, 1.0)))
    matrix[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    return matrix
