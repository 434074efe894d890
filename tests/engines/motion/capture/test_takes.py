"""Takes in a folder: motion, and beside it sound, words and labels by name."""

from pathlib import Path

import pytest

from lipwright.engines.motion.capture import TakeFiles, find_takes, read_texts
from lipwright.errors import FileFormatError, InputError


def put(root: Path, *names: str) -> Path:
    for name in names:
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text("x", "utf-8")
    return root


def test_files_of_one_folder(tmp_path: Path) -> None:
    put(tmp_path, "b.csv", "a.c3d", "a.wav", "a.flac", "b.mp3", "b.TextGrid", ".c.csv", "d.wav")
    (tmp_path / "a.txt").write_text("Hello \n there.", "utf-8")
    assert find_takes(tmp_path) == [
        TakeFiles("a", tmp_path / "a.c3d", tmp_path / "a.wav", "Hello there."),
        TakeFiles("b", tmp_path / "b.csv", tmp_path / "b.mp3", None, tmp_path / "b.TextGrid"),
    ]


def test_folders_for_each_kind(tmp_path: Path) -> None:
    put(tmp_path, "motion/a.csv", "audio/a.flac", "measured/a.csv", "words.csv")
    (tmp_path / "text.csv").write_text("sentence,text\na.flac,bin blue\n", "utf-8")
    wanted = [
        TakeFiles("a", tmp_path / "motion/a.csv", tmp_path / "audio/a.flac", "bin blue", None)
    ]
    assert find_takes(tmp_path) == wanted
    assert find_takes(tmp_path / "motion") == wanted


def test_a_table_may_lie_elsewhere(tmp_path: Path) -> None:
    folder = put(tmp_path / "takes", "a.csv")
    table = tmp_path / "lines.csv"
    table.write_text("Name,Transcript\na,Hello.\n", "utf-8")
    assert find_takes(folder, table)[0].text == "Hello."


@pytest.mark.parametrize(
    ("names", "words"),
    [
        (("a.wav",), "no recorded motion"),
        (("text.csv.bak",), "no recorded motion"),
        (("a.csv", "a.c3d"), "'a.c3d' and 'a.csv' are both the take 'a'"),
    ],
)
def test_folders_that_are_refused(tmp_path: Path, names: tuple[str, ...], words: str) -> None:
    with pytest.raises(InputError, match=words):
        find_takes(put(tmp_path, *names))


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        find_takes(tmp_path / "none")
    with pytest.raises(InputError, match="cannot be read"):
        find_takes(put(tmp_path, "a.csv") / "a.csv")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "the columns none; expected 'name' and 'text'"),
        ("a,b\nc,d\n", "line 1: the columns a, b"),
        ("name,text\na,one\na,two\n", "line 3: 'a' a second time, with other words"),
        ("name,text\na\n", "line 2: 1 cells"),
    ],
)
def test_bad_tables_of_texts(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "text.csv"
    path.write_text(text, "utf-8")
    with pytest.raises(FileFormatError, match=words):
        read_texts(path)


def test_an_empty_text_is_refused(tmp_path: Path) -> None:
    put(tmp_path, "a.csv")
    (tmp_path / "a.txt").write_text(" \n", "utf-8")
    with pytest.raises(FileFormatError, match=r"a\.txt: is empty"):
        find_takes(tmp_path)
