"""Saving: what a colleague sees in a diff, and what others wrote meanwhile."""

from __future__ import annotations

from pathlib import Path

import pytest

from lipwright import animate
from lipwright.engines.bigram import load_set, read_edits, read_set
from lipwright.engines.bigram.edits import Edit
from lipwright.errors import InputError, LipwrightError
from lipwright.pipeline import from_labels
from lipwright.studio.changes import (
    ClearPair,
    DrawCurve,
    DrawPair,
    DrawPhone,
    MoveBoundary,
    PutEdit,
    SetRule,
)
from lipwright.studio.desk import Place
from lipwright.studio.messages import PreviewView
from lipwright.studio.session import Session
from tests.studio.made import opened
from tests.studio.test_session import TRIANGLE

SET: Place = ("set", "")
OVER: Place = ("overrides", "")
EDITS: Place = ("edits", "1")
F_AH = DrawCurve("set", ("f", "ah"), "open", TRIANGLE)


def shown(session: Session, place: Place, name: str = "") -> PreviewView:
    return session.desk.preview(place, session.state, name)


def save(session: Session, place: Place, name: str = "") -> Path:
    path = session.save(place, name, shown(session, place, name).digest)
    assert path is not None
    return Path(path)


def changed_lines(diff: str) -> list[str]:
    return [row for row in diff.splitlines() if row[:1] in "+-" and row[:3] not in ("+++", "---")]


def test_the_diff_is_one_line_for_one_curve(desk: Path) -> None:
    session = opened("mine.json")
    session.edit(F_AH)
    removed, added = changed_lines(shown(session, SET).diff)
    assert removed.startswith('-      "open": [[')
    assert added == '+      "open": [[0, 0], [0.4, 0.7], [1, 0]],'
    before = (desk / "mine.json").read_text("utf-8").splitlines()
    save(session, SET)
    after = (desk / "mine.json").read_text("utf-8").splitlines()
    assert [a for a, b in zip(before, after, strict=True) if a != b] == [removed[1:]]
    assert read_set(desk / "mine.json").bigrams["f", "ah"].curves["open"].pairs()[1] == (0.4, 0.7)
    assert changed_lines(shown(session, SET).diff) == []


def test_undo_works_past_saving(desk: Path) -> None:
    session = opened("mine.json")
    before = (desk / "mine.json").read_bytes()
    session.edit(F_AH)
    save(session, SET)
    assert session.desk.dirty(session.state) == []
    session.undo(1)
    assert session.desk.dirty(session.state) == [SET]
    save(session, SET)
    assert (desk / "mine.json").read_bytes() == before


def test_a_pair_that_comes_and_goes_stands_where_it_stood(desk: Path) -> None:
    session = opened("mine.json")
    before = (desk / "mine.json").read_bytes()
    was = session.state.own.bigrams["bmp", "ow"]
    session.edit(ClearPair("set", ("bmp", "ow")))
    assert len(changed_lines(shown(session, SET).diff)) > 2
    curves = {pose: tuple(keys.pairs()) for pose, keys in was.curves.items()}
    session.edit(DrawPair("set", ("bmp", "ow"), curves, was.boundary, was.word))
    assert shown(session, SET).diff == ""
    assert save(session, SET).read_bytes() == before


def test_overrides_are_a_new_file_that_the_command_line_reads(desk: Path) -> None:
    session = opened("english", "low.json")
    session.edit(DrawCurve("overrides", ("l", "ow"), "W", ((0, 0), (0.9, 0.05), (1, 0))))
    session.edit(SetRule("overrides", "gain", ("wide",), "", 0.5))
    session.edit(SetRule("overrides", "pose", ("open",), "limit", 9))
    session.edit(SetRule("overrides", "threshold", ("open", "FV"), "", 0.4))
    session.edit(SetRule("overrides", "setting", (), "padding", 0.15))
    session.edit(DrawPhone("overrides", "ah", "open", ((-0.5, 0), (0.5, 0.5), (1.5, 0))))
    preview = shown(session, OVER, "troll.json")
    assert preview.is_new
    path = save(session, OVER, "troll.json")
    assert path == desk / "troll.json"
    performance = animate(from_labels("low.json"), overrides=path)
    now = session.motion("1").animation
    assert performance.animation.values.tobytes() == now.values.tobytes()
    assert opened("english", "troll.json").state.overrides.gains == {"wide": 0.5}
    assert shown(session, OVER).diff == ""


def test_edits_are_a_file_that_animate_takes(desk: Path) -> None:
    session = opened("english", "low.json")
    session.edit(PutEdit("1", Edit("low", 2, "open", level=0.9, label="ow")))
    drawn = ((0.0, 0.2), (0.5, 0.8), (1.0, 0.1))
    session.edit(PutEdit("1", Edit("map", 1, "PBM", hold=0.03, keys=drawn, unlocked=True)))
    path = save(session, EDITS, "low.edits.json")
    assert read_edits(path) == session.state.lines["1"].edits
    performance = animate(from_labels("low.json"), edits=path)
    now = session.motion("1").animation
    assert performance.animation.values.tobytes() == now.values.tobytes()
    again = opened("english", "low.json", "low.edits.json")
    assert again.state.lines["1"].edits == session.state.lines["1"].edits
    session.edit(PutEdit("1", Edit("low", 2, "open", level=0.8, label="ow")))
    assert len(changed_lines(shown(session, EDITS).diff)) == 2


def test_moved_boundaries_are_saved_as_labels(desk: Path) -> None:
    session = opened("english", "low.json")
    session.edit(MoveBoundary("1", 3, 0.48))
    assert ("labels", "1") in session.desk.dirty(session.state)
    path = save(session, ("labels", "1"), "low.TextGrid")
    assert from_labels(path).phones.tier[4].start == 0.48


def test_a_set_of_ones_own_on_the_english_one_holds_only_what_differs(desk: Path) -> None:
    session = opened("english")
    session.edit(F_AH)
    session.edit(SetRule("set", "pose", ("open",), "limit", 9))
    path = save(session, SET, "mine2.json")
    text = path.read_text("utf-8")
    assert '"base": "english"' in text
    assert text.count('"pair"') == 1
    made = read_set(path)
    assert made.rules.pose("open").limit == 9
    assert len(made.bigrams) == len(load_set("english").bigrams)
    again = opened("mine2.json")
    again.edit(ClearPair("set", ("f", "ah")))
    assert again.cast.of.bigrams["f", "ah"] == load_set("english").bigrams["f", "ah"]


def test_a_file_that_changed_underneath_is_not_written_over(desk: Path) -> None:
    session = opened("mine.json")
    session.edit(F_AH)
    path = desk / "mine.json"
    ours = shown(session, SET)
    theirs = path.read_text("utf-8").replace('"word": "low"', '"word": "slowly"')
    assert theirs.count("slowly") == 1
    path.write_text(theirs, "utf-8")
    assert session.save(SET, "", ours.digest) is None
    both = shown(session, SET)
    assert '"word": "slowly"' in both.theirs
    assert '"open": [[0, 0], [0.4, 0.7], [1, 0]]' in both.diff
    with pytest.raises(InputError, match="changed on disk since it was opened"):
        session.save(SET, "", both.digest)
    assert path.read_text("utf-8") == theirs
    session.reread(SET, keep=True)
    assert session.state.own.of.bigrams["l", "ow"].word == "slowly"
    save(session, SET)
    text = path.read_text("utf-8")
    assert '"word": "slowly"' in text
    assert '"open": [[0, 0], [0.4, 0.7], [1, 0]]' in text


def test_what_both_changed_is_named(desk: Path) -> None:
    session = opened("mine.json")
    session.edit(F_AH)
    other = opened("mine.json", character="head")
    other.edit(DrawCurve("set", ("f", "ah"), "open", ((0, 0), (0.5, 0.1), (1, 0))))
    other.edit(DrawCurve("set", ("l", "ow"), "open", ((0, 0), (0.5, 0.1), (1, 0))))
    save(other, SET)
    assert shown(session, SET).both == ("f-ah",)
    session.reread(SET, keep=False)
    assert session.state.own.bigrams["f", "ah"].curves["open"].pairs()[1] == (0.5, 0.1)
    session.undo(1)
    assert session.state.own.bigrams["f", "ah"].curves["open"].pairs()[1] == (0.4, 0.7)


def test_what_is_broken_on_disk_is_said_and_left_alone(desk: Path) -> None:
    session = opened("mine.json")
    session.edit(F_AH)
    path = desk / "mine.json"
    path.write_text("{", "utf-8")
    preview = shown(session, SET)
    assert "cannot be read" in preview.refused
    with pytest.raises(InputError, match="cannot be read"):
        session.save(SET, "", preview.digest)
    assert path.read_text("utf-8") == "{"


def test_a_file_that_is_gone_is_written_again(desk: Path) -> None:
    session = opened("mine.json")
    session.edit(F_AH)
    (desk / "mine.json").unlink()
    assert shown(session, SET).theirs == "the file is gone\n"
    save(session, SET)
    assert read_set(desk / "mine.json").name == "english"


def test_a_name_that_exists_and_was_not_opened_is_refused(desk: Path) -> None:
    session = opened("english", "low.json")
    session.edit(DrawCurve("overrides", ("f", "ah"), "open", TRIANGLE))
    before = (desk / "mine.json").read_bytes()
    preview = shown(session, OVER, "mine.json")
    assert "was not opened" in preview.refused
    with pytest.raises(InputError, match="was not opened"):
        session.save(OVER, "mine.json", preview.digest)
    assert (desk / "mine.json").read_bytes() == before


@pytest.mark.parametrize(
    "name",
    [
        "../up.json", "/tmp/x.json", "a/b.json", "..\\up.json", "C:x.json", ".hidden.json",
        "x.txt", "json", "x\0.json", "..",
    ],
)  # fmt: skip
def test_a_page_cannot_name_other_places(desk: Path, name: str) -> None:
    session = opened("english")
    session.edit(DrawCurve("overrides", ("f", "ah"), "open", TRIANGLE))
    with pytest.raises(LipwrightError, match="the name"):
        session.save(OVER, name, "none")
    assert sorted(path.name for path in desk.iterdir()) == ["low.json", "low.wav", "mine.json"]


def test_a_read_only_file_is_refused_with_a_reason(desk: Path) -> None:
    session = opened("mine.json")
    session.edit(F_AH)
    (desk / "mine.json").chmod(0o444)
    assert "is read-only" in shown(session, SET).refused


CHARACTER = """{
  "format": "lipwright/character",
  "version": 1,
  "name": "troll",
  "base": "head"%s
}
"""


@pytest.mark.parametrize(
    ("said", "becomes"),
    [
        ("", '"overrides": "troll-overrides.json"'),
        (', "overrides": []', '"overrides": ["troll-overrides.json"]'),
        (
            ', "overrides": {"gains": {"wide": 0.5}}',
            '"overrides": [{"gains": {"wide": 0.5}}, "troll-overrides.json"]',
        ),
        (
            ',\n  "settings": {"poses": {"open": {"limit": 9}}}',
            '"name": "troll",\n  "overrides": "troll-overrides.json",\n  "base"',
        ),
    ],
)
def test_a_characters_overrides_are_named_in_its_file(desk: Path, said: str, becomes: str) -> None:
    troll = desk / "troll.json"
    troll.write_text(CHARACTER % said, "utf-8")
    session = opened("troll.json", "low.json")
    session.edit(DrawCurve("overrides", ("l", "ow"), "W", ((0, 0), (0.9, 0.05), (1, 0))))
    diff = shown(session, OVER).diff
    assert "+++ troll-overrides.json" in diff
    assert "+++ troll.json" in diff
    now = session.motion("1").animation
    save(session, OVER)
    assert becomes in troll.read_text("utf-8")
    performance = animate(from_labels("low.json"), character=troll)
    assert performance.animation.values.tobytes() == now.values.tobytes()
    again = opened("troll.json", "low.json")
    assert again.state.overrides.bigrams.keys() == {("l", "ow")}
    assert again.motion("1").animation.values.tobytes() == now.values.tobytes()
    again.edit(DrawCurve("overrides", ("l", "ow"), "W", ((0, 0), (0.9, 0.15), (1, 0))))
    assert len(changed_lines(shown(again, OVER).diff)) == 2


def test_a_character_file_that_changed_meanwhile_is_not_written_over(desk: Path) -> None:
    troll = desk / "troll.json"
    troll.write_text(CHARACTER % "", "utf-8")
    session = opened("troll.json")
    session.edit(DrawCurve("overrides", ("l", "ow"), "W", TRIANGLE))
    preview = shown(session, OVER)
    troll.write_text(CHARACTER % ', "about": "x"', "utf-8")
    assert session.save(OVER, "", preview.digest) is None
    assert not (desk / "troll-overrides.json").exists()
    save(session, OVER)
    assert '"about": "x"' in troll.read_text("utf-8")
