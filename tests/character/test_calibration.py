"""Gains are found from the mesh: all characters open alike, and close without crossing."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.character.calibration import CROSSED, OPEN_GAP, TOUCH, WIDTHS, calibrate
from lipwright.character.character import Character, load_character
from lipwright.character.inspect import describe_character, inspect_character
from lipwright.character.vocabulary import POSES
from lipwright.gltf import Gltf
from tests.character.sheets import dropped, face, met, widened

ICT_HEAD = Path(__file__).parents[2] / "../shared/characters/ict_head.glb"


def loaded(made: Gltf) -> Character:
    return Character("face", lambda: made)


def stand(character: Character, **weights: float) -> tuple[float, float, float]:
    """Return gap, contact and width at weights of the controls, through the whole mapping."""
    mouth = character.calibration().mouth
    assert mouth is not None
    frame = Animation(tuple(weights), np.array([list(weights.values())], np.float32), 60.0)
    made = character.rig(frame).channels
    stance = mouth.stand(dict(zip(made.controls, map(float, made.values[0]), strict=True)))
    return stance.gap, stance.contact, stance.width


@pytest.mark.parametrize("drop", [0.0125, 0.02, 0.05])
def test_all_mouths_open_alike(drop: float) -> None:
    character = loaded(face({"jawOpen": dropped(drop), "mouthPucker": widened(-0.6)}))
    assert stand(character, open=0.5)[0] == pytest.approx(OPEN_GAP, abs=0.002)
    assert stand(character, W=1.0)[2] == pytest.approx(WIDTHS["W"], abs=0.01)


@pytest.mark.parametrize(("gap", "way"), [(0.0, 0.004), (0.004, 0.002), (0.004, 0.02)])
def test_closed_lips_touch_and_do_not_cross(gap: float, way: float) -> None:
    moves = {"jawOpen": dropped(0.02), "mouthRollLower": met(way), "mouthRollUpper": met(way)}
    character = loaded(face(moves, gap=gap))
    seen, contact, _ = stand(character, PBM=1.0)
    assert seen <= TOUCH
    assert contact >= CROSSED


def test_lips_that_cannot_be_closed_are_told_of() -> None:
    character = loaded(face({"jawOpen": dropped(0.02), "mouthPressLeft": met(0.0003)}, gap=0.004))
    measured = character.calibration().controls["PBM"]
    assert measured.note.startswith("the lips stay ")
    assert measured.after > TOUCH
    assert "the lips stay" in describe_character(character)


def test_a_rig_that_cannot_open_as_far_is_told_of() -> None:
    measured = loaded(face({"jawOpen": dropped(0.004)})).calibration().controls["open"]
    assert measured.note.startswith("this rig reaches 0.0")
    assert measured.after < measured.wanted


def write(path: Path, gains: str) -> Path:
    head = '{"format": "lipwright/mapping", "version": 1, "name": "mine", "controls": {}, '
    path.write_text(f'{head}"gains": {gains}}}')
    return path


def test_a_users_gain_wins_and_is_marked(tmp_path: Path) -> None:
    model = tmp_path / "face.glb"
    model.write_bytes(face({"jawOpen": dropped(0.02), "mouthPucker": widened(-0.6)}).to_glb())
    plain = inspect_character(load_character(model))
    own = load_character(model, write(tmp_path / "mine.json", '{"open": 0.4}'))
    report = inspect_character(own)
    assert report["controls"]["open"]["gain"] == 0.4
    assert report["calibration"]["controls"]["open"]["note"] == "as the mapping says"
    assert report["controls"]["W"]["gain"] == plain["controls"]["W"]["gain"] != 1
    assert "(as the mapping says)" in describe_character(own)


def test_a_written_mapping_keeps_the_gains_that_were_found(tmp_path: Path) -> None:
    model = tmp_path / "face.glb"
    model.write_bytes(face({"jawOpen": dropped(0.02), "mouthPucker": widened(-0.6)}).to_glb())
    first = load_character(model)
    first.write_mapping(tmp_path / "mine.json")
    again = load_character(model, tmp_path / "mine.json")
    values = np.random.default_rng(5).random((9, 9), dtype=np.float32)
    line = Animation(POSES, values, 60.0)
    assert np.allclose(first.rig(line).channels.values, again.rig(line).channels.values, atol=1e-6)


def test_the_built_in_head_is_the_measure() -> None:
    character = load_character("head")
    _, found = calibrate(character.read_rig(), character.fit())
    for control in ("open", "W", "ShCh", "wide"):
        assert found.controls[control].before == pytest.approx(
            found.controls[control].wanted, abs=0.005
        )
    assert found.controls["PBM"].gain == 1
    assert found.controls["PBM"].after <= TOUCH
    assert character.fit().gains == {}


def test_a_surface_that_cannot_be_read_leaves_gains_alone() -> None:
    made = face({"jawOpen": dropped(0.02)})
    made.json["meshes"][0]["primitives"][0]["indices"] = 999
    character = loaded(made)
    assert character.calibration().reason.startswith("its surface cannot be read (")
    assert character.fit().gains == {}
    assert "calibration: none, its surface" in describe_character(character)


@pytest.mark.shared_data
@pytest.mark.skipif(not ICT_HEAD.exists(), reason="the shared folder is absent")
def test_a_scanned_head_opens_and_closes_as_the_built_in_one() -> None:
    character = load_character(ICT_HEAD)
    found = character.calibration()
    assert found.mouth is not None
    assert found.face is not None
    points = found.face.positions({})
    corners: Sequence[float] = points[list(found.mouth.corners), 0].tolist()
    assert corners == pytest.approx([-0.0235, 0.0235], abs=0.002)
    assert found.controls["PBM"].before < CROSSED
    seen, contact, _ = stand(character, PBM=1.0)
    assert seen <= TOUCH
    assert contact >= CROSSED
    assert stand(character, open=0.5)[0] == pytest.approx(found.controls["open"].wanted, abs=0.003)


@pytest.mark.shared_data
@pytest.mark.skipif(not ICT_HEAD.exists(), reason="the shared folder is absent")
def test_a_scanned_head_makes_a_round_hole_in_uw_and_not_a_broad_slit() -> None:
    character = load_character(ICT_HEAD)
    seen, _, width = stand(character, W=0.88)
    assert width < 0.75
    assert 0.09 < seen < 0.15
