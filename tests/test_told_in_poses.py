"""Recorded motion told in poses: closures are reached, bounds hold, few keys, any character."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.engines.bigram import load_set
from lipwright.motion_takes import build_motion
from tests.engines.motion.takes import record

# Lips that close and round, and a tongue.
LINE = "Bring five more paper boats before the water moves."


@pytest.fixture(scope="module")
def database(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("a b")
    build_motion(record(folder / "takes"), folder / "db", workers=1)
    return folder / "db"


@pytest.fixture(scope="module")
def told(database: Path) -> Animation:
    speech = pipeline.say(LINE)
    return pipeline.animate(speech, engine="motion", database=database, controls="poses").animation


def test_it_has_the_poses_of_the_set(told: Animation) -> None:
    assert told.controls == load_set("english").rules.names
    assert told.report["told_in_poses_of"] == "english"
    assert 0 <= told.values.min() <= told.values.max() <= 1
    assert told.control("open").max() > 0.3
    assert told.control("W").max() > 0.2


@pytest.mark.parametrize("rate", [24.0, 30.0, 60.0])
def test_every_closure_is_reached_at_any_rate(database: Path, rate: float) -> None:
    speech = pipeline.say(LINE)
    made = pipeline.animate(
        speech, engine="motion", database=database, controls="poses", rate=rate
    ).animation
    for phone in speech.phones:
        pose = {"p": "PBM", "b": "PBM", "m": "PBM", "f": "FV", "v": "FV"}.get(phone.label)
        if pose is None:
            continue
        near = (made.times >= phone.start - 0.5 / rate) & (made.times <= phone.end + 0.5 / rate)
        assert made.control(pose)[near].max() >= 0.9, (phone, rate)


def test_the_bounds_of_the_set_hold(told: Animation) -> None:
    for high, low, threshold in load_set("english").rules.bounds():
        if threshold <= 1:
            room = np.maximum(0.0, 1.0 - told.control(high.name) / threshold)
            assert (told.control(low.name) <= room + 1e-6).all(), (high.name, low.name)


def test_few_keys_stand_for_the_frames(told: Animation) -> None:
    for name, keys in told.keys.items():
        assert np.abs(keys.at(told.times) - told.control(name)).max() <= 0.02 + 1e-6, name
    moving = [name for name in told.controls if told.control(name).any()]
    assert set(told.keys) == set(moving)
    assert sum(map(len, told.keys.values())) < len(moving) * len(told) / 4


def test_a_face_keeps_its_motion(database: Path, told: Animation) -> None:
    speech = pipeline.say(LINE)
    shapes = pipeline.animate(speech, engine="motion", database=database).animation
    jaw = np.interp(told.times, shapes.times, shapes.control("jawOpen"))
    assert np.corrcoef(jaw, told.control("open"))[0, 1] > 0.9


@pytest.mark.parametrize("character", ["crab", "rhubarb"])
def test_characters_without_these_shapes_play_poses(
    database: Path, tmp_path: Path, character: str
) -> None:
    target = tmp_path / ("a.tsv" if character == "rhubarb" else "a.glb")
    given = ["--engine", "motion", "--database", str(database), "--character", character]
    assert main(["say", LINE, *given, "-o", str(target), "-o", str(tmp_path / "a.json")]) == 0
    assert "PBM" in Animation.load(tmp_path / "a.json").controls
    assert target.stat().st_size > 100


def test_a_set_says_in_whose_poses(database: Path) -> None:
    speech = pipeline.say("Mandarin has more.")
    made = pipeline.animate(
        speech, engine="motion", database=database, bigram_set="mandarin"
    ).animation
    assert made.report["told_in_poses_of"] == "mandarin"


BAD = {
    "a set for recorded controls": (
        ["--controls", "recorded", "--set", "english"],
        "a set, for recorded controls",
    ),
    "poses that no lips have": (["--set", "crab"], "moves the head's lips"),
    "recorded controls on a crab": (
        ["--controls", "recorded", "--character", "crab"],
        "none of the controls",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_line(
    name: str, database: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    given, words = BAD[name]
    source = ["--engine", "motion", "--database", str(database)]
    assert main(["say", "Hello.", *source, *given, "-o", str(tmp_path / "a.json")]) == 1
    told = capsys.readouterr().err
    assert words in told
    assert told.count("\n") == 1
    assert list(tmp_path.iterdir()) == []
