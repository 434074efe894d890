"""A line is sent whole once, then in parts: what a page puts together is the line as it is."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import msgspec
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lipwright.engines.bigram.edits import Edit
from lipwright.studio.asking import Studio
from lipwright.studio.changes import AddLine, MoveBoundary, PutEdit
from lipwright.studio.messages import Answer, LinePart, LineView, Watch
from lipwright.studio.page_views import Watcher
from lipwright.studio.session import Session
from tests.studio.made import opened
from tests.studio.test_session import play

LISTS = ("words", "phones", "classes", "pairs")
moves = st.builds(MoveBoundary, st.just("1"), st.integers(-1, 9), st.floats(0, 1.4))
edits = st.builds(
    Edit, word=st.sampled_from(("fat", "low")), phone=st.integers(1, 3), pose=st.just("open")
)
todo = st.lists(
    st.one_of(
        st.tuples(st.just("do"), moves, st.sampled_from(("", "drag"))),
        st.tuples(st.just("do"), st.builds(PutEdit, st.just("1"), edits), st.just("")),
        st.tuples(st.just("undo"), st.integers(1, 3), st.just("")),
        st.tuples(st.just("redo"), st.integers(1, 3), st.just("")),
    ),
    min_size=1,
    max_size=8,
)


def told(shown: LineView | None, answer: Answer) -> LineView | None:
    """What a page shows after an answer, by the words of the messages alone."""
    if isinstance(answer, LineView):
        return answer
    if not isinstance(answer, LinePart):
        return shown
    assert shown is not None
    assert shown.line == answer.line
    lists: dict[str, Any] = {}
    for name in LISTS:
        items, splice = list(getattr(shown, name)), getattr(answer, name)
        items[splice.at : splice.at + splice.gone] = splice.new
        lists[name] = tuple(items)
    rest = {
        name: getattr(answer, name) for name in ("revision", "duration", "start", "end", "edits")
    }
    return msgspec.structs.replace(shown, **lists, **rest)


def whole(session: Session) -> LineView:
    """The line as another page is sent it."""
    fresh = Watcher(session)
    fresh.watch(Watch(line="1"))
    return next(one for one in fresh.news() if isinstance(one, LineView))


@settings(
    max_examples=25,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(todo=todo)
def test_parts_put_together_are_the_line(desk: Path, todo: list[tuple[str, object, str]]) -> None:
    session = opened("english", "low.json")
    session.drop_draft() if session.left else None
    watcher = Watcher(session)
    watcher.watch(Watch(line="1"))
    shown = next(one for one in watcher.news() if isinstance(one, LineView))
    for _ in play(session, todo):
        for answer in watcher.news():
            shown = told(shown, answer) or shown
        now = whole(session)
        assert msgspec.structs.replace(shown, revision=0) == msgspec.structs.replace(
            now, revision=0
        )


def test_a_drag_sends_what_moved_and_counts_no_pair_anew(desk: Path) -> None:
    session = opened("english", "low.json")
    studio, watcher = Studio(session), Watcher(session)
    studio.ask(watcher, Watch(line="1"))
    need = dict(session.need())
    session.edit(MoveBoundary("1", 3, 0.48))
    (part,) = (one for one in watcher.news() if isinstance(one, LinePart))
    assert [(one.label, one.start, one.end) for one in part.phones.new] == [
        ("t", 0.35, 0.48),
        ("m", 0.48, 0.55),
    ]
    assert [one.label for one in part.words.new] == ["fat", "map"]
    assert len(part.pairs.new) < len(whole(session).pairs)
    assert session.need() == need


def test_pairs_are_counted_anew_where_a_gap_opens_or_another_line_comes(desk: Path) -> None:
    session = opened("english", "low.json")
    line = session.state.lines["1"]
    before = session.need()
    rows = tuple(("t", 0.35, 0.36) if row[0] == "t" else row for row in line.phones)
    session.edit(AddLine(msgspec.structs.replace(line, phones=rows)))
    assert session.need() != before


def test_another_recording_of_a_line_is_sent_whole(desk: Path) -> None:
    session = opened("english", "low.json")
    watcher = Watcher(session)
    watcher.watch(Watch(line="1"))
    list(watcher.news())
    line = session.state.lines["1"]
    session.edit(AddLine(msgspec.structs.replace(line, title="again")))
    assert any(isinstance(one, LineView) for one in watcher.news())
