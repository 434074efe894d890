"""Markers cleaned: what was spoilt on purpose is put right, and what cannot be is refused."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from lipwright.character.head import build_head
from lipwright.engines.motion.capture import clean, read_motion
from lipwright.errors import InputError
from tests.engines.motion.capture.made import (
    RATE,
    Floats,
    error_mm,
    motion,
    spoil,
    spread,
    write_c3d,
)

DATA = Path(__file__).parents[4] / ".." / "shared"
MARKERS = 109
SHAPES = ("jawOpen", "mouthFunnel", "mouthSmileLeft", "mouthSmileRight", "mouthUpperUpLeft")


@cache
def shapes() -> tuple[Floats, Floats]:
    """Places of 109 markers on the built-in head, (M, 3), and how shapes move them."""
    skin = max(build_head(), key=lambda part: len(part.positions) if part.morphs else 0)
    points = skin.positions.astype(np.float64)
    moves = np.stack([skin.morphs[name] for name in SHAPES]).astype(np.float64)
    front = np.flatnonzero(points[:, 2] > np.quantile(points[:, 2], 0.55))
    reach = np.linalg.norm(moves, axis=2).sum(axis=0)[front]
    mouth = front[reach > np.quantile(reach, 0.75)]
    chosen = [int(mouth[i]) for i in spread(points[mouth], 50, 0)]
    others = [int(front[i]) for i in spread(points[front], MARKERS, 0)]
    chosen += [i for i in others if i not in chosen][: MARKERS - 50]
    return points[chosen], moves[:, chosen]


@cache
def speech(seed: int, seconds: float = 3.0) -> Floats:
    """A face that talks, (T, M, 3), and rests in its first third of a second."""
    rng = np.random.default_rng(seed)
    rest, moves = shapes()
    at = np.arange(int(seconds * RATE)) / RATE
    waves = [
        np.sin(np.pi * rng.uniform(1, 3) * (at - 0.33)) ** 2 * rng.uniform(0.2, 0.8) for _ in SHAPES
    ]
    weights = np.stack(waves, axis=1) * np.clip((at - 0.33) / 0.1, 0, 1)[:, None]
    return np.asarray(rest + np.einsum("tc,cmi->tmi", weights, moves))


def rms(values: Floats) -> float:
    return float(np.sqrt(np.mean(values**2)))


def labels() -> list[str]:
    return [f"m{i:03}" for i in range(MARKERS)]


@pytest.mark.parametrize("seed", [1, 2])
def test_a_spoilt_take_is_recovered_from_its_file(tmp_path: Path, seed: int) -> None:
    true = speech(seed)
    spoilt = spoil(true, seed)
    path = write_c3d(tmp_path / "take.c3d", spoilt.points, labels())
    cleaned, report = clean(read_motion(path))
    off = error_mm(cleaned, report.rest.points, true)
    assert rms(off) < 0.3
    assert off.max() < 5
    assert np.isfinite(cleaned.values).all()
    assert report.gap_share == pytest.approx(0.02, abs=0.005)
    assert len(report.swaps) == len(spoilt.swaps)
    assert 0.5 * spoilt.spikes <= report.spikes <= 1.5 * spoilt.spikes
    assert report.refused == ()


def test_the_rest_face_is_where_the_face_is_still() -> None:
    true = speech(3)
    cleaned, _ = clean(motion(spoil(true, 3, swaps=0, spikes=0).points))
    resting = cleaned.points[:30]
    assert rms(1e3 * resting) < 0.3
    assert np.abs(cleaned.points).max() > 5e-3


def test_rest_may_be_a_span_of_seconds() -> None:
    true = speech(3)
    cleaned, _ = clean(motion(spoil(true, 3).points), rest=(1.0, 1.1))
    frames = (cleaned.times >= 1.0) & (cleaned.times < 1.1)
    np.testing.assert_allclose(cleaned.values[frames].mean(axis=0), 0, atol=1e-6)
    with pytest.raises(InputError, match=r"rest from 7 to 8 s; expected seconds between 0 and 3"):
        clean(motion(true), rest=(7.0, 8.0))


def test_takes_of_one_actor_share_a_rest_face() -> None:
    first, report = clean(motion(spoil(speech(4), 4).points, labels()))
    second = spoil(speech(5), 5).points
    turned = second[:, ::-1]
    cleaned, other = clean(motion(turned, labels()[::-1]), rest=report.rest)
    assert cleaned.channels == first.channels
    assert rms(error_mm(cleaned, other.rest.points, speech(5))) < 0.3
    assert rms(1e3 * cleaned.points[:30]) < 0.4


def test_the_head_alone_does_not_move_the_face() -> None:
    still = np.repeat(speech(1)[:1], 240, axis=0)
    cleaned, report = clean(motion(spoil(still, 6, noise=0, gaps=0, swaps=0, spikes=0).points))
    assert np.abs(cleaned.values).max() < 1e-6
    assert report.head_degrees > 2
    assert report.head_mm > 5


def test_clean_markers_stay_as_they_are() -> None:
    true = speech(7)
    cleaned, report = clean(motion(true))
    assert rms(error_mm(cleaned, report.rest.points, true)) < 0.05
    assert (report.swaps, report.spikes, report.gap_share) == ((), 0, 0)


def test_a_swap_behind_a_gap_is_put_right() -> None:
    true = speech(8)
    points = spoil(true, 8, gaps=0, swaps=0, spikes=0).points
    apart = np.linalg.norm(true[0][:, None] - true[0], axis=2) + 9 * np.eye(MARKERS)
    one = 20
    other = int(np.argmin(apart[one]))
    points[150:240, [one, other]] = points[150:240, [other, one]]
    points[145:160, one] = np.nan
    points[148:166, other] = np.nan
    points[235:244, other] = np.nan
    cleaned, report = clean(motion(points))
    assert len(report.swaps) == 1
    assert error_mm(cleaned, report.rest.points, true)[:, [one, other]].max() < 1.5


def test_three_labels_in_a_ring_are_put_right() -> None:
    true = speech(9)
    points = spoil(true, 9, gaps=0, swaps=0, spikes=0).points
    points[200:260, [10, 11, 12]] = points[200:260, [11, 12, 10]]
    cleaned, report = clean(motion(points))
    assert len(report.swaps) == 1
    assert report.swaps[0].count("m0") == 3
    assert rms(error_mm(cleaned, report.rest.points, true)) < 0.3


def test_low_rates_work_too() -> None:
    true = speech(1, 6.0)[::4]
    points = spoil(true, 1, longest=0.1).points
    cleaned, report = clean(motion(points, rate=RATE / 4))
    assert rms(error_mm(cleaned, report.rest.points, true)) < 0.4


def test_markers_that_are_lost_for_long_are_left_out() -> None:
    points = spoil(speech(2), 2, swaps=0).points
    points[60:300, 5] = np.nan
    points[:, 6] = np.nan
    cleaned, report = clean(motion(points))
    assert [text.partition(" ")[0] for text in report.refused] == ["m005", "m006"]
    assert "lost for 2.00 s" in report.refused[0]
    assert "m005.x" not in cleaned.channels
    assert len(cleaned.channels) == 3 * (MARKERS - 2)
    assert any(note.startswith("markers left out: m005 (lost") for note in cleaned.notes)


def test_the_report_is_one_line() -> None:
    _, report = clean(motion(spoil(speech(2), 2).points))
    line = str(report)
    assert "\n" not in line
    for words in ("made.c3d: 109 markers, 360 frames", "% gaps", "4 swaps", "left out: none"):
        assert words in line
    assert "the head turns" in line


def broken(what: str) -> NDArray[np.float64]:
    points = speech(1).copy()
    rng = np.random.default_rng(0)
    if what == "many lost":
        points[:, ::3] = np.nan
    elif what == "blind":
        points[100:160] = np.nan
    elif what == "nothing rigid":
        points += rng.normal(scale=0.01, size=(1, MARKERS, 3))
        points *= 1 + np.cumsum(rng.normal(scale=0.05, size=points.shape), axis=0)
    elif what == "never seen":
        points[:] = np.nan
    return points


@pytest.mark.parametrize(
    ("what", "words"),
    [
        ("many lost", r"37 of 109 markers are lost for too long: m000 \(lost for 3.00 s"),
        ("never seen", "109 of 109 markers are lost"),
        ("blind", r"most markers are lost from 0\.83 to 1\.33 s"),
    ],
)
def test_takes_that_are_refused(what: str, words: str) -> None:
    with pytest.raises(InputError, match=rf"made\.c3d: .*{words}"):
        clean(motion(broken(what)))


def test_named_markers_hold_the_head() -> None:
    true = speech(1)
    _, found = clean(motion(true))
    named = found.rest.rigid[::3]
    cleaned, report = clean(motion(spoil(true, 1).points), rigid=named)
    assert report.rest.rigid == named
    assert rms(error_mm(cleaned, report.rest.points, true)) < 0.3
    with pytest.raises(InputError, match=r"no marker 'm0001'.*Did you mean 'm001'"):
        clean(motion(true), rigid=["m0001", "m002", "m003"])
    with pytest.raises(InputError, match="lie on a line or in one place"):
        clean(motion(true), rigid=["m001", "m002"])


def test_a_face_without_anything_rigid_is_refused() -> None:
    with pytest.raises(InputError, match=r"no markers keep their distances.*Name those"):
        clean(motion(broken("nothing rigid")))


def test_a_rest_face_of_another_layout_is_refused() -> None:
    _, report = clean(motion(speech(1)))
    other = replace(report.rest, labels=("philtrum", *report.rest.labels[1:]))
    with pytest.raises(InputError, match="no marker 'philtrum'; expected the 109 markers"):
        clean(motion(speech(1)), rest=other)


@pytest.mark.shared_data
def test_a_human_face_with_recorded_curves(tmp_path: Path) -> None:
    if not (DATA / "characters" / "ict_head.glb").is_file():
        pytest.skip("the recordings are not beside the project")
    from bench.motion_capture import recovered

    for error, report, right in recovered(tmp_path, takes=2):
        assert rms(error) < 0.3
        assert right == len(report.swaps) == 4
