"""``motion info``: bars in the terminal, a picture in a file."""

import json
import sys
from pathlib import Path
from xml.etree import ElementTree

import click
import pytest
from click.testing import CliRunner

from lipwright.cli import main, motion_info
from lipwright.cli.motion import motion
from lipwright.engines.motion.building import build
from tests.engines.motion.small import prepared


def bars(told: str) -> list[str]:
    return [line for line in told.splitlines() if line.startswith("  ") and "█" in line]


def test_bars_stand_in_columns(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["motion", "info", "synthetic"]) == 0
    told = capsys.readouterr().out
    assert max(map(len, told.splitlines())) <= 80
    assert told == "".join(f"{line.rstrip()}\n" for line in told.splitlines())
    rows = bars(told)
    assert len(rows) == 14
    starts = [[at for at in range(1, len(row)) if row[at] == "█" != row[at - 1]] for row in rows]
    assert len({column for row in starts for column in row}) == 3
    assert "\x1b" not in told  # no colour where nobody looks
    words = [row.split() for row in rows]
    longest = max(words, key=lambda row: len(row[2]))
    assert longest[:2] == ["sil", "99"]
    assert "100.0" in told


def test_thin_and_lacking_phones_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    build(tmp_path / "db", [prepared("b" * 12 + "f" * 3)])
    assert main(["motion", "info", str(tmp_path / "db")]) == 0
    told = capsys.readouterr().out
    assert "thin (fewer than 10 units): f\n" in told
    assert "no unit of: aa ae ah ao " in told
    coloured = CliRunner().invoke(motion, ["info", str(tmp_path / "db")], color=True).output
    assert click.unstyle(coloured) == told
    thin, plenty = (
        next(line for line in coloured.splitlines() if f"  {phone} " in line) for phone in "fb"
    )
    assert "\x1b[33m" in thin
    assert "\x1b[34m" in plenty


def test_a_terminal_without_blocks_gets_letters(monkeypatch: pytest.MonkeyPatch) -> None:
    class Old:
        encoding = "cp1252"

    monkeypatch.setattr(sys, "stdout", Old())
    rows = [click.unstyle(row) for row in motion_info._bars({"a": 40, "b": 20, "c": 1})]
    (row,) = rows
    row.encode("ascii")
    counted = [word.count("#") for word in row.split() if "#" in word]
    assert abs(counted[0] - 2 * counted[1]) <= 1
    assert counted[1] > counted[2] == 1


def test_a_picture_is_drawn_and_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "units.svg"
    assert main(["motion", "info", "synthetic", "--picture", str(path)]) == 0
    assert f"  {path}  (picture)" in capsys.readouterr().out
    assert "synthetic: 36 takes" in path.read_text("utf-8")
    ElementTree.fromstring(path.read_text("utf-8"))
    path.unlink()
    assert main(["motion", "info", "synthetic", "--json", "--picture", str(path)]) == 0
    assert json.loads(capsys.readouterr().out)["takes"] == 36
    assert path.exists()


@pytest.mark.parametrize(
    ("name", "words"),
    [("units.png", "a picture with '.png'; expected .svg"), ("no/units.svg", "does not exist")],
)
def test_a_picture_that_cannot_be_written_is_refused_first(
    name: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["motion", "info", "synthetic", "--picture", str(tmp_path / name)]) == 1
    told = capsys.readouterr()
    assert words in told.err
    assert told.out == ""
