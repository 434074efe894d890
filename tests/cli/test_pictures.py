"""Characters of pictures from the command line."""

import json
from pathlib import Path

import pytest

from lipwright.cli import main
from tests.cli.test_bad_input import fails

PETER = "Peter Piper picked a peck of pickled peppers."


def test_a_line_for_every_consumer(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    names = ("peter.tsv", "peter.xml", "peter.dat", "peter.rhubarb.json", "peter.html")
    outputs = [part for name in names for part in ("-o", str(tmp_path / name))]
    assert main(["say", PETER, "--character", "rhubarb", "--on", "2", *outputs]) == 0
    assert {path.name for path in tmp_path.iterdir()} == {*names, "peter.wav"}
    assert "Moho" in capsys.readouterr().out
    cues = json.loads((tmp_path / "peter.rhubarb.json").read_bytes())
    assert cues["metadata"]["soundFile"] == "peter.wav"
    # The lips close for each of the eight p.
    assert sum(cue["value"] == "A" for cue in cues["mouthCues"]) == 8
    switches = (tmp_path / "peter.dat").read_text().splitlines()
    assert switches[0] == "MohoSwitch1"
    assert all(int(row.split()[0]) % 2 == 1 for row in switches[1:])
    table = (tmp_path / "peter.tsv").read_text().splitlines()
    assert [row.split()[1] for row in table] == [row.split()[1] for row in switches[1:]]


def test_a_head_is_held_too(line_wav: Path, tmp_path: Path) -> None:
    arguments = ["animate", str(line_wav), "--text", "She had your dark suit in greasy wash water"]
    arguments += ["--pictures", "preston_blair", "--without", "WQ,L", "--fps", "12", "-o"]
    assert main([*arguments, str(tmp_path / "a.rhubarb.json")]) == 0
    cues = json.loads((tmp_path / "a.rhubarb.json").read_bytes())
    assert cues["metadata"]["soundFile"] == line_wav.name
    shapes = {cue["value"] for cue in cues["mouthCues"]}
    assert {"AI", "etc", "rest"} <= shapes
    assert not shapes & {"WQ", "L"}


BAD = {
    "no model": (["--character", "rhubarb", "-o", "a.glb"], "pictures has no model"),
    "a mapping": (["--character", "rhubarb", "--mapping", "m.json"], "takes no mapping"),
    "two lists": (["--character", "rhubarb", "--pictures", "rhubarb"], "takes no pictures"),
    "unknown list": (["--pictures", "rubarb"], "no mouth shapes 'rubarb'"),
    "unknown shape": (["--without", "Q"], "no shape 'Q'; expected one of A B C"),
    "no stand-in": (["--without", "A"], "'A' is not drawn, and nothing stands in"),
    "fps 0": (["--fps", "0"], "0 frames per second; expected 1 to 100"),
    "fps nan": (["--fps", "nan"], "nan frames per second"),
    "on 0": (["--on", "0"], "1 for ones, 2 for twos"),
    "hold 0": (["--hold", "0 frames"], "more than 0"),
    "hold -1": (["--hold", "-1 frames"], "as '2 frames' or '80 ms'"),
    "hold 2": (["--hold", "2"], "as '2 frames' or '80 ms'"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_wishes_are_one_line(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    arguments, words = BAD[name]
    outputs = [] if "-o" in arguments else ["-o", "a.tsv"]
    assert words in fails(capsys, tmp_path, "say", "Hi", *arguments, *outputs)


def test_a_model_is_refused_before_the_work(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = ("animate", tmp_path / "none.wav", "--character", "rhubarb")
    message = fails(capsys, tmp_path, *arguments, "-o", tmp_path / "a.glb")
    assert "pictures has no model" in message


def test_a_file_that_is_read_is_not_written_over(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own = tmp_path / "own.json"
    own.write_text("{}")
    arguments = ("say", "Hi", "--pictures", own, "-o", own)
    assert "over its own input" in fails(capsys, tmp_path, *arguments)


@pytest.mark.parametrize("name", ["rhubarb", "preston_blair", "fleming_dobbs"])
def test_a_list_of_mouths_is_inspected(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["character", "inspect", name]) == 0
    text = capsys.readouterr().out
    assert max(map(len, text.splitlines())) <= 80
    assert main(["character", "inspect", name, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert f"{name}: {len(found['shapes'])} mouth shapes, {found['rest']} at rest" in text
    for shape in found["shapes"]:
        assert f"  {shape['label']} " in text
    assert fails(capsys, tmp_path, "character", "inspect", name, "--write", "m.json").startswith(
        f"lipwright: {name}: a character of pictures has neither a mapping nor a mesh"
    )


def test_a_list_of_ones_own_is_inspected(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shapes = [
        {"label": "shut", "at": [{"PBM": 1}], "only": ["bmp"], "picture": "shut.png"},
        {"label": "ajar", "at": [{"open": 0.3, "W": 0.2}, {}]},
        {"label": "idle", "at": [{}], "only": ["sil"]},
    ]
    content = {"format": "lipwright/pictures", "version": 1, "name": "duck", "shapes": shapes}
    content |= {"rest": "idle", "reach": {"bmp": "shut"}}
    content |= {"missing": ["idle"], "fallback": {"idle": "ajar"}}
    (tmp_path / "duck.json").write_text(json.dumps(content), "utf-8")
    (tmp_path / "shut.png").write_bytes(b"\x89PNG")
    assert main(["character", "inspect", str(tmp_path / "duck.json")]) == 0
    text = capsys.readouterr().out
    assert "  shut  1 PBM\n        (every bmp must show it; shut.png)" in text
    assert "  ajar  0.3 open + 0.2 W; rest" in text
    assert "not drawn: ajar stands in" in text


def test_a_flat_page_is_no_head(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    page = str(tmp_path / "hi.html")
    assert main(["say", "Hi", "--character", "rhubarb", "-o", page]) == 0
    assert f"{page}  (speaking mouth: open it in a browser)" in capsys.readouterr().out
