"""Characters are loaded, described and rigged; what cannot speak is refused."""

from __future__ import annotations

import json
from pathlib import Path
from time import process_time

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.character.between import between_names, betweens
from lipwright.character.character import Character, load_character
from lipwright.character.inspect import describe_character, inspect_character
from lipwright.character.mapping import read_mapping
from lipwright.character.vocabulary import POSES
from lipwright.errors import CharacterError, InputError
from lipwright.gltf import Gltf, morph_meshes, parse_glb
from tests.character.sheets import dropped, face
from tests.models import model

SHARED = Path(__file__).parents[2] / "../shared"
ICT_HEAD = SHARED / "characters" / "ict_head.glb"


def saved(tmp_path: Path, made: Gltf, name: str = "face.glb") -> Path:
    path = tmp_path / name
    path.write_bytes(made.to_glb())
    return path


def test_a_file_becomes_a_character(tmp_path: Path) -> None:
    path = saved(tmp_path, model(("jawOpen", "mouthPucker")), "Gesicht é.vrm")
    character = load_character(path)
    rigged = character.rig(Animation(("open",), np.ones((2, 1), np.float32), 60.0))
    assert rigged.name == "Gesicht é"
    assert parse_glb(rigged.glb).json == model(("jawOpen", "mouthPucker")).json
    assert "jawOpen" in rigged.channels.controls


def test_the_head_is_built_in_and_speaks_every_pose_as_it_is() -> None:
    character = load_character("head")
    values = np.random.default_rng(2).random((4, 9), dtype=np.float32)
    rigged = character.rig(Animation(POSES, values, 60.0))
    assert rigged.channels.controls == (*POSES, "open@50")
    assert np.array_equal(rigged.channels.values[:, :-1], values)
    between = 1 - np.abs(2 * values[:, POSES.index("open")] - 1)
    assert rigged.channels.control("open@50") == pytest.approx(between, abs=1e-6)
    shown = {name for mesh in morph_meshes(parse_glb(rigged.glb)) for name in mesh.targets}
    assert set(POSES) <= shown
    assert {c["status"] for c in inspect_character(character)["controls"].values()} == {"exact"}


NO_MORPHS = model(())
NO_MESH = model(meshes=[], nodes=[{"name": "Head"}])
JAW_BONE = model(
    (),
    nodes=[{"mesh": 0}, {"name": "Bip01 Jaw"}],
    skins=[{"joints": [1]}],
)


@pytest.mark.parametrize(
    ("made", "message"),
    [
        (NO_MESH, "holds no mesh; expected a head to animate"),
        (
            NO_MORPHS,
            "has no morph targets and no jaw that turns; expected a head with.*blend shapes",
        ),
        (JAW_BONE, r"no jaw that turns \(its joint 'Bip01 Jaw' carries no vertices\)"),
    ],
)
def test_a_model_that_cannot_move_a_mouth_is_refused(
    tmp_path: Path, made: Gltf, message: str
) -> None:
    path = saved(tmp_path, made)
    with pytest.raises(CharacterError, match=message) as caught:
        load_character(path)
    assert str(caught.value).startswith(str(path))


def test_an_unknown_character_and_a_missing_file_are_told_apart(tmp_path: Path) -> None:
    with pytest.raises(CharacterError, match="no character 'crap'; expected head"):
        load_character("crap")
    with pytest.raises(InputError, match=r"crab\.glb: no such file"):
        load_character(tmp_path / "crab.glb")


def test_a_rig_without_known_shapes_is_refused_once_it_must_speak(tmp_path: Path) -> None:
    path = saved(tmp_path, model(("smirk", "frown")))
    character = load_character(path)
    with pytest.raises(CharacterError, match=r"face\.glb: none of the controls .* \(smirk, frown"):
        character.check(POSES)
    assert "vocabulary: none that Lipwright knows" in describe_character(character)
    assert inspect_character(character)["unused"] == ["smirk", "frown"]
    character.check(("frown",))


def test_a_mapping_written_to_be_edited_gives_the_same_and_obeys_the_edit(tmp_path: Path) -> None:
    names = ("Head_jawOpen", "Head_mouthPucker", "mouthSmile_L", "mouthSmile_R")
    path = saved(tmp_path, model(names))
    edited = tmp_path / "mine.json"
    load_character(path).write_mapping(edited)
    values = np.random.default_rng(3).random((3, 9), dtype=np.float32)
    line = Animation(POSES, values, 60.0)
    plain = load_character(path).rig(line).channels
    again = load_character(path, edited).rig(line).channels
    assert np.array_equal(plain.control("Head_jawOpen"), again.control("Head_jawOpen"))
    document = json.loads(edited.read_text("utf-8"))
    assert document["controls"]["wide"] == {"mouthSmile_L": 0.7, "mouthSmile_R": 0.7}
    document["controls"]["open"] = {"Head_mouthPucker": 1}
    edited.write_text(json.dumps(document))
    assert read_mapping(edited).name == "face"
    moved = load_character(path, edited).rig(Animation(("open",), values[:, :1], 60.0)).channels
    assert moved.controls == ("Head_mouthPucker",)


def test_a_mapping_that_does_not_fit_is_refused_on_loading(tmp_path: Path) -> None:
    path, own = saved(tmp_path, model()), tmp_path / "mine.json"
    own.write_text(
        '{"format": "lipwright/mapping", "version": 1, "name": "m", "controls": {"W": {"zz": 1}}}'
    )
    with pytest.raises(CharacterError, match=r"mine\.json: the model has no channel 'zz'"):
        load_character(path, own)


def test_the_description_fits_a_terminal_and_says_what_is_missing(tmp_path: Path) -> None:
    names = ("jawOpen", "mouthFunnel", "mouthPressLeft", "mouthPressRight", "mouthRollLower")
    text = describe_character(load_character(saved(tmp_path, model(names))))
    assert max(map(len, text.splitlines())) <= 80
    assert "vocabulary: arkit, 4 of the 13 channels" in text
    assert "0.7 mouthPressLeft/Right" in text
    assert "W       stand-in  0.6 mouthFunnel" in text
    assert "(lacks tongueOut)" in text


@pytest.mark.shared_data
@pytest.mark.skipif(not ICT_HEAD.exists(), reason="the shared folder is absent")
def test_the_scanned_head_is_found_to_speak_arkit() -> None:
    report = inspect_character(load_character(ICT_HEAD))
    assert report["vocabulary"] == "arkit"
    missing = [c for c, made in report["controls"].items() if made["status"] == "missing"]
    assert missing == ["tBack", "tRoof", "tTeeth"]
    assert len(report["meshes"]) == 5


def test_thousands_of_targets_are_read_at_once(tmp_path: Path) -> None:
    path = saved(tmp_path, model(("jawOpen", "jawOpen@50", *(f"wrinkle{n}" for n in range(4000)))))
    before = process_time()
    character = load_character(path)
    assert character.fit().weights_of("open")
    assert process_time() - before < 5
    targets = character.read_rig().targets
    assert len(targets) == 4001
    assert "jawOpen@50" not in targets


def test_a_surface_of_no_numbers_is_not_measured() -> None:
    made = face({"jawOpen": dropped(0.02)})
    place = made.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]
    view = made.json["bufferViews"][made.json["accessors"][place]["bufferView"]]
    start = view.get("byteOffset", 0)
    broken = made.binary[:start] + b"\x00\x00\xc0\x7f" + made.binary[start + 4 :]
    found = Character("face", lambda: Gltf(made.json, broken)).calibration()
    assert found.mouth is None
    assert found.reason == (
        "its surface cannot be read (places of vertices that are no finite numbers)"
    )


def test_no_name_is_no_character() -> None:
    with pytest.raises(CharacterError, match="no character; expected head, crab, or a file"):
        load_character("")


def test_in_betweens_are_those_of_one_spelling() -> None:
    names = ["open", "open@50", "open@50.0", "open@05", "W@50"]
    assert betweens(names) == {"open": [0.5]}
    assert between_names(names) == {"open@50"}
