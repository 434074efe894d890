"""Rigs: what a model has that can move a mouth.

Morph targets by name, the expressions of VRM 0 and 1 (named mixes of morph targets),
and joints that look like a jaw. Joints are reported, not yet driven.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any

from lipwright.character.between import between_names
from lipwright.errors import CharacterError
from lipwright.gltf import Gltf, MorphMesh, morph_meshes, structure

Weights = dict[str, float]


@dataclass(frozen=True, slots=True)
class Rig:
    """What a model has that can move a mouth.

    Parameters
    ----------
    meshes : tuple of MorphMesh
        The meshes with morph targets that some node shows.
    expressions : dict of str to dict of str to float
        For each VRM expression, the weight of each morph target that it moves.
    jaws : tuple of str
        Names of joints that look like a jaw.
    """

    meshes: tuple[MorphMesh, ...]
    expressions: dict[str, Weights] = field(default_factory=dict)
    jaws: tuple[str, ...] = ()

    @property
    def targets(self) -> tuple[str, ...]:
        """The names of all morph targets but in-betweens, each once, in the file's order."""
        names = self.all_targets
        return tuple(name for name in names if name not in between_names(names))

    @property
    def all_targets(self) -> tuple[str, ...]:
        """The same with in-betweens."""
        return tuple(dict.fromkeys(name for mesh in self.meshes for name in mesh.targets))


def read_rig(model: Gltf) -> Rig:
    """Return the rig of a model.

    Raises
    ------
    CharacterError
        If nothing in it can move: no meshes, or none with morph targets.
    FileFormatError
        If the structure of the file is broken.
    """
    if not model.items("meshes"):
        raise CharacterError("holds no mesh", where=model.where, expected="a head to animate")
    meshes = morph_meshes(model)
    with structure(model.where):
        jaws = _jaws(model)
        expressions = _expressions(model, meshes)
    shown = tuple(mesh for mesh in meshes if mesh.nodes)
    if not shown:
        joint = f" (its joint {jaws[0]!r} is not driven yet)" if jaws else ""
        raise CharacterError(
            f"has no morph targets{joint}",
            where=model.where,
            expected="a head with mouth shapes, such as ARKit's or visemes",
            cure="export it with its blend shapes (shape keys)",
        )
    return Rig(shown, expressions, jaws)


def _jaws(model: Gltf) -> tuple[str, ...]:
    joints = {index for skin in model.items("skins") for index in skin.get("joints", ())}
    names = [str(n.get("name", "")) for i, n in enumerate(model.items("nodes")) if i in joints]
    return tuple(name for name in names if re.search(r"jaw|mandible", name, re.IGNORECASE))


def _expressions(model: Gltf, meshes: tuple[MorphMesh, ...]) -> dict[str, Weights]:
    """Read VRM 0's blend shape groups or VRM 1's expressions; skip binds that lead nowhere."""
    extensions = _inside(model.json, "extensions")
    names = {mesh.index: mesh.targets for mesh in meshes}
    found: dict[str, Weights] = {}
    master = _inside(extensions, "VRM", "blendShapeMaster")
    for group in _dicts(master.get("blendShapeGroups")):
        name = group.get("presetName")
        if name in (None, "", "unknown"):
            name = group.get("name")
        binds = [
            (bind.get("mesh"), bind.get("index"), bind.get("weight"), 0.01)
            for bind in _dicts(group.get("binds"))
        ]
        _collect(found, str(name), binds, names)
    nodes = model.items("nodes")
    for kind in ("preset", "custom"):
        expressions = _inside(extensions, "VRMC_vrm", "expressions", kind)
        for name, expression in expressions.items():
            rows = (
                _dicts(expression.get("morphTargetBinds")) if isinstance(expression, dict) else []
            )
            binds = [
                (_mesh_of(nodes, bind.get("node")), bind.get("index"), bind.get("weight"), 1.0)
                for bind in rows
            ]
            _collect(found, str(name), binds, names)
    return found


def _collect(
    found: dict[str, Weights],
    name: str,
    binds: list[tuple[Any, Any, Any, float]],
    names: dict[int, tuple[str, ...]],
) -> None:
    weights = {
        names[mesh][index]: float(weight) * scale
        for mesh, index, weight, scale in binds
        if isinstance(index, int)
        and isinstance(weight, int | float)
        and 0 <= index < len(names.get(mesh, ()))
    }
    if weights:
        found[name] = weights


def _mesh_of(nodes: list[dict[str, Any]], index: Any) -> Any:
    inside = isinstance(index, int) and 0 <= index < len(nodes)
    return nodes[index].get("mesh") if inside else None


def _inside(value: Any, *keys: str) -> dict[str, Any]:
    for key in keys:
        value = value.get(key) if isinstance(value, dict) else None
    return value if isinstance(value, dict) else {}


def _dicts(value: Any) -> list[dict[str, Any]]:
    return [item for item in value if isinstance(item, dict)] if isinstance(value, list) else []
