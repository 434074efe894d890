"""Saving: the suffix picks the format, and nothing is written before everything is made."""

import io
import sys
from importlib import import_module
from pathlib import Path

import pytest

from lipwright import export
from lipwright.errors import InputError, LipwrightError, OutputError
from tests.export.performances import performance


@pytest.mark.parametrize(("suffix", "name"), export.FORMATS.items())
def test_every_suffix_has_its_module(suffix: str, name: str) -> None:
    module = import_module(f"lipwright.export.{name}")
    assert callable(module.encode)
    assert module.__doc__
    assert suffix == suffix.lower()


def test_each_path_gets_its_own_format(tmp_path: Path) -> None:
    paths = [tmp_path / "ä 1.JSON", tmp_path / "a.csv", tmp_path / "a.wav", tmp_path / "b.csv"]
    export.save(performance(), *paths)
    for path in paths:
        assert path.read_bytes() == export.encode(performance(), path.suffix)


BAD = {
    "unknown suffix": (["a.fbx"], InputError, r"a\.fbx: the suffix '\.fbx' names no format; "),
    "known ones": (["a.fbx"], InputError, r"expected one of \.json \.csv \.c3d \.glb \.html \.wav"),
    "no suffix": (["a"], InputError, r"a: has no suffix; expected one of"),
    "the same file": (["b.csv", "./b.csv"], InputError, r"b\.csv: is named twice"),
    "two streams": (["-", "-"], InputError, r"-: is named twice"),
    "missing folder": (["no/a.csv"], OutputError, r"a\.csv: the folder '.*no' does not exist"),
    "a folder": (["folder.csv"], OutputError, r"folder\.csv: is a folder"),
    "read-only": (["locked.csv"], OutputError, r"locked\.csv: is read-only"),
}


@pytest.mark.parametrize(("names", "error", "words"), BAD.values(), ids=BAD)
def test_a_bad_output_is_refused_before_anything_is_written(
    tmp_path: Path, names: list[str], error: type[LipwrightError], words: str
) -> None:
    (tmp_path / "folder.csv").mkdir()
    (tmp_path / "locked.csv").write_bytes(b"mine")
    (tmp_path / "locked.csv").chmod(0o444)
    paths = [name if name == "-" else f"{tmp_path}/{name}" for name in names]
    with pytest.raises(error, match=words):
        export.save(performance(), tmp_path / "first.json", *paths)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["folder.csv", "locked.csv"]
    assert (tmp_path / "locked.csv").read_bytes() == b"mine"


def test_one_format_that_fails_leaves_nothing_of_the_others(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_bytes(b"old")
    with pytest.raises(InputError, match="no sound"):
        export.save(performance(silent=True), tmp_path / "a.json", tmp_path / "a.wav")
    assert [path.name for path in tmp_path.iterdir()] == ["a.json"]
    assert (tmp_path / "a.json").read_bytes() == b"old"


def test_the_same_file_under_two_links_is_one(tmp_path: Path) -> None:
    (tmp_path / "link.csv").symlink_to(tmp_path / "a.csv")
    with pytest.raises(InputError, match="is named twice"):
        export.save(performance(), tmp_path / "a.csv", tmp_path / "link.csv")


def test_a_dash_is_json_on_standard_output(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    stream = io.TextIOWrapper(io.BytesIO())
    monkeypatch.setattr(sys, "stdout", stream)
    export.save(performance(), "-", tmp_path / "a.csv")
    assert stream.buffer.getvalue() == performance().animation.to_bytes()
    assert (tmp_path / "a.csv").exists()


def test_an_unknown_suffix_is_refused_by_encode_too() -> None:
    with pytest.raises(InputError, match=r"the suffix '\.fbx' names no format"):
        export.encode(performance(), ".fbx")
