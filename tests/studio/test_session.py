"""Changes, undo and redo: whatever is done, the past comes back byte for byte."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st

from lipwright.engines.bigram import BigramEngine
from lipwright.engines.bigram.edits import Edit
from lipwright.engines.bigram.overrides import lay_over
from lipwright.errors import InputError
from lipwright.studio.changes import (
    AnyChange,
    ClearPair,
    DrawCurve,
    DrawPair,
    DrawPhone,
    MoveBoundary,
    MoveMark,
    NameWord,
    PutEdit,
    RemoveEdit,
    RemoveLine,
    SetRule,
)
from lipwright.studio.desk import content_of
from lipwright.studio.session import Session
from tests.studio.made import opened

TRIANGLE = ((0.0, 0.0), (0.4, 0.7), (1.0, 0.0))
LABELS = ("f", "ah", "bmp", "l", "ow", "sil")
POSES = ("open", "W", "FV", "PBM", "tRoof")


def contents(session: Session) -> list[bytes]:
    """What every document would hold."""
    return [
        content_of(session.state, place, "x.TextGrid")
        for place in session.desk.places(session.state)
    ]


def keys() -> st.SearchStrategy[tuple[tuple[float, float], ...]]:
    return st.lists(
        st.tuples(st.floats(0.02, 0.98), st.floats(0, 1)),
        min_size=1,
        max_size=5,
        unique_by=lambda key: round(key[0], 2),
    ).map(lambda inner: ((0.0, 0.0), *sorted(inner), (1.0, 0.0)))


targets = st.sampled_from(("set", "overrides"))
pairs = st.tuples(st.sampled_from(LABELS), st.sampled_from(LABELS[:-1]))
poses = st.sampled_from(POSES)
edits = st.builds(
    Edit,
    word=st.sampled_from(("fat", "map", "Low", "gone")),
    phone=st.integers(1, 3),
    pose=poses,
    gain=st.floats(0, 3),
    hold=st.floats(0, 0.1),
    level=st.none() | st.floats(0, 1),
)
changes: st.SearchStrategy[AnyChange] = st.one_of(
    st.builds(DrawCurve, targets, pairs, poses, keys()),
    st.builds(DrawCurve, targets, pairs, poses, st.none()),
    st.builds(DrawPair, targets, pairs, st.dictionaries(poses, keys(), max_size=2)),
    st.builds(ClearPair, targets, pairs),
    st.builds(MoveMark, targets, pairs, st.floats(0.05, 0.95)),
    st.builds(NameWord, targets, pairs, st.text("abc", max_size=4)),
    st.builds(DrawPhone, targets, st.sampled_from(LABELS[:-1]), poses, keys()),
    st.builds(
        SetRule,
        st.just("overrides"),
        st.just("gain"),
        st.tuples(poses),
        st.just(""),
        st.none() | st.floats(0, 2),
    ),
    st.builds(
        SetRule,
        targets,
        st.just("pose"),
        st.tuples(poses),
        st.sampled_from(("limit", "window", "softness")),
        st.floats(0.01, 0.9),
    ),
    st.builds(
        SetRule,
        targets,
        st.just("setting"),
        st.just(()),
        st.just("spline"),
        st.sampled_from(("soften", "pchip", "linear")),
    ),
    st.builds(
        SetRule,
        targets,
        st.just("threshold"),
        st.just(("open", "FV")),
        st.just(""),
        st.floats(0.2, 2),
    ),
    st.builds(MoveBoundary, st.just("1"), st.integers(-1, 9), st.floats(0, 1.4)),
    st.builds(PutEdit, st.just("1"), edits),
    st.builds(RemoveLine, st.just("1")),
)
steps = st.lists(
    st.one_of(
        st.tuples(st.just("do"), changes, st.sampled_from(("", "", "drag"))),
        st.tuples(st.just("undo"), st.integers(1, 3), st.just("")),
        st.tuples(st.just("redo"), st.integers(1, 3), st.just("")),
    ),
    min_size=1,
    max_size=14,
)


def play(session: Session, todo: list[tuple[str, object, str]]) -> Iterator[None]:
    for what, one, merge in todo:
        if what == "undo":
            session.undo(one)  # type: ignore[arg-type]
        elif what == "redo":
            session.redo(one)  # type: ignore[arg-type]
        else:
            before = contents(session)
            try:
                session.edit(one, merge)  # type: ignore[arg-type]
            except InputError:
                assert contents(session) == before
        yield


@settings(
    max_examples=25,
    deadline=None,
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(todo=steps, own=st.booleans())
def test_whatever_is_done_undo_leads_back_and_redo_forth_again(
    desk: Path, todo: list[tuple[str, object, str]], own: bool
) -> None:
    session = opened("mine.json" if own else "english", "low.json")
    session.drop_draft() if session.left else None
    start = contents(session)
    for _ in play(session, todo):
        pass
    end, far = contents(session), session.steps.undo_steps
    session.undo(10_000)
    assert contents(session) == start
    session.redo(far)
    assert contents(session) == end
    assert_cast_is_whole(session)
    again = opened("mine.json" if own else "english", "low.json")
    if again.left is not None:
        assert contents(again) == start
        again.take_draft()
    assert contents(again) == end
    again.undo(10_000)
    assert contents(again) == start


def assert_cast_is_whole(session: Session) -> None:
    """What was kept up to date change by change equals what is laid anew."""
    whole = lay_over(session.state.own.of, session.state.overrides)
    of = session.cast.of
    assert set(of.bigrams) == set(whole.bigrams)
    assert all(of.bigrams[p].curves == b.curves for p, b in whole.bigrams.items())
    assert of.singles == whole.singles
    assert of.rules == whole.rules
    for line in session.state.lines.values():
        motion = session.motion(line.id)
        fresh = BigramEngine(whole).animate(motion.speech, 60.0, line.edits)
        np.testing.assert_array_equal(motion.animation.values, fresh.values)


def test_a_drag_is_one_step_of_undo(desk: Path) -> None:
    session = opened("english", "low.json")
    for height in (0.1, 0.2, 0.3):
        drawn = ((0.0, 0.0), (0.4, height), (1.0, 0.0))
        session.edit(DrawCurve("overrides", ("f", "ah"), "open", drawn), "drag 1")
    session.edit(DrawCurve("overrides", ("f", "ah"), "open", TRIANGLE), "drag 2")
    assert session.history.undo_steps == 2
    session.undo(1)
    kept = session.state.overrides.bigrams["f", "ah"].curves["open"].pairs()
    assert kept[1] == (0.4, 0.3)
    session.undo(1)
    assert not session.state.overrides.bigrams
    assert session.history.redo == "draw open of f-ah"


def test_drawing_in_overrides_begins_with_what_the_set_has(desk: Path) -> None:
    session = opened("english", "low.json")
    was = session.cast.of.bigrams["f", "ah"].curves
    session.edit(DrawCurve("overrides", ("f", "ah"), "open", TRIANGLE))
    now = session.cast.of.bigrams["f", "ah"]
    assert now.curves["FV"] == was["FV"]
    assert now.curves["open"].pairs() == list(TRIANGLE)
    assert now.source == "english overrides"
    session.edit(ClearPair("overrides", ("f", "ah")))
    assert session.cast.of.bigrams["f", "ah"].curves == was


def test_an_override_moves_the_face_and_a_cleared_one_no_more(desk: Path) -> None:
    session = opened("english", "low.json")
    before = session.motion("1").animation
    session.edit(DrawCurve("overrides", ("l", "ow"), "W", ((0.0, 0.0), (0.9, 0.1), (1.0, 0.0))))
    after = session.motion("1").animation
    at = 0.9
    assert after.at([at])[0, 1] < before.at([at])[0, 1] - 0.1
    session.undo(1)
    np.testing.assert_array_equal(session.motion("1").animation.values, before.values)


def test_dragging_a_boundary_takes_the_word_along(desk: Path) -> None:
    session = opened("english", "low.json")
    session.edit(MoveBoundary("1", 3, 0.48))
    line = session.state.lines["1"]
    assert line.phones[3][2] == line.phones[4][1] == 0.48
    assert line.words[0][2] == line.words[1][1] == 0.48
    motion = session.motion("1")
    closed = motion.animation.at([0.52])[0, motion.animation.controls.index("PBM")]
    assert closed > 0.9


def test_a_boundary_keeps_clear_of_its_neighbours(desk: Path) -> None:
    session = opened("english", "low.json")
    session.edit(MoveBoundary("1", 3, 5.0))
    assert session.state.lines["1"].phones[4][1] == pytest.approx(0.545)
    session.edit(MoveBoundary("1", 3, -5.0))
    assert session.state.lines["1"].phones[3][2] == pytest.approx(0.355)


def test_an_edit_of_the_same_place_is_replaced(desk: Path) -> None:
    session = opened("english", "low.json")
    session.edit(PutEdit("1", Edit("low", 2, "open", gain=2)))
    session.edit(PutEdit("1", Edit("LOW", 2, "open", gain=3)))
    session.edit(PutEdit("1", Edit("low", 1, "open", gain=3)))
    assert [edit.gain for edit in session.state.lines["1"].edits] == [3, 3]
    session.edit(RemoveEdit("1", session.state.lines["1"].edits[0]))
    assert len(session.state.lines["1"].edits) == 1


def test_edits_survive_another_recording_and_lost_ones_are_told(desk: Path) -> None:
    session = opened("english", "low.json")
    session.edit(PutEdit("1", Edit("low", 2, "open", level=0.9, label="ow")))
    session.edit(PutEdit("1", Edit("low", 2, "W", level=0.9, label="aa")))
    for phone in (6, 7):
        session.edit(MoveBoundary("1", phone, 0.75 + 0.1 * (phone - 6)))
    motion = session.motion("1")
    assert motion.animation.at([1.0])[0, 0] > 0.6
    assert session.lost(session.state.lines["1"]) == 1


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (DrawCurve("set", ("f", "xx"), "open", TRIANGLE), "'xx' is not a phone"),
        (DrawCurve("set", ("f", "ah"), "opn", TRIANGLE), "Did you mean 'open'"),
        (DrawCurve("set", ("sil", "sil"), "open", TRIANGLE), "silence after silence"),
        (DrawCurve("set", ("f", "ah"), "open", ((0, 0.5), (1, 0))), "expected 0 at both ends"),
        (DrawCurve("set", ("f", "ah"), "open", ((0, 0), (0.5, 2), (1, 0))), "weights in 0..1"),
        (DrawCurve("set", ("f", "ah"), "open", ((0, 0), (0.5, 1), (0.5, 0))), "times that increa"),
        (DrawCurve("set", ("f", "ah"), "open", ((0, 0),)), "two or more"),
        (MoveMark("overrides", ("f", "ah"), 0), "0.01 to 0.99"),
        (DrawPhone("set", "ah", "open", ((-2, 0), (1, 0))), "times in -1..2"),
        (SetRule("set", "pose", ("open",), "speed", 3), "unknown setting 'speed'"),
        (SetRule("set", "pose", ("open",), "limit", "fast"), "limit"),
        (SetRule("set", "pose", ("open",), "limit", 0), "0.001 to 1e+06"),
        (SetRule("set", "pose", ("open",), "limit", None), "a set says all of them"),
        (SetRule("set", "gain", ("open",), "", 2), "Set it in the overrides"),
        (SetRule("overrides", "gain", ("open",), "", 11), "0 to 10"),
        (SetRule("overrides", "gain", ("opn",), "", 1), "Did you mean 'open'"),
        (SetRule("overrides", "setting", (), "warp", "bent"), "warp"),
        (SetRule("overrides", "setting", (), "wrap", "linear"), "Did you mean 'warp'"),
        (SetRule("overrides", "threshold", ("FV", "PBM"), "", 0.5), "both widen"),
        (MoveBoundary("1", 77, 0.5), "no boundary 77"),
        (MoveBoundary("9", 1, 0.5), "no line '9'"),
        (RemoveLine("9"), "no line '9'"),
        (PutEdit("1", Edit("low", 1, "opn")), "unknown pose 'opn'"),
        (RemoveEdit("1", Edit("low", 1, "open")), "no edit"),
    ],
)
def test_what_makes_no_sense_is_refused_and_changes_nothing(
    desk: Path, change: AnyChange, words: str
) -> None:
    session = opened("mine.json", "low.json")
    before, records = contents(session), session.draft.read()
    with pytest.raises(InputError, match=re.escape(words)):
        session.edit(change)
    assert contents(session) == before
    assert session.draft.read() == records
    assert session.history.undo_steps == 0
