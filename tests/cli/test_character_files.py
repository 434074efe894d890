"""Character files on the command line: say, inspect, why, new; and what is refused."""

import json
from pathlib import Path
from typing import Any

import pytest

from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.engines.bigram.set_file import DATA
from tests.character_files import LOW, write_character, write_model, write_overrides
from tests.cli.test_bad_input import fails

WORDS = "Hello, hello."


def run(*arguments: object) -> int:
    return main([str(argument) for argument in arguments])


@pytest.fixture
def troll(tmp_path: Path) -> Path:
    """A troll on a gnome on the head."""
    write_character(tmp_path / "gnome.json", base="head", gains={"W": 0.9})
    return write_character(
        tmp_path / "troll.json",
        base="gnome.json",
        overrides={"bigrams": [LOW]},
        settings={"poses": {"open": {"limit": 6}}},
        speech={"rate": [80, 150]},
    )


def time_of(line: Path, word: int, share: float) -> float:
    interval = Animation.load(line).words.intervals[word]
    return interval.start + share * (interval.end - interval.start)


def test_a_character_speaks_and_why_tells_what_it_overrode(
    troll: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    outputs = [part for name in ("a.json", "a.glb", "a.html") for part in ("-o", tmp_path / name)]
    assert run("say", WORDS, "--character", troll, *outputs) == 0
    assert "troll speaks 80 to 150 words per minute: 150, not 175" in capsys.readouterr().err
    line = tmp_path / "a.json"
    report = Animation.load(line).report["character"]
    assert (report["name"], report["file"]) == ("troll", troll.as_posix())
    asked = ("set", "why", line, "--time", time_of(line, 0, 0.55), "--control", "W")
    assert run(*asked) == 0
    told = capsys.readouterr()
    assert f"character troll, {troll}, overrides; english itself: " in told.out
    assert "without overrides: " in told.out
    assert told.err == ""
    assert run(*asked, "--json") == 0
    found = json.loads(capsys.readouterr().out)[0]
    mine = next(origin for origin in found["origins"] if origin["pair"] == "l-ow")
    assert mine["source"] == "troll"
    assert mine["own"] > mine["value"]
    assert found["alone"] > found["value"]


def test_why_finds_the_character_again_or_asks_for_it(
    troll: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "line and all"
    folder.mkdir()
    line = folder / "a.json"
    assert run("say", WORDS, "--character", troll, "-o", line) == 0
    asked = ("set", "why", line, "--time", "0.3")
    for name in ("troll.json", "gnome.json"):  # moved beside the line
        (tmp_path / name).rename(folder / name)
    assert run(*asked) == 0
    (folder / "troll.json").rename(folder / "ogre.json")
    capsys.readouterr()
    message = fails(capsys, tmp_path, *asked)
    assert "made by the character 'troll', whose file" in message
    assert "--character" in message
    assert run(*asked, "--character", folder / "ogre.json") == 0
    assert capsys.readouterr().err == ""
    write_character(folder / "troll.json", base="head")
    assert "is now another" in fails(capsys, tmp_path, *asked)
    assert run(*asked, "--character", folder / "troll.json") == 0
    assert "another state of 'troll'" in capsys.readouterr().err


def test_a_preset_with_rules_of_its_own_is_told(
    troll: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    made = ("say", WORDS, "--character", troll, "--preset", "published")
    assert run(*made, "-o", tmp_path / "a.json") == 0
    assert "settings of its own: those of the overrides are not used" in capsys.readouterr().err
    line = tmp_path / "a.json"
    assert run("set", "why", line, "--time", time_of(line, 0, 0.75)) == 0
    assert "character troll" in capsys.readouterr().out


def test_why_takes_the_set_that_the_character_brings(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (DATA / "english.json").read_text("utf-8")
    (tmp_path / "its.json").write_text(text.replace('"name": "english"', '"name": "its"'), "utf-8")
    path = write_character(tmp_path / "troll.json", base="head", set="its.json")
    line = tmp_path / "a.json"
    assert run("say", "Papa", "--character", path, "-o", line) == 0
    assert run("set", "why", line, "--time", time_of(line, 0, 0.3), "--json") == 0
    answer = capsys.readouterr().out.splitlines()[-1]
    assert json.loads(answer)[0]["origins"][0]["source"] == "its"
    # The user's set goes before it, and must then be named again.
    assert run("say", "Papa", "--character", path, "--set", "english", "-o", line) == 0
    capsys.readouterr()
    asked = ("set", "why", line, "--time", "0.3")
    assert "--set" in fails(capsys, tmp_path, *asked)
    assert run(*asked, "--set", "english") == 0


def test_inspect_shows_the_layers(
    troll: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("character", "inspect", troll) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "head (built in), then" in shown
    assert f"l-ow ({troll}, overrides)" in shown
    assert f"open: limit 6 ({troll}, settings)" in shown
    assert f"gain from {tmp_path / 'gnome.json'}" in shown
    assert run("character", "inspect", troll, "--json") == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["set"] == "english"
    assert [change["pairs"] for change in facts["overrides"]] == [["l-ow"], []]


def test_new_writes_a_file_that_speaks(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model = write_model(tmp_path / "face.glb")
    path = tmp_path / "troll.json"
    assert run("character", "new", path, "--model", model, "--set", "english") == 0
    assert f"--character {path}" in capsys.readouterr().out
    assert run("say", "Papa", "--character", path, "-o", tmp_path / "a.glb") == 0
    capsys.readouterr()
    assert "exists already" in fails(capsys, tmp_path, "character", "new", path, "--model", model)
    fails(capsys, tmp_path, "character", "new", tmp_path / "b.json", status=2)
    wrong = ("character", "new", tmp_path / "b.json", "--model", "head", "--set", "englsh")
    assert "no bigram set 'englsh'" in fails(capsys, tmp_path, *wrong)


def test_no_file_of_a_character_is_written_over(
    troll: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name in ("troll.json", "gnome.json"):
        arguments = ("say", "Hi", "--character", troll, "-o", tmp_path / name)
        assert "over its own input" in fails(capsys, tmp_path, *arguments)


BAD: list[tuple[dict[str, Any], str]] = [
    ({"base": "troll.json"}, "leads back to itself: troll.json → troll.json"),
    ({"base": "head", "overrides": {"gains": {"opn": 1}}}, "Did you mean 'open'?"),
    ({"base": "head", "overrides": [{"bigrams": [LOW]}] * 2}, "l-ow is said twice"),
    (
        {
            "base": "head",
            "overrides": {"poses": {"PBM": {"meets": "widen"}}},
            "settings": {"poses": {"PBM": {"meets": "cut"}}},
        },
        "widen in overrides, cut in settings",
    ),
    ({"base": "head", "mapping": {"open": {"opne": 1}}}, "no channel 'opne'"),
    ({"model": "gone.glb"}, "gone.glb: no such file"),
    ({"base": "head", "set": "gone.json"}, "gone.json: no such file"),
    ({"base": "head", "version": 2}, "newer Lipwright"),
    ({"base": "head", "gains": {"open": float("inf")}}, "Infinity"),
    ({"base": "head", "settings": {"padding": float("nan")}}, "NaN"),
]


@pytest.mark.parametrize(("content", "words"), BAD)
def test_character_files_that_are_broken(
    content: dict[str, Any], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = write_character(tmp_path / "troll.json", **content)
    output = tmp_path / "a.json"
    for arguments in (
        ("say", "Hi", "--character", path, "-o", output),
        ("character", "inspect", path),
    ):
        message = fails(capsys, tmp_path, *arguments)
        assert words in message
        assert "troll.json" in message


def test_a_folder_is_no_character(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "troll.json"
    folder.mkdir()
    arguments = ("say", "Hi", "--character", folder, "-o", tmp_path / "a.json")
    assert "troll.json: is a folder" in fails(capsys, tmp_path, *arguments)
    write_overrides(tmp_path / "o.json")
    arguments = ("say", "Hi", "--character", tmp_path / "o.json", "-o", tmp_path / "a.json")
    assert "expected a file of format 'lipwright/character'" in fails(capsys, tmp_path, *arguments)


def test_nothing_that_is_read_is_written_over(
    troll: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    base, own = tmp_path / "base.json", tmp_path / "own.json"
    base.write_bytes((DATA / "english.json").read_bytes())
    head = {
        "format": "lipwright/bigram-set",
        "version": 1,
        "name": "own",
        "base": "base.json",
        "bigrams": [],
    }
    own.write_text(json.dumps(head), "utf-8")
    elf = write_character(tmp_path / "elf.json", base="head", set="own.json")
    gnome = tmp_path / "gnome.json"
    for arguments in (
        ("character", "inspect", troll, "--write", troll),
        ("character", "inspect", troll, "--write", gnome),
        ("character", "inspect", elf, "--picture", own),
        ("say", "Hi", "--character", elf, "-o", own),
        ("say", "Hi", "--set", own, "-o", base),
    ):
        assert "would be written over its own input" in fails(
            capsys, tmp_path, *map(str, arguments)
        )


def test_a_set_is_shown_as_a_character_has_it(
    troll: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("set", "show", "l-ow", "--character", troll, "--json") == 0
    shown = json.loads(capsys.readouterr().out)
    assert (shown["source"], shown["curves"]) == ("troll", LOW["curves"])
    assert run("set", "show", "bmp-aa", "--character", "crab") == 0
    assert "mandibles_in" in capsys.readouterr().out
    new = {"pair": ["sh", "yu"], "curves": {}}
    path = write_character(
        tmp_path / "c.json", base="head", set="mandarin", overrides={"bigrams": [new]}
    )
    assert run("set", "coverage", "--character", path, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["set"] == "mandarin"
    told = fails(capsys, tmp_path, "set", "show", "l-ow", "--character", "crap")
    assert "no character 'crap'" in told
    assert "Did you mean 'crab'?" in told
    assert run("set", "coverage", "--character", troll, "--set", "crab") == 1
    assert "unknown pose" in capsys.readouterr().err


def test_a_base_that_does_not_suit_the_set_starts_nothing(
    troll: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    new = tmp_path / "new.json"
    told = fails(
        capsys, tmp_path, "character", "new", str(new), "--base", str(troll), "--set", "crab"
    )
    assert "unknown pose 'W'" in told


@pytest.mark.parametrize(
    ("name", "content", "cure"),
    [
        ("a.json", '{"format": "lipwright/face", "version": 1}', "lipwright character build"),
        ("a.json", '{"format": "lipwright/mapping", "version": 1}', "it goes with --mapping"),
        ("a.json", '{"format": "lipwright/bigram-set", "version": 1}', "it goes with --set"),
        ("a.obj", "v 0 0 0\n", "lipwright character build"),
        ("a.fbx", "Kaydara FBX Binary", "convert it to glb"),
    ],
)
def test_what_is_no_character_is_told_where_it_goes(
    name: str, content: str, cure: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / name).write_text(content, "utf-8")
    for command in (
        ["character", "inspect"],
        ["say", "Hi", "-o", tmp_path / "hi.csv", "--character"],
    ):
        assert cure in fails(capsys, tmp_path, *command, tmp_path / name).lower()


def test_the_set_of_a_built_in_character_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("character", "inspect", "crab") == 0
    assert "\nset: crab, nothing overridden\n" in capsys.readouterr().out
    assert run("character", "inspect", "crab", "--json") == 0
    assert json.loads(capsys.readouterr().out)["set"] == "crab"
