"""What markers do to a model: targets that add up, a jaw that follows, all else still."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.character import load_character
from lipwright.character.surfaces import read_surfaces
from lipwright.errors import CharacterError
from lipwright.export import glb
from lipwright.gltf import Gltf, GltfWriter, morph_meshes, parse_glb, read_accessor
from lipwright.marker_faces import MarkerFile, bind, drive, marker_face, read_face_mesh
from lipwright.marker_faces.driving import MarkerFace
from lipwright.performance import Performance, RiggedModel
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Tier
from tests.character.sheets import jawed
from tests.export.validator import issues
from tests.marker_faces.heads import POSES, bound, chosen, driven, head, layout
from tests.marker_layouts import layout_of, recorded

Floats = NDArray[np.float64]
FRONT = np.array([0.0, 0.0, 1.0])


def weights(pose: int) -> dict[str, float]:
    moves = recorded(head(), list(chosen()), POSES)[pose : pose + 1]
    return dict(zip(driven().targets, driven().weights_of(moves)[0].tolist(), strict=True))


def moved(face: MarkerFace, values: dict[str, float], part: str) -> Floats:
    """How a part moves, as a viewer adds up its targets."""
    shown = read_surfaces(face.model, {}, FRONT)
    number = next(i for i, each in enumerate(shown.parts) if each.name.startswith(part))
    rows = shown.part_of == number
    return np.asarray((shown.positions(values) - shown.positions({}))[rows])


def test_targets_do_what_the_markers_do() -> None:
    for pose, shapes in enumerate(POSES):
        true = head().surfaces.positions(shapes) - head().points
        skin = moved(driven(), weights(pose), "skin")
        rows = np.flatnonzero(head().skin)
        marks = np.searchsorted(rows, list(chosen()))
        assert skin[marks] == pytest.approx(true[rows[marks]], abs=2e-4)
        *values, parted = weights(pose).values()
        steps = np.tensordot(values, driven().steps, 1)
        assert parted == 0
        assert skin == pytest.approx(driven().skin.moved(steps), abs=2e-5)
        seen = head().outward[rows] & (head().points[rows, 2] > 0.02)
        off = np.linalg.norm(skin - true[rows], axis=1)[seen]
        assert np.sqrt(np.mean(off**2)) < 0.0012


def test_coefficients_and_displacements_give_the_same_weights() -> None:
    one = np.random.default_rng(0).normal(size=(3, len(layout().basis))) * driven().deviations
    moves = layout().mean + np.tensordot(one, layout().basis, 1)
    flat = moves.reshape(3, -1)
    assert driven().weights(one) == pytest.approx(driven().weights_of(flat), abs=1e-5)


def test_the_lower_teeth_follow_the_chin_and_the_upper_stay() -> None:
    true = head().surfaces.positions(POSES[1]) - head().points
    names = [part.name.split()[0] for part in head().surfaces.parts]
    start = dict(zip(names, head().surfaces.starts, strict=True))
    teeth = moved(driven(), weights(1), "teeth_lower")
    rows = slice(start["teeth_lower"], start["teeth_lower"] + len(teeth))
    assert teeth == pytest.approx(true[rows], abs=0.003)
    assert moved(driven(), weights(1), "tongue")[:, 1].min() < -0.005
    aside = moved(driven(), weights(5), "teeth_lower")[:, 0].mean()
    assert aside > 0.001
    for still in ("teeth_upper", "gums_upper", "eye_left", "hair", "shirt"):
        assert not moved(driven(), weights(1), still).any()


def test_no_lip_follows_the_markers_of_the_other() -> None:
    rows = np.flatnonzero(head().skin)
    sides, marks = head().sides[rows], head().sides[list(chosen())]
    marks[:2] = 0.5  # they are on the corners
    weights = driven().skin.weights
    assert (marks[2:20] == np.repeat((1.0, 0.0), 9)).all()
    assert (weights[np.ix_(sides == 0, marks == 1)] == 0).all()
    assert (weights[np.ix_(sides == 1, marks == 0)] == 0).all()


def test_brows_go_with_the_skin_they_are_on() -> None:
    assert moved(driven(), weights(6), "brows")[:, 1].max() > 0.003
    assert np.abs(moved(driven(), weights(1), "brows")).max() < 0.002


def test_lips_do_not_cross_when_they_open() -> None:
    mouth, rest = head().mouth, head().points
    values = weights(1)
    whole = read_surfaces(driven().model, {}, FRONT).positions(values)
    gaps = whole[mouth.upper, 1] - whole[mouth.lower, 1]
    assert (gaps > rest[mouth.upper, 1] - rest[mouth.lower, 1] - 1e-4).all()
    assert gaps.max() > 0.01


def test_lips_that_press_on_one_another_do_not_cross() -> None:
    moves = recorded(head(), list(chosen()), POSES)
    press = np.zeros_like(moves[:1])
    along = 1.0 - np.linspace(-1.0, 1.0, 9) ** 2
    press[0, 2:11, 1], press[0, 11:20, 1] = -0.002 * along, 0.002 * along
    whole = layout_of(head().points[list(chosen())], np.concatenate([moves, press]))
    made = drive(whole, head(), bound())
    values = dict(zip(made.targets, made.weights_of(press)[0].tolist(), strict=True))
    crossed = closest(made, {**values, "markers lips apart": 0.0})
    assert crossed < -0.003
    assert 0.55 * crossed < closest(made, values) < 0.0


def closest(made: MarkerFace, values: dict[str, float]) -> float:
    """The least distance from the lower lip to the upper, about the middle."""
    mouth = head().mouth
    shown = read_surfaces(made.model, {}, FRONT).positions(values)
    return float((shown[mouth.upper, 1] - shown[mouth.lower, 1])[5:-5].min())


def test_a_model_keeps_what_it_had_and_is_valid(tmp_path: Path) -> None:
    before = {mesh.name: mesh.targets for mesh in morph_meshes(head().model)}
    after = {mesh.name: mesh.targets for mesh in morph_meshes(driven().model)}
    assert after["skin"] == (*before["skin"], *driven().targets)
    assert driven().targets[:2] == ("markers mean", "markers 1")
    assert "hair" not in after
    values = np.stack([list(weights(pose).values()) for pose in range(len(POSES))])
    channels = Animation(driven().targets, values.astype(np.float32), 25.0)
    rigged = RiggedModel("head", driven().model.to_glb(), channels)
    made = glb.encode(Performance(channels, Speech(PhoneTrack(Tier())), lambda: rigged))
    assert issues(made, tmp_path) == []
    animation = parse_glb(made).items("animations")[-1]
    assert len(animation["channels"]) >= 3


def test_a_model_that_is_driven_already_is_refused() -> None:
    twice = replace(head(), model=driven().model)
    with pytest.raises(CharacterError, match="has a morph target 'markers mean' already"):
        drive(layout(), twice, bind(layout(), head()))


def turned_model() -> Gltf:
    """The head as another program exports it: in centimetres, turned, with an animation."""
    writer = GltfWriter(head().model)
    root = next(n for n in writer.json["nodes"] if n.get("children"))
    root["scale"], root["translation"] = [100.0] * 3, [3.0, 150.0, -2.0]
    nodes: list[dict[str, Any]] = writer.json["nodes"]
    skin = next(i for i, node in enumerate(nodes) if node.get("name") == "skin")
    nodes[skin]["rotation"] = [0.0, 0.0, 0.0, 1.0]
    targets = len(head().model.items("meshes")[0]["weights"])
    nodes[skin]["weights"] = [0.0] * targets
    clock = writer.accessor(np.array([0.0, 1.0], np.float32), limits=True)
    output = writer.accessor(np.ones(2 * targets, np.float32))
    channel = {"sampler": 0, "target": {"node": skin, "path": "weights"}}
    writer.add(
        "animations", {"channels": [channel], "samplers": [{"input": clock, "output": output}]}
    )
    return writer.finish()


def test_units_places_and_animations_of_a_model_are_kept(tmp_path: Path) -> None:
    path = tmp_path / "other.glb"
    path.write_bytes(turned_model().to_glb())
    face = read_face_mesh(load_character(path))
    assert face.width == pytest.approx(100 * head().width, rel=0.05)
    found = bind(layout(), face)
    assert found.alignment.scale == pytest.approx(100, rel=0.02)
    made = drive(layout(), face, found)
    skin = moved(made, weights(1), "skin")
    assert skin == pytest.approx(100 * moved(driven(), weights(1), "skin"), abs=0.15)
    unused = {"UNUSED_OBJECT", "UNUSED_MESH_WEIGHTS"}  # the old animation's, replaced
    assert {issue["code"] for issue in issues(made.model.to_glb(), tmp_path)} <= unused
    sampler = made.model.items("animations")[0]["samplers"][0]
    old = len(head().model.items("meshes")[0]["weights"])
    kept = read_accessor(made.model, sampler["output"]).reshape(2, -1)
    assert (kept[:, :old] == 1).all()
    assert kept.shape[1] == old + len(made.targets)
    assert not kept[:, old:].any()


@pytest.mark.parametrize("facing", [1.0, -1.0])
def test_skin_on_joints_goes_where_the_markers_go(facing: float, tmp_path: Path) -> None:
    joint = {"rotation": [0.0, 0.6, 0.0, 0.8], "scale": [2.0, 2.0, 2.0]}
    path = tmp_path / "jawed.glb"
    path.write_bytes(jawed({}, joint, facing=facing).to_glb())
    face = read_face_mesh(load_character(path))
    upper = face.sides > 0.5
    far = np.abs(face.points[:, :2] / (0.02, 0.015))
    rows = [
        int(np.argmin(np.linalg.norm(far - (x, y), axis=1) + 9 * (upper != up)))
        for up in (True, False)
        for x, y in ((0.0, 0.4), (0.5, 0.4), (1.0, 0.4), (0.0, 1.4), (1.0, 1.4))
    ]
    places = face.points[rows]
    moves = np.zeros((2, len(rows), 3))
    moves[1, ~upper[rows], 1] = -0.01
    own = layout_of(places, moves)
    found = {
        label: tuple(point @ face.surfaces.axes)
        for label, point in zip(own.labels, places, strict=True)
    }
    file = MarkerFile("jawed", len(face.points), found)
    made = drive(own, face, bind(own, face, file))
    values = dict(zip(made.targets, made.weights_of(moves[1:])[0].tolist(), strict=True))
    shown = read_surfaces(made.model, {}, face.surfaces.axes[2])
    went = shown.positions(values) - shown.positions({})
    assert went[rows] == pytest.approx(moves[1], abs=1e-5)


def test_one_call_makes_it_all(tmp_path: Path) -> None:
    path = tmp_path / "markers.json"
    bind(layout(), head()).to_file(head()).write(path)
    made = marker_face(load_character("head"), layout(), path)
    assert made.targets == driven().targets
    assert made.steps == pytest.approx(driven().steps)
    assert made.note.startswith("109 markers lie 0.0 mm from the skin")
