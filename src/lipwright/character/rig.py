"""Rigs: what a model has that can move a mouth.

Morph targets by name, the expressions of VRM 0 and 1 (named mixes of morph targets),
and joints: the one that is the jaw, with how it opens.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from lipwright.character.between import between_names
from lipwright.character.jaw import jaw_turn, opening_turn
from lipwright.character.skeleton import jaw_names
from lipwright.errors import CharacterError
from lipwright.gltf import Gltf, MorphMesh, morph_meshes, structure
from lipwright.performance import JointTurn

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
    jaw : JointTurn, optional
        How the jaw opens, where a joint carries it.
    model : Gltf, optional
        The model itself.
    """

    meshes: tuple[MorphMesh, ...]
    expressions: dict[str, Weights] = field(default_factory=dict)
    jaws: tuple[str, ...] = ()
    jaw: JointTurn | None = None
    model: Gltf | None = None

    @property
    def targets(self) -> tuple[str, ...]:
        """The names of all morph targets but in-betweens, each once, in the file's order."""
        names = self.all_targets
        between = between_names(names)
        return tuple(name for name in names if name not in between)

    @property
    def all_targets(self) -> tuple[str, ...]:
        """The same with in-betweens."""
        return tuple(dict.fromkeys(name for mesh in self.meshes for name in mesh.targets))

    @property
    def nodes(self) -> dict[str, int]:
        """The nodes that have a name; of several of one name, the first."""
        found: dict[str, int] = {}
        for index, node in enumerate(self.model.items("nodes") if self.model else ()):
            if isinstance(node.get("name"), str):
                found.setdefault(node["name"], index)
        return found

    def opening(self, node: int, degrees: float) -> JointTurn | None:
        """Return how a joint turns to lower what it carries, or None if it carries nothing."""
        return opening_turn(self.model, node, degrees) if self.model else None


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
        jaws = jaw_names(model)
        expressions = _expressions(model, meshes)
    shown = tuple(mesh for mesh in meshes if mesh.nodes)
    jaw = jaw_turn(model)
    if not shown and jaw is None:
        joint = f" (its joint {jaws[0]!r} carries no vertices)" if jaws else ""
        raise CharacterError(
            f"has no morph targets and no jaw that turns{joint}",
            where=model.where,
            expected="a head with mouth shapes, such as ARKit's or visemes, or a jaw joint",
            cure="export it with its blend shapes (shape keys)",
        )
    return Rig(shown, expressions, jaws, jaw, model)


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
