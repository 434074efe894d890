"""``set coverage`` as people and programs meet it."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from lipwright.cli import main
from lipwright.engines.bigram.set_file import DATA

PAGE = Path(__file__).parents[2] / "docs" / "coverage.md"


def run(*arguments: object) -> int:
    return main(["set", "coverage", *map(str, arguments)])


def partial(folder: Path) -> Path:
    """A set without ah-bmp, and without anything for oy."""
    content = json.loads((DATA / "english.json").read_bytes())
    content["bigrams"] = [
        b for b in content["bigrams"] if b["pair"] != ["ah", "bmp"] and "oy" not in b["pair"]
    ]
    del content["phones"]["oy"]
    path = folder / "mine.json"
    path.write_text(json.dumps(content))
    return path


def test_the_table_has_the_order_and_what_each_step_gains(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("--set", partial(tmp_path), "--text", "A map for a boy.", "--no-silence") == 0
    told = capsys.readouterr()
    lines = told.out.splitlines()
    assert max(map(len, lines)) <= 100
    assert "across words, silence left out" in lines[1]
    (start,) = (i for i, line in enumerate(lines) if line.startswith("to draw, in this order"))
    steps = [line.split() for line in lines[start + 2 : start + 5]]
    assert [step[1] for step in steps] == ["ah-bmp", "bmp-oy", *[steps[2][1]]][: len(steps)]
    assert steps[0][4:] == ["single", "curves", "map"]
    assert steps[1][4:] == ["no", "curve", "at", "all", "boy"]
    assert lines[-1] == "no single-phone curve either: oy"


def test_everything_is_listed_when_asked(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--language", "en") == 0
    head = capsys.readouterr().out
    assert "more: --all" in head
    assert run("--language", "en", "--all") == 0
    whole = capsys.readouterr().out.splitlines()
    assert len(whole) > len(head.splitlines()) + 50
    assert whole[-1].split()[4] == "100.0%"


def facts(capsys: pytest.CaptureFixture[str], *arguments: object) -> dict[str, Any]:
    assert run(*arguments, "--json") == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def test_the_answer_for_programs_holds_what_the_page_says(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = facts(capsys, partial(tmp_path), "--text", "A map.")
    documented = PAGE.read_text("utf-8").split("## The answer for programs")[1].split("\n## ")[0]
    for key in found:
        assert f"`{key}`" in documented, key
    for key in (*found["pairs"][0], *found["order"][0]):
        assert f"`{key}`" in documented, key
    assert found["needed"]["ah-bmp"] == 2
    assert found["missing"] == ["ah-bmp"]
    assert found["order"] == [
        {"pair": "ah-bmp", "gain": pytest.approx(2 / 5), "covered": pytest.approx(1)}
    ]
    (first, *_) = found["pairs"]
    assert (first["pair"], first["state"], first["word"]) == ("ah-bmp", "stand-in", "map")
    assert len(found["undrawn"]) == 1 + 43
    assert found["possible"] == 483


def test_options_reach_the_count(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = ("--text", "A map.")
    assert facts(capsys, *text, "--within-words")["total"] == 2
    assert facts(capsys, *text, "--no-silence")["total"] == 3
    timed = facts(capsys, *text, "--by", "time")
    assert timed["by"] == "time"
    assert 0.5 < timed["total"] < 1.5
    (tmp_path / "a.lab").write_text("0 1000000 m\n1000000 2000000 ae\n")
    labels = ("--labels", tmp_path / "a.lab")
    assert facts(capsys, *labels, *labels)["needed"]["bmp-ah"] == 2


def test_other_languages_name_their_stand_ins(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("--language", "de", "--text", "Ich möchte das Buch.") == 0
    told = capsys.readouterr()
    assert "ç as kg" in told.err
    assert " drawn *" in told.out


def test_the_picture_is_written_beside_the_table(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "a.svg"
    assert run("--text", "A map.", "--picture", target) == 0
    assert str(target) in capsys.readouterr().out
    root = ElementTree.parse(target).getroot()
    assert sum(1 for group in root.iter() if group.get("class") == "cell") == 484
    assert "100.0% of running speech drawn in the set english" in target.read_text("utf-8")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--text", ""], "nothing to say"),
        (["--text-file", "empty.txt"], "empty.txt: nothing to say"),
        (["--text-file", "nowhere.txt"], "nowhere.txt: no such file"),
        (["--text-file", "binary.txt"], "binary.txt: byte 0 is not UTF-8"),
        (["--language", "atlantean"], "no paragraph in the language 'atlantean'; expected one of "),
        (["--language", "atlantean", "--text", "Hi"], "no voice 'atlantean'"),
        (["--language", "en", "--text", "Привет, мир"], "does not read Cyrillic"),
        (["klingon"], "no bigram set 'klingon'"),
        (["--set", "nowhere.json"], "nowhere.json: no such file"),
        (["--picture", "a.png"], "a picture with '.png'; expected .svg"),
        (["--picture", "nowhere/a.svg"], "does not exist"),
        (["--labels", "odd.lab"], "odd.lab: "),
        (["--labels", "good.lab", "--within-words"], "good.lab: has phones but no words"),
        (["--labels", "good.lab", "--phone-set", "elvish"], "no phone set 'elvish'"),
        (["--overrides", "nowhere.json"], "nowhere.json: no such file"),
    ],
)
def test_bad_input_is_one_line(
    arguments: list[str],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("empty.txt").write_text("")
    Path("binary.txt").write_bytes(b"\xff\xfe\x00\x01")
    Path("odd.lab").write_text("0 1000000 m\n1000000 2000000 qq\n")
    Path("good.lab").write_text("0 1000000 m\n1000000 2000000 ae\n")
    before = sorted(tmp_path.iterdir())
    assert run(*arguments) == 1
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.count("\n") == 1
    assert words in told.err
    assert sorted(tmp_path.iterdir()) == before


def test_two_different_sets_are_wrong_usage(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("english", "--set", "other.json") == 2
    assert "two sets" in capsys.readouterr().err


def test_a_picture_is_not_written_over_what_is_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = tmp_path / "a.svg"
    text.write_text("A map.")
    assert run("--text-file", text, "--picture", text) == 1
    assert "over its own input" in capsys.readouterr().err
    assert text.read_text() == "A map."


def test_text_comes_through_a_pipe(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "lipwright", "set", "coverage", "--text-file", "-", "--json"]
    done = subprocess.run(command, input=b"A map.", capture_output=True)
    assert json.loads(done.stdout)["needed"]["bmp-ah"] == 1


def test_interrupting_a_long_count_leaves_nothing(tmp_path: Path) -> None:
    text = tmp_path / "long.txt"
    text.write_text("A very long story, and no end of it. " * 20000)
    command = [sys.executable, "-m", "lipwright", "set", "coverage", "--text-file", str(text)]
    process = subprocess.Popen(
        [*command, "--picture", str(tmp_path / "a.svg")], stderr=subprocess.PIPE, text=True
    )
    time.sleep(1.5)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=20)
    assert process.returncode == 130
    assert errors.strip() == "lipwright: interrupted; nothing was left half-written"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["long.txt"]


def test_a_text_that_names_a_file_is_that_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "a corpus.txt"
    path.write_text("A map for a boy.", "utf-8")
    assert facts(capsys, "--text", path) == facts(capsys, "--text-file", path)
    assert facts(capsys, "--text", "A map for a boy.")["needed"]["bmp-oy"] == 1
