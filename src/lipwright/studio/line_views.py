"""What the page shows of a line: words, phones, pairs, edits, and why it moves as it does."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from typing import TypeVar

import msgspec
import numpy as np
from numpy.typing import NDArray

from lipwright.engines.bigram.edits import Found, plain_word
from lipwright.engines.bigram.engine import BigramEngine, Solved
from lipwright.engines.bigram.model import Pair
from lipwright.engines.bigram.why import Explanation
from lipwright.engines.bigram.why import why as explain
from lipwright.studio.changes import LineData, Row
from lipwright.studio.lines import duration_of, tier_of
from lipwright.studio.messages import (
    ClassSpan,
    ClassSplice,
    EditView,
    LineName,
    LinePart,
    LineView,
    OriginView,
    PairSpan,
    PairSplice,
    ReasonView,
    Span,
    SpanSplice,
    WhyView,
)
from lipwright.studio.motion import Motion

T = TypeVar("T")


def line_name(line: LineData, lost: int) -> LineName:
    """Return a line as the list shows it."""
    return LineName(line.id, line.title, duration_of(line), len(line.edits), lost)


def line_view(line: LineData, motion: Motion, revision: int) -> LineView:
    """Return a line, without its motion."""
    solved = motion.solved
    assert solved is not None
    start = min(0.0, float(solved.spans.starts[0]) if solved.spans.labels else 0.0)
    end = float(solved.spans.ends[-1]) if solved.spans.labels else 0.0
    return LineView(
        revision=revision,
        line=line.id,
        title=line.title,
        text=line.text,
        source=line.source,
        duration=duration_of(line),
        start=min(start, motion.animation.start),
        end=max(end, duration_of(line)),
        words=_spans(line.words),
        phones=_spans(line.phones),
        classes=tuple(_classes(line, solved)),
        pairs=tuple(_pairs(solved)),
        edits=_edits(line, solved.edits),
        notes=line.notes,
        sound=f"sounds/{line.sound.key}.wav" if line.sound else "",
    )


def line_part(known: LineView, now: LineView) -> LinePart | None:
    """Return what became different in a line; None where it is another, or has other words."""
    said = ("revision", "duration", "start", "end", "edits")
    lists = ("words", "phones", "classes", "pairs")
    rest = {name: getattr(known, name) for name in said + lists}
    if msgspec.structs.replace(now, **rest) != known:
        return None
    words, phones, classes, pairs = (
        _splice(getattr(known, name), getattr(now, name)) for name in lists
    )
    return LinePart(
        line=now.line,
        words=SpanSplice(*words),
        phones=SpanSplice(*phones),
        classes=ClassSplice(*classes),
        pairs=PairSplice(*pairs),
        **{name: getattr(now, name) for name in said},
    )


def _splice(before: tuple[T, ...], after: tuple[T, ...]) -> tuple[int, int, tuple[T, ...]]:
    """Return where two lists part, how much of the first is gone, and what is there instead."""
    fewest = min(len(before), len(after))
    at = next((n for n in range(fewest) if before[n] != after[n]), fewest)
    left = fewest - at
    same = next((n for n in range(left) if before[-1 - n] != after[-1 - n]), left)
    return at, len(before) - at - same, after[at : len(after) - same]


def _spans(rows: Iterable[Row]) -> tuple[Span, ...]:
    return tuple(Span(*row) for row in rows)


def _pairs(solved: Solved) -> Iterator[PairSpan]:
    spans = solved.spans
    columns = (spans.first.tolist(), spans.boundary.tolist(), spans.last.tolist())
    for pair, first, boundary, last in zip(spans.pairs, *columns, strict=True):
        yield PairSpan(pair, first, boundary, last)


def _classes(line: LineData, solved: Solved) -> Iterator[ClassSpan]:
    """Each class, and what an edit of its phone hangs on: as :mod:`...bigram.edits` finds it."""
    spans = solved.spans
    places = list(phone_places(line))
    # A phone that became several classes is one phone: it is found again by its time.
    phones = _places_at(line.phones, 0.5 * (spans.starts + spans.ends))
    columns = (spans.labels, spans.starts.tolist(), spans.ends.tolist(), phones)
    for label, start, end, index in zip(*columns, strict=True):
        phone = index if index >= 0 and line.phones[index][0] != "sil" else -1
        word, number, inside, occurrence = places[phone] if phone >= 0 else ("", -1, 0, 0)
        yield ClassSpan(label, start, end, phone, word, number, inside, occurrence)


def phone_places(line: LineData) -> Iterator[tuple[str, int, int, int]]:
    """Yield each phone's word, the word's number, the phone's place in it, and which such word."""
    seen: Counter[int] = Counter()
    occurrences = _occurrences(line.words)
    middles = np.array([0.5 * (start + end) for _, start, end in line.phones])
    for (label, _, _), number in zip(line.phones, _places_at(line.words, middles), strict=True):
        if label != "sil" or number < 0:
            seen[number] += 1
        if number < 0:
            yield "", -1, seen[number], 1
        else:
            yield line.words[number][0], number, seen[number], occurrences[number]


def _places_at(rows: tuple[Row, ...], times: NDArray[np.float64]) -> list[int]:
    """Return which row holds each instant; -1 where none does."""
    edges = np.array([(start, end) for _, start, end in rows]).reshape(-1, 2)
    places = np.searchsorted(edges[:, 0], times, side="right") - 1
    held = places >= 0
    held[held] = times[held] < edges[places[held], 1]
    return [int(place) for place in np.where(held, places, -1)]


def _occurrences(words: Iterable[Row]) -> list[int]:
    count: Counter[str] = Counter()
    found = []
    for label, _, _ in words:
        word = plain_word(label)
        count[word] += 1
        found.append(count[word])
    return found


def _edits(line: LineData, found: tuple[Found, ...]) -> tuple[EditView, ...]:
    places = {id(one.edit): one.phone for one in found}
    views = []
    for edit in line.edits:
        phone = places.get(id(edit))
        start, end = (phone.start, phone.end) if phone else (0.0, 0.0)
        views.append(EditView(edit, edit.name, phone is None, start, end))
    return tuple(views)


def edited_pairs(solved: Solved) -> Counter[Pair]:
    """Return how many edits of a line lie in each pair."""
    count: Counter[Pair] = Counter()
    spans = solved.spans
    for one in solved.edits:
        middle = one.phone.middle
        for index, pair in enumerate(spans.pairs):
            if spans.starts[index] <= middle < spans.ends[index + 1]:
                count[pair] += 1
    return count


def why_view(
    engine: BigramEngine, solved: Solved, line: LineData, control: str, time: float
) -> WhyView:
    """Return why a control of a line has its value at an instant."""
    found: Explanation = explain(engine, solved, control, time)
    words = tier_of(line.words)
    word = words.at(time)
    return WhyView(
        line=line.id,
        control=control,
        time=time,
        phone=found.phone,
        word=word.label if word else "",
        value=found.value,
        origins=tuple(
            OriginView(
                _pair(one.pair),
                one.source,
                one.start,
                one.end,
                one.value,
                one.keys,
                one.override,
                one.own,
            )
            for one in found.origins
        ),
        reasons=tuple(
            ReasonView(one.stage, one.before, one.after, one.text) for one in found.reasons
        ),
        edits=found.edits,
        alone=found.alone,
        text=found.text(),
    )


def _pair(name: str) -> Pair:
    first, _, second = name.partition("-")
    return first, second
