"""Additions lie behind what is there, aligned; accessors read back what was written."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright.errors import FileFormatError
from lipwright.gltf import Gltf, GltfWriter, keep_morphs, morph_meshes, parse_glb, read_accessor
from tests.models import model


def test_old_bytes_and_objects_stay_where_they_were() -> None:
    old = parse_glb(model().to_glb())
    writer = GltfWriter(old)
    index = writer.accessor(np.arange(5, dtype=np.float32), limits=True)
    new = parse_glb(writer.finish().to_glb())
    assert new.binary[: len(old.binary)] == old.binary
    for kind in ("accessors", "bufferViews"):
        assert new.json[kind][: len(old.json[kind])] == old.json[kind]
    assert new.json["meshes"] == old.json["meshes"]
    assert read_accessor(new, index).tolist() == [0, 1, 2, 3, 4]
    assert old.json["buffers"][0]["byteLength"] == len(old.binary)


def test_additions_begin_at_multiples_of_four() -> None:
    writer = GltfWriter()
    writer.view(b"abc")
    index = writer.accessor(np.array([[1, 2, 3]], np.float32))
    made = writer.finish()
    assert made.json["bufferViews"][1]["byteOffset"] == 4
    assert read_accessor(made, index).tolist() == [[1, 2, 3]]


@pytest.mark.parametrize("moved", [0, 3, 90, 100])
def test_sparse_arrays_read_back(moved: int) -> None:
    values = np.zeros((100, 3), np.float32)
    values[:moved] = np.arange(3 * moved).reshape(-1, 3) + 1
    writer = GltfWriter()
    index = writer.sparse(values, limits=True)
    made = parse_glb(writer.finish().to_glb())
    assert np.array_equal(read_accessor(made, index), values)
    assert len(made.binary) <= values.nbytes
    assert made.json["accessors"][index]["max"] == values.max(axis=0).tolist()


def test_strided_and_normalised_arrays_read_back() -> None:
    writer = GltfWriter()
    view = writer.view(bytes([0, 255, 9, 9, 51, 0, 9, 9]))
    writer.json["bufferViews"][view]["byteStride"] = 4
    index = writer.add(
        "accessors",
        {
            "bufferView": view,
            "componentType": 5121,
            "normalized": True,
            "count": 2,
            "type": "VEC2",
        },
    )
    assert read_accessor(writer.finish(), index) == pytest.approx(np.array([[0, 1], [0.2, 0]]))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"count": 1000}, "accessor 0: reaches beyond its data"),
        ({"type": "VEC9"}, r"accessor 0: breaks the structure of glTF \(KeyError: 'VEC9'\)"),
        ({"bufferView": 99}, "accessor 0: breaks the structure of glTF"),
    ],
)
def test_an_accessor_that_lies_is_refused(changes: dict[str, object], message: str) -> None:
    made = model()
    made.json["accessors"][0] |= changes
    with pytest.raises(FileFormatError, match=message):
        read_accessor(made, 0)
    with pytest.raises(FileFormatError, match="accessor 999: does not exist"):
        read_accessor(made, 999)


def moves(made: Gltf, target: int) -> NDArray[np.float32]:
    (primitive,) = made.json["meshes"][0]["primitives"]
    return read_accessor(made, primitive["targets"][target]["POSITION"])


def test_only_some_morph_targets_may_be_kept() -> None:
    names = [f"m{index}" for index in range(20)]
    whole = model(names)
    small = keep_morphs(whole, {"m3", "m7"})
    (mesh,) = morph_meshes(small)
    assert mesh.targets == ("m3", "m7")
    assert len(small.to_glb()) < 0.8 * len(whole.to_glb())
    for old, new in ((3, 0), (7, 1)):
        assert np.array_equal(moves(whole, old), moves(small, new))
    assert read_accessor(small, 0).tolist() == read_accessor(whole, 0).tolist()
    assert morph_meshes(keep_morphs(whole, ())) == ()
    assert len(morph_meshes(whole)[0].targets) == 20


def test_names_of_morph_targets_are_found_where_exporters_put_them() -> None:
    made = model(("a", "b"))
    mesh = made.json["meshes"][0]
    mesh["primitives"][0]["extras"] = mesh.pop("extras")
    assert morph_meshes(made)[0].targets == ("a", "b")
    del mesh["primitives"][0]["extras"]
    (found,) = morph_meshes(made)
    assert found.targets == ("Face[0]", "Face[1]")
    assert not found.named


def test_primitives_that_differ_in_targets_are_refused() -> None:
    made = model()
    mesh = made.json["meshes"][0]
    mesh["primitives"].append({"attributes": {}})
    with pytest.raises(FileFormatError, match="mesh 'Face': its primitives have 0 and 2"):
        morph_meshes(made)


def test_a_weight_at_rest_of_a_node_goes_before_its_mesh() -> None:
    made = model()
    made.json["meshes"][0]["weights"] = [0.25, 0]
    assert morph_meshes(made)[0].weights == ((0.25, 0),)
    made.json["nodes"][0]["weights"] = [0.5, 0.75]
    assert morph_meshes(made)[0].weights == ((0.5, 0.75),)


def test_an_empty_model_grows_a_buffer() -> None:
    writer = GltfWriter(Gltf({"asset": {"version": "2.0"}}, b""))
    writer.view(b"12345")
    assert parse_glb(writer.finish().to_glb()).json["buffers"] == [{"byteLength": 5}]
