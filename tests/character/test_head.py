"""The built-in head: what one would see on it."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright.character.face_model import flattening
from lipwright.character.head import Landmarks, Mouth, build_head, landmarks, measure
from lipwright.character.head.anatomy import of_skin, rigid
from lipwright.character.head.arkit import SHAPES
from lipwright.character.head.lids import EYE_CENTER, EYE_RADIUS
from lipwright.character.head.poses import POSES
from lipwright.character.head.skin import build_skin
from lipwright.character.head.teeth import LOWER, UPPER, teeth
from lipwright.character.mesh import Part
from tests.character import rays

Floats = NDArray[np.float64]

NINE = ("open", "W", "ShCh", "PBM", "FV", "wide", "tBack", "tRoof", "tTeeth")
SIDED = [name.removesuffix("Left") for name in SHAPES if name.endswith("Left")]
EVEN = [name for name in (*POSES, *SHAPES) if not name.endswith(("Left", "Right"))]
ARKIT = {
    "jawOpen",
    "jawForward",
    "jawLeft",
    "jawRight",
    "mouthClose",
    "mouthFunnel",
    "mouthPucker",
    "mouthLeft",
    "mouthRight",
    "mouthSmileLeft",
    "mouthSmileRight",
    "mouthFrownLeft",
    "mouthFrownRight",
    "mouthDimpleLeft",
    "mouthDimpleRight",
    "mouthStretchLeft",
    "mouthStretchRight",
    "mouthRollLower",
    "mouthRollUpper",
    "mouthShrugLower",
    "mouthShrugUpper",
    "mouthPressLeft",
    "mouthPressRight",
    "mouthLowerDownLeft",
    "mouthLowerDownRight",
    "mouthUpperUpLeft",
    "mouthUpperUpRight",
    "tongueOut",
    "cheekPuff",
    "eyeBlinkLeft",
    "eyeBlinkRight",
    "browInnerUp",
    "browOuterUpLeft",
    "browOuterUpRight",
    "browDownLeft",
    "browDownRight",
}


@cache
def head() -> dict[str, Part]:
    return {part.name: part for part in build_head()}


@cache
def marks() -> Landmarks:
    return landmarks()


def mouth(**weights: float) -> Mouth:
    return measure(list(head().values()), marks(), weights)


def moved(name: str, **weights: float) -> Floats:
    part = head()[name]
    points = part.positions.astype(np.float64)
    for target, weight in weights.items():
        if target in part.morphs:
            points += weight * part.morphs[target]
    return points


def loop_gaps(**weights: float) -> Floats:
    """Return the gap between the lips at each vertex of their contact (metres)."""
    points = moved("skin", **weights)
    return points[list(marks().upper_loop), 1] - points[list(marks().lower_loop), 1]


def first_hit(name: str, across: Floats, **weights: float) -> Floats:
    """Return the depth at which rays along -z from in front hit a part; -inf where none."""
    return rays.first_hit(moved(name, **weights), head()[name].triangles, across)


# The meshes


def test_every_part_is_finite_and_whole() -> None:
    for part in head().values():
        assert part.positions.dtype == np.float32
        assert part.triangles.dtype == np.uint32
        assert np.isfinite(part.positions).all()
        assert np.unique(part.triangles).size == len(part.positions)
        if part.colors is not None:
            assert part.colors.shape == part.positions.shape
            assert part.colors.min() >= 0
            assert part.colors.max() <= 1
        for moves in part.morphs.values():
            assert moves.shape == part.positions.shape
            assert moves.dtype == np.float32
            assert np.isfinite(moves).all()
            assert np.abs(moves).max() > 0


def test_building_twice_gives_the_same_bytes() -> None:
    for first, second in zip(head().values(), build_head(), strict=True):
        assert first.positions.tobytes() == second.positions.tobytes()
        assert first.triangles.tobytes() == second.triangles.tobytes()
        for name, moves in first.morphs.items():
            assert moves.tobytes() == second.morphs[name].tobytes()


def test_it_is_light() -> None:
    assert 5_000 < sum(len(part.triangles) for part in head().values()) < 12_000


def test_it_has_a_heads_proportions() -> None:
    skin = head()["skin"].positions
    crown = skin[:, 1].max()
    chin = skin[(np.abs(skin[:, 0]) < 0.005) & (skin[:, 2] > 0.075), 1].min()
    assert crown - chin == pytest.approx(0.225, abs=0.015)
    assert EYE_CENTER[1] == pytest.approx((crown + chin) / 2, abs=0.01)
    assert float(mouth().breadth) == pytest.approx(0.051, abs=0.004)
    pupils = [head()[f"eye_{side}"].positions[0, 0] for side in ("left", "right")]
    assert pupils[0] - pupils[1] == pytest.approx(0.063, abs=0.003)


@pytest.mark.parametrize("name", head())
def test_triangles_face_one_way_and_none_is_flat(name: str) -> None:
    part = head()[name]
    triangles = part.triangles.astype(np.int64)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    assert len(np.unique(edges, axis=0)) == len(edges)
    a, b, c = part.positions.astype(np.float64)[triangles].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    assert np.linalg.norm(normals, axis=1).min() > 1e-9
    # Seen from the front, the nearest surface faces the viewer.
    middle = (a + b + c) / 3
    front = middle[np.argmax(middle[:, 2])]
    near = np.linalg.norm(middle - front, axis=1) < 0.002
    assert normals[near].sum(axis=0)[2] > 0


def test_the_skin_is_open_only_at_the_neck_and_behind_the_lids() -> None:
    part = head()["skin"]
    triangles = part.triangles.astype(np.int64)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    there = set(map(tuple, edges.tolist()))
    ends = {start for start, end in there if (end, start) not in there}
    points = part.positions[list(ends)]
    at_eyes = np.linalg.norm(np.abs(points) * [1, 0, 0] + points * [0, 1, 1] - EYE_CENTER, axis=1)
    assert ((points[:, 1] < -0.16) | (at_eyes < EYE_RADIUS + 0.0005)).all()


@pytest.mark.parametrize("weights", [{"open": 1.0}, {"jawOpen": 1.0}, {"open": 0.5, "wide": 1.0}])
def test_nothing_is_seen_through_an_open_mouth(weights: dict[str, float]) -> None:
    points = moved("skin", **weights)
    upper, lower = points[list(marks().upper_loop)], points[list(marks().lower_loop)]
    share = np.linspace(0.1, 0.9, 5)[:, None, None]
    across = (upper * share + lower * (1 - share))[:, 2:-2, :2].reshape(-1, 2)
    depth = first_hit("skin", across, **weights)
    assert (depth > 0.0).all()
    assert np.median(depth) < 0.06  # a hollow, not a wall behind the lips


def test_the_bag_of_the_mouth_stays_inside_the_face() -> None:
    skin = build_skin()
    bag = skin.mouth[11:].ravel()
    for weights in ({}, *({name: 1.0} for name in NINE)):
        points = moved("skin", **weights)
        outside = first_hit("skin", points[bag, :2], **weights)
        assert (outside - points[bag, 2] > -1e-6).all()
    rest = moved("skin")[bag]
    assert (first_hit("skin", rest[:, :2]) - rest[:, 2] > 0.001).all()


# The poses


def test_all_targets_are_there() -> None:
    names = {name for part in head().values() for name in part.morphs}
    assert names >= {*NINE, *ARKIT}
    assert names == {*POSES, *SHAPES, "open@50", "jawOpen@50"}


def test_lips_touch_at_rest() -> None:
    assert float(mouth().opening) == 0.0
    np.testing.assert_allclose(loop_gaps(), 0.0, atol=1e-9)


@pytest.mark.parametrize("weight", [0.5, 0.9, 1.0])
def test_pbm_seals_without_crossing(weight: float) -> None:
    np.testing.assert_allclose(loop_gaps(PBM=weight), 0.0, atol=1e-7)
    assert float(mouth(PBM=weight).opening) == 0.0


@pytest.mark.parametrize(
    "other", [{"open": 0.15}, {"W": 0.7}, {"W": 1.0}, {"wide": 1.0}, {"ShCh": 0.5}]
)
def test_pbm_looks_closed_beside_other_poses(other: dict[str, float]) -> None:
    assert float(mouth(PBM=1.0, **other).opening) == 0.0


def test_pbm_rolls_the_red_in() -> None:
    points, rest = moved("skin", PBM=1.0), moved("skin")
    border = [marks().upper_lip[0], marks().lower_lip[0]]
    red = points[border, 1][0] - points[border, 1][1]
    assert red < 0.85 * (rest[border, 1][0] - rest[border, 1][1])
    assert float(mouth(PBM=1.0).protrusion) < -0.001


@pytest.mark.parametrize("name", [*POSES, *SHAPES])
def test_lips_never_cross(name: str) -> None:
    if name == "mouthClose":  # it takes back what jawOpen does
        np.testing.assert_allclose(loop_gaps(mouthClose=1.0, jawOpen=1.0), 0.0, atol=1e-7)
    else:
        assert loop_gaps(**{name: 1.0}).min() > -1e-7


def test_open_parts_the_lips_ever_wider() -> None:
    weights = np.linspace(0.0, 1.0, 11)
    measured = measure(list(head().values()), marks(), {"open": weights})
    assert (np.diff(measured.opening) > 0).all()
    assert 0.018 < measured.opening[-1] < 0.03


def test_rounding_narrows_and_protrudes() -> None:
    rest = mouth()
    for name, breadth, protrusion in (("W", 0.65, 0.006), ("ShCh", 0.85, 0.004)):
        posed = mouth(**{name: 1.0})
        assert float(posed.breadth) < breadth * float(rest.breadth)
        assert float(posed.protrusion) > protrusion
    assert float(mouth(ShCh=1.0).opening) > 0.003  # the teeth show
    oh, ah = mouth(open=0.5, W=0.8), mouth(open=0.5)
    assert float(oh.breadth) < 0.75 * float(ah.breadth)
    assert float(oh.opening) > 0.8 * float(ah.opening)


def test_wide_spreads_the_corners_and_keeps_the_jaw() -> None:
    assert float(mouth(wide=1.0).breadth) > 1.15 * float(mouth().breadth)
    assert 0.001 < float(mouth(wide=1.0).opening) < 0.004  # the teeth show …
    assert float(mouth(wide=0.5, PBM=1.0).opening) == 0.0  # … and closed lips hide them
    assert "wide" not in head()["teeth_lower"].morphs


def test_fv_brings_the_lower_lip_to_the_edge_of_the_upper_teeth() -> None:
    edge = moved("teeth_upper")
    incisors = edge[np.abs(edge[:, 0]) < 0.008]
    lip = moved("skin", FV=1.0)[marks().lower_inner_lip]
    assert abs(lip[1] - incisors[:, 1].min()) < 0.0025
    assert 0.0 < lip[2] - incisors[:, 2].max() < 0.002
    # The upper lip leaves the teeth to be seen above the lower one.
    upper = moved("skin", FV=1.0)[list(marks().upper_lip), 1].min()
    assert upper - lip[1] > 0.0025


def test_the_lower_teeth_go_with_the_jaw_and_the_upper_stay() -> None:
    for name in ("teeth_upper", "gums_upper"):
        assert not head()[name].morphs
    drop = moved("teeth_lower") - moved("teeth_lower", open=1.0)
    assert drop[:, 1].min() > 0.008
    assert drop[:, 1].max() < 0.03


def test_the_tongue_goes_where_it_should() -> None:
    tip = int(np.argmax(moved("tongue")[:, 2]))
    edge = UPPER.edge * 1e-3
    assert moved("tongue")[:, 2].max() < moved("teeth_lower")[:, 2].max()
    roof = moved("tongue", tRoof=1.0, open=0.3)[tip]
    assert roof[1] > edge + 0.002  # behind the teeth, above their edge
    assert roof[2] < moved("teeth_upper")[:, 2].max()
    between = moved("tongue", tTeeth=1.0, open=0.25)[tip]
    lower_edge = moved("teeth_lower", open=0.25)
    assert lower_edge[np.abs(lower_edge[:, 0]) < 0.005, 1].max() < between[1] < edge
    assert between[2] > moved("teeth_lower", open=0.25)[:, 2].max()
    body = moved("tongue", tBack=1.0)[:, 1].max() - moved("tongue")[:, 1].max()
    assert body > 0.006
    out = moved("tongue", tongueOut=1.0, jawOpen=0.3)[:, 2].max()
    assert out > moved("skin", jawOpen=0.3)[list(marks().lower_lip), 2].max() + 0.01


def test_an_eye_closes_over_its_ball() -> None:
    turn = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    seen = [EYE_CENTER[:2] + r * np.stack([np.cos(turn), np.sin(turn)], 1) for r in (0.001, 0.0045)]
    across = np.concatenate(seen)
    ball = first_hit("eye_left", across)
    assert (first_hit("skin", across) < ball)[:24].all()  # open: the pupil is seen
    assert (
        first_hit("skin", across, eyeBlinkLeft=1.0)
        > first_hit("eye_left", across, eyeBlinkLeft=1.0)
    ).all()
    # Half closed, the lid lies on the ball and not in it.
    high = across[across[:, 1] > 0.0015]
    assert (
        first_hit("skin", high, eyeBlinkLeft=0.5) > first_hit("eye_left", high, eyeBlinkLeft=0.5)
    ).all()


def mirror_error(first: str, second: str) -> float:
    """Return how far a target is from the mirror image of another (metres)."""
    worst = 0.0
    for part in head().values():
        if part.name.startswith("eye_") or first not in part.morphs:
            continue
        places: dict[tuple[float, ...], list[int]] = {}
        keys = np.round(part.positions.astype(np.float64), 7) + 0.0
        for number, key in enumerate(map(tuple, keys.tolist())):
            places.setdefault(key, []).append(number)
        mirrored = part.morphs[first] * np.array([-1, 1, 1], np.float32)
        for number, key in enumerate(map(tuple, (keys * [-1, 1, 1] + 0.0).tolist())):
            twins = part.morphs[second][places[key]]
            worst = max(worst, float(np.abs(twins - mirrored[number]).max(axis=1).min()))
    return worst


@pytest.mark.parametrize("name", SIDED)
def test_left_and_right_mirror_each_other(name: str) -> None:
    assert mirror_error(f"{name}Left", f"{name}Right") < 1e-6


@pytest.mark.parametrize("name", EVEN)
def test_even_poses_are_even(name: str) -> None:
    assert mirror_error(name, name) < 1e-6


def test_a_smile_lifts_its_own_corner() -> None:
    rest, smiling = moved("skin"), moved("skin", mouthSmileLeft=1.0)
    rise = (smiling - rest)[[marks().left_corner, marks().right_corner], 1]
    assert rise[0] > 0.003
    assert abs(rise[1]) < 0.0005


def test_the_flattened_turn_of_the_jaw_is_as_stated() -> None:
    skin, row = of_skin(build_skin()), rigid(teeth(LOWER)[0], 1.0)
    for pose, stated in ((POSES["open"], 1.1e-3), (SHAPES["jawOpen"], 1.9e-3)):
        error = max(flattening(part.points, pose(part)) for part in (skin, row))
        assert 0.9 * stated < error <= stated
