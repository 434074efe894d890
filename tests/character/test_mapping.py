"""Mappings: their files, how they fit a rig, and what they make of an animation."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.character.builtin import to_gltf
from lipwright.character.fitting import EXACT, MISSING, PARTLY, STAND_IN, Fitting, fit
from lipwright.character.mapping import JointChannel, Mapping, read_mapping
from lipwright.character.rig import Rig, read_rig
from lipwright.character.vocabulary import POSES, vocabularies
from lipwright.errors import CharacterError, FileFormatError
from lipwright.gltf import Gltf
from tests.models import model, square

ARKIT = [
    *("jawOpen", "mouthClose", "mouthFunnel", "mouthPucker", "mouthRollLower", "mouthRollUpper"),
    *("mouthShrugLower", "mouthSmileLeft", "mouthSmileRight", "mouthDimpleLeft"),
    *("mouthDimpleRight", "mouthStretchLeft", "mouthStretchRight", "mouthPressLeft"),
    *("mouthPressRight", "mouthLowerDownLeft", "mouthLowerDownRight", "mouthUpperUpLeft"),
    *("mouthUpperUpRight", "tongueOut", "browInnerUp", "eyeBlinkLeft", "eyeWideLeft"),
]
OCULUS = ["sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "I", "O", "U"]


def rig(*targets: str) -> Rig:
    return read_rig(model(targets))


def frames(**controls: float) -> Animation:
    return Animation(tuple(controls), np.array([list(controls.values())], np.float32), 60.0)


def driven(fitting: Fitting, **controls: float) -> dict[str, float]:
    made = fitting.drive(frames(**controls))
    return dict(zip(made.controls, made.values[0].tolist(), strict=True))


@pytest.mark.parametrize(
    ("targets", "vocabulary"),
    [
        (POSES, "facefx"),
        (ARKIT, "arkit"),
        ([f"Head_{name}" for name in ARKIT], "arkit"),
        ([*(f"viseme_{name}" for name in OCULUS), "mouthOpen", "mouthSmile"], "oculus15"),
        ([*ARKIT, *(f"viseme_{name}" for name in OCULUS)], "arkit"),
        (["aa", "ih", "ou", "ee", "oh"], "vrm1"),
        ([f"Face.M_F00_Fcl_MTH_{vowel}" for vowel in "AIUEO"], "vrm0"),
        (["あ", "い", "う", "え", "お", "まばたき"], "vrm0"),
        (["mouthOpen", "mouthSmile"], "arkit"),
        (["eyeWide_L", "browUp", "smirk"], ""),
        ([f"mouth_{shape}" for shape in "ABCDEFGHX"], "rhubarb"),
        ([f"Mouth.{shape}" for shape in "ABCDEF"], "rhubarb"),
        (["AI", "O", "E", "U", "etc", "L", "WQ", "MBP", "FV", "rest"], "preston_blair"),
        (["MBP", "NLTDR", "FV", "TH", "GK", "SH", "O", "EHSZ", "AA", "IY"], "fleming_dobbs"),
        (["AE", "Ah", "B_M_P", "Ch_J", "EE", "F_V", "Oh", "S_Z", "Th", "W_OO"], "reallusion15"),
        (
            [f"CC_Base_Body.V_{shape}" for shape in ("Open", "Explosive", "Dental_Lip", "Wide")],
            "cc4",
        ),
        ([f"vrc.v_{name.lower()}" for name in OCULUS], "oculus15"),
        ([f"Outfit_{letter}" for letter in "ABCDEFX"], ""),
        ([f"Toggle_{letter}" for letter in "AIUEO"], ""),
    ],
)
def test_the_vocabulary_is_found(targets: list[str], vocabulary: str) -> None:
    assert fit(rig(*targets)).vocabulary == vocabulary


@pytest.mark.parametrize("vocabulary", vocabularies(), ids=lambda vocabulary: vocabulary.name)
def test_every_vocabulary_knows_every_pose(vocabulary: Mapping) -> None:
    assert set(vocabulary.controls) == set(POSES)
    fitting = fit(rig(*vocabulary.channels))
    assert fitting.vocabulary == vocabulary.name
    assert fitting.found == fitting.asked
    for control, fitted in fitting.controls.items():
        assert fitted.status == (EXACT if vocabulary.controls[control] else MISSING)


SPEAKING = [vocabulary.name for vocabulary in vocabularies() if vocabulary.name != "facefx"]


@pytest.mark.parametrize("name", SPEAKING)
def test_a_closure_shuts_what_a_vowel_opens(name: str) -> None:
    (vocabulary,) = (known for known in vocabularies() if known.name == name)
    fitting = fit(rig(*vocabulary.channels))
    opened = driven(fitting, open=0.2, PBM=0.0)
    closed = driven(fitting, open=0.2, PBM=1.0)
    for target in fitting.controls["open"].weights:
        assert opened[target] > 0
        assert closed[target] < 0.03


def test_the_poses_themselves_map_to_themselves() -> None:
    values = np.random.default_rng(1).random((5, 9), dtype=np.float32)
    made = fit(rig(*POSES)).drive(Animation(POSES, values, 30.0, -0.25, engine="bigram"))
    assert made.controls == POSES
    assert np.array_equal(made.values, values)
    assert (made.rate, made.start, made.engine) == (30.0, -0.25, "bigram")


def test_channels_are_summed_and_kept_within_limits() -> None:
    mapping = Mapping(
        "mine",
        {"open": {"jawOpen": 0.6}, "W": {"jawOpen": 0.6, "mouthPucker": -1}},
        gains={"W": 2},
        limits={"mouthPucker": (-0.5, 1)},
    )
    fitting = fit(rig("jawOpen", "mouthPucker"), mapping)
    assert driven(fitting, open=1, W=0.25) == pytest.approx({"jawOpen": 0.9, "mouthPucker": -0.5})
    assert driven(fitting, open=1, W=1) == pytest.approx({"jawOpen": 1, "mouthPucker": -0.5})


def test_a_users_mapping_names_only_what_differs() -> None:
    plain = fit(rig(*ARKIT))
    own = fit(rig(*ARKIT), Mapping("mine", {"W": {"mouthFunnel": 1}}, gains={"open": 0.5}))
    assert own.weights_of("W") == {"mouthFunnel": 1}
    assert own.weights_of("PBM") == plain.weights_of("PBM")
    assert own.weights_of("open")["jawOpen"] == plain.weights_of("open")["jawOpen"] / 2


def test_controls_that_are_the_rigs_own_names_pass_through() -> None:
    fitting = fit(rig("Crab_frown", "jawOpen"))
    made = driven(fitting, frown=0.5, JAW_OPEN=0.25, elsewhere=1.0)
    assert made == {"Crab_frown": 0.5, "jawOpen": 0.25}


def test_what_is_missing_is_said_and_stood_in_for() -> None:
    fitting = fit(rig("jawOpen", "mouthFunnel", "mouthSmileLeft", "mouthSmileRight"))
    status = {control: fitted.status for control, fitted in fitting.controls.items()}
    assert status["W"] == STAND_IN
    assert fitting.weights_of("W") == {"mouthFunnel": 0.6}
    assert fitting.controls["W"].missing == ("mouthPucker",)
    assert fitting.weights_of("wide") == {"mouthSmileLeft": 0.7, "mouthSmileRight": 0.7}
    assert status["open"] == PARTLY
    assert fitting.controls["open"].missing == ("mouthLowerDown", "mouthUpperUp")
    assert status["tBack"] == MISSING


@pytest.mark.parametrize(
    "targets", [["jawOpen"], ["jawOpen", "mouthClose"], ["Mouth Open"], ["mouth_A"], ["viseme_aa"]]
)
def test_a_rig_that_can_only_open_still_speaks_and_closes(targets: list[str]) -> None:
    fitting = fit(rig(*targets))
    status = {control: fitted.status for control, fitted in fitting.controls.items()}
    assert status["open"] in (EXACT, PARTLY)
    assert status["W"] == status["PBM"] == STAND_IN
    assert status["FV"] in (STAND_IN, PARTLY)
    assert status["tRoof"] == MISSING
    assert "instead of" in fitting.controls["W"].note
    assert driven(fitting, open=1, PBM=0)[targets[0]] > 0.69
    assert driven(fitting, open=1, PBM=1)[targets[0]] == 0
    assert 0 < driven(fitting, open=0.5, W=1)[targets[0]] < driven(fitting, open=0.5)[targets[0]]


def test_a_rig_of_rhubarbs_basic_shapes_closes_with_its_own() -> None:
    fitting = fit(rig(*(f"mouth_{shape}" for shape in "ABCDEF")))
    assert driven(fitting, open=0.3, PBM=1)["mouth_A"] == 1
    assert driven(fitting, open=0.3, PBM=1)["mouth_D"] == 0
    assert fitting.controls["FV"].status == STAND_IN
    assert fitting.controls["FV"].missing == ("G",)


def test_vrm_targets_on_several_meshes_move_together() -> None:
    parts = [square("Face", ["A"]), square("Teeth", ["Fcl_A", "A2"])]
    binds = [{"mesh": 0, "index": 0, "weight": 100}, {"mesh": 1, "index": 1, "weight": 50}]
    groups = [{"presetName": "a", "binds": binds}]
    vrm = {"extensions": {"VRM": {"blendShapeMaster": {"blendShapeGroups": groups}}}}
    made = to_gltf(parts, "Head")
    fitting = fit(read_rig(Gltf({**made.json, **vrm}, made.binary)))
    assert fitting.weights_of("open") == {"A": 1.0, "A2": 0.5}


def test_a_rig_that_nothing_moves_is_an_error_that_lists_its_names() -> None:
    with pytest.raises(CharacterError, match=r"none of the controls \(open\).*\(smirk, frown\)"):
        fit(rig("smirk", "frown")).drive(frames(open=1))


def test_a_name_that_the_model_has_not_is_met_with_near_ones() -> None:
    mapping = Mapping("mine", {"open": {"jawOpem": 1}})
    with pytest.raises(CharacterError, match=r"mine.json: .*'jawOpem'.*Did you mean 'jawOpen'"):
        fit(rig("jawOpen", "smirk"), mapping, "mine.json")


def test_vrm_expressions_move_the_targets_that_they_bind() -> None:
    nodes = [{"mesh": 0, "name": "Face"}, {"name": "Head", "children": [0]}]
    bind = {"node": 0, "index": 1, "weight": 0.5}
    preset = {
        "aa": {"morphTargetBinds": [bind]},
        "ou": {"morphTargetBinds": [{"node": 0, "index": 0, "weight": 1}]},
        "ih": {"morphTargetBinds": [{"node": 0, "index": 99, "weight": 1}, {"node": 7}]},
    }
    vrm = {"VRMC_vrm": {"specVersion": "1.0", "expressions": {"preset": preset}}}
    fitting = fit(read_rig(model(("x", "y"), nodes=nodes, extensions=vrm)))
    assert fitting.vocabulary == "vrm1"
    assert fitting.weights_of("open") == {"y": 0.5}


def test_vrm_0_groups_are_in_percent_and_go_before_likely_names() -> None:
    groups = [{"name": "A", "presetName": "a", "binds": [{"mesh": 0, "index": 0, "weight": 80}]}]
    vrm: dict[str, Any] = {"VRM": {"blendShapeMaster": {"blendShapeGroups": groups}}}
    fitting = fit(read_rig(model(("Fcl_MTH_A", "Fcl_MTH_U"), extensions=vrm)))
    assert fitting.vocabulary == "vrm0"
    assert fitting.weights_of("open") == {"Fcl_MTH_A": 0.8}
    assert fitting.weights_of("W") == {"Fcl_MTH_U": 0.9}


def test_a_mapping_is_written_a_row_per_line_and_reads_back(tmp_path: Path) -> None:
    mapping = Mapping(
        "mine",
        {"open": {"jawOpen": 0.7, "mund.auf_ö": 0.25}, "tBack": {}},
        otherwise={"open": [{"jawOpen": 1}]},
        names={"jawOpen": ["mouthOpen"]},
        gains={"open": 1.2},
        limits={"jawOpen": (0, 0.9)},
        notes={"tBack": 'no "tongue"'},
        about="for a test",
        joints={"Jaw": JointChannel("Bip Jaw", (0.0, 0.6, -0.8), 18), "Chin": JointChannel()},
    )
    path = tmp_path / "mine.json"
    path.write_bytes(mapping.to_bytes())
    assert read_mapping(path) == mapping
    assert '    "open": {"jawOpen": 0.7, "mund.auf_ö": 0.25},\n' in path.read_text("utf-8")


def test_the_documented_mapping_can_be_read(tmp_path: Path) -> None:
    page = (Path(__file__).parents[2] / "docs" / "characters.md").read_text("utf-8")
    path = tmp_path / "hero.json"
    path.write_text(page.split("```json\n")[1].split("```")[0])
    read = read_mapping(path)
    assert read.joints == {"Jaw": JointChannel("Bip01_Jaw", (0.0, 0.0, 1.0), 18)}
    assert read.gains == {"open": 0.9}


def document(**changes: Any) -> dict[str, Any]:
    return {
        "format": "lipwright/mapping",
        "version": 1,
        "name": "mine",
        "controls": {"open": {"jawOpen": 1}},
        **changes,
    }


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "is empty"),
        ("{", "broken JSON"),
        (json.dumps(document(version=2)), "version 2; expected version 1 or older. It was written"),
        (json.dumps(document(format="lipwright/animation")), "expected a file of format"),
        (json.dumps(document(colour=1)), "unknown field `colour`"),
        (json.dumps(document(controls={"open": {"jawOpen": "1"}})), r"at controls\[...\]\[...\]"),
        (json.dumps(document()).replace(": 1}}", ": 1e999}}"), "the number 1e999; expected finite"),
        (json.dumps(document(gains={"open": -1})), r"gains.open: the gain -1.0; expected 0 or"),
        (json.dumps(document(limits={"jawOpen": [1, 0]})), "limits.jawOpen: the limits 1.0 to 0"),
        (
            json.dumps(document(joints={"Jaw": {"axis": [0, 0, 0]}})),
            "joints.Jaw: the axis has no direction; expected one such as",
        ),
        (
            json.dumps(document(joints={"Jaw": {"axis": [1, 0]}})),
            r"at joints\[...\].axis: Expected `array` of length 3, got 2",
        ),
        (
            json.dumps(document(joints={"Jaw": {"axis": [1, 0, 9]}})).replace("9", "1e999"),
            "the number 1e999; expected finite",
        ),
        (json.dumps(document(joints={"Jaw": {"degrees": 0}})), "joints.Jaw: 0 degrees; expected"),
        (json.dumps(document(joints={"Jaw": {"degrees": 200}})), "200 degrees; .* at most 90"),
        (json.dumps(document(joints={"Jaw": {"bone": "x"}})), "unknown field `bone`"),
        ('{"format": "lipwright/mapping", "gains": {"open": NaN}}', "the number NaN"),
    ],
)
def test_a_bad_mapping_file_is_refused(tmp_path: Path, content: str, message: str) -> None:
    path = tmp_path / "mine.json"
    path.write_text(content)
    with pytest.raises(FileFormatError, match=message):
        read_mapping(path)
