"""Characters and mappings that cannot be used: each row an input and words of the one line."""

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from lipwright.cli import main
from lipwright.gltf import Gltf
from tests.character.sheets import dropped, face, jawed
from tests.cli.test_bad_input import fails
from tests.models import model

HEAD = '{"format": "lipwright/mapping", "version": 1, "name": "mine"'


def mapping(controls: str, more: str = "") -> str:
    return f'{HEAD}, "controls": {controls}{more}}}'


OPENS = '{"open": {"Jaw": 1}}'
BAD_MAPPINGS: dict[str, tuple[str, str]] = {
    "unknown target": (mapping('{"open": {"jawOpem": 1}}'), "no channel 'jawOpem'"),
    "unknown joint": (
        mapping(OPENS, ', "joints": {"Jaw": {"joint": "Jow"}}'),
        "joints.Jaw: the model has no joint 'Jow'; expected one of Jaw. Did you mean 'Jaw'?",
    ),
    "joint of no vertices": (
        mapping(OPENS, ', "joints": {"Jaw": {"joint": "Face"}}'),
        "the joint 'Face' carries no vertices",
    ),
    "zero axis": (mapping(OPENS, ', "joints": {"Jaw": {"axis": [0, 0, 0]}}'), "no direction"),
    "infinite axis": (
        mapping(OPENS, ', "joints": {"Jaw": {"axis": [1e999, 0, 0]}}'),
        "the number 1e999; expected finite",
    ),
    "too many degrees": (mapping(OPENS, ', "joints": {"Jaw": {"degrees": 400}}'), "400 degrees"),
    "negative gain": (mapping("{}", ', "gains": {"open": -2}'), "gains.open"),
}


@pytest.mark.parametrize("name", BAD_MAPPINGS)
def test_mappings_that_cannot_be_used(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    content, words = BAD_MAPPINGS[name]
    character, own = tmp_path / "face.glb", tmp_path / "mine.json"
    made = jawed({})
    if name == "joint of no vertices":
        made.json["nodes"].append({"name": "Face"})
        made.json["nodes"][0]["name"] = "Skin"
    character.write_bytes(made.to_glb())
    own.write_text(content)
    given = ("--mapping", own)
    message = fails(capsys, tmp_path, "character", "inspect", character, *given)
    assert words in message
    assert "mine.json" in message
    output = ("-o", tmp_path / "a.glb")
    assert fails(capsys, tmp_path, "say", "Hi", "--character", character, *given, *output)


def huge(path: Path) -> None:
    """Write a GLB of 2 GB that takes no room on the disk."""
    data = jawed({}).to_glb()
    path.write_bytes(data)
    os.truncate(path, 1 << 31)


def without_mouth(path: Path) -> None:
    path.write_bytes(model(("smirk", "browUp")).to_glb())


def without_anything(path: Path) -> None:
    path.write_bytes(model(()).to_glb())


BAD_MODELS: dict[str, tuple[Callable[[Path], None], str]] = {
    "2 GB": (huge, "2.1 GB; expected a model of at most 1.1 GB"),
    "no mouth": (without_mouth, "none of the controls (open, W,"),
    "nothing that moves": (without_anything, "no morph targets and no jaw that turns"),
}


@pytest.mark.parametrize("name", BAD_MODELS)
def test_models_that_cannot_be_used(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    make, words = BAD_MODELS[name]
    character = tmp_path / "face.glb"
    make(character)
    arguments = ("say", "Hi", "--character", character, "-o", tmp_path / "a.glb")
    if name == "2 GB":  # too large to be compared byte by byte
        assert main([str(argument) for argument in arguments]) == 1
        message = capsys.readouterr().err
        assert message.count("\n") == 1
        assert not (tmp_path / "a.glb").exists()
    else:
        message = fails(capsys, tmp_path, *arguments)
    assert words in message
    assert "face.glb" in message


def test_a_mouth_that_is_not_found_is_not_drawn(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    character, picture = tmp_path / "face.glb", tmp_path / "lips.svg"
    character.write_bytes(model().to_glb())
    message = fails(capsys, tmp_path, "character", "inspect", character, "--picture", picture)
    assert "no mouth to draw: nothing on it parts as lips do" in message


def test_the_mouth_is_drawn_and_the_gains_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    character, picture = tmp_path / "face.glb", tmp_path / "lips.svg"
    character.write_bytes(face({"jawOpen": dropped(0.02)}).to_glb())
    arguments = ["character", "inspect", str(character), "--picture", str(picture)]
    assert main(arguments) == 0
    said = capsys.readouterr().out
    assert "calibration: lips at 19 pairs of vertices" in said
    assert f"written: {picture}" in said
    drawn = picture.read_text("utf-8")
    for title in ("rest", "open 0.5", "PBM 1", "W 1"):
        assert f">{title}</text>" in drawn
    assert "gap 23.0% of the width" in drawn
    assert drawn.count('fill="#e8590c"') == 4 * 19 + 1
    first = picture.read_bytes()
    assert main(arguments) == 0
    assert picture.read_bytes() == first


def test_what_is_hidden_is_not_drawn(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    made = face({"jawOpen": dropped(0.02)})
    behind = {"mesh": made.json["nodes"][0].get("mesh", 0), "translation": [0, 0, -0.03]}
    drawn = []
    for name, nodes in (("one", []), ("two", [behind])):
        document = {**made.json, "nodes": [*made.json["nodes"], *nodes]}
        character, picture = tmp_path / f"{name}.glb", tmp_path / f"{name}.svg"
        character.write_bytes(Gltf(document, made.binary).to_glb())
        assert main(["character", "inspect", str(character), "--picture", str(picture)]) == 0
        drawn.append(picture.read_text("utf-8").count("<path"))
    assert drawn[0] > 200
    # Only what shows through the open mouth and past the edges is drawn twice.
    assert drawn[1] < 1.3 * drawn[0]
