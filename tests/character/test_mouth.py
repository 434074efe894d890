"""The mouth is found on a mesh: on sheets whose lips are known, and on the built-in head."""

from __future__ import annotations

import numpy as np
import pytest

from lipwright.character.builtin import to_gltf
from lipwright.character.calibration import Calibration, calibrate
from lipwright.character.character import load_character
from lipwright.character.fitting import fit
from lipwright.character.head import landmarks
from lipwright.character.mesh import Part
from lipwright.character.mouth import Mouth
from lipwright.character.rig import read_rig
from lipwright.gltf import Gltf
from tests.character.sheets import HALF, dropped, face, jawed, met, sheet
from tests.models import model, square


def found(made: Gltf) -> tuple[Mouth, Calibration]:
    rig = read_rig(made)
    _, calibration = calibrate(rig, fit(rig))
    assert calibration.mouth is not None, calibration.reason
    return calibration.mouth, calibration


@pytest.mark.parametrize("gap", [0.0, 0.003])
@pytest.mark.parametrize("size", [1.0, 100.0])
def test_lips_corners_and_width_are_found_at_any_size(gap: float, size: float) -> None:
    mouth, calibration = found(face({"jawOpen": dropped(0.02)}, gap=gap, size=size))
    assert calibration.face is not None
    points = calibration.face.positions({}) / size
    for lip, side in ((mouth.upper, 1), (mouth.lower, -1)):
        seam = side * gap / 2 * np.sqrt(1 - (points[lip, 0] / HALF) ** 2)
        assert np.abs(points[lip, 1] - seam).max() < 1e-6
        assert len(lip) >= 17
    assert points[list(mouth.corners), 0] == pytest.approx([-HALF, HALF], abs=0.003)
    assert mouth.width == pytest.approx(2 * HALF * size, rel=0.11)


def test_the_gap_is_what_is_seen_between_the_lips() -> None:
    mouth, _ = found(face({"jawOpen": dropped(0.02), "mouthClose": met(0.002)}))
    wide = 0.02 * mouth.width**-1
    opened, half = mouth.stand({"jawOpen": 1.0}), mouth.stand({"jawOpen": 0.5})
    assert mouth.stand({}).gap == pytest.approx(0, abs=1e-9)
    assert 0.9 * wide < opened.gap < opened.widest + 1e-9 < wide + 1e-6
    assert half.gap == pytest.approx(opened.gap / 2)
    crossed = mouth.stand({"mouthClose": 1.0})
    assert crossed.contact == pytest.approx(-0.004 / mouth.width, rel=0.1)


def test_lips_that_are_meshes_of_their_own_belong_together() -> None:
    whole = sheet({"jawOpen": dropped(0.02)})
    half = len(whole.positions) // 2
    parts = []
    for name, rows in (("Upper", slice(None, half)), ("Lower", slice(half, None))):
        inside = whole.triangles[(whole.triangles // half == (name == "Lower")).all(axis=1)]
        morphs = {target: moves[rows] for target, moves in whole.morphs.items()}
        first = inside.min()
        parts.append(
            Part(name, whole.positions[rows], inside - first, whole.material, morphs, None)
        )
    mouth, _ = found(to_gltf(parts, "Head"))
    assert (mouth.upper < half).all()
    assert (mouth.lower >= half).all()


def test_teeth_behind_the_lips_are_not_taken_for_them() -> None:
    lips = sheet({"jawOpen": dropped(0.02)})
    back = np.array([0, 0, -0.006], np.float32)
    teeth = Part("Row", lips.positions + back, lips.triangles, lips.material, lips.morphs, None)
    mouth, calibration = found(to_gltf([teeth, lips], "Head"))
    assert calibration.face is not None
    parts = calibration.face.part_of
    assert set(parts[mouth.upper]) == set(parts[mouth.lower]) == {1}


@pytest.mark.parametrize("facing", [1.0, -1.0])
def test_a_face_may_look_either_way(facing: float) -> None:
    mouth, calibration = found(jawed({}, facing=facing))
    assert calibration.face is not None
    assert calibration.face.axes[2].tolist() == [0, 0, facing]
    right, left = calibration.face.positions({})[list(mouth.corners)]
    assert right[0] < 0 < left[0]


def test_what_does_not_part_is_no_mouth() -> None:
    rig = read_rig(model(("jawOpen", "smile")))
    fitting, calibration = calibrate(rig, fit(rig))
    assert calibration.mouth is None
    assert calibration.reason == "nothing on it parts as lips do"
    assert fitting.gains == {}
    still = square("Face", ["jawOpen"])
    still.morphs["jawOpen"][:] = 0
    rig = read_rig(to_gltf([still], "Head"))
    assert calibrate(rig, fit(rig))[1].mouth is None


def test_the_mouth_of_the_built_in_head_is_where_its_makers_put_it() -> None:
    character = load_character("head")
    rig = character.read_rig()
    _, calibration = calibrate(rig, character.fit())
    mouth, surfaces, marks = calibration.mouth, calibration.face, landmarks()
    assert mouth is not None
    assert surfaces is not None
    names = [part.name.split()[0] for part in surfaces.parts]
    first = surfaces.starts[names.index("skin")]
    points = surfaces.positions({})
    true = points[[first + marks.right_corner, first + marks.left_corner]]
    assert np.abs(points[list(mouth.corners)] - true).max() < 0.001
    for taken, loop in ((mouth.upper, marks.upper_loop), (mouth.lower, marks.lower_loop)):
        inside = np.abs(points[taken, 0]) < 0.023
        assert set((taken[inside] - first).tolist()) <= set(loop)
