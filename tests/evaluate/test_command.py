"""``lipwright evaluate motion`` as a user types it."""

import json
from pathlib import Path

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.character.head import build_head, landmarks, measure
from lipwright.cli import main
from tests.evaluate.faces import FRAME, PHONES, mouth, write_recording


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """An animation of the head, and a recording of a face that moves as the head does."""
    folder = tmp_path_factory.mktemp("faces")
    times = np.arange(180) / 60
    opened = 0.6 * mouth(times)
    values = np.stack((opened, 0.4 - 0.4 * np.cos(3 * times)), axis=1).astype(np.float32)
    made = Animation(("open", "W"), values, 60.0, phones=PHONES)
    made.save(folder / "line.json")
    weights = made.at((np.arange(75) + 0.5) * FRAME)
    parts, marks = build_head(), landmarks()
    seen = measure(parts, marks, {"open": weights[:, 0], "W": weights[:, 1]})
    face = write_recording(folder / "face.csv", 10 * seen.opening, 10 * seen.breadth)
    return folder / "line.json", face


def run(*arguments: object) -> int:
    return main(["evaluate", "motion", *map(str, arguments)])


def test_a_face_that_moves_as_the_head_does(
    files: tuple[Path, Path], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*files, "--json") == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["lag_ms"] == 0
    assert facts["opening"]["correlation"] > 0.999
    assert facts["rounding"]["correlation"] > 0.999
    assert facts["closures"]["p b m"]["met"] == 1
    assert facts["frames"] == 75
    assert run(*files) == 0
    told = capsys.readouterr().out
    assert "opening   correlation 1.00" in told
    assert "p b m     100% of 2 recorded closures met" in told


def test_rhubarb_with_phones_from_labels(
    files: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table, labels = tmp_path / "line.tsv", tmp_path / "line.ctm"
    table.write_text("0\tX\n1\tA\n1.1\tD\n1.4\tA\n1.5\tB\n1.8\tG\n1.9\tF\n2.2\tX\n3\tX\n")
    assert run(table, files[1], "--json") == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["closures"] == {}
    assert 0.3 < facts["opening"]["correlation"] < 0.999
    labels = tmp_path / "line.lab"
    labels.write_text(
        "".join(f"{phone.start:.3f} {phone.end:.3f} {phone.label}\n" for phone in PHONES)
    )
    assert run(table, files[1], "--labels", labels, "--json") == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["closures"]["p b m"]["met"] == 1


def test_what_cannot_be_compared_is_said_in_one_line(
    files: tuple[Path, Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    animation, face = files
    ears = tmp_path / "ears.json"
    Animation(("earWiggle",), np.zeros((9, 1), np.float32), 60.0).save(ears)
    for arguments, words in (
        ((animation, animation), "no column time"),
        ((face, face), "JSON"),
        ((ears, face), "no control moves the head's mouth"),
        ((animation, tmp_path / "none.csv"), "no such file"),
        ((animation, face, "--shapes", face), "no column mouthPucker"),
    ):
        assert run(*arguments) == 1
        captured = capsys.readouterr()
        assert captured.out == ""
        assert captured.err.count("\n") == 1
        assert words in captured.err
