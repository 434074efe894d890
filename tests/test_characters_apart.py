"""Characters in one process: each its own overrides, sets and speed; files that change."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lipwright
from lipwright.casting import engine_for
from lipwright.character.character import BUILT_IN_SETS
from lipwright.engines.bigram.set_file import DATA
from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Tier
from tests.character_files import (
    LOW,
    write_character,
    write_mapping,
    write_model,
    write_overrides,
)

# "map a low map": the pair l-ow once, in the middle.
PHONES = [
    ("m", 0.0, 0.1), ("ae", 0.1, 0.3), ("p", 0.3, 0.4), ("ah", 0.4, 0.5), ("l", 0.5, 0.6),
    ("ow", 0.6, 0.8), ("m", 0.8, 0.9), ("ae", 0.9, 1.1), ("p", 1.1, 1.2),
]  # fmt: skip
LINE = Speech(PhoneTrack(Tier.of(*PHONES), "arpabet"))
POSES = ("open", "W", "wide", "ShCh", "FV", "PBM", "tBack", "tRoof", "tTeeth")


def values(character: Path | str, **how: Any) -> np.ndarray:
    return lipwright.animate(LINE, character=character, **how).animation.values


def test_two_characters_differ_only_where_an_override_says_so(tmp_path: Path) -> None:
    troll = write_character(tmp_path / "troll.json", base="head", overrides={"bigrams": [LOW]})
    high = {"pair": ["l", "ow"], "curves": {"W": [[0, 0], [0.6, 1], [1, 0]]}}
    gnome = write_character(tmp_path / "gnome.json", base="head", overrides={"bigrams": [high]})
    first = lipwright.animate(LINE, character=troll).animation
    second = lipwright.animate(LINE, character=gnome).animation
    assert np.array_equal(first.values, values(troll))  # the other one has left nothing behind
    differs = np.abs(first.values - second.values) > 1e-9
    assert [name for name, moves in zip(POSES, differs.any(axis=0), strict=True) if moves] == ["W"]
    times = first.times[differs.any(axis=1)]
    # The pair spans 0.5 to 0.8 s; W is softened over 0.12 s to each side and its maxima are
    # joined with those of the neighbours.
    assert times.min() > 0.3
    assert times.max() < 1.0
    middle = int(np.argmin(np.abs(first.times - 0.68)))
    assert second.control("W")[middle] > first.control("W")[middle] + 0.3
    assert first.report["overrides"] == ["troll"]
    assert first.report["character"]["name"] == "troll"
    assert first.report["set_digest"] != second.report["set_digest"]


def test_a_character_that_differs_in_nothing_is_its_base(tmp_path: Path) -> None:
    plain = write_character(tmp_path / "plain.json", base="head")
    made = lipwright.animate(LINE, character=plain).animation
    head = lipwright.animate(LINE).animation
    assert np.array_equal(made.values, head.values)
    assert made.report["set_digest"] == head.report["set_digest"]
    assert head.report["character"] == {"name": "head"}


def test_a_report_names_the_file_as_it_was_given(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write_character(tmp_path / "troll.json", base="head")
    monkeypatch.chdir(tmp_path)
    for spelled in (str(path), "troll.json", "./troll.json", str(path)):
        report = lipwright.animate(LINE, character=spelled).animation.report
        assert report["character"]["file"] == Path(spelled).as_posix()


def test_the_users_overrides_go_on_top_of_the_characters(tmp_path: Path) -> None:
    troll = write_character(tmp_path / "troll.json", base="head", overrides={"gains": {"open": 0}})
    assert values(troll)[:, 0].max() == 0
    wide_open = {"pair": ["l", "ow"], "curves": {"open": [[0, 0], [0.6, 0.8], [1, 0]]}}
    mine = write_overrides(tmp_path / "mine.json", bigrams=[wide_open])
    assert values(troll, overrides=mine)[:, 0].max() > 0.5


def test_the_set_is_the_users_else_the_characters_else_the_default(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = (DATA / "english.json").read_text("utf-8")
    for name in ("mine", "its"):
        renamed = text.replace('"name": "english"', f'"name": "{name}"')
        (tmp_path / f"{name}.json").write_text(renamed, "utf-8")

    def used(character: Path | str, given: Path | None = None) -> str:
        return engine_for(given, character=character).of.name

    write_character(tmp_path / "base.json", base="head", set="its.json")
    top = write_character(tmp_path / "top.json", base="base.json")
    assert used(top) == "its"
    assert used(top, tmp_path / "mine.json") == "mine"
    assert used("head") == "english"
    assert used(write_character(tmp_path / "named.json", base="head", set="english")) == "english"
    # A built-in character brings its own set, and whoever is layered on it has it too.
    monkeypatch.setitem(BUILT_IN_SETS, "head", str(tmp_path / "mine.json"))
    assert used("head") == "mine"
    assert used(write_character(tmp_path / "on_head.json", base="head")) == "mine"
    assert used(top) == "its"


@pytest.mark.parametrize("content", [{"set": "englsh"}, {"set": "gone.json"}])
def test_a_set_that_is_not_there_is_told_with_who_names_it(
    tmp_path: Path, content: dict[str, str]
) -> None:
    path = write_character(tmp_path / "troll.json", base="head", **content)
    with pytest.raises(InputError, match=r"troll\.json, at set: .*(englsh|gone\.json)"):
        lipwright.animate(LINE, character=path)


def test_whatever_file_changes_is_read_again(tmp_path: Path) -> None:
    """An animator saves any of a character's files and speaks the line again."""
    text = (DATA / "english.json").read_text("utf-8")

    def write(name: str, gain: float) -> None:
        path = tmp_path / name
        if name == "set.json":
            softer = re.sub(r'"softness": [\d.]+', f'"softness": {0.1 * gain:g}', text)
            path.write_text(softer, "utf-8")
        elif name == "jaw.json":
            write_overrides(path, gains={"open": gain})
        elif name == "base.json":
            parts = ["jaw.json", {"gains": {"W": gain}}]
            write_character(path, base="head", set="set.json", overrides=parts)
        else:
            write_character(path, base="base.json", overrides={"gains": {"PBM": gain}})

    names = ("set.json", "jaw.json", "base.json", "top.json")
    for name in names:
        write(name, 0.5)
    before = values(tmp_path / "top.json")
    for name in names:
        write(name, 0.25)
        os.utime(tmp_path / name, ns=(1, 1))  # whatever the clock's grain
        after = values(tmp_path / "top.json")
        assert not np.array_equal(before, after), name
        assert np.array_equal(after, values(tmp_path / "top.json"))
        before = after


def test_a_line_of_a_known_character_reads_no_file_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_model(tmp_path / "face.glb")
    write_overrides(tmp_path / "jaw.json", gains={"open": 0.5})
    write_mapping(tmp_path / "m.json", controls={"W": {"mouthPucker": 1}})
    path = write_character(
        tmp_path / "c.json", model="face.glb", mapping="m.json", overrides="jaw.json"
    )
    expected = values(path)
    monkeypatch.setattr(Path, "read_bytes", lambda path: pytest.fail(f"read {path} again"))
    assert np.array_equal(values(path), expected)


def test_what_a_character_maps_in_vain_is_told(tmp_path: Path) -> None:
    path = write_character(tmp_path / "c.json", base="head", gains={"PMB": 0.5})
    notes = lipwright.animate(LINE, character=path).speech.notes
    assert notes == (f"{path} maps 'PMB', which the set has not; did you mean 'PBM'?",)


def test_say_keeps_to_the_characters_speed(tmp_path: Path) -> None:
    path = write_character(tmp_path / "slow.json", base="head", speech={"rate": [80, 100]})
    text = "Peter Piper picked a peck."
    slow = lipwright.say(text, character=path)
    assert slow.notes == ("slow speaks 80 to 100 words per minute: 100, not 175",)
    assert slow.duration == pytest.approx(lipwright.say(text, rate=100).duration)
    with pytest.raises(InputError, match="80 to 450"):
        lipwright.say(text, rate=9000, character=path)


def test_speed_limits_of_a_character_hold(tmp_path: Path) -> None:
    limits = {"poses": {"open": {"limit": 3}, "W": {"limit": 2}}}
    path = write_character(tmp_path / "slow.json", base="head", settings=limits)
    keys = lipwright.animate(LINE, character=path).animation.keys
    for pose, limit in (("open", 3), ("W", 2)):
        slopes = np.diff(keys[pose].values) / np.diff(keys[pose].times)
        assert np.abs(slopes).max() <= limit + 1e-6
    document = json.loads(path.read_text("utf-8"))
    assert document["settings"] == limits


def test_a_set_is_read_again_when_its_base_or_its_reduction_changes(tmp_path: Path) -> None:
    english = json.loads((DATA / "english.json").read_bytes())
    base, own, reduction = (tmp_path / f"{name}.json" for name in ("base", "own", "reduction"))
    base.write_text(json.dumps(english), "utf-8")
    head = {key: english[key] for key in ("format", "version", "phone_set")}
    own.write_text(json.dumps({**head, "name": "own", "base": "base.json", "bigrams": []}), "utf-8")
    labels = {label: "ah" if label == "ow" else "bmp" for label, _, _ in PHONES}
    table = {"format": "lipwright/reduction", "version": 1, "source": "arpabet"}
    table |= {"target": "common", "map": labels}
    reduction.write_text(json.dumps(table), "utf-8")

    first, reduced = values("head", bigram_set=own), values("head", reduction=reduction)
    engine = engine_for(own)
    assert engine_for(own) is engine
    english["rules"]["poses"][0]["limit"] = 1.5
    base.write_text(json.dumps(english), "utf-8")
    table["map"] = {**labels, "ow": "w"}
    reduction.write_text(json.dumps(table), "utf-8")
    assert engine_for(own) is not engine
    assert np.abs(values("head", bigram_set=own) - first).max() > 0.05
    assert np.abs(values("head", reduction=reduction) - reduced).max() > 0.05


def test_a_set_of_other_poses_is_told() -> None:
    notes = lipwright.animate(LINE, bigram_set="crab").speech.notes
    assert notes == (
        "head knows 1 of the set's 12 poses (tongue_out): the others are not seen; "
        "choose another --set",
    )
    assert lipwright.animate(LINE, bigram_set="crab", character="crab").speech.notes == ()
    assert lipwright.animate(LINE, bigram_set="english", character="crab").speech.notes == ()
