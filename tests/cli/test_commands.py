"""The commands as a user types them: what they write, print and answer."""

import csv
import io
import json
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.engines.bigram.set_file import DATA
from tests.conftest import LINE

PIPER = "Peter Piper picked a peck of pickled peppers."


def run(*arguments: object) -> int:
    return main([str(argument) for argument in arguments])


def test_say_writes_every_format_and_the_sound_beside(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    names = ["a.json", "a.csv", "a.glb", "a.html"]
    outputs = [part for name in names for part in ("-o", tmp_path / name)]
    assert run("say", PIPER, *outputs) == 0
    for name in [*names, "a.wav"]:
        assert (tmp_path / name).stat().st_size > 1000
        assert str(tmp_path / name) in capsys.readouterr().out or name != "a.json"
    animation = Animation.load(tmp_path / "a.json")
    assert animation.words.labels[0] == "Peter"
    rows = list(csv.reader(io.StringIO((tmp_path / "a.csv").read_text())))
    assert rows[0] == ["time", *animation.controls]
    assert len(rows) == 1 + len(animation)
    closed = animation.control("PBM") > 0.9
    assert 6 <= np.sum(np.diff(closed.astype(int)) == 1) <= 8  # P P p p p p p


def test_say_to_standard_output_is_the_animation_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("say", "Hello there.", "-o", "-") == 0
    animation = Animation.from_bytes(capsys.readouterr().out.encode())
    assert animation.words.labels == ("Hello", "there")


def test_say_speaks_other_languages(tmp_path: Path) -> None:
    assert (
        run("say", "Guten Morgen, wie geht es dir?", "--voice", "de", "-o", tmp_path / "g.json")
        == 0
    )
    animation = Animation.load(tmp_path / "g.json")
    assert animation.control("open").max() > 0.2
    assert animation.control("PBM").max() > 0.9


def test_say_faster_is_shorter(tmp_path: Path) -> None:
    for speed in (120, 240):
        assert run("say", PIPER, "--speed", speed, "-o", tmp_path / f"{speed}.json") == 0
    slow, fast = (Animation.load(tmp_path / f"{speed}.json") for speed in (120, 240))
    assert fast.duration < 0.7 * slow.duration


def test_animate_takes_words_labels_or_nothing(line_wav: Path, tmp_path: Path) -> None:
    labels = tmp_path / "line.TextGrid"
    assert run("phones", line_wav, "--text", LINE, "-o", labels) == 0
    (tmp_path / "line.txt").write_text(LINE)
    ways = {
        "text": ("--text", LINE),
        "file": ("--text-file", tmp_path / "line.txt"),
        "labels": ("--labels", labels),
        "alone": (),
    }
    made = {}
    for name, way in ways.items():
        assert run("animate", line_wav, *way, "-o", tmp_path / f"{name}.json") == 0
        made[name] = Animation.load(tmp_path / f"{name}.json")
    assert made["text"].words.labels[:4] == ("She", "had", "your", "dark")
    assert np.array_equal(made["text"].values, made["file"].values)
    assert np.abs(made["text"].values - made["labels"].values).max() < 0.05
    assert made["alone"].control("open").max() > 0.2


def test_words_of_another_language_are_put_in_time(tmp_path: Path) -> None:
    text = "Bäume grünen früh."
    assert run("say", text, "--voice", "de", "-o", tmp_path / "said.json") == 0
    given = (tmp_path / "said.wav", "--text", text, "--language", "de")
    assert run("animate", *given, "-o", tmp_path / "a.json") == 0
    assert run("phones", *given, "-o", tmp_path / "a.TextGrid") == 0
    said, aligned = (Animation.load(tmp_path / name) for name in ("said.json", "a.json"))
    assert aligned.words.labels == ("Bäume", "grünen", "früh")
    assert np.abs(aligned.control("PBM") - said.control("PBM")).mean() < 0.05
    assert "yː" in (tmp_path / "a.TextGrid").read_text("utf-8")


def test_rate_and_preset_and_overrides_reach_the_engine(tmp_path: Path) -> None:
    gains = {"format": "lipwright/bigram-overrides", "version": 1, "name": "shy"}
    (tmp_path / "shy.json").write_text(json.dumps({**gains, "gains": {"open": 0.3}}))
    base = ("say", "Father", "--rate", 24, "-o")
    assert run(*base, tmp_path / "a.json") == 0
    assert run(*base, tmp_path / "b.json", "--overrides", tmp_path / "shy.json") == 0
    assert run(*base, tmp_path / "c.json", "--preset", "published") == 0
    plain, shy, published = (Animation.load(tmp_path / f"{name}.json") for name in "abc")
    assert plain.rate == 24
    assert shy.control("open").max() < 0.5 * plain.control("open").max()
    assert published.report["preset"] == "published"


def test_an_answer_for_programs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("say", "Hello.", "-o", tmp_path / "a.json", "--json") == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["files"] == [str(tmp_path / "a.json"), str(tmp_path / "a.wav")]
    assert facts["stand_ins"] == []


def test_set_commands(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("set", "coverage") == 0
    assert "483 of 483 pairs" in capsys.readouterr().out
    assert run("set", "coverage", "--text", "hello", "--json") == 0
    assert json.loads(capsys.readouterr().out)["share"] == 1
    assert run("set", "show", "f-ah") == 0
    shown = capsys.readouterr().out
    assert "fat" in shown
    assert "FV" in shown
    assert "█" in shown
    assert run("say", "Piper", "-o", tmp_path / "a.json") == 0
    capsys.readouterr()
    assert run("set", "why", tmp_path / "a.json", "--time", "0.3", "--control", "open") == 0
    assert "drawn by" in capsys.readouterr().out
    assert run("set", "why", tmp_path / "a.json", "--time", "0.3", "--json") == 0
    assert json.loads(capsys.readouterr().out)[0]["origins"][0]["source"] == "english"


def test_why_says_when_the_set_has_changed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (DATA / "english.json").read_text().replace('"name": "english"', '"name": "mine"')
    mine = tmp_path / "mine.json"
    mine.write_text(text)
    line = tmp_path / "line.json"
    assert run("say", "Father", "--set", mine, "-o", line) == 0
    animation = Animation.load(line)
    time = float(animation.times[animation.control("open").argmax()])
    capsys.readouterr()
    assert run("set", "why", line, "--time", time) == 1
    assert "--set" in capsys.readouterr().err
    assert run("set", "why", line, "--time", time, "--control", "open", "--set", mine) == 0
    assert capsys.readouterr().err == ""
    mine.write_text(re.sub(r'"softness": [\d.]+', '"softness": 0.3', text))
    assert run("set", "why", line, "--time", time, "--control", "open", "--set", mine) == 0
    told = capsys.readouterr().err
    assert "in the file" in told
    assert "other files of the set 'mine'" in told


def test_character_inspect(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("character", "inspect", "head", "--write", tmp_path / "map.json") == 0
    assert "PBM" in capsys.readouterr().out
    assert run("say", "Hi", "-o", tmp_path / "a.glb", "--mapping", tmp_path / "map.json") == 0
    capsys.readouterr()
    assert run("character", "inspect", "head", "--json") == 0
    assert json.loads(capsys.readouterr().out)


@pytest.mark.parametrize(
    "arguments",
    [(), ("--help",), ("say", "--help"), ("animate", "-h"), ("set", "why", "-h"), ("--version",)],
)
def test_help_is_there(arguments: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*arguments) in (0, 2)
    assert capsys.readouterr() != ("", "")


def test_interrupting_leaves_nothing_half_written(tmp_path: Path) -> None:
    text = tmp_path / "long.txt"
    text.write_text("A very long story. " * 3000)
    with text.open() as story:
        command = [sys.executable, "-m", "lipwright", "say", "-", "-o", str(tmp_path / "a.json")]
        process = subprocess.Popen(command, stdin=story, stderr=subprocess.PIPE, text=True)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=20)
    assert process.returncode == 130
    assert errors.strip() == "lipwright: interrupted; nothing was left half-written"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["long.txt"]


def test_interrupting_while_another_language_is_read_is_one_line(
    line_wav: Path, tmp_path: Path
) -> None:
    text = tmp_path / "long.txt"
    text.write_text("Eine sehr lange Geschichte. " * 3000, "utf-8")
    output = tmp_path / "a.json"
    arguments = [line_wav, "--text-file", text, "--language", "de", "-o", output]
    command = [sys.executable, "-m", "lipwright", "animate", *map(str, arguments)]
    process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    time.sleep(1.5)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert process.returncode == 130
    assert errors.strip() == "lipwright: interrupted; nothing was left half-written"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["long.txt"]


def test_a_reader_that_stops_early_is_no_error() -> None:
    command = f'"{sys.executable}" -m lipwright set coverage --json | head -c 10'
    run = subprocess.run(command, shell=True, capture_output=True, text=True, check=True)
    assert run.stderr == ""
