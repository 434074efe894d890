"""Parts become a model whose normals and morph targets are what the shapes say."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lipwright.character.builtin import to_glb
from lipwright.character.mesh import Part
from lipwright.gltf import Gltf, morph_meshes, parse_glb, read_accessor
from tests.models import SKIN, square


def arrays(model: Gltf, mesh: int = 0) -> dict[str, np.ndarray]:
    (primitive,) = model.json["meshes"][mesh]["primitives"]
    found = {name: read_accessor(model, at) for name, at in primitive["attributes"].items()}
    for index, target in enumerate(primitive.get("targets", ())):
        found |= {f"{name} {index}": read_accessor(model, at) for name, at in target.items()}
    found["indices"] = read_accessor(model, primitive["indices"])
    return found


def sphere(size: int = 24) -> Part:
    around, down = np.meshgrid(np.linspace(0, 2 * np.pi, size, endpoint=False), range(1, size))
    height = np.pi * down / size
    points = np.stack(
        (np.cos(around) * np.sin(height), np.cos(height), -np.sin(around) * np.sin(height)), axis=-1
    )
    numbers = np.arange(points[..., 0].size).reshape(size - 1, size)
    a, d = numbers[:-1], numbers[1:]
    b, c = np.roll(a, -1, axis=1), np.roll(d, -1, axis=1)
    triangles = np.stack((a, d, c, a, c, b), axis=-1).reshape(-1, 3).astype(np.uint32)
    positions = points.reshape(-1, 3).astype(np.float32)
    return Part("Ball", positions, triangles, SKIN, {"grow": positions.copy()}, None)


def test_normals_of_a_ball_point_outwards_and_stay_when_it_grows() -> None:
    part = sphere()
    found = arrays(parse_glb(to_glb([part], "Ball")))
    inner = np.abs(part.positions[:, 1]) < 0.9
    assert np.abs(found["NORMAL"] - part.positions)[inner].max() < 0.02
    assert np.linalg.norm(found["NORMAL"], axis=1).max() < 1 + 1e-6
    assert not found["NORMAL 0"].any()
    assert np.array_equal(found["POSITION 0"], part.positions)


def test_a_moved_vertex_turns_the_normals_around_it() -> None:
    part = square("Face", ["lift"] * 1, size=6)
    moves = np.zeros_like(part.positions)
    moves[14] = (0, 0, 0.01)
    part = replace(part, morphs={"lift": moves})
    found = arrays(parse_glb(to_glb([part], "Head")))
    lifted = replace(part, positions=part.positions + moves, morphs={})
    whole = arrays(parse_glb(to_glb([lifted], "Head")))["NORMAL"]
    assert np.abs(found["NORMAL"] + found["NORMAL 0"] - whole).max() < 2e-3
    turned = np.flatnonzero(found["NORMAL 0"].any(axis=1))
    assert {13, 15, 8, 20} <= set(turned)
    assert set(turned) <= {7, 8, 13, 14, 15, 20, 21}


def test_names_colours_materials_and_nodes_are_written() -> None:
    face = square("Face", ["open", "W"])
    colored = replace(face, colors=np.full((36, 3), 0.5, np.float32))
    teeth = replace(square("Teeth", ["open"]), material=replace(SKIN, name="Enamel"))
    made = parse_glb(to_glb([colored, teeth, replace(face, name="Copy")], "Head"))
    assert [mesh.targets for mesh in morph_meshes(made)] == [
        ("open", "W"),
        ("open",),
        ("open", "W"),
    ]
    assert np.all(arrays(made)["COLOR_0"] == 0.5)
    assert [material["name"] for material in made.json["materials"]] == ["Skin", "Enamel"]
    root = made.json["nodes"][made.json["scenes"][0]["nodes"][0]]
    assert root == {"name": "Head", "children": [0, 1, 2]}
    assert made.json["asset"]["generator"] == "Lipwright"


def test_only_wanted_morph_targets_are_written() -> None:
    made = parse_glb(to_glb([square("Face", ["open", "W", "FV"])], "Head", {"FV", "open"}))
    assert morph_meshes(made)[0].targets == ("open", "FV")
    assert morph_meshes(parse_glb(to_glb([square("Face", ["open"])], "Head", ()))) == ()


def test_the_same_parts_give_the_same_bytes() -> None:
    assert to_glb([sphere()], "Ball") == to_glb([sphere()], "Ball")
