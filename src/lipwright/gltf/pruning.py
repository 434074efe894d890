"""Making a model smaller for showing it: only the morph targets that move.

Indices stay as they are; what is dropped becomes empty, and the binary chunk is packed
anew. For a page that plays one line, not for files that go on to other programs: existing
animations and VRM's expressions, which count on all morph targets, are left out.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator
from typing import Any

from lipwright.gltf.container import Gltf
from lipwright.gltf.morphs import morph_meshes

_COUNTING = ("VRM", "VRMC_vrm")


def keep_morphs(model: Gltf, keep: Collection[str]) -> Gltf:
    """Return a model with only some of its morph targets.

    Parameters
    ----------
    model : Gltf
        The model.
    keep : collection of str
        The names of the morph targets that stay.

    Returns
    -------
    Gltf
        It looks the same with all other morph targets at 0.
    """
    document: dict[str, Any] = json.loads(json.dumps(model.json))
    dropped: set[int] = set()
    for mesh in morph_meshes(model):
        kept = [index for index, name in enumerate(mesh.targets) if name in keep]
        holders = [document["meshes"][mesh.index], *(document["nodes"][n] for n in mesh.nodes)]
        for holder in holders:
            if "weights" in holder:
                holder["weights"] = [holder["weights"][index] for index in kept]
        for primitive in document["meshes"][mesh.index]["primitives"]:
            targets = primitive.pop("targets")
            primitive["targets"] = [targets[index] for index in kept]
            dropped |= {accessor for target in targets for accessor in target.values()}
            for holder in (holders[0], primitive):
                _rename(holder, [mesh.targets[index] for index in kept])
        _drop_empty(document["meshes"][mesh.index], holders)
    document.pop("animations", None)
    for name in _COUNTING:
        document.get("extensions", {}).pop(name, None)
    for accessor in dropped - set(_used_accessors(document)):
        document["accessors"][accessor] = {"componentType": 5126, "count": 1, "type": "SCALAR"}
    return _packed(Gltf(document, model.binary, model.where, model.rest))


def _rename(holder: dict[str, Any], names: list[str]) -> None:
    extras = holder.get("extras")
    if "primitives" in holder:
        holder["extras"] = {**(extras if isinstance(extras, dict) else {}), "targetNames": names}
    elif isinstance(extras, dict):
        extras.pop("targetNames", None)


def _drop_empty(mesh: dict[str, Any], holders: list[dict[str, Any]]) -> None:
    """Drop lists that must not be empty (glTF 2.0, sections 5.23 and 5.24)."""
    for primitive in mesh["primitives"]:
        if not primitive["targets"]:
            del primitive["targets"]
    for holder in holders:
        if holder.get("weights") == []:
            del holder["weights"]


def _used_accessors(document: dict[str, Any]) -> Iterator[int]:
    for mesh in document.get("meshes", ()):
        for primitive in mesh["primitives"]:
            yield from primitive.get("attributes", {}).values()
            yield from (index for t in primitive.get("targets", ()) for index in t.values())
            if "indices" in primitive:
                yield primitive["indices"]
    for skin in document.get("skins", ()):
        if "inverseBindMatrices" in skin:
            yield skin["inverseBindMatrices"]


def _packed(model: Gltf) -> Gltf:
    """Leave out the bytes of buffer views that nothing names any more."""
    views = model.items("bufferViews")
    if any("extensions" in view for view in views):
        return model
    named = set(_views_named(model.json))
    binary = bytearray()
    for index, view in enumerate(views):
        if view["buffer"] != 0:
            continue
        start, length = view.get("byteOffset", 0), view["byteLength"]
        if index not in named:
            start, length = 0, 1
            view.pop("byteStride", None)
        view["byteOffset"], view["byteLength"] = len(binary), length
        binary += model.binary[start : start + length]
        binary += b"\0" * (-len(binary) % 4)
    if model.items("buffers"):
        model.items("buffers")[0]["byteLength"] = len(binary)
    return Gltf(model.json, bytes(binary), model.where, model.rest)


def _views_named(value: Any) -> Iterator[int]:
    if isinstance(value, dict):
        for key, item in value.items():
            if key == "bufferView" and isinstance(item, int):
                yield item
            else:
                yield from _views_named(item)
    elif isinstance(value, list):
        for item in value:
            yield from _views_named(item)
