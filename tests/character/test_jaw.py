"""A jaw joint opens the mouth where no morph target does."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.character.calibration import OPEN_GAP
from lipwright.character.character import Character, load_character
from lipwright.character.fitting import EXACT, MISSING, STAND_IN, fit
from lipwright.character.inspect import describe_character, inspect_character
from lipwright.character.rig import read_rig
from lipwright.errors import CharacterError
from lipwright.gltf import Gltf
from lipwright.performance import JointTurn
from tests.character.sheets import dropped, jawed, widened
from tests.character_files import write_character, write_mapping

QUARTER = 0.5**0.5


def gap(character: Character, **weights: float) -> float:
    mouth = character.calibration().mouth
    assert mouth is not None
    return mouth.stand(character.fit().values(weights)).gap


@pytest.mark.parametrize(
    ("joint", "facing", "axis"),
    [
        ({}, 1.0, (1, 0, 0)),
        ({}, -1.0, (-1, 0, 0)),
        ({"rotation": [0, 0, QUARTER, QUARTER]}, 1.0, (0, -1, 0)),
        ({"rotation": [0, QUARTER, 0, QUARTER]}, 1.0, (0, 0, 1)),
        ({"scale": [2, 2, 2]}, 1.0, (1, 0, 0)),
    ],
)
def test_the_axis_is_found_from_how_the_joint_stands(
    joint: dict[str, Any], facing: float, axis: tuple[float, ...]
) -> None:
    made = jawed({}, joint, "Bip01_Jaw", facing)
    jaw = read_rig(made).jaw
    assert jaw is not None
    assert jaw.name == "Bip01_Jaw"
    assert jaw.axis == pytest.approx(axis, abs=1e-6)
    character = Character("face", lambda: made)
    assert gap(character) == pytest.approx(0, abs=1e-6)
    assert gap(character, open=0.5) == pytest.approx(OPEN_GAP, abs=0.002)
    assert gap(character, open=0.5, PBM=1) == pytest.approx(0, abs=1e-6)


def test_a_jaw_alone_speaks_and_says_what_it_cannot() -> None:
    character = Character("face", lambda: jawed({}))
    report = inspect_character(character)
    status = {control: made["status"] for control, made in report["controls"].items()}
    assert report["vocabulary"] == "jaw"
    assert status["open"] == status["PBM"] == status["W"] == STAND_IN
    assert status["wide"] == status["tRoof"] == MISSING
    assert report["joints"] == {"Jaw": {"joint": "Jaw", "axis": [1, 0, 0], "degrees": 20}}
    text = describe_character(character)
    assert "joint: 'Jaw' turns by 20° about its own (1, 0, 0) when 'Jaw' is 1" in text
    assert max(map(len, text.splitlines())) <= 80


def test_a_jaw_stands_in_for_the_target_that_opens() -> None:
    fitting = fit(read_rig(jawed({"mouthPucker": widened(-0.5), "mouthFunnel": widened(-0.1)})))
    assert fitting.vocabulary == "arkit"
    assert fitting.controls["open"].status == STAND_IN
    assert fitting.controls["open"].weights == {"Jaw": 0.7}
    assert "Jaw instead of jawOpen" in fitting.controls["open"].note
    assert fitting.controls["W"].status == EXACT


def test_a_jaw_is_left_alone_where_a_target_opens() -> None:
    made = jawed({"jawOpen": dropped(0.02)})
    fitting = fit(read_rig(made))
    assert fitting.joints == {}
    text = describe_character(Character("face", lambda: made))
    assert "joints like a jaw (not driven): Jaw" in text


def test_what_a_vrm_file_calls_its_jaw_is_the_jaw() -> None:
    made = jawed({}, None, "J_Adj_C_Chin")
    assert read_rig_or_none(made) is None
    humanoid = {"humanoid": {"humanBones": {"jaw": {"node": 3}}}}
    vrm = Gltf({**made.json, "extensions": {"VRMC_vrm": humanoid}}, made.binary)
    jaw = read_rig(vrm).jaw
    assert jaw is not None
    assert jaw.name == "J_Adj_C_Chin"


def read_rig_or_none(made: Gltf) -> JointTurn | None:
    try:
        return read_rig(made).jaw
    except CharacterError:
        return None


def mapping(path: Path, joints: str, controls: str = '{"open": {"Jaw": 1}}') -> Path:
    head = '{"format": "lipwright/mapping", "version": 1, "name": "mine", '
    path.write_text(f'{head}"controls": {controls}, "joints": {joints}}}')
    return path


def saved(tmp_path: Path, made: Gltf) -> Path:
    path = tmp_path / "face.glb"
    path.write_bytes(made.to_glb())
    return path


def test_a_mapping_says_how_a_joint_turns(tmp_path: Path) -> None:
    model = saved(tmp_path, jawed({"jawOpen": dropped(0.02)}, None, "chin"))
    own = mapping(
        tmp_path / "m.json", '{"Jaw": {"joint": "chin", "axis": [2, 0, 0], "degrees": 9}}'
    )
    character = load_character(model, own)
    values = np.array([[0.0], [0.5]], np.float32)
    rigged = character.rig(Animation(("open",), values, 60.0))
    assert rigged.joints == {"Jaw": JointTurn(3, "chin", (1.0, 0.0, 0.0), 9.0)}
    assert rigged.channels.controls == ("Jaw",)
    assert rigged.channels.values.tolist() == values.tolist()


def test_a_mapping_may_use_the_jaw_that_was_found(tmp_path: Path) -> None:
    model = saved(tmp_path, jawed({"jawOpen": dropped(0.02)}))
    fitting = load_character(model, mapping(tmp_path / "m.json", "{}")).fit()
    assert fitting.weights_of("open") == {"Jaw": 1.0}
    assert fitting.joints["Jaw"].degrees == 20


def test_what_a_mapping_leaves_open_is_found(tmp_path: Path) -> None:
    model = saved(tmp_path, jawed({"jawOpen": dropped(0.02)}, None, "chin"))
    own = mapping(tmp_path / "m.json", '{"Jaw": {"joint": "chin"}}')
    assert load_character(model, own).fit().joints["Jaw"].axis == pytest.approx((1, 0, 0))


@pytest.mark.parametrize(
    ("joints", "message"),
    [
        ('{"Jaw": {"joint": "Jow"}}', r"joints.Jaw: the model has no joint 'Jow'; .* mean 'Jaw'"),
        ('{"Jaw": {"joint": "Empty"}}', "the joint 'Empty' carries no vertices. Give its"),
    ],
)
def test_a_joint_that_is_not_there_is_refused(tmp_path: Path, joints: str, message: str) -> None:
    made = jawed({"jawOpen": dropped(0.02)})
    made.json["nodes"].append({"name": "Empty"})
    model, own = saved(tmp_path, made), mapping(tmp_path / "m.json", joints)
    with pytest.raises(CharacterError, match=message):
        load_character(model, own)


def test_a_written_mapping_holds_the_joint(tmp_path: Path) -> None:
    model = saved(tmp_path, jawed({}))
    first = load_character(model)
    first.write_mapping(tmp_path / "mine.json")
    assert '"Jaw": {"joint": "Jaw", "axis": [1, 0, 0], "degrees": 20}' in (
        tmp_path / "mine.json"
    ).read_text("utf-8")
    again = load_character(model, tmp_path / "mine.json")
    assert again.fit().joints == first.fit().joints
    assert again.fit().values({"open": 0.5}) == first.fit().values({"open": 0.5})


def test_a_character_file_may_use_the_joints_of_a_mapping_file(tmp_path: Path) -> None:
    saved(tmp_path, jawed({"jawOpen": dropped(0.02)}, None, "chin"))
    write_mapping(tmp_path / "m.json", joints={"Drop": {"joint": "chin", "degrees": 12}})
    rows = {"open": {"Drop": 0.5, "jawOpen": 0.5}}
    path = write_character(tmp_path / "c.json", model="face.glb", mapping=["m.json", rows])
    fitting = load_character(path).fit()
    assert fitting.weights_of("open") == {"Drop": 0.5, "jawOpen": 0.5}
    assert fitting.joints["Drop"].degrees == 12
    write_character(tmp_path / "d.json", base="c.json", mapping={"wide": {"Drop": 0.1}})
    assert load_character(tmp_path / "d.json").fit().weights_of("wide") == {"Drop": 0.1}
    write_character(tmp_path / "d.json", base="c.json", mapping={"wide": {"Dorp": 0.1}})
    with pytest.raises(CharacterError, match=r"d.json, at mapping: .* no channel 'Dorp'"):
        load_character(tmp_path / "d.json")
