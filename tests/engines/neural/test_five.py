"""The publication's five, read off a face and played by poses."""

from __future__ import annotations

import numpy as np
import pytest

from lipwright.engines.neural.five import FIVE, FiveOfShapes, in_poses
from lipwright.errors import InputError

CHANNELS = ("jawOpen", "mouthPucker", "mouthSmileLeft", "mouthSmileRight", "mouthClose")
FACES = {
    "rest": (0.0, 0.0, 0.0, 0.0, 0.0),
    "a": (0.4, 0.0, 0.0, 0.0, 0.0),
    "i": (0.04, 0.0, 0.3, 0.3, 0.0),
    "o/u": (0.1, 0.8, 0.0, 0.0, 0.0),
    "b/m/p": (0.0, 0.0, 0.0, 0.0, 0.2),
}
PLAYED = {"rest": None, "a": "open", "i": "wide", "o/u": "W", "b/m/p": "PBM"}


@pytest.mark.parametrize("name", FACES)
def test_each_face_is_its_own_output_and_pose(name: str) -> None:
    values = np.array([face for face in FACES.values() for _ in range(50)])
    five = FiveOfShapes.fit(CHANNELS, values).five(np.array([FACES[name]]))
    shown = dict(zip(FIVE, five[0], strict=True))
    opens = shown.pop("open")
    assert opens == pytest.approx(FACES[name][0] / 0.4)
    if name == "rest":
        assert not any(shown.values())
    else:
        assert max(shown, key=shown.__getitem__) == name
        assert shown[name] > 0.85
    poses, weights = in_poses(five)
    played = dict(zip(poses, weights[0], strict=True))
    wanted = PLAYED[name]
    assert all((weight > 0.5) == (pose == wanted) for pose, weight in played.items()), played


def test_shapes_that_never_move_give_0() -> None:
    rng = np.random.default_rng(0)
    values = np.zeros((100, 5))
    values[:, 0] = rng.random(100)
    five = FiveOfShapes.fit(CHANNELS, values).five(values)
    assert five[:, [1, 2, 3]].max() == 0
    assert five[:, 0] == pytest.approx(five[:, 4])


def test_a_face_without_a_jaw_is_refused() -> None:
    with pytest.raises(InputError, match="no jawOpen"):
        FiveOfShapes.fit(("open",), np.zeros((9, 1)))
    with pytest.raises(InputError, match="does not move"):
        FiveOfShapes.fit(("jawOpen",), np.zeros((9, 1)))
