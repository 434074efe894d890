"""The motion engine from end to end: recordings, a database, lines, what is refused."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.gltf import read_gltf
from lipwright.motion_takes import build_motion
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier
from tests.engines.motion.takes import LINES, RATE, record, shapes


@pytest.fixture(scope="module")
def takes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return record(tmp_path_factory.mktemp("some takes"))


@pytest.fixture(scope="module")
def database(takes: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("databases") / "a database"
    built = build_motion(takes, folder, workers=1)
    assert (built.takes, built.refused) == (len(LINES), ())
    return folder


def alike(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.corrcoef(one, other)[0, 1])


@pytest.mark.parametrize("search", ["optimal", "greedy"])
def test_a_recorded_line_comes_back_as_it_was(database: Path, search: str) -> None:
    sound = pipeline.say(LINES["two"]).sound
    assert sound is not None
    speech = pipeline.align(sound, LINES["two"])
    made = pipeline.animate(
        speech, engine="motion", database=database, search=search, rate=RATE
    ).animation
    assert made.report["jumps"] == 0
    assert [take for take, _, _ in made.report["stretches"]] == ["two"]
    original = pipeline.animate(pipeline.say(LINES["two"]), rate=RATE).animation
    count = len(made) - 5
    for name, values in shapes(original).items():
        if name in ("jawOpen", "mouthPucker"):
            there = np.interp(made.times, original.times, values)
            assert alike(made.control(name)[5:count], there[5:count]) > 0.95, name


def test_a_new_line_is_put_together_and_closes(database: Path) -> None:
    speech = pipeline.say("Bring my map, please.")
    made = pipeline.animate(speech, engine="motion", database=database, rate=60).animation
    assert made.engine == "motion"
    assert made.report["paths"] > 1
    assert made.report["stretches"]
    jaw = made.control("jawOpen")
    assert jaw.max() > 0.15
    for phone in speech.phones:
        if phone.label in ("b", "m", "p"):
            near = (made.times >= phone.start - 0.02) & (made.times <= phone.end + 0.02)
            assert jaw[near].min() < 0.25 * jaw.max(), phone
    assert 0 <= made.values.min() <= made.values.max() <= 1
    assert np.abs(np.diff(made.values, axis=0)).max() * 60 < 25  # no leaps at the seams


def test_the_same_line_gives_the_same_bytes(database: Path, tmp_path: Path) -> None:
    for name in ("a.json", "b.json"):
        given = ["--engine", "motion", "--database", str(database)]
        assert main(["say", "Five more boats.", *given, "-o", str(tmp_path / name)]) == 0
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


def test_every_output_takes_it(database: Path, tmp_path: Path) -> None:
    outputs = [
        part for name in ("a.json", "a.csv", "a.glb", "a.html") for part in ("-o", tmp_path / name)
    ]
    given = ["--engine", "motion", "--database", database, "--search", "optimal"]
    assert main(list(map(str, ["say", "My paper boat.", *given, *outputs]))) == 0
    assert "jawOpen" in Animation.load(tmp_path / "a.json").controls
    assert all((tmp_path / name).stat().st_size for name in ("a.csv", "a.glb", "a.html"))


def test_phones_that_no_take_has_are_told(
    database: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    given = ["--engine", "motion", "--database", str(database)]
    assert main(["say", "A vision of joy.", *given, "-o", str(tmp_path / "a.json")]) == 0
    told = capsys.readouterr().err
    assert "phones that the database lacks: " in told
    assert "zh as " in told


def test_a_stopped_build_goes_on_where_it_was(takes: Path, tmp_path: Path) -> None:
    target = tmp_path / "db"
    seen: list[float] = []

    def stop(share: float) -> None:
        seen.append(share)
        if len(seen) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        build_motion(takes, target, workers=1, progress=stop)
    assert not target.exists()
    seen.clear()
    built = build_motion(takes, target, workers=1, progress=seen.append)
    assert len(seen) == len(LINES) - 3
    assert built.takes == len(LINES)
    assert [path.name for path in tmp_path.iterdir()] == ["db"]


def test_takes_are_added_and_counted(
    takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "db"
    more = record(tmp_path / "more", {"six": "Boys may vote in June."})
    assert main(["motion", "build", str(takes), "-o", str(target), "--workers", "1"]) == 0
    assert main(["motion", "add", str(more), str(target), "--json"]) == 0
    told = capsys.readouterr().out.splitlines()
    assert told[0].startswith(f"{target}: 5 takes (")
    assert json.loads(told[1])["takes"] == 6
    assert main(["motion", "info", str(target)]) == 0
    assert "6 takes (6 with sound)" in capsys.readouterr().out
    assert main(["motion", "info", str(target), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["units_per_phone"]["m"] > 3


def test_a_take_that_cannot_be_used_is_left_out(
    takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "takes"
    folder.mkdir()
    for path in takes.iterdir():
        (folder / path.name).write_bytes(path.read_bytes())
    (folder / "one.txt").unlink()
    (folder / "two.wav").unlink()
    rows = (folder / "three.csv").read_text().splitlines()
    (folder / "three.csv").write_text("\n".join(rows[: len(rows) // 2]))
    assert main(["motion", "build", str(folder), "-o", str(tmp_path / "db")]) == 0
    told = capsys.readouterr()
    assert "2 takes" in told.out
    for reason in ("one.csv: has no words", "two.csv: has no sound", "three.csv: motion from"):
        assert reason in told.err


NOTE = (
    "note: the database is synthetic: made by the bigram engine; build one from recordings with "
    "'lipwright motion build'\n"
)


@pytest.mark.parametrize("given", [[], ["--database", "synthetic"]])
def test_without_a_database_the_built_in_one_is_used_and_said_to_be_synthetic(
    given: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = str(tmp_path / "a.json")
    assert main(["say", "Hello.", "--engine", "motion", *given, "-o", output]) == 0
    assert capsys.readouterr().err == NOTE
    made = Animation.load(tmp_path / "a.json")
    assert (made.engine, made.report["database"]) == ("motion", "synthetic")
    assert made.control("open").max() > 0.2
    assert "jawOpen" not in made.controls


def test_a_folder_that_is_called_synthetic_goes_first(
    database: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["motion", "info", "synthetic"]) == 0
    told = capsys.readouterr()
    assert "units: 1" in told.out
    assert told.err == NOTE
    shutil.copytree(database, tmp_path / "synthetic")
    given = ["--engine", "motion", "--database", "synthetic", "-o", "a.json"]
    assert main(["say", "My map.", *given]) == 0
    assert capsys.readouterr().err == ""
    assert "jawOpen" in Animation.load(tmp_path / "a.json").controls


@pytest.mark.parametrize(
    ("character", "suffixes"),
    [
        ("head", "html glb csv json tsv"),
        ("crab", "html glb csv json tsv"),
        ("rhubarb", "html csv json tsv"),
        ("preston_blair", "html json dat"),
    ],
)
def test_every_character_plays_a_database_of_poses(
    character: str, suffixes: str, tmp_path: Path
) -> None:
    names = [f"a.{suffix}" for suffix in suffixes.split()]
    outputs = [part for name in names for part in ("-o", str(tmp_path / name))]
    given = ["--engine", "motion", "--character", character]
    assert main(["say", "My five boats moved.", *given, *outputs]) == 0
    assert all((tmp_path / name).stat().st_size for name in names)
    if "tsv" in suffixes:
        shapes = [row.split()[1] for row in (tmp_path / "a.tsv").read_text().splitlines()]
        assert shapes.count("A") >= 3  # m, b, m
        assert len(set(shapes)) >= 4
    if "glb" in suffixes:
        assert read_gltf(tmp_path / "a.glb").items("animations")


LINES_TO_CLOSE = (
    "Of my people, five moved off before Friday.",
    "If Ben moves, improve it even more.",
    "Five brave men have both been left before breakfast.",
    "Peter Piper picked a peck of pickled peppers.",
)


@pytest.mark.parametrize("search", ["several", "optimal", "greedy"])
@pytest.mark.parametrize("rate", [24.0, 30.0, 60.0])
def test_lips_close_and_meet_the_teeth_in_a_frame(search: str, rate: float) -> None:
    for text in LINES_TO_CLOSE:
        speech = pipeline.say(text)
        made = pipeline.animate(speech, engine="motion", search=search, rate=rate).animation
        for phone in speech.phones:
            pose = {**dict.fromkeys("pbm", "PBM"), **dict.fromkeys("fv", "FV")}.get(phone.label)
            if pose is None:
                continue
            away = np.maximum(phone.start - made.times, made.times - phone.end)
            near = away <= max(0.0, float(away.min())) + 1e-9
            assert made.control(pose)[near].max() >= 0.9, (text, phone)


def test_a_face_rests_while_nothing_is_said() -> None:
    rows = [
        Interval(*row)
        for row in (("sil", 0, 1.5), ("b", 1.5, 1.58), ("aa", 1.58, 1.8), ("sil", 1.8, 3.5))
    ]
    made = pipeline.animate(Speech(PhoneTrack(Tier(tuple(rows)))), engine="motion").animation
    assert np.abs(made.at(np.linspace(0.1, 1.2, 20))).max() < 0.06
    assert np.abs(made.at(np.linspace(2.1, 3.4, 20))).max() < 0.06
    assert made.at([1.7])[0, made.controls.index("open")] > 0.3


BAD = {
    "no such database": (["--engine", "motion", "--database", "none"], "none: no such folder"),
    "no database there": (["--engine", "motion", "--database", "."], "lipwright: "),
    "another engine": (["--database", "none"], "a motion database, with the bigram engine"),
    "controls": (["--controls", "poses"], "controls or markers, with the bigram engine"),
    "markers": (["--markers", "m.json"], "controls or markers, with the bigram engine"),
    "overrides": (
        ["--engine", "motion", "--database", "none", "--overrides", "mine.json"],
        "with the motion engine",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_input_is_one_line(
    name: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    given, told = BAD[name]
    assert main(["say", "Hello.", *given, "-o", "a.json"]) == 1
    error = capsys.readouterr().err
    assert told in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("voice", "text", "stand_in"),
    [
        ("fr", "Tu veux du feu, Jeanne ?", "y"),
        ("de", "Über rote Rosen.", "ʁ"),
        ("cmn", "你好吗", ""),
    ],
)
def test_lines_in_other_languages_are_spoken(voice: str, text: str, stand_in: str) -> None:
    speech = pipeline.say(text, voice=voice)
    made = pipeline.animate(speech, engine="motion").animation
    assert made.control("open").max() > 0.1
    assert any(stand_in in wanted for wanted in made.report["nearest_phones"])
