"""Whatever is wrong inside a model, it is refused in one line or read: never a crash."""

from __future__ import annotations

import copy
from collections.abc import Iterator
from typing import Any

from hypothesis import given
from hypothesis import strategies as st

from lipwright.character.calibration import calibrate
from lipwright.character.fitting import fit
from lipwright.character.rig import read_rig
from lipwright.errors import InputError
from lipwright.gltf import Gltf, parse_glb, read_accessor
from tests.character.sheets import jawed, widened
from tests.models import model

VRM: dict[str, Any] = {
    "VRM": {"blendShapeMaster": {"blendShapeGroups": [{"name": "A", "binds": [{"mesh": 0}]}]}},
    "VRMC_vrm": {"expressions": {"preset": {"aa": {"morphTargetBinds": [{"node": 0}]}}}},
}
BASE = model(("jawOpen", "mouthPucker"), extensions=VRM, skins=[{"joints": [0]}])
JAWED = jawed({"mouthPucker": widened(-0.4)})
GLB = BASE.to_glb()
OTHERS: st.SearchStrategy[object] = st.sampled_from(
    [None, -1, 0, 7, 1e9, "x", "", [], {}, [1], ["x"], [[]], [{}], {"x": 1}]
)


def places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Yield the path of every value in a document."""
    if path:
        yield path
    if isinstance(value, dict | list):
        keys = value if isinstance(value, dict) else range(len(value))
        for key in keys:
            yield from places(value[key], (*path, key))


def use(data: bytes) -> str:
    """Do what making a character of a file does, and read all of it; return the error."""
    try:
        made = parse_glb(data)
        rig = read_rig(made)
        calibrate(rig, fit(rig))
        for index in range(len(made.items("accessors"))):
            read_accessor(made, index)
    except InputError as error:
        return str(error)
    return ""


@given(path=st.sampled_from(sorted(places(BASE.json), key=repr)), other=OTHERS)
def test_any_value_may_be_wrong(path: tuple[Any, ...], other: object) -> None:
    document = copy.deepcopy(BASE.json)
    holder = document
    for key in path[:-1]:
        holder = holder[key]
    holder[path[-1]] = other
    assert "\n" not in use(Gltf(document, BASE.binary).to_glb())


@given(path=st.sampled_from(sorted(places(JAWED.json), key=repr)), other=OTHERS)
def test_any_value_of_a_skinned_jaw_may_be_wrong(path: tuple[Any, ...], other: object) -> None:
    document = copy.deepcopy(JAWED.json)
    holder = document
    for key in path[:-1]:
        holder = holder[key]
    holder[path[-1]] = other
    assert "\n" not in use(Gltf(document, JAWED.binary).to_glb())


@given(length=st.integers(0, len(GLB) - 1))
def test_a_cut_file_is_refused(length: int) -> None:
    error = use(GLB[:length])
    assert error.startswith("model: ")
    assert "\n" not in error


@given(at=st.integers(0, len(GLB) - 1), byte=st.integers(0, 255))
def test_any_byte_may_be_wrong(at: int, byte: int) -> None:
    assert "\n" not in use(GLB[:at] + bytes([byte]) + GLB[at + 1 :])
