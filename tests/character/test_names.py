"""Names of shapes are found however a rig spells them."""

from __future__ import annotations

import pytest

from lipwright.character.names import match_names

KNOWN = {
    "jawOpen": ["mouthOpen"],
    "mouthSmile": [],
    "mouthPucker": [],
    "tTeeth": [],
    "PBM": [],
    "aa": [],
    "A": ["あ"],
    "wide": [],
}

SPELLINGS = [
    ("jawOpen", "jawOpen"),
    ("JawOpen", "jawOpen"),
    ("jaw_open", "jawOpen"),
    ("JAW-OPEN", "jawOpen"),
    ("jawopen", "jawOpen"),
    ("Head_jawOpen", "jawOpen"),
    ("blendShape1.jawOpen", "jawOpen"),
    ("JawOpen_L", "jawOpen"),
    ("jawOpen1", "jawOpen"),
    ("head_blendShapes:jaw_Open", "jawOpen"),
    ("jawOpen_ncl1_1", "jawOpen"),
    ("mouthOpen", "jawOpen"),
    ("mouthSmileLeft", "mouthSmile"),
    ("mouthSmile_R", "mouthSmile"),
    ("MouthSmileR", "mouthSmile"),
    ("L_mouth_smile", "mouthSmile"),
    ("mouthsmileleft", "mouthSmile"),
    ("t_teeth", "tTeeth"),
    ("pbm", "PBM"),
    ("P_B_M", "PBM"),
    ("viseme_aa", "aa"),
    ("Fcl_MTH_A", "A"),
    ("あ", "A"),
    ("Mouth_wide", "wide"),
    ("CC_Base_Body.A14_Jaw_Open", "jawOpen"),
    ("head_lod0_mesh__jaw_open", "jawOpen"),
    ("vrc.v_aa", "aa"),
    ("V_AA", "aa"),
    ("Mouth_A", "A"),
    ("mouth_shape_A", "A"),
    ("mouth_shape_PBM", "PBM"),
    ("Face.M_F00_000_00_Fcl_MTH_A", "A"),
    ("blendShape1.a", "A"),
    ("A", "A"),
]


@pytest.mark.parametrize(("spelled", "meant"), SPELLINGS)
def test_spellings(spelled: str, meant: str) -> None:
    assert match_names([spelled], KNOWN) == {meant: (spelled,)}


@pytest.mark.parametrize(
    "other",
    [
        *("", "_", "jaw", "open", "eyeWide_L", "eye_wide", "A_pose_body", "jawOpener", "mouth"),
        *("Outfit_A", "Toggle_A", "hair_a", "Body_A", "mouth_smirk_A", "A14", "nose_wide"),
        "aa_battery_cover",
    ],
)
def test_other_names_are_left_alone(other: str) -> None:
    assert match_names([other], KNOWN) == {}


def test_two_sides_make_one_and_several_meshes_go_together() -> None:
    rig = ["Face_jawOpen", "Teeth_jawOpen", "mouthSmile_L", "mouthSmile_R"]
    assert match_names(rig, KNOWN) == {
        "jawOpen": ("Face_jawOpen", "Teeth_jawOpen"),
        "mouthSmile": ("mouthSmile_L", "mouthSmile_R"),
    }


def test_a_movement_that_a_rig_has_twice_counts_once() -> None:
    assert match_names(["mouthSmile", "mouthSmileLeft", "mouthSmileRight"], KNOWN) == {
        "mouthSmile": ("mouthSmile",)
    }
    assert match_names(["mouthOpen", "jawOpen"], KNOWN) == {"jawOpen": ("jawOpen",)}
    assert match_names(["jawOpen_old", "jawOpen"], KNOWN) == {"jawOpen": ("jawOpen",)}
