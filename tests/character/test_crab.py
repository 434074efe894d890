"""The built-in crab: what one would see on it."""

from __future__ import annotations

import itertools
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright.character import load_character
from lipwright.character.builtin import to_glb
from lipwright.character.crab import build_crab
from lipwright.character.crab.anatomy import of_body, part_of
from lipwright.character.crab.body import BAG_LOOPS, SIDES, build_body
from lipwright.character.crab.eyes import CENTERS
from lipwright.character.crab.mouthparts import mandible, swinging
from lipwright.character.crab.poses import EXTRAS, SPEECH
from lipwright.character.face_model import flattening
from lipwright.character.mesh import Part
from tests.character.rays import first_hit
from tests.export.validator import issues

Floats = NDArray[np.float64]
LOOPS = build_body().loops
CONTACT = LOOPS[BAG_LOOPS]
UPPER = CONTACT[1 : SIDES // 2]
LOWER = CONTACT[-1 : SIDES // 2 : -1]
PARTS = tuple(part.name for part in build_crab())


@cache
def crab() -> dict[str, Part]:
    return {part.name: part for part in build_crab()}


def moved(name: str, **weights: float) -> Floats:
    part = crab()[name]
    points: Floats = part.positions.astype(np.float64)
    for target, weight in weights.items():
        if target in part.morphs:
            points += weight * part.morphs[target]
    return points


def gaps(**weights: float) -> Floats:
    """Return the gap between upper edge and plate along the mouth (metres)."""
    points = moved("shell", **weights)
    heights: Floats = points[UPPER, 1] - points[LOWER, 1]
    return heights


def breadth(**weights: float) -> float:
    points = moved("shell", **weights)
    return float(points[CONTACT[0], 0] - points[CONTACT[SIDES // 2], 0])


def apart(**weights: float) -> float:
    """Return how far the mandibles are from each other (metres; below 0 if they crossed)."""
    left, right = moved("mandible_left", **weights), moved("mandible_right", **weights)
    return float(left[:, 0].min() - right[:, 0].max())


# The meshes


def test_every_part_is_finite_and_whole() -> None:
    for part in crab().values():
        assert np.isfinite(part.positions).all()
        assert np.unique(part.triangles).size == len(part.positions)
        assert part.colors is not None
        assert part.colors.shape == part.positions.shape
        assert 0 <= part.colors.min() <= part.colors.max() <= 1
        for moves in part.morphs.values():
            assert moves.shape == part.positions.shape
            assert np.isfinite(moves).all()
            assert np.abs(moves).max() > 0


def test_building_twice_gives_the_same_bytes() -> None:
    assert to_glb(build_crab(), "Crab") == to_glb(build_crab(), "Crab")


def test_it_is_light() -> None:
    vertices = sum(len(part.positions) for part in crab().values())
    assert 10_000 < vertices < 25_000
    assert len(to_glb(build_crab(), "Crab")) < 2_500_000


def test_the_validator_finds_nothing(tmp_path: Path) -> None:
    assert issues(load_character("crab").model().to_glb(), tmp_path) == []


@pytest.mark.parametrize("name", PARTS)
def test_triangles_face_outward_and_none_is_flat(name: str) -> None:
    part = crab()[name]
    triangles = part.triangles.astype(np.int64)
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    assert len(np.unique(edges, axis=0)) == len(edges)
    there = set(map(tuple, edges.tolist()))
    is_open = [edge for edge in there if edge[::-1] not in there]
    a, b, c = part.positions.astype(np.float64)[triangles].transpose(1, 0, 2)
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    assert areas.min() > 1e-10
    if name.startswith("lids"):  # open in front, where the ball looks out
        assert is_open
    else:
        assert is_open == []
        assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() > 0  # six times the volume


def test_nobody_takes_it_for_a_human() -> None:
    everything = np.concatenate([part.positions for part in crab().values()])
    breadth, height, _ = np.ptp(everything, axis=0)
    assert breadth > 1.3 * height
    big, small = (np.ptp(crab()[f"claw_{side}"].positions[:, 1]) for side in ("left", "right"))
    assert big > 1.4 * small  # one claw is the big one
    assert 0.15 < np.ptp(crab()["shell"].positions[:, 0]) < 0.25  # beside a head of 0.15


# The poses


def test_each_pose_is_seen_and_none_is_another() -> None:
    looks = {}
    for name in (*SPEECH, *EXTRAS):
        moves = [part.morphs.get(name, np.zeros_like(part.positions)) for part in crab().values()]
        looks[name] = np.concatenate(moves).ravel().astype(np.float64)
        assert np.abs(looks[name]).max() > 0.004, name
    for one, other in itertools.combinations(looks, 2):
        a, b = looks[one], looks[other]
        assert a @ b < 0.9 * np.linalg.norm(a) * np.linalg.norm(b), (one, other)


def test_the_mouth_is_shut_at_rest() -> None:
    np.testing.assert_allclose(gaps(), 0.0, atol=1e-9)
    assert apart() > 0.08


@pytest.mark.parametrize("name", SPEECH)
def test_edge_and_plate_never_cross(name: str) -> None:
    for weight in (0.5, 1.0):
        assert gaps(**{name: weight}).min() > -0.0005


@pytest.mark.parametrize("other", [{}, {"frown": 0.3}, {"smile": 0.1}])
def test_the_mandibles_pinch_the_mouth_shut(other: dict[str, float]) -> None:
    assert -0.004 < apart(mandibles_in=1.0, **other) < 0.006
    # They meet before the line where the mouth closes, and in front of it.
    left = moved("mandible_left", mandibles_in=1.0, **other)
    tip = left[np.argmin(left[:, 0])]
    line = moved("shell", mandibles_in=1.0, **other)[CONTACT[SIDES // 4]]
    assert abs(tip[1] - line[1]) < 0.020
    assert tip[2] > line[2]
    # What parts the edges a little is sealed by the plate's inner side, which rises.
    shell = moved("shell", mandibles_in=1.0, **other)
    upper, inner = LOOPS[BAG_LOOPS, SIDES // 4], LOOPS[BAG_LOOPS - 2, 3 * SIDES // 4]
    assert shell[upper, 1] - shell[inner, 1] < 0.001


def test_it_goes_sideways_more_than_up_and_down() -> None:
    tip = np.argmin(moved("mandible_left", mandibles_in=1.0)[:, 0])
    together, wide = (
        moved("mandible_left", **{pose: 1.0})[tip, 0] for pose in ("mandibles_in", "mandibles_out")
    )
    assert 2 * (wide - together) > 3 * gaps(mouth_open=1.0).max()


def test_open_parts_the_mouth_ever_wider() -> None:
    openings = [gaps(mouth_open=weight).max() for weight in np.linspace(0, 1, 6)]
    assert (np.diff(openings) > 0.003).all()
    assert 0.02 < openings[-1] < 0.04


def test_the_rim_takes_its_shapes() -> None:
    assert breadth(mouth_OO=1.0) < 0.5 * breadth()
    assert gaps(mouth_OO=1.0).max() > 0.4 * breadth(mouth_OO=1.0)  # nearly round
    assert breadth(smile=1.0) > 1.15 * breadth()
    rest, corner, middle = moved("shell"), CONTACT[0], CONTACT[SIDES // 4]
    for pose, way in (("smile", 1.0), ("frown", -1.0)):
        points = moved("shell", **{pose: 1.0})
        bend = (points[corner, 1] - points[middle, 1]) - (rest[corner, 1] - rest[middle, 1])
        assert way * bend > 0.008


def test_teeth_show_where_they_should_and_nowhere_else() -> None:
    middle = abs(crab()["teeth_upper"].positions[:, 0]) < 0.012

    def upper_teeth(**weights: float) -> float:
        """Return how much of the upper teeth is below the upper edge."""
        edge = moved("shell", **weights)[CONTACT[SIDES // 4], 1]
        return float(edge - moved("teeth_upper", **weights)[middle, 1].min())

    assert upper_teeth(bare_teeth=1.0) > 0.006
    assert upper_teeth(bite=1.0) > 0.006
    assert gaps(bite=1.0).max() > 0.004
    # The plate's edge lies behind the teeth that bite on it.
    plate = moved("shell", bite=1.0)[CONTACT[3 * SIDES // 4]]
    assert plate[2] < moved("teeth_upper")[middle, 2].max() + 0.002
    assert upper_teeth(mouth_OO=1.0) < 0.001


def test_the_tongue_stays_in_until_it_comes_out() -> None:
    shell = moved("shell")
    front = shell[CONTACT[SIDES // 4], 2]
    inside = shell[LOOPS[:BAG_LOOPS].ravel()]
    tongue = moved("tongue")
    assert tongue[:, 2].max() < moved("teeth_lower")[:, 2].max()
    assert tongue[:, 1].min() > inside[:, 1].min() - 0.001
    assert np.abs(tongue[:, 0]).max() < np.abs(inside[:, 0]).max()
    for weights in ({"tongue_up": 1.0}, {"tongue_back": 1.0}, {"mouth_open": 1.0}):
        assert moved("tongue", **weights)[:, 2].max() < front
    assert moved("tongue", tongue_out=1.0, mouth_open=0.3)[:, 2].max() > front + 0.008
    rise = moved("tongue", tongue_up=1.0)[:, 1].max() - tongue[:, 1].max()
    assert rise > 0.008


def test_the_plate_takes_its_teeth_along_and_leaves_the_upper_ones() -> None:
    assert "mouth_open" not in crab()["teeth_upper"].morphs
    drop = moved("teeth_lower") - moved("teeth_lower", mouth_open=1.0)
    assert drop[:, 1].min() > 0.012


@pytest.mark.parametrize("side", ["Left", "Right"])
def test_an_eye_closes_over_its_ball(side: str) -> None:
    number = 1 if side == "Left" else -1
    center = CENTERS[number] * 1e-3
    across = np.stack(np.meshgrid(*2 * [np.linspace(-0.015, 0.015, 9)]), axis=-1)
    rays = center[:2] + across.reshape(-1, 2)

    def depth(kind: str, blink: float) -> Floats:
        name = f"{kind}_{side.lower()}"
        points = moved(name, **{f"eyeBlink{side}": blink})
        return first_hit(points, crab()[name].triangles, rays)

    assert (depth("lids", 1.0) > depth("eye", 1.0)).all()
    middle = np.linalg.norm(rays - center[:2], axis=1) < 0.008
    assert (depth("lids", 0.0) < depth("eye", 0.0))[middle].all()  # it looks at you
    # Half closed, the lid lies on the ball and not in it.
    high = rays[:, 1] > center[1] + 0.010
    assert (depth("lids", 0.5) > depth("eye", 0.5))[high].all()


def test_claws_snap() -> None:
    for side in ("left", "right"):
        before = moved(f"finger_{side}")[:, 0].mean()
        after = moved(f"finger_{side}", **{f"claw_snap_{side}": 1.0})[:, 0].mean()
        assert abs(after) > abs(before) + 0.003  # towards the fixed finger, outward


def test_the_flattened_turns_are_as_stated() -> None:
    body = of_body(build_body())
    assert 0.7e-3 < flattening(body.points, SPEECH["mouth_open"](body)) <= 0.9e-3
    horn = mandible(1)
    part = part_of(horn.points * 1e-3, mandible=swinging(horn))
    assert 4.7e-3 < flattening(part.points, SPEECH["mandibles_in"](part)) <= 5.3e-3


def test_its_own_poses_need_no_mapping_and_facefx_has_one() -> None:
    fitting = load_character("crab").fit()
    for pose in SPEECH:
        assert fitting.weights_of(pose) == {pose: 1.0}
    assert fitting.vocabulary == "crab"
    assert fitting.weights_of("PBM")["mandibles_in"] == 1
