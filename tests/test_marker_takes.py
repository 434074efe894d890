"""Databases of markers: built from C3D, spoken with, written, and what is refused."""

from __future__ import annotations

import csv
import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.engines.motion.capture import read_motion
from lipwright.engines.motion.database import open_database
from lipwright.engines.motion.learnt import learnt_of
from lipwright.markers import marker_labels
from lipwright.motion_takes import build_motion
from tests.engines.motion.capture.made import write_c3d
from tests.engines.motion.takes import LINES
from tests.engines.motion.takes import record as record_shapes
from tests.marked_faces import RATE, dots, head_skin, labels, record

LINE = "My boat moved past the paper map."


@pytest.fixture(scope="module")
def takes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record(tmp_path_factory.mktemp("marker takes"))


@pytest.fixture(scope="module")
def database(takes: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("a b") / "db"
    built = build_motion(takes, folder, workers=1)
    assert (built.takes, built.refused) == (len(LINES), ())
    return folder


def copied(takes: Path, to: Path) -> Path:
    return Path(shutil.copytree(takes, to))


def changed(path: Path, take: str, change: object) -> None:
    """Write a take's markers anew, changed."""
    motion = read_motion(path / f"{take}.c3d")
    points = motion.points
    names = change(points)  # type: ignore[operator]
    write_c3d(path / f"{take}.c3d", points, names or motion.labels, rate=RATE)


def test_all_takes_lie_on_one_rest_face(database: Path) -> None:
    held = open_database(database)
    assert held.markers == labels()
    assert len(held.rigid) >= 4
    face = np.asarray(held.rest, np.float64).reshape(-1, 3)
    true = head_skin().positions[dots()].astype(np.float64)
    apart = np.linalg.norm(face[:, None] - face, axis=2)
    wanted = np.linalg.norm(true[:, None] - true, axis=2)
    assert np.abs(apart - wanted).max() < 1.5e-3  # a face at rest is not quite neutral


def test_the_lips_are_found_without_names(database: Path) -> None:
    held = open_database(database)
    row = learnt_of(held).row
    assert row is not None
    weights = row.reshape(-1, 3)
    used = np.flatnonzero(np.abs(weights).sum(axis=1))
    places = head_skin().positions[dots()][used]
    lips = head_skin().positions[dots()][:12]
    assert np.abs(places[:, 1] - lips[:, 1].mean()).max() < 0.02  # metres, about the mouth
    assert np.allclose(weights.sum(axis=0), 0, atol=1e-9)  # moving the head opens nothing


def test_a_line_gives_places_on_a_still_head(database: Path) -> None:
    speech = pipeline.say(LINE)
    made = pipeline.animate(
        speech, engine="motion", database=database, controls="recorded", rate=RATE
    ).animation
    assert marker_labels(made.controls) == labels()
    held = open_database(database)
    moved = made.values - held.rest
    assert 0.003 < np.abs(moved).max() < 0.05  # metres
    brow = [3 * labels().index(name) for name in held.rigid]
    assert np.abs(moved[:, brow]).max() < 5e-4


def test_closures_close_between_the_lips(database: Path) -> None:
    speech = pipeline.say(LINE)
    made = pipeline.animate(
        speech, engine="motion", database=database, controls="recorded", rate=60
    ).animation
    held = open_database(database)
    known = learnt_of(held)
    assert known.opening is not None
    opening = known.opening(np.asarray(made.values - held.rest, np.float64))
    for phone in speech.phones:
        if phone.label in ("p", "b", "m"):
            near = (made.times >= phone.start - 0.02) & (made.times <= phone.end + 0.02)
            assert opening[near].min() < 0.2 * opening.max(), phone


def test_markers_are_written_as_json_csv_and_c3d(database: Path, tmp_path: Path) -> None:
    files = [tmp_path / f"a.{suffix}" for suffix in ("json", "csv", "c3d")]
    given = ["--engine", "motion", "--database", str(database), "--controls", "recorded"]
    outputs = [part for file in files for part in ("-o", str(file))]
    assert main(["say", LINE, *given, *outputs]) == 0
    made = Animation.load(files[0])
    again = read_motion(files[2])
    assert again.labels == marker_labels(made.controls)
    assert again.rate == made.rate
    assert np.abs(again.values - made.values).max() < 1e-6
    assert files[1].read_text().startswith("time,dot00.x,dot00.y,dot00.z")


def test_c3d_of_poses_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["say", "Hello.", "-o", str(tmp_path / "a.c3d")]) == 1
    assert "no markers to write as C3D" in capsys.readouterr().err


def test_every_take_is_told_of(
    takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = copied(takes, tmp_path / "takes")
    (folder / "one.txt").unlink()
    table = tmp_path / "takes.csv"
    given = ["motion", "build", str(folder), "-o", str(tmp_path / "db"), "--workers", "1"]
    assert main([*given, "--report", str(table)]) == 0
    assert "% of their variance kept; least of " in capsys.readouterr().out
    with table.open(newline="") as file:
        rows = {row["take"]: row for row in csv.DictReader(file)}
    assert set(rows) == set(LINES)
    assert rows["one"]["used"] == "no"
    assert "has no words" in rows["one"]["notes"]
    assert float(rows["two"]["variance"]) > 0.95
    assert 0.0005 < float(rows["two"]["gaps"]) < 0.01


def test_takes_that_are_added_lie_on_the_same_face(
    takes: Path, database: Path, tmp_path: Path
) -> None:
    target = copied(database, tmp_path / "db")
    more = record(tmp_path / "more", {"six": "Boys may vote in June."})
    before = np.array(open_database(target).rest)
    built = build_motion(more, target, add=True, workers=1)
    assert built.takes == len(LINES) + 1
    held = open_database(target)
    assert np.array_equal(held.rest, before)
    last = held.values[held.take_first[-2] : held.take_first[-1]]
    brow = [3 * held.markers.index(name) + axis for name in held.rigid for axis in range(3)]
    assert np.abs(last[:, brow]).max() < 1e-3


def lost(points: np.ndarray) -> None:
    points[20:110, 3] = np.nan  # 1.5 s without a marker


def test_a_marker_that_a_take_lost_is_left_out_of_all(takes: Path, tmp_path: Path) -> None:
    folder = copied(takes, tmp_path / "takes")
    changed(folder, "two", lost)
    built = build_motion(folder, tmp_path / "db", workers=1)
    assert built.takes == len(LINES)
    assert any("markers that some take lost for too long: dot03" in note for note in built.notes)
    assert "dot03" not in open_database(tmp_path / "db").markers


def test_a_take_that_lost_most_is_left_out(takes: Path, tmp_path: Path) -> None:
    folder = copied(takes, tmp_path / "takes")

    def blind(points: np.ndarray) -> None:
        points[20:80] = np.nan

    changed(folder, "two", blind)
    built = build_motion(folder, tmp_path / "db", workers=1)
    assert built.takes == len(LINES) - 1
    assert "most markers are lost from" in built.refused[0]


def test_labels_of_another_layout_leave_a_take_out(takes: Path, tmp_path: Path) -> None:
    folder = copied(takes, tmp_path / "takes")
    changed(folder, "two", lambda points: [f"m{n}" for n in range(points.shape[1])])
    built = build_motion(folder, tmp_path / "db", workers=1)
    assert built.takes == len(LINES) - 1
    assert "no marker 'dot00'" in built.refused[0]


def test_shapes_and_markers_do_not_go_together(
    takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = copied(takes, tmp_path / "takes")
    record_shapes(folder, {"seven": "Go now."})
    assert main(["motion", "build", str(folder), "-o", str(tmp_path / "db")]) == 1
    told = capsys.readouterr().err
    assert "shapes (seven.csv) and markers (five.c3d)" in told
    assert told.count("\n") == 1
    assert not (tmp_path / "db").exists()


def test_a_second_build_gives_the_same_bytes(takes: Path, database: Path, tmp_path: Path) -> None:
    build_motion(takes, tmp_path / "db", workers=1)
    header = json.loads((database / "database.json").read_text())
    for path in sorted((database / header["arrays"]).iterdir()):
        again = tmp_path / "db" / header["arrays"] / path.name
        assert again.read_bytes() == path.read_bytes(), path.name
