"""Character files: layers of model, mapping, gains and limits; what is broken is refused."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright.animation import Animation
from lipwright.character import file_of, keep_character, load_character
from lipwright.character.inspect import describe_character, inspect_character
from lipwright.character.start_file import start_character
from lipwright.errors import InputError, OutputError
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Tier
from tests.character_files import write_character, write_mapping, write_model


def driven(
    character: Path, controls: dict[str, float], mapping: Path | None = None
) -> dict[str, float]:
    """What the rig's channels are when controls have these values."""
    values = np.array([list(controls.values())], np.float32)
    line = Animation(tuple(controls), values, 60.0)
    channels = load_character(character, mapping).rig(line).channels
    return {name: float(channels.control(name)[0]) for name in channels.controls}


def test_a_character_is_layered_and_names_only_what_differs(tmp_path: Path) -> None:
    (tmp_path / "models").mkdir()
    write_model(tmp_path / "models" / "face.glb", "jawOpen", "mouthPucker", "mouthFunnel")
    write_character(
        tmp_path / "base.json",
        model="models/face.glb",
        mapping={"open": {"jawOpen": 0.5}, "W": {"mouthPucker": 1}},
        gains={"open": 0.8, "W": 0.5},
        limits={"jawOpen": [0, 0.3]},
    )
    top = write_character(
        tmp_path / "top.json", base="base.json", mapping={"W": {"mouthFunnel": 1}}, gains={"W": 0.9}
    )
    found = driven(top, {"open": 0.5, "W": 0.5})
    assert found == pytest.approx({"jawOpen": 0.2, "mouthFunnel": 0.45})
    assert driven(top, {"open": 1.0, "W": 0.0})["jawOpen"] == pytest.approx(0.3)  # the base's limit
    own = write_mapping(tmp_path / "own.json", controls={"W": {"jawOpen": 1}}, gains={"W": 1})
    assert driven(top, {"W": 0.25}, own) == pytest.approx({"jawOpen": 0.25})


def test_a_mapping_may_be_a_file_with_rows_on_top(tmp_path: Path) -> None:
    write_model(tmp_path / "face.glb", "smirk", "frown")
    write_mapping(tmp_path / "m.json", controls={"open": {"smirk": 1}, "W": {"smirk": 0.5}})
    rows = {"W": {"frown": 0.25}}
    path = write_character(tmp_path / "c.json", model="face.glb", mapping=["m.json", rows])
    assert driven(path, {"open": 0.5, "W": 1}) == pytest.approx({"smirk": 0.5, "frown": 0.25})


def test_inspect_says_which_layer_each_thing_comes_from(tmp_path: Path) -> None:
    write_model(tmp_path / "face.glb", "jawOpen", "mouthPucker", "mouthFunnel")
    base = write_character(
        tmp_path / "base.json",
        model="face.glb",
        mapping={"W": {"mouthFunnel": 1}},
        gains={"open": 0.5},
        limits={"jawOpen": [0, 0.5]},
        speech={"rate": [80, 150]},
    )
    top = write_character(tmp_path / "top.json", base="base.json", mapping={"FV": {"jawOpen": 0.1}})
    own = write_mapping(tmp_path / "own.json", controls={"PBM": {"mouthFunnel": 0.1}})
    facts = inspect_character(load_character(top, own))
    sources = {name: control["from"] for name, control in facts["controls"].items()}
    assert sources["FV"] == str(top)
    assert sources["W"] == str(base)
    assert sources["PBM"] == str(own)
    assert sources["open"] == f"its vocabulary; gain from {base}"
    assert sources["wide"] == ""
    assert [layer["name"] for layer in facts["layers"]] == ["base", "top"]
    assert facts["model"] == {"name": str(tmp_path / "face.glb"), "from": str(base)}
    assert facts["limits_from"] == {"jawOpen": str(base)}
    assert facts["speech_rate"] == [80, 150]
    text = describe_character(load_character(top, own))
    assert "80 to 150 words per minute" in text
    assert "jawOpen 0 to 0.5" in " ".join(text.split())


@pytest.mark.parametrize(
    ("own", "asked", "spoken"),
    [([100, 150], 175, 150), ([100, 150], 90, 100), ([100, 150], 120, 120), (None, 300, 300)],
)
def test_the_rate_of_speech_is_kept_within_what_the_character_can(
    tmp_path: Path, own: list[int] | None, asked: float, spoken: float
) -> None:
    path = write_character(tmp_path / "c.json", base="head", speech={"rate": own} if own else {})
    file = file_of(path)
    assert file is not None
    rate, note = file.speakable(asked)
    assert rate == spoken
    assert bool(note) == (rate != asked)
    assert file.speakable(9000) == (9000, "")  # refused where it is spoken


def test_a_recording_that_is_too_fast_is_told(tmp_path: Path) -> None:
    file = file_of(write_character(tmp_path / "c.json", base="head", speech={"rate": [80, 120]}))
    assert file is not None
    for length, told in ((0.3, "200 words per minute, c can 120"), (0.6, "")):
        words = Tier.of(*((f"w{i}", i * length, (i + 1) * length) for i in range(6)))
        note = file.too_fast(Speech(PhoneTrack(Tier()), words))
        assert told in note
        assert bool(note) == bool(told)


def test_a_character_is_read_again_when_any_of_its_files_changes(tmp_path: Path) -> None:
    model = write_model(tmp_path / "face.glb", "jawOpen", "mouthPucker")
    mapping = write_mapping(tmp_path / "m.json", controls={"W": {"mouthPucker": 1}})
    base = write_character(tmp_path / "base.json", model="face.glb")
    top = write_character(tmp_path / "top.json", base="base.json", mapping="m.json")
    before = keep_character(top)
    assert keep_character(top) is before
    for path in (model, mapping, base, top):
        os.utime(path, ns=(1, 1))
        after = keep_character(top)
        assert after is not before, path
        assert keep_character(top) is after
        before = after


def row(**content: Any) -> dict[str, Any]:
    return {"base": "head", **content}


BAD: list[tuple[dict[str, Any], str, str]] = [
    (row(colour="green"), "colour", ""),
    (row(version=2), "version 2", "newer Lipwright"),
    (row(version="1"), "version '1'", "1 to 1"),
    (row(format="lipwright/mapping"), "lipwright/mapping", "lipwright/character"),
    (row(name=""), "length >= 1", "at name"),
    (row(name=None), "null", "at name"),
    (row(gains={"open": -1}), "the gain -1", "gains.open"),
    (row(gains={"open": float("nan")}), "the number NaN", "line 1"),
    (row(limits={"open": [1, 0]}), "the limits 1.0 to 0.0", "the lower one first"),
    (row(limits={"opn": [0, 1]}), "no channel 'opn'", "did you mean 'open'"),
    (row(mapping={"open": {"opne": 1}}), "no channel 'opne'", "Did you mean 'open'"),
    (row(mapping={"open": {"open": "1"}}), "at mapping", "float"),
    (row(mapping="gone.json"), "gone.json: no such file", "at mapping"),
    (row(overrides="gone.json"), "gone.json: no such file", "at overrides"),
    (row(overrides=["folder.json"]), "folder.json: is a folder", "at overrides"),
    (row(speech={"rate": [200, 100]}), "200 to 100 words per minute", "at speech.rate"),
    (row(speech={"rate": [10, 100]}), "10 to 100 words per minute", "within 80 to 450"),
    (row(speech={"rate": [100]}), "length", "at speech.rate"),
    ({"base": "gone.json"}, "gone.json: no such file", "at base"),
    ({"base": "folder.json"}, "folder.json: is a folder", "at base"),
    ({"base": "face.glb"}, "the base 'face.glb'", "A model goes into 'model'"),
    ({"base": "haed"}, "the base 'haed'", "Did you mean 'head'"),
    ({"model": "other.json"}, "the model 'other.json'", "another character goes into 'base'"),
    ({"model": "gone.glb"}, "gone.glb: no such file", "at model"),
    ({"model": "folder.json/x.glb"}, "folder.json", "at model"),
    ({"model": "haed"}, "no character", "Did you mean 'head'"),
    ({}, "names no model", '"base": "head"'),
]


@pytest.mark.parametrize(("content", "found", "more"), BAD)
def test_a_broken_character_file_is_refused_with_its_place(
    tmp_path: Path, content: dict[str, Any], found: str, more: str
) -> None:
    (tmp_path / "folder.json").mkdir()
    path = write_character(tmp_path / "my troll.json", **content)
    with pytest.raises(InputError) as caught:
        load_character(path)
    message = str(caught.value)
    assert message.startswith(str(path))
    assert found in message
    assert more.lower() in message.lower()
    assert "\n" not in message


def test_bases_that_lead_back_are_refused_with_the_chain(tmp_path: Path) -> None:
    for name, base in (("a", "b"), ("b", "c"), ("c", "b"), ("d", "d")):
        write_character(tmp_path / f"{name}.json", base=f"{base}.json")
    with pytest.raises(InputError, match=r"c\.json, at base: .*: b\.json → c\.json → b\.json"):
        load_character(tmp_path / "a.json")
    with pytest.raises(InputError, match=r"d\.json → d\.json"):
        load_character(tmp_path / "d.json")


def test_a_fault_in_a_base_is_told_with_who_names_it(tmp_path: Path) -> None:
    write_character(tmp_path / "base.json", base="head", gains={"open": -2})
    top = write_character(tmp_path / "top.json", base="base.json")
    with pytest.raises(InputError, match=r"top\.json, at base: .*base\.json, at gains\.open"):
        load_character(top)


@pytest.mark.parametrize("data", [b"", b"  ", b"{", b"\xff\xfe", b"[]", b"3"])
def test_what_is_no_character_file_is_refused(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "c.json"
    path.write_bytes(data)
    with pytest.raises(InputError, match=r"c\.json"):
        load_character(path)
    with pytest.raises(InputError, match="no such file"):
        load_character(tmp_path / "gone.json")


def test_a_start_file_gives_the_model_as_it_is_and_obeys_the_edit(tmp_path: Path) -> None:
    (tmp_path / "characters").mkdir()
    model = write_model(tmp_path / "face.glb", "Head_jawOpen", "Head_mouthPucker")
    path = tmp_path / "characters" / "troll.json"
    start_character(path, str(model), None, None)
    text = path.read_text("utf-8")
    assert re.search(r'^    "open": \{"Head_jawOpen": [\d.]+\},$', text, re.MULTILINE)
    document = json.loads(text)
    assert document["model"] == "../face.glb"
    same = {"open": 0.5, "W": 0.25, "PBM": 1.0}
    assert driven(path, same) == pytest.approx(driven(model, same))
    document["mapping"]["open"] = {"Head_mouthPucker": 1}
    path.write_text(json.dumps(document), "utf-8")
    assert driven(path, {"open": 0.5}) == {"Head_mouthPucker": 0.5}
    with pytest.raises(OutputError, match=r"troll\.json: exists already"):
        start_character(path, "head", None, None)


def test_a_start_file_on_a_base_differs_in_nothing(tmp_path: Path) -> None:
    start_character(tmp_path / "base.json", "head", None, "english")
    start_character(tmp_path / "top.json", None, str(tmp_path / "base.json"), None)
    loaded = load_character(tmp_path / "top.json")
    assert (loaded.model_name, loaded.bigram_set, loaded.mapping) == ("head", "english", None)
    for base, words in ((tmp_path / "gone.json", "no such file"), ("x.glb", "--model")):
        with pytest.raises((InputError, OutputError), match=words):
            start_character(tmp_path / "new.json", None, str(base), None)
    assert not (tmp_path / "new.json").exists()
    with pytest.raises(OutputError, match=r"expected \.json"):
        start_character(tmp_path / "new.glb", "head", None, None)
