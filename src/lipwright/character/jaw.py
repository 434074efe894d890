"""A jaw joint as a channel: which way it turns is found from the model.

The face looks along +z (VRM 0: -z) unless what the jaw carries lies clearly elsewhere of
its joint. The jaw opens about the axis from the head's right to its left: its own points
in front of the joint then go down.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.mapping import JAW_DEGREES
from lipwright.character.skeleton import find_jaw, world_matrices
from lipwright.character.surfaces import read_surfaces
from lipwright.gltf import Gltf, structure
from lipwright.performance import JointTurn

Floats = NDArray[np.float64]

_WAYS = np.array([[0, 0, 1], [0, 0, -1], [1, 0, 0], [-1, 0, 0]], np.float64)
_CLEARLY = 0.15


def usual_front(model: Gltf) -> Floats:
    """Return where a model of this kind looks: +z, or -z in VRM 0."""
    extensions = model.json.get("extensions")
    backwards = isinstance(extensions, dict) and "VRM" in extensions
    return np.array(_WAYS[1] if backwards else _WAYS[0])


def front_of(offset: Floats, size: float, usual: Floats) -> Floats:
    """Return where a face looks whose mouth or jaw lies at an offset from its middle."""
    flat = offset * (1, 0, 1)
    if np.linalg.norm(flat) < _CLEARLY * size:
        return usual
    return np.asarray(_WAYS[int(np.argmax(_WAYS @ flat))])


def jaw_turn(model: Gltf) -> JointTurn | None:
    """Return how the model's jaw joint opens, or None if it has none that carries anything."""
    with structure(model.where):
        node = find_jaw(model)
    return opening_turn(model, node) if node is not None else None


def opening_turn(model: Gltf, node: int, degrees: float = JAW_DEGREES) -> JointTurn | None:
    """Return how a joint turns to lower what it carries, or None if it carries nothing."""
    with structure(model.where), np.errstate(all="ignore"):
        return _opening_turn(model, node, degrees)


def _opening_turn(model: Gltf, node: int, degrees: float) -> JointTurn | None:
    name = str(model.items("nodes")[node].get("name", f"node {node}"))
    found = JointTurn(node, name, (1.0, 0.0, 0.0), degrees)
    faces = read_surfaces(model, {name: found}, np.array([0.0, 0.0, 1.0]))
    if not faces.parts:
        return None
    share = np.concatenate([part.turning[:, 3, 3] for part in faces.parts])
    if share.max(initial=0.0) < 0.1:
        return None
    points = faces.positions({})
    offset = np.average(points, axis=0, weights=share) - faces.pivot
    carried = points[share > 0.1]
    front = front_of(offset, float(np.ptp(carried, axis=0).max(initial=0.0)), usual_front(model))
    across = np.cross((0.0, 1.0, 0.0), front)
    own = np.linalg.pinv(world_matrices(model)[node][:3, :3]) @ across
    if not np.isfinite(own).all() or not np.linalg.norm(own) > 0:
        return None
    own = np.round(own / np.linalg.norm(own), 6) + 0.0
    return JointTurn(node, name, (float(own[0]), float(own[1]), float(own[2])), degrees)
