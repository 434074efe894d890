"""Set and override files: what is written is read back; what is broken is refused."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright.engines.bigram import load_set, read_overrides, read_set
from lipwright.engines.bigram.set_file import set_bytes
from lipwright.errors import InputError
from tests.engines.bigram.random_lines import random_set

SMALL: dict[str, Any] = {
    "format": "lipwright/bigram-set",
    "version": 1,
    "name": "small",
    "rules": {"poses": [{"name": "open", "priority": 1}]},
    "bigrams": [{"pair": ["f", "ah"], "curves": {"open": [[0, 0], [0.5, 1], [1, 0]]}}],
}


def write(path: Path, **changes: Any) -> Path:
    path.write_text(json.dumps({**SMALL, **changes}))
    return path


def test_a_set_survives_its_file(tmp_path: Path) -> None:
    path = tmp_path / "set.json"
    for original in (load_set("english"), random_set(np.random.default_rng(1))):
        path.write_bytes(set_bytes(original))
        again = read_set(path)
        assert set_bytes(again) == path.read_bytes()
        assert again.rules.names == original.rules.names
        assert set(again.bigrams) == set(original.bigrams)


def test_one_key_list_per_line(tmp_path: Path) -> None:
    """An animator who moves a key sees one line in a diff."""
    before = set_bytes(load_set("english")).decode().splitlines()
    text = "\n".join(before).replace("[0.15, 1], [0.28, 1]", "[0.15, 1], [0.4, 1]", 1)
    after = text.splitlines()
    assert sum(a != b for a, b in zip(before, after, strict=True)) == 1


def bigram(**changes: Any) -> dict[str, Any]:
    return {"bigrams": [{**SMALL["bigrams"][0], **changes}]}


BAD = [
    (bigram(curves={"open": [[0, 0], [0.5, 2], [1, 0]]}), "weights from 0 to 2", "f-ah"),
    (bigram(curves={"open": [[0, 0.3], [1, 0]]}), "0 at both ends", "f-ah"),
    (bigram(curves={"open": [[0.5, 0], [0.5, 1], [1, 0]]}), "key 2", "f-ah"),
    (bigram(curves={"open": [[-1, 0], [0.5, 1], [1, 0]]}), "times in 0..1", "f-ah"),
    (bigram(curves={"open": [[0, 0]]}), "two or more", "f-ah"),
    (bigram(curves={"smile": [[0, 0], [1, 0]]}), "unknown pose 'smile'", "f-ah"),
    (bigram(pair=["f", "zz"]), "'zz' is not a phone", "expected one of ah"),
    (bigram(boundary=0), "boundary 0", "f-ah"),
    (bigram(wrd="fat"), "wrd", "bigrams[0]"),
    ({"bigrams": SMALL["bigrams"] * 2}, "f-ah stands twice", "Remove one"),
    ({"version": 2}, "version 2", "newer Lipwright"),
    ({"version": 0}, "version 0", "1 to 1"),
    ({"format": "lipwright/animation"}, "lipwright/animation", "lipwright/bigram-set"),
    ({"rules": {"poses": []}}, "no poses", "at least one"),
    ({"rules": {"poses": [{"name": "a", "priority": 1}] * 2}}, "'a' stands twice", "rules"),
    ({"reach": {"f": "FV"}}, "unknown pose 'FV'", "reach"),
]


@pytest.mark.parametrize(("changes", "found", "more"), BAD)
def test_a_broken_set_is_refused_with_its_place(
    tmp_path: Path, changes: dict[str, Any], found: str, more: str
) -> None:
    path = write(tmp_path / "broken set.json", **changes)
    with pytest.raises(InputError) as caught:
        read_set(path)
    message = str(caught.value)
    assert message.startswith(str(path))
    assert found in message
    assert more in message
    assert "\n" not in message


def test_not_a_number_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "nan.json"
    path.write_text(json.dumps({**SMALL, **bigram(boundary=float("nan"))}))
    with pytest.raises(InputError, match=r"nan\.json.*NaN"):
        read_set(path)


def overrides(path: Path, **content: Any) -> Path:
    head = {"format": "lipwright/bigram-overrides", "version": 1, "name": "gnome"}
    path.write_text(json.dumps({**head, **content}))
    return path


def test_overrides_change_what_they_name_and_nothing_else(tmp_path: Path) -> None:
    base = load_set("english")
    drawn = {"pair": ["l", "ow"], "curves": {"W": [[0, 0], [0.5, 1], [1, 0]]}}
    path = overrides(
        tmp_path / "o.json",
        bigrams=[drawn],
        gains={"open": 0.5},
        poses={"open": {"limit": 8}},
        settings={"padding": 0.3},
    )
    changed = read_overrides(path, base)
    assert changed.bigrams["l", "ow"].source == "gnome"
    assert changed.bigrams["l", "ow"].curves.keys() == {"W"}
    assert changed.bigrams["f", "ah"].source == "english"
    halved = changed.bigrams["f", "ah"].curves["open"].values.max()
    assert halved == pytest.approx(0.5 * base.bigrams["f", "ah"].curves["open"].values.max())
    assert changed.rules.pose("open").limit == 8
    assert changed.rules.pose("W") == base.rules.pose("W")
    assert changed.rules.settings.padding == 0.3


@pytest.mark.parametrize(
    ("content", "found"),
    [
        ({"gains": {"smile": 1}}, "unknown pose 'smile'"),
        ({"gains": {"open": -1}}, "gain -1"),
        ({"poses": {"open": {"limits": 3}}}, "limits"),
        ({"settings": {"warp": "sideways"}}, "sideways"),
        ({"bigrams": [{"pair": ["f", "ah"], "curves": {"smile": [[0, 0], [1, 0]]}}]}, "smile"),
    ],
)
def test_broken_overrides_are_refused(tmp_path: Path, content: dict[str, Any], found: str) -> None:
    path = overrides(tmp_path / "o.json", **content)
    with pytest.raises(InputError, match=found) as caught:
        read_overrides(path, load_set("english"))
    assert str(path) in str(caught.value)
