"""Mandarin from the command line: a line, its coverage, and bad input in one line each."""

import json
from pathlib import Path

import pytest

from lipwright.animation import Animation
from lipwright.cli import main
from tests.cli.test_bad_input import fails


def test_a_line_is_said_with_the_mandarin_set(tmp_path: Path) -> None:
    path = tmp_path / "line.json"
    arguments = ["say", "你好，女儿！", "--voice", "cmn", "--set", "mandarin", "-o", str(path)]
    assert main(arguments) == 0
    animation = Animation.load(path)
    assert animation.phones.phone_set == "pinyin"
    assert [phone.label for phone in animation.phones].count("ü") == 1
    assert animation.report["stand_ins"] == []
    assert main(["set", "why", str(path), "--time", "0.5"]) == 0


def test_coverage_misses_no_pair(capsys: pytest.CaptureFixture[str]) -> None:
    text = "2026年，妈妈和女儿去学校，我用iPhone。"
    assert main(["set", "coverage", "mandarin", "--text", text, "--voice", "cmn", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["missing"] == []
    assert found["share"] == 1
    assert "z-yu" in found["needed"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("zhv9", "'zhv9': no syllables of Mandarin; expected pinyin such as zhe4"),
        ("ni3 hao9", "'hao9': no syllables of Mandarin"),
        ("𠮷祥", "'𠮷': no known reading. Write pinyin in the place"),
        ("，。！", "nothing to say"),
        ("你好 مرحبا", "does not read Arabic letters. Choose one that does: --voice ar"),
    ],
)
def test_what_cannot_be_read_is_one_clear_line(
    text: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "out.json"
    said = fails(capsys, tmp_path, "say", text, "--voice", "cmn", "--set", "mandarin", "-o", output)
    assert words in said
