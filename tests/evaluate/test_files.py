"""Files that are measured: recorded faces and Rhubarb's tables."""

from pathlib import Path

import numpy as np
import pytest

from lipwright.errors import FileFormatError, InputError
from lipwright.evaluate import read_recording, read_rhubarb
from tests.evaluate.faces import write_recording


def test_a_frame_stands_for_its_middle(tmp_path: Path) -> None:
    gap, width = np.array([0.1, 0.2, 0.3, 0.2]), np.array([0.6, 0.5, 0.5, 0.6])
    seen = read_recording(write_recording(tmp_path / "face.csv", gap, width))
    np.testing.assert_allclose(seen.opening.times, [0.02, 0.06, 0.10, 0.14])
    np.testing.assert_allclose(seen.opening.values, gap)
    np.testing.assert_allclose(seen.breadth.values, width)
    assert seen.pucker is None


def test_the_pucker_comes_from_a_file_of_its_own(tmp_path: Path) -> None:
    face = write_recording(tmp_path / "face.csv", np.arange(4.0), np.arange(4.0))
    shapes = tmp_path / "shapes.csv"
    shapes.write_text("time,jawOpen,mouthPucker\n0,1,.1\n.1,1,.2\n.2,1,.4\n.3,1,.3\n")
    seen = read_recording(face, shapes)
    assert seen.pucker is not None
    np.testing.assert_allclose(seen.pucker.times, [0.05, 0.15, 0.25, 0.35])
    np.testing.assert_allclose(seen.pucker.values, [0.1, 0.2, 0.4, 0.3])


GOOD = "time,lipGapInner,lipWidth\n0,1,2\n.04,1,3\n.08,2,2\n.12,1,2\n"
BAD = {
    "no column": (GOOD.replace("lipWidth", "width"), "no column lipWidth"),
    "a word": (GOOD.replace("2,2", "2,two"), "line 4: 'two'"),
    "not a number": (GOOD.replace("2,2", "2,nan"), "line 4: 'nan'"),
    "a short row": (GOOD.replace("1,3", "1"), "line 3: ''"),
    "no frames": (GOOD.splitlines()[0], "0 frames"),
    "back in time": (GOOD.replace(".08", ".03"), "time 0.03 s comes after 0.04 s"),
    "empty": ("", "no column"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_recordings_are_refused(name: str, tmp_path: Path) -> None:
    text, words = BAD[name]
    (tmp_path / "face.csv").write_text(text)
    with pytest.raises(FileFormatError, match=words) as caught:
        read_recording(tmp_path / "face.csv")
    assert "face.csv" in str(caught.value)


def test_files_that_are_no_text_or_not_there(tmp_path: Path) -> None:
    (tmp_path / "face.csv").write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(FileFormatError, match="no text"):
        read_recording(tmp_path / "face.csv")
    with pytest.raises(InputError, match="no such file"):
        read_rhubarb(tmp_path / "none.tsv")


def test_rhubarbs_shapes_hold_until_the_next(tmp_path: Path) -> None:
    path = tmp_path / "line.tsv"
    path.write_text("0.00\tX\n0.10\tA\n0.25\tD\n0.50\tF\n0.60\tX\n")
    line = read_rhubarb(path)
    assert line.duration == pytest.approx(0.61)
    shown = dict(zip(line.controls, line.at([0.05, 0.15, 0.3, 0.55]).T, strict=True))
    np.testing.assert_allclose(shown["PBM"], [0, 1, 0, 0])
    assert list(np.argsort(shown["open"])[-2:]) == [3, 2]
    assert shown["W"].argmax() == 3
    before, after = line.at([0.24, 0.25])
    assert before[line.controls.index("PBM")] == 1
    assert after[line.controls.index("PBM")] == 0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "empty"),
        ("0.0\tX\n0.1\tZ\n", "line 2"),
        ("0.0 X\nsoon A\n", "line 2"),
        ("0.5\tX\n0.1\tA\n", "back"),
        ("0.0\tX\n1e9\tA\n", "line 2: time 1e9"),
        ("0.0\tX\nnan\tA\n", "line 2: time nan"),
    ],
)
def test_bad_tables_are_refused(text: str, words: str, tmp_path: Path) -> None:
    (tmp_path / "line.tsv").write_text(text)
    with pytest.raises(FileFormatError, match=words):
        read_rhubarb(tmp_path / "line.tsv")
