"""A file in a form of its own keeps it: the diff is what was done, and nothing else."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import HealthCheck, Phase, given, settings

from lipwright.engines.bigram import read_set
from lipwright.engines.bigram.model import BigramSet
from lipwright.errors import InputError
from lipwright.studio.changes import AnyChange, ClearPair, DrawCurve, DrawPair, SetRule
from tests.studio.made import opened
from tests.studio.test_saving import OVER, SET, changed_lines, save, shown
from tests.studio.test_session import TRIANGLE, changes

SMALL = {
    "version": 1,
    "format": "lipwright/bigram-set",
    "name": "small",
    "base": "english",
    "bigrams": [
        {
            "word": "fat",
            "pair": ["f", "ah"],
            "curves": {"open": [[0, 0], [0.5, 0.5], [1, 0]], "FV": [[0, 0], [0.2, 1], [0.6, 0]]},
        },
        {"pair": ["l", "ow"], "curves": {"W": [[0, 0], [0.5, 0.5], [1, 0]]}},
        {"pair": ["bmp", "ow"], "curves": {"W": [[0, 0], [0.5, 0.5], [1, 0]]}},
    ],
}
FORMS = {
    "four spaces": {"indent": 4},
    "one line": {"separators": (",", ":")},
    "tabs": {"indent": "\t"},
}


def written(path: Path, form: str) -> str:
    text = json.dumps(SMALL, **FORMS[form])  # type: ignore[arg-type]
    path.write_text(text, "utf-8")
    return text


@pytest.mark.parametrize("form", FORMS)
def test_one_key_is_one_small_change(desk: Path, form: str) -> None:
    path = desk / "small.json"
    before = written(path, form)
    session = opened("small.json")
    session.edit(DrawCurve("set", ("f", "ah"), "open", TRIANGLE))
    save(session, SET)
    after = path.read_text("utf-8")
    old = json.dumps([[0, 0], [0.5, 0.5], [1, 0]], **FORMS[form])  # type: ignore[arg-type]
    if form == "one line":
        assert after == before.replace(old, "[[0, 0], [0.4, 0.7], [1, 0]]", 1)
    kept = [row for row in before.splitlines() if row in after.splitlines()]
    assert len(kept) >= len(before.splitlines()) - 15
    assert read_set(path).bigrams["f", "ah"].curves["open"].pairs() == list(TRIANGLE)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    "change",
    [
        DrawCurve("set", ("f", "ah"), "W", TRIANGLE),
        DrawCurve("set", ("f", "ah"), "FV", None),
        DrawCurve("set", ("aa", "z"), "W", TRIANGLE),
        DrawCurve("set", ("sil", "f"), "W", TRIANGLE),
        ClearPair("set", ("f", "ah")),
        ClearPair("set", ("l", "ow")),
        ClearPair("set", ("bmp", "ow")),
        DrawPair("set", ("l", "ow"), {}, 0.4, "load"),
        SetRule("set", "pose", ("open",), "limit", 9),
    ],
)
def test_whatever_is_done_the_file_says_it_in_its_own_form(
    desk: Path, form: str, change: AnyChange
) -> None:
    path = desk / "small.json"
    before = written(path, form)
    session = opened("small.json")
    session.edit(change)
    save(session, SET)
    assert_same(read_set(path), session.state.own.of)
    text = path.read_text("utf-8")
    assert text.startswith(before[:40])
    session.undo(1)
    save(session, SET)
    assert_same(read_set(path), session.state.own.of)


def assert_same(one: BigramSet, other: BigramSet) -> None:
    assert set(one.bigrams) == set(other.bigrams)
    for pair, bigram in one.bigrams.items():
        there = other.bigrams[pair]
        assert (bigram.curves, bigram.boundary) == (there.curves, there.boundary)
    assert one.rules == other.rules
    assert one.singles == other.singles


@settings(
    max_examples=20,
    deadline=None,
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(change=changes)
def test_any_change_is_read_back(desk: Path, change: AnyChange) -> None:
    path = desk / "small.json"
    written(path, "four spaces")
    session = opened("small.json", "low.json")
    session.drop_draft() if session.left else None
    try:
        session.edit(change)
    except InputError:
        return
    if shown(session, SET).diff:
        save(session, SET)
    assert_same(read_set(path), session.state.own.of)
    session.draft.close()


def test_windows_line_ends_stay(desk: Path) -> None:
    path = desk / "mine.json"
    lines = path.read_bytes().splitlines()
    path.write_bytes(b"\r\n".join([*lines, b""]))
    session = opened("mine.json")
    assert session.desk.dirty(session.state) == []
    session.edit(DrawCurve("set", ("f", "ah"), "open", TRIANGLE))
    assert len(changed_lines(shown(session, SET).diff)) == 2
    save(session, SET)
    after = path.read_bytes().split(b"\r\n")
    assert sum(one != other for one, other in zip(after, lines, strict=False)) == 1
    assert not any(b"\n" in one for one in after)


def test_overrides_in_a_form_of_their_own(desk: Path) -> None:
    path = desk / "over.json"
    said = {"format": "lipwright/bigram-overrides", "version": 1, "name": "o",
            "gains": {"wide": 0.5}, "poses": {"open": {"limit": 9}}}  # fmt: skip
    path.write_text(json.dumps(said, indent=1), "utf-8")
    session = opened("english", "over.json")
    session.edit(SetRule("overrides", "gain", ("wide",), "", 0.75))
    session.edit(DrawCurve("overrides", ("f", "ah"), "open", TRIANGLE))
    save(session, OVER)
    text = path.read_text("utf-8")
    assert text.startswith('{\n "format"')
    assert '"limit": 9' in text
    again = opened("english", "over.json")
    assert again.state.overrides.gains == {"wide": 0.75}
    assert again.cast.of.bigrams["f", "ah"].curves["open"].pairs() == list(TRIANGLE)
