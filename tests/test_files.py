"""Files: read whole or refused with their place, written whole or not at all."""

import errno
import io
import os
import stat
import sys
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright import files
from lipwright.errors import FileFormatError, InputError, OutputError


def parts(folder: Path) -> list[str]:
    return [path.name for path in folder.iterdir() if path.name.endswith(".part")]


# Writing


def test_a_new_file_has_its_content_and_ordinary_rights(tmp_path: Path) -> None:
    path = tmp_path / "ein Löwe 🦁.json"
    files.write_atomically(path, b"one")
    assert path.read_bytes() == b"one"
    assert parts(tmp_path) == []
    beside = tmp_path / "beside"
    beside.write_bytes(b"")
    assert path.stat().st_mode == beside.stat().st_mode


def test_a_file_that_was_there_keeps_its_rights(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_bytes(b"old")
    path.chmod(0o600)
    files.write_atomically(path, b"new")
    assert path.read_bytes() == b"new"
    assert stat.S_IMODE(path.stat().st_mode) & 0o077 == stat.S_IMODE(0o600) & 0o077


def _full(*_: object, **__: object) -> None:
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def _interrupted(*_: object) -> None:
    raise KeyboardInterrupt


@pytest.mark.parametrize("old", [None, b"old"])
@pytest.mark.parametrize(
    ("step", "fails", "error", "words"),
    [
        ((os, "fsync"), _full, OutputError, r"a\.json: the disk is full\. Free some space"),
        ((Path, "replace"), _full, OutputError, r"a\.json: the disk is full"),
        ((tempfile, "mkstemp"), _full, OutputError, r"a\.json: the disk is full"),
        ((os, "fsync"), _interrupted, KeyboardInterrupt, None),
    ],
)
def test_what_fails_on_the_way_leaves_everything_as_it_was(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    old: bytes | None,
    step: tuple[Any, str],
    fails: Callable[..., None],
    error: type[BaseException],
    words: str | None,
) -> None:
    path = tmp_path / "a.json"
    if old is not None:
        path.write_bytes(old)
    monkeypatch.setattr(*step, fails)
    with pytest.raises(error, match=words):
        files.write_atomically(path, b"new")
    monkeypatch.undo()
    assert (path.read_bytes() if path.exists() else None) == old
    assert parts(tmp_path) == []


def test_a_read_only_file_stays_also_for_the_superuser(tmp_path: Path) -> None:
    path = tmp_path / "a.json"
    path.write_bytes(b"old")
    path.chmod(0o444)
    with pytest.raises(OutputError, match=r"a\.json: is read-only\. Choose another name"):
        files.write_atomically(path, b"new")
    assert path.read_bytes() == b"old"
    path.chmod(0o644)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("missing/a.json", r"the folder '.*missing' does not exist\. Make it first"),
        ("file/a.json", r"'.*file' is a file, not a folder"),
        (".", "is a folder; expected a file's name"),
        ("n" * 300 + ".json", "cannot be written"),
        ("a\0b.json", "cannot be written"),
    ],
)
def test_a_name_that_cannot_be_written_is_refused(tmp_path: Path, name: str, words: str) -> None:
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(OutputError, match=words):
        files.write_atomically(tmp_path / name, b"new")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_link_is_followed_and_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "real.json").write_bytes(b"old")
    (tmp_path / "link.json").symlink_to(tmp_path / "real.json")
    files.write_atomically(tmp_path / "link.json", b"new")
    assert (tmp_path / "link.json").is_symlink()
    assert (tmp_path / "real.json").read_bytes() == b"new"


if sys.platform != "win32":

    def test_a_pipe_is_written_into_and_never_replaced(tmp_path: Path) -> None:
        pipe = tmp_path / "pipe.json"
        os.mkfifo(pipe)
        read: list[bytes] = []
        reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()), daemon=True)
        reader.start()
        files.write_atomically(pipe, b"through")
        reader.join(5)
        assert read == [b"through"]
        assert stat.S_ISFIFO(pipe.stat().st_mode)


class _Stream(io.TextIOWrapper):
    """Standard output as a program sees it."""


def test_a_dash_is_standard_output(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = _Stream(io.BytesIO())
    monkeypatch.setattr(sys, "stdout", stream)
    print("before ", end="")
    files.write_output("-", b"\xff\x00")
    assert stream.buffer.getvalue() == b"before \xff\x00"  # type: ignore[attr-defined]


def test_standard_output_that_is_closed_is_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    class Closed(io.BytesIO):
        def write(self, data: object, /) -> int:
            raise BrokenPipeError(errno.EPIPE, "Broken pipe")

    monkeypatch.setattr(sys, "stdout", _Stream(Closed()))
    with pytest.raises(OutputError, match=r"standard output: cannot be written \(Broken pipe\)"):
        files.write_output("-", b"data")


# Reading


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("missing.json", r"missing\.json: no such file\. Check the path"),
        (".", "is a folder; expected a file"),
        ("a\0.json", "cannot be read"),
    ],
)
def test_what_cannot_be_read_says_why(tmp_path: Path, name: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        files.read_bytes(tmp_path / name)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", r"a\.json, line 1 column 1: broken JSON"),
        (b'{"a": 1,\n "b" 2}', r"a\.json, line 2 column 6: broken JSON \(Expecting ':' delimiter"),
        (b'{"a": 1, "a": 2}', r"a\.json: the key 'a' stands twice\. Remove one of the two"),
        (b'{"a": NaN}', r"a\.json, line 1: the number NaN; expected finite numbers"),
        (b"[-Infinity]", r"the number -Infinity"),
        (b"[1e999]", r"the number 1e999; expected finite numbers"),
        (b"[" + b"9" * 5000 + b"]", r"a number that is too long"),
        (b'["\xff"]', r"byte 2 is not UTF-8 text"),
        (b'["\\ud800"]', r"an escape \\ud8\.\. without its other half"),
        (b"[" * 100_000, r"nested too deeply"),
    ],
)
def test_broken_json_is_refused_with_its_place(data: bytes, words: str) -> None:
    with pytest.raises(FileFormatError, match=words):
        files.parse_json(data, "a.json")


def test_json_with_a_mark_and_whole_letters_is_read() -> None:
    assert files.parse_json(b'\xef\xbb\xbf["\\ud83e\\udd81", 1e100]', "a.json") == ["🦁", 1e100]


FORMAT = "lipwright/test"


def _second(document: dict[str, Any]) -> dict[str, Any]:
    return {**document, "name": document["title"]}


def _third(document: dict[str, Any]) -> dict[str, Any]:
    return {**document, "name": document["name"].upper()}


def test_old_versions_are_upgraded_step_by_step() -> None:
    old = {"format": FORMAT, "version": 1, "title": "a"}
    new = files.check_document(
        old, "a.json", format=FORMAT, version=3, upgrades={1: _second, 2: _third}
    )
    assert new == {"version": 3, "title": "a", "name": "A"}
    assert old == {"format": FORMAT, "version": 1, "title": "a"}


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ([], r"a\.json: no 'format' that Lipwright knows; expected a file of format"),
        ({"format": "x", "version": 1}, r"a file of format 'x'; expected"),
        ({"format": FORMAT}, r"version None; expected 1 to 1"),
        ({"format": FORMAT, "version": True}, r"version True"),
        ({"format": FORMAT, "version": 0}, r"version 0; expected 1 to 1"),
        ({"format": FORMAT, "version": 7}, r"version 7; expected version 1 or older.*newer"),
    ],
)
def test_a_document_of_another_kind_is_refused(value: Any, words: str) -> None:
    with pytest.raises(FileFormatError, match=words):
        files.check_document(value, "a.json", format=FORMAT, version=1)


class _Pose(msgspec.Struct, forbid_unknown_fields=True):
    name: str
    limit: float


def test_a_structure_names_the_place_of_what_does_not_fit() -> None:
    with pytest.raises(FileFormatError, match=r"a\.json, at \[1\]\.limit: Expected `float`"):
        files.convert(
            [{"name": "a", "limit": 1}, {"name": "b", "limit": "x"}], list[_Pose], "a.json"
        )
    with pytest.raises(FileFormatError, match=r"a\.json: Expected `object`"):
        files.convert(3, _Pose, "a.json")


def test_an_empty_document_says_so(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_bytes(b" \n")
    with pytest.raises(FileFormatError, match=r"a\.json: is empty; expected a file of format"):
        files.read_document(tmp_path / "a.json", format=FORMAT, version=1)


@given(st.floats(-1e6, 1e6), st.integers(0, 8))
def test_numbers_are_written_short_and_near(value: float, digits: int) -> None:
    text = files.format_number(value, digits)
    assert abs(float(text) - value) <= 0.5 * 10**-digits + 1e-9
    assert not (("." in text) and text.endswith(("0", ".")))
    assert text != "-0"


def test_text_is_quoted_with_its_letters() -> None:
    assert files.quote('ɑ "b"\n') == '"ɑ \\"b\\"\\n"'
