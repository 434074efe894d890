"""Drafts: a studio that dies loses nothing, one that saved all leaves nothing behind."""

from __future__ import annotations

import errno
from pathlib import Path
from typing import Any

import pytest

from lipwright.errors import InputError
from lipwright.studio import messages
from lipwright.studio.changes import AddLine, DrawCurve, LineData, MoveBoundary, SetRule
from lipwright.studio.drafts import state_folder
from tests.studio.made import ask, opened, talk
from tests.studio.test_session import TRIANGLE, contents

F_AH = DrawCurve("overrides", ("f", "ah"), "open", TRIANGLE)
GAIN = SetRule("overrides", "gain", ("wide",), "", 0.5)


def test_a_studio_that_died_is_offered_again_and_goes_on_with_its_past(desk: Path) -> None:
    session = opened("english", "low.json")
    start = contents(session)
    session.edit(F_AH)
    session.edit(MoveBoundary("1", 3, 0.48))
    session.edit(GAIN)
    session.undo(1)
    end = contents(session)
    # It is not closed: the program was killed.
    again = opened("english", "low.json")
    assert contents(again) == start
    assert again.offer is not None
    assert again.offer.steps == 2
    assert again.offer.summary == "move a boundary; draw open of f-ah"
    again.take_draft()
    assert contents(again) == end
    assert again.history.redo == "set wide gain"
    again.redo(1)
    again.undo(9)
    assert contents(again) == start


def test_nothing_is_done_before_the_draft_is_decided_about(desk: Path) -> None:
    opened("english").edit(F_AH)
    again = opened("english")
    with pytest.raises(InputError, match="an earlier studio left 1 changes"):
        again.edit(GAIN)
    again.drop_draft()
    again.edit(GAIN)
    assert again.history.undo_steps == 1
    aside = list(state_folder().rglob("aside-*.jsonl"))
    assert len(aside) == 1
    assert b'"f","ah"' in aside[0].read_bytes()


@pytest.mark.parametrize("cut", [1, 10, 60])
def test_a_journal_that_was_cut_in_the_middle_of_a_line_keeps_the_lines_before(
    desk: Path, cut: int
) -> None:
    session = opened("english")
    session.edit(GAIN)
    session.edit(F_AH)
    path = session.draft.path
    path.write_bytes(path.read_bytes()[:-cut])
    again = opened("english")
    assert again.offer is not None
    again.take_draft()
    assert again.state.overrides.gains == {"wide": 0.5}
    again.edit(F_AH)
    third = opened("english")
    third.take_draft()
    assert third.history.undo_steps == again.history.undo_steps


def test_what_was_saved_is_not_offered(desk: Path) -> None:
    session = opened("mine.json")
    session.edit(DrawCurve("set", ("f", "ah"), "open", TRIANGLE))
    shown = session.desk.preview(("set", ""), session.state, "")
    assert session.save(("set", ""), "", shown.digest) is not None
    assert opened("mine.json").offer is None
    session.close()
    assert not session.draft.path.exists()


def test_ending_with_changes_that_were_not_saved_keeps_them(desk: Path) -> None:
    session = opened("english")
    session.edit(F_AH)
    session.close()
    assert opened("english").offer is not None


def test_lines_that_were_typed_come_back(desk: Path) -> None:
    session = opened("english")
    line = LineData("1", "hm", (("m", 0.0, 0.3),), (), text="hm")
    session.edit(AddLine(line))
    again = opened("english")
    again.take_draft()
    assert again.state.lines["1"] == line
    assert again.next_line() == "2"


def test_a_page_that_was_there_goes_on_without_being_asked(desk: Path) -> None:
    session = opened("english")
    hello = ask(*talk(session), messages.Start())[0]
    assert isinstance(hello, messages.Hello)
    session.edit(F_AH)
    again = opened("english")
    studio, watcher = talk(again)
    stranger = studio.ask(watcher, messages.Start()).own[0]
    assert isinstance(stranger, messages.Hello)
    assert stranger.draft is not None
    known = studio.ask(watcher, messages.Start(session=hello.session)).own[0]
    assert isinstance(known, messages.Hello)
    assert known.draft is None
    assert known.session == hello.session
    assert known.history.undo == "draw open of f-ah"


def test_other_files_have_another_draft(desk: Path) -> None:
    opened("english").edit(F_AH)
    assert opened("mine.json").offer is None
    assert opened("english").offer is not None


def test_a_set_that_changed_since_is_compared_with_what_was_opened(desk: Path) -> None:
    session = opened("mine.json")
    session.edit(DrawCurve("set", ("f", "ah"), "open", TRIANGLE))
    path = desk / "mine.json"
    path.write_text(
        path.read_text("utf-8").replace('"name": "english"', '"name": "other"'), "utf-8"
    )
    again = opened("mine.json")
    again.take_draft()
    shown = again.desk.preview(("set", ""), again.state, "")
    assert '+  "name": "other"' in shown.theirs


def test_a_full_disk_is_said_and_nothing_is_changed(
    desk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    session = opened("english")
    session.edit(GAIN)
    before, journal = contents(session), session.draft.path.read_bytes()
    whole = Path.open

    class Full:
        """A file that takes ten bytes more."""

        def __init__(self, file: Any) -> None:
            self._file = file

        def __enter__(self) -> Full:
            return self

        def __exit__(self, *_: object) -> None:
            self._file.close()

        def write(self, data: bytes) -> None:
            self._file.write(data[:10])
            raise OSError(errno.ENOSPC, "No space left on device")

        def __getattr__(self, name: str) -> Any:
            return getattr(self._file, name)

    monkeypatch.setattr(Path, "open", lambda *a, **k: Full(whole(*a, **k)))
    studio, watcher = talk(session)
    (failed,) = studio.ask(watcher, messages.EditRequest(change=F_AH)).own
    assert isinstance(failed, messages.Failed)
    assert "No space left" in failed.error
    monkeypatch.undo()
    assert contents(session) == before
    assert session.draft.path.read_bytes() == journal
    session.edit(F_AH)
    assert session.history.undo_steps == 2
