"""``--by-ear``: a file without text is animated, labelled and learnt from."""

import json
from pathlib import Path

import numpy as np
import pytest

from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.schedule.by_ear import NOTE
from lipwright.sound import Sound
from tests.engines.motion.takes import LINES, record


@pytest.fixture(scope="module")
def line(tmp_path_factory: pytest.TempPathFactory) -> Path:
    sound = pipeline.say("Könnten Sie das bitte wiederholen?", voice="de").sound
    assert sound is not None
    path = tmp_path_factory.mktemp("a line") / "line.wav"
    path.write_bytes(sound.wav_bytes())
    return path


@pytest.fixture(scope="module")
def takes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Three takes, of which one has its words."""
    names = ("one", "two", "three")
    folder = record(tmp_path_factory.mktemp("takes"), {name: LINES[name] for name in names})
    for name in names[1:]:
        (folder / f"{name}.txt").unlink()
    return folder


def test_a_line_is_animated(line: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "a.json"
    assert main(["animate", str(line), "--by-ear", "-o", str(output)]) == 0
    told = capsys.readouterr()
    assert "0 words" in told.out.splitlines()[0]
    assert told.err == f"note: {NOTE}\n"
    made = Animation.load(output)
    assert made.control("open").max() > 0.3
    assert not len(made.words)


def test_phones_are_written(line: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "a.TextGrid"
    assert main(["phones", str(line), "--by-ear", "--json", "-o", str(output)]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["source"], told["confidence"], told["words"]) == ("ear", 0.0, 0)
    again = pipeline.from_labels(output)
    assert again.phones.tier.labels == pipeline.hear(line).phones.tier.labels


def test_takes_without_words_are_learnt_from(
    takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "db"
    build = ["motion", "build", str(takes), "-o", str(target), "--workers", "1"]
    assert main(build) == 0
    told = capsys.readouterr()
    assert told.out.startswith(f"{target}: 1 takes")
    assert "two.csv: has no words" in told.err
    assert main([*build, "--by-ear"]) == 0
    told = capsys.readouterr()
    assert told.out.startswith(f"{target}: 3 takes")
    assert told.err.splitlines()[-1].startswith("note: takes without words: 2; ")
    more = tmp_path / "more"
    more.mkdir()
    for path in takes.glob("two.*"):
        (more / f"four{path.suffix}").write_bytes(path.read_bytes())
    assert main(["motion", "add", str(more), str(target), "--by-ear"]) == 0
    assert capsys.readouterr().out.startswith(f"{target}: 4 takes")


def test_a_line_by_ear_finds_its_take(takes: Path, tmp_path: Path) -> None:
    target, output = tmp_path / "db", tmp_path / "a.json"
    assert main(["motion", "build", str(takes), "-o", str(target), "--by-ear"]) == 0
    given = ["--engine", "motion", "--database", str(target), "-o", str(output)]
    assert main(["animate", str(takes / "two.wav"), "--by-ear", *given]) == 0
    made = Animation.load(output)
    rows = np.genfromtxt(takes / "two.csv", delimiter=",", names=True)
    jaw = np.interp(made.times, rows["time"] + 0.01, rows["jawOpen"])
    assert np.corrcoef(jaw, made.control("jawOpen"))[0, 1] > 0.8


def test_where_no_take_has_words_the_way_out_is_named(
    takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "takes"
    folder.mkdir()
    for path in takes.glob("two.*"):
        (folder / path.name).write_bytes(path.read_bytes())
    assert main(["motion", "build", str(folder), "-o", str(tmp_path / "db")]) == 1
    assert "--by-ear" in capsys.readouterr().err
    assert not (tmp_path / "db").exists()


def test_a_take_without_speech_is_left_out(
    takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "takes"
    folder.mkdir()
    for path in takes.iterdir():
        (folder / path.name).write_bytes(path.read_bytes())
    count = len(np.genfromtxt(folder / "two.csv", delimiter=",", names=True))
    noise = np.random.default_rng(0).normal(0, 0.1, count * 320).astype(np.float32)
    (folder / "two.wav").write_bytes(Sound(noise, 16000).wav_bytes())
    assert main(["motion", "build", str(folder), "-o", str(tmp_path / "db"), "--by-ear"]) == 0
    told = capsys.readouterr()
    assert "2 takes" in told.out
    assert "two.wav: no speech in it" in told.err


USAGE = {
    "text": ["--text", "Könnten Sie"],
    "text file": ["--text-file", "line.txt"],
    "labels": ["--labels", "line.TextGrid"],
    "language": ["--language", "de"],
    "lexicon": ["--lexicon", "words.dict"],
    "phone set": ["--phone-set", "ipa"],
}


@pytest.mark.parametrize("command", ["animate", "phones"])
@pytest.mark.parametrize("name", USAGE)
def test_words_do_not_go_with_it(
    command: str, name: str, line: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    given = [command, str(line), "--by-ear", *USAGE[name], "-o", str(tmp_path / "a.json")]
    assert main(given) == 2
    assert f"it does not go with {USAGE[name][0]}\n" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


SOUNDS = {
    "silence": (np.zeros(16000), "silent"),
    "one sample": (np.ones(1), "no speech in it"),
    "noise": (np.random.default_rng(0).normal(0, 0.1, 32000), "no speech in it"),
}


@pytest.mark.parametrize("name", SOUNDS)
def test_a_sound_without_speech_is_one_line(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    samples, words = SOUNDS[name]
    path = tmp_path / "line.wav"
    path.write_bytes(Sound(samples.astype(np.float32), 16000).wav_bytes())
    assert main(["animate", str(path), "--by-ear", "-o", str(tmp_path / "a.json")]) == 1
    told = capsys.readouterr().err
    assert told.startswith("lipwright: ")
    assert told.count("\n") == 1
    assert words in told
    assert "line.wav" in told
    assert [each.name for each in tmp_path.iterdir()] == ["line.wav"]


def test_standard_input_is_no_recording(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["animate", "-", "--by-ear", "-o", str(tmp_path / "a.json")]) == 1
    assert capsys.readouterr().err.count("\n") == 1
