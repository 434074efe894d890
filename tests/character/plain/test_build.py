"""Morph targets made for plain meshes, as a face file says."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright import animate, say
from lipwright.character.builtin import to_gltf
from lipwright.character.head import build_head
from lipwright.character.plain import BuiltFace, build_face
from lipwright.cli import main
from lipwright.gltf import Gltf, GltfWriter, morph_meshes, read_accessor
from tests.character.plain.files import face, glb, lip, written
from tests.export.validator import issues

Floats = NDArray[np.float64]


def displaced(model: Gltf, mesh: str, target: str) -> tuple[Floats, Floats]:
    """Points of a mesh and their displacement, (V, 3) each, in the mesh's own axes."""
    found = next(one for one in morph_meshes(model) if one.name == mesh)
    primitive = model.items("meshes")[found.index]["primitives"][0]
    points = read_accessor(model, primitive["attributes"]["POSITION"])
    accessor = primitive["targets"][found.targets.index(target)]["POSITION"]
    return points.astype(np.float64), read_accessor(model, accessor).astype(np.float64)


def loss(built: BuiltFace, name: str) -> tuple[float, float]:
    one = next(one for one in built.losses if one.name == name)
    return one.linear, one.with_between


def test_lips_that_lie_on_each_other_part(tmp_path: Path) -> None:
    model = build_face(written(tmp_path)).model
    assert [mesh.name for mesh in morph_meshes(model)] == ["upper", "lower"]
    points, moved = displaced(model, "lower", "open")
    line = np.isclose(points[:, 1], 0)
    # 30 degrees about an axis 6 cm behind the lips.
    assert moved[line & (points[:, 0] == 0), 1] == pytest.approx(-0.06 * 0.5, abs=1e-6)
    assert (moved[line, 1] < -0.02).all()
    assert morph_meshes(model)[0].targets == ("W", "oo")


def test_a_mouth_narrows_about_its_middle(tmp_path: Path) -> None:
    points, moved = displaced(build_face(written(tmp_path)).model, "upper", "W")
    corner = points[:, 0].argmax()
    near = np.isclose(points[:, 1], 0)
    assert moved[near & (points[:, 0] == 0)] == pytest.approx(np.array([[0, 0, 0.01]]), abs=1e-6)
    assert -0.015 < moved[corner, 0] < -0.005


def test_mixtures_are_basic_expressions_at_an_intensity(tmp_path: Path) -> None:
    model = build_face(written(tmp_path)).model
    _, rounded = displaced(model, "upper", "W")
    _, mixed = displaced(model, "upper", "oo")
    np.testing.assert_allclose(mixed, 0.8 * rounded, atol=1e-8)
    _, opened = displaced(model, "lower", "open")
    _, lower = displaced(model, "lower", "W")
    _, mixed = displaced(model, "lower", "oo")
    # A fifth of the angle, not a fifth of the chord.
    assert 1e-5 < np.abs(mixed - (0.8 * lower + 0.2 * opened)).max() < 2e-3


def test_in_betweens_bring_back_the_arc(tmp_path: Path) -> None:
    linear, bent = loss(build_face(written(tmp_path)), "open")
    assert linear == pytest.approx(np.sqrt(0.06**2 + 0.03**2) * (1 - np.cos(np.pi / 12)), rel=0.1)
    assert bent < 0.3 * linear
    more = face(between={"open": [0.25, 0.5, 0.75]})
    assert loss(build_face(written(tmp_path, more)), "open")[1] < 0.1 * linear
    none = build_face(written(tmp_path, face(between={})))
    assert loss(none, "open") == (linear, linear)


def test_single_vertices_move_by_their_own(tmp_path: Path) -> None:
    own = face(
        clusters={"rim": [{"part": "upper", "vertices": [0, 3]}]},
        expressions={
            "curl": [
                {
                    "cluster": "rim",
                    "shifts": [[0, 1, 0], [0, 0, 2]],
                    "degrees": [0, 90],
                    "turn": {"degrees": 0, "axis": [0, 0, 1], "pivot": [-1, 0, 0]},
                }
            ]
        },
        mixtures={},
        between={},
    )
    points, moved = displaced(build_face(written(tmp_path, own)).model, "upper", "curl")
    np.testing.assert_allclose(moved[0], [0, 0.01, 0], atol=1e-8)
    np.testing.assert_allclose(points[3] + moved[3], [-0.01, 0.01, 0.02], atol=1e-8)
    assert np.count_nonzero(moved.any(axis=1)) == 2


def test_a_glb_keeps_what_it_holds_wherever_its_node_stands(tmp_path: Path) -> None:
    writer = GltfWriter(glb(scale=1.0))
    for node in writer.json["nodes"][:2]:  # turned a quarter about z, in centimetres
        node["rotation"] = [0, 0, np.sqrt(0.5), np.sqrt(0.5)]
        node["scale"] = [0.01, 0.01, 0.01]
    writer.json["meshes"][0]["extras"] = {"owner": "kept"}
    (tmp_path / "lips.glb").write_bytes(writer.finish().to_glb())
    flat = face(
        model="lips.glb",
        unit=1,
        clusters={"all": [{"part": "upper"}]},
        expressions={"up": [{"cluster": "all", "shift": [0, 0.01, 0]}]},
        mixtures={},
        between={},
    )
    model = build_face(written(tmp_path, flat)).model
    _, moved = displaced(model, "upper", "up")
    np.testing.assert_allclose(moved, np.tile([1.0, 0.0, 0.0], (len(moved), 1)), atol=1e-6)
    assert model.items("meshes")[0]["extras"] == {"owner": "kept", "targetNames": ["up"]}
    assert "targets" not in model.items("meshes")[1]["primitives"][0]
    assert issues(model.to_glb(), tmp_path) == []


def test_seams_do_not_tear(tmp_path: Path) -> None:
    upper = lip("upper", 1.0)
    split = upper.positions[upper.triangles.ravel()]  # every triangle with corners of its own
    lines = ["o upper", *("v {:.4f} {:.4f} {:.4f}".format(*point) for point in split)]
    lines += [f"f {k + 1} {k + 2} {k + 3}" for k in range(0, len(split), 3)]
    along = face(
        clusters={"jaw": [{"along": {"point": [0, 0, 0], "radius": 2.5}}]},
        expressions={"open": [{"cluster": "jaw", "shift": [0, 1, 0]}]},
        mixtures={},
        between={},
    )
    path = written(tmp_path, along)
    (tmp_path / "lips.obj").write_text("\n".join(lines))
    points, moved = displaced(build_face(path).model, "upper", "open")
    assert np.count_nonzero(moved) > 6
    places, place = np.unique(points, axis=0, return_inverse=True)
    for number in range(len(places)):
        assert np.ptp(moved[place.reshape(-1) == number], axis=0).max() < 1e-9


def test_a_plain_head_speaks(tmp_path: Path) -> None:
    skin = [part for part in build_head() if part.name == "skin"]
    (tmp_path / "bust.glb").write_bytes(to_gltf(skin, "Bust", keep=()).to_glb())
    jaw = {"degrees": 15, "axis": [1, 0, 0], "pivot": [0, -0.016, 0.004]}
    lips = {"sphere": {"center": [0, -0.0685, 0.09], "radius": 0.042, "core": 0.35}}
    low = {"along": {"point": [0, -0.095, 0.085], "radius": 0.105, "core": 0.3}}
    bust = face(
        model="bust.glb",
        unit=1,
        clusters={
            "jaw": [
                low,
                {"plane": {"point": [0, -0.06, 0], "normal": [0, -1, 0.35], "fade": 0.02}},
            ],
            "lips": [lips],
        },
        expressions={
            "open": [{"cluster": "jaw", "turn": jaw}],
            "W": [{"cluster": "lips", "shift": [0, 0, 0.007]}],
        },
        mixtures={},
        between={"open": [0.5]},
    )
    out = tmp_path / "speaking bust.glb"
    assert main(["character", "build", str(written(tmp_path, bust)), "-o", str(out)]) == 0
    assert issues(out.read_bytes(), tmp_path) == []
    rigged = animate(say("papa"), character=out).rig()
    channels = rigged.channels
    assert {"open", "W", "open@50"} <= set(channels.controls)
    opened = channels.control("open")
    assert opened.max() > 0.3
    np.testing.assert_allclose(channels.control("open@50"), 1 - np.abs(2 * opened - 1), atol=1e-6)


def test_the_command_tells_what_it_made(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = written(tmp_path)
    out = tmp_path / "lips.glb"
    assert main(["character", "build", str(path), "-o", str(out)]) == 0
    told = capsys.readouterr().out
    assert "3 morph targets" in told
    assert "with in-betweens" in told
    assert main(["character", "build", str(path), "-o", str(out), "--json"]) == 0
    targets = json.loads(capsys.readouterr().out)["targets"]
    assert [one["name"] for one in targets] == ["open", "W", "oo"]
    assert issues(out.read_bytes(), tmp_path) == []


def edited(**expression: object) -> dict[str, object]:
    return face(expressions={"open": [{"cluster": "jaw", **expression}]}, mixtures={}, between={})


BAD = {
    "no such model": (face(model="none.obj"), "none.obj: no such file"),
    "no unit": (face(unit=0), "at unit: 0 metres per unit; expected more than 0"),
    "no expression": (face(expressions={}), "at expressions: nothing"),
    "no cluster": (face(clusters={}), "no cluster 'jaw'"),
    "an empty cluster": (face(clusters={"jaw": []}), "at clusters.jaw: no region"),
    "an empty region": (face(clusters={"jaw": [{}]}), "sphere, along, box, plane or part"),
    "no radius": (
        face(clusters={"jaw": [{"sphere": {"center": [0, 0, 0], "radius": 0}}]}),
        "radius 0, core 0",
    ),
    "a vertex too many": (
        face(clusters={"jaw": [{"part": "upper", "vertices": [99]}], "mouth": [{"part": "upper"}]}),
        "no vertex 99 in 'upper'; expected 0 to 27",
    ),
    "no axis": (
        edited(turn={"degrees": 3, "axis": [0, 0, 0], "pivot": [0, 0, 0]}),
        "turn.axis: no direction",
    ),
    "no movement": (edited(), "at expressions.open[0]: no movement"),
    "not finite": (edited(shift=[0, 1e999, 0]), "face.json"),
    "a typing mistake": (edited(shfit=[0, 1, 0]), "shfit"),
    "nothing moves": (
        face(clusters={"jaw": [{"part": "chin"}], "mouth": [{"part": "chin"}]}),
        "the expression 'open' moves nothing",
    ),
    "a mixture of nothing": (face(mixtures={"x": {"smile": 1}}), "no expression 'smile'"),
    "a mixture's name": (face(mixtures={"W": {"open": 1}}), "at mixtures.W"),
    "in-betweens": (face(between={"open": [0.5, 0.2]}), "rising numbers between 0 and 1"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_face_files_are_refused(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    content, told = BAD[name]
    out = tmp_path / "out.glb"
    assert main(["character", "build", str(written(tmp_path, content)), "-o", str(out)]) == 1
    error = capsys.readouterr().err
    assert told in error
    assert error.count("\n") == 1
    assert not out.exists()


OBJ = {
    "no face": ("v 0 0 0\n", "holds no face"),
    "a word": ("v 0 0 zero\n", "lips.obj, line 1: 'v 0 0 zero'; expected v and three numbers"),
    "a vertex that is not there": ("v 0 0 0\nf 1 2 3\n", "line 2"),
    "no bytes": ("", "holds no face"),
    "not finite": ("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a position is not finite"),
}


@pytest.mark.parametrize("name", OBJ)
def test_bad_meshes_are_refused(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    content, told = OBJ[name]
    path = written(tmp_path)
    (tmp_path / "lips.obj").write_text(content)
    assert main(["character", "build", str(path), "-o", str(tmp_path / "out.glb")]) == 1
    assert told in capsys.readouterr().err


def test_a_name_that_the_model_has_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = written(tmp_path)
    out = tmp_path / "lips.glb"
    assert main(["character", "build", str(path), "-o", str(out)]) == 0
    written(tmp_path, face(model="lips.glb"))
    assert main(["character", "build", str(path), "-o", str(tmp_path / "two.glb")]) == 1
    assert "has a morph target 'W' already" in capsys.readouterr().err


def test_obj_polygons_and_negative_indices(tmp_path: Path) -> None:
    path = written(
        tmp_path,
        face(
            clusters={"all": [{"part": "skin"}]},
            expressions={"up": [{"cluster": "all", "shift": [0, 1, 0]}]},
            mixtures={},
            between={},
        ),
    )
    text = "usemtl skin\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4/1/1 -3//2 -2 -1 # a square\n"
    (tmp_path / "lips.obj").write_text("mtllib lips.mtl\n" + text)
    (tmp_path / "lips.mtl").write_text("newmtl skin\nKd 1 0.5 0\n")
    model = build_face(path).model
    mesh = model.items("meshes")[0]["primitives"][0]
    assert len(read_accessor(model, mesh["indices"])) == 6
    color = model.items("materials")[0]["pbrMetallicRoughness"]["baseColorFactor"]
    assert color == pytest.approx([1.0, 0.5**2.2, 0.0, 1.0])
