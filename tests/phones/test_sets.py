"""Phone sets: what comes with Lipwright is whole, and a user's file is checked."""

import json
from pathlib import Path
from typing import Any

import pytest

from lipwright.errors import FileFormatError, InputError, LabelError
from lipwright.phones import SILENCE, load_phone_set, phone_set_names


@pytest.mark.parametrize("name", phone_set_names())
def test_each_set_is_whole(name: str) -> None:
    phone_set = load_phone_set(name)
    assert phone_set.name == name
    assert SILENCE in phone_set.labels
    for label in phone_set.labels:
        assert phone_set.normalise(label) == label
    for alias, label in phone_set.aliases.items():
        assert alias not in phone_set.labels
        assert phone_set.normalise(alias) == label


def test_the_common_set_has_the_classes_of_table_1_each_with_an_example() -> None:
    common = load_phone_set("common")
    expected = "ah aa ao eh er ih w ow aw oy ay h r l z sh th f d kg bmp sil"
    assert common.labels == tuple(expected.split())
    assert all("[" in common.example(label) for label in common.labels if label != SILENCE)


@pytest.mark.parametrize(
    ("name", "spelled", "label"),
    [
        ("arpabet", "AH0", "ah"),
        ("arpabet", " IY2 ", "iy"),
        ("arpabet", "hv", "hh"),
        ("arpabet", "SP", "sil"),
        ("arpabet", "", "sil"),
        ("common", "BMP", "bmp"),
        ("sampa", "E", "E"),
        ("sampa", "@r", "@`"),
    ],
)
def test_other_spellings_become_the_sets_own(name: str, spelled: str, label: str) -> None:
    assert load_phone_set(name).normalise(spelled) == label


@pytest.mark.parametrize(("name", "label"), [("arpabet", "xx"), ("arpabet", "5"), ("sampa", "AH")])
def test_an_unknown_label_is_refused_with_the_known_ones(name: str, label: str) -> None:
    with pytest.raises(LabelError, match=f"'{label}' is not a phone of '{name}'; expected one of"):
        load_phone_set(name).normalise(label)


def test_an_unknown_set_is_refused_with_the_known_ones() -> None:
    with pytest.raises(LabelError, match=r"no phone set 'klingon'; expected one of .*arpabet"):
        load_phone_set("klingon")


def own(tmp_path: Path, **change: Any) -> str:
    document = {
        "format": "lipwright/phone-set",
        "version": 1,
        "name": "crab",
        "phones": [{"label": "click", "example": "[tk]"}, {"label": "sil"}],
    }
    path = tmp_path / "own set.json"
    path.write_text(json.dumps({**document, **change}), encoding="utf-8")
    return str(path)


def test_a_users_set_is_read_from_its_path(tmp_path: Path) -> None:
    crab = load_phone_set(own(tmp_path))
    assert (crab.name, crab.labels, crab.example("click")) == ("crab", ("click", "sil"), "[tk]")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"phones": [{"label": "a"}, {"label": "a"}]}, "a stands twice"),
        ({"phones": [{"lable": "a"}]}, r"own set\.json, at phones\[0\]: .*`lable`"),
        ({"version": 99}, "was written by a newer Lipwright"),
    ],
)
def test_a_users_broken_set_is_refused(tmp_path: Path, change: dict[str, Any], words: str) -> None:
    with pytest.raises((FileFormatError, LabelError), match=words):
        load_phone_set(own(tmp_path, **change))


def test_a_missing_file_of_a_set_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        load_phone_set(str(tmp_path / "none.json"))
