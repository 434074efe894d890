"""Markers on characters: a face that they drive, poses that they are told in, their file."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.gltf import morph_meshes, parse_glb
from lipwright.motion_takes import build_motion
from tests.export.validator import issues
from tests.marked_faces import RATE, record

LINE = "My boat moved past the paper map."


@pytest.fixture(scope="module")
def database(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("a b")
    build_motion(record(folder / "takes"), folder / "db", workers=1)
    return folder / "db"


def options(database: Path, *more: str) -> list[str]:
    return ["--engine", "motion", "--database", str(database), *more]


def test_markers_drive_the_head(database: Path, tmp_path: Path) -> None:
    target = tmp_path / "a.glb"
    outputs = ["-o", str(target), "-o", str(tmp_path / "a.html"), "-o", str(tmp_path / "a.tsv")]
    assert main(["say", LINE, *options(database), *outputs]) == 0
    assert issues(target.read_bytes(), tmp_path) == []
    model = parse_glb(target.read_bytes(), "a.glb")
    names = {name for mesh in morph_meshes(model) for name in mesh.targets}
    assert {"markers mean", "markers 1", "markers lips apart"} <= names
    page = (tmp_path / "a.html").read_text("utf-8")
    assert '"markers 1"' in page  # what moves the model
    assert '"controls":["open","W"' in page  # what is drawn
    cues = (tmp_path / "a.tsv").read_text().splitlines()
    assert sum(line.endswith("A") for line in cues) >= 5  # m b m p p m p


def test_markers_are_told_in_the_poses_that_made_them(database: Path) -> None:
    speech = pipeline.say("We saw five blue boats on the water.")  # as in take two
    made = pipeline.animate(
        speech, engine="motion", database=database, controls="poses", rate=RATE
    ).animation
    drawn = pipeline.animate(speech, rate=RATE).animation
    for pose, least in (("open", 0.85), ("W", 0.8)):
        there = np.interp(made.times, drawn.times, drawn.control(pose))
        assert np.corrcoef(there, made.control(pose))[0, 1] > least, pose
    for phone in speech.phones:
        if phone.label == "b":
            near = (made.times >= phone.start - 0.01) & (made.times <= phone.end + 0.01)
            assert made.control("PBM")[near].max() > 0.9


@pytest.mark.parametrize("character", ["crab", "rhubarb"])
def test_who_has_no_such_face_plays_poses(database: Path, tmp_path: Path, character: str) -> None:
    target = tmp_path / "a.json"
    given = options(database, "--character", character)
    assert main(["say", LINE, *given, "-o", str(target)]) == 0
    assert "PBM" in Animation.load(target).controls


def test_where_markers_lie_is_a_file_to_edit(
    database: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "head.json"
    assert main(["motion", "bind", str(database), "-o", str(target)]) == 0
    assert "markers lie 0." in capsys.readouterr().out
    document = json.loads(target.read_text("utf-8"))
    assert len(document["markers"]) > 40
    document["pins"] = {"dot00": document["markers"]["dot01"]}
    moved = tmp_path / "moved.json"
    moved.write_text(json.dumps(document), "utf-8")
    for file, name in ((target, "a.glb"), (moved, "b.glb")):
        given = options(database, "--markers", str(file))
        assert main(["say", LINE, *given, "-o", str(tmp_path / name)]) == 0
    assert (tmp_path / "a.glb").read_bytes() != (tmp_path / "b.glb").read_bytes()


def test_a_set_is_fitted_to_markers(database: Path, tmp_path: Path) -> None:
    target = tmp_path / "mine.json"
    assert main(["set", "fit", str(database), "-o", str(target)]) == 0
    speech = pipeline.say("We saw five blue boats on the water.")
    mine = pipeline.animate(speech, bigram_set=target, rate=RATE).animation
    drawn = pipeline.animate(speech, rate=RATE).animation
    for pose in ("open", "W"):  # what moved the markers, found again
        there = np.interp(mine.times, drawn.times, drawn.control(pose))
        assert np.corrcoef(there, mine.control(pose))[0, 1] > 0.7, pose


BAD = {
    "a marker file for shapes": (
        ["say", LINE, "--engine", "motion", "--markers", "x.json", "-o", "a.glb"],
        "x.json: a marker file, for a database without markers",
    ),
    "no such marker file": (
        ["say", LINE, *options(Path("DB")), "--markers", "none.json", "-o", "a.glb"],
        "none.json: no such file",
    ),
    "markers on a crab": (
        ["say", LINE, *options(Path("DB"), "--controls", "recorded", "--character", "crab"),
         "-o", "a.glb"],
        "miss this face by",
    ),
    "markers on pictures": (
        ["say", LINE, *options(Path("DB"), "--controls", "recorded", "--character", "rhubarb"),
         "-o", "a.tsv"],
        "markers, for a character of pictures",
    ),
    "to bind a database of poses": (
        ["motion", "bind", "SYNTHETIC", "-o", "b.json"],
        "no markers, but channels such as 'open'",
    ),
    "to bind nothing": (["motion", "bind", "none", "-o", "b.json"], "none: no such folder"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_line(
    name: str,
    database: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    from lipwright.engines.motion.synthetic import FOLDER

    monkeypatch.chdir(tmp_path)
    given, words = BAD[name]
    places = {"DB": str(database), "SYNTHETIC": str(FOLDER)}
    assert main([places.get(part, part) for part in given]) == 1
    told = capsys.readouterr().err
    assert words in told
    assert told.count("\n") == 1, told
    assert list(tmp_path.iterdir()) == []
