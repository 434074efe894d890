"""Which pairs lines or a text need, and which to draw first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from itertools import pairwise
from typing import TYPE_CHECKING

from lipwright.engines.bigram.coverage import Coverage, Need, coverage
from lipwright.engines.bigram.model import BigramSet, Pair
from lipwright.errors import LabelError, TextError
from lipwright.phones import SILENCE, PhoneTrack
from lipwright.speech import Speech
from lipwright.studio.changes import LineData
from lipwright.studio.lines import tier_of
from lipwright.studio.messages import (
    Cell,
    CoverageRequest,
    CoverageView,
    EditedPair,
    NeedView,
)

if TYPE_CHECKING:
    from lipwright.studio.session import Session

SHOWN = 500
Outline = tuple[str, tuple[str, ...], tuple[float, ...], tuple[float, ...]]


def lines_of_session(session: Session) -> list[Speech]:
    """Return the open lines, as far as they are counted: without their sounds."""
    return [
        Speech(PhoneTrack(tier_of(line.phones), line.phone_set), tier_of(line.words))
        for line in session.state.lines.values()
        if line.phones
    ]


class Needs:
    """Which pairs the open lines need, kept up to date line by line."""

    def __init__(self) -> None:
        self._counts: dict[str, tuple[LineData, Outline, Counter[Pair]]] = {}
        self._lines: tuple[int, ...] = ()
        self._shares: dict[Pair, float] = {}

    def shares(self, of: BigramSet, lines: Mapping[str, LineData]) -> Mapping[Pair, float]:
        """Return each pair's share, 0..1, of the pairs of all lines."""
        places = tuple(map(id, lines.values()))
        if places != self._lines:
            self._counts = {name: self._counted(of, line) for name, line in lines.items()}
            self._lines = places
            counts = (count for _, _, count in self._counts.values())
            total: Counter[Pair] = sum(counts, Counter())
            whole = total.total() or 1
            self._shares = {pair: amount / whole for pair, amount in total.items()}
        return self._shares

    def _counted(self, of: BigramSet, line: LineData) -> tuple[LineData, Outline, Counter[Pair]]:
        """Count a line, unless only edges between its phones have moved since."""
        known = self._counts.get(line.id)
        if known is not None and known[0] is line:
            return known
        outline = _outline(line)
        same = known is not None and known[1] == outline
        return line, outline, known[2] if known is not None and same else _count(of, line)


def _outline(line: LineData) -> Outline:
    """Return what the pairs of a line depend on: its phones, and where and how long none is."""
    labels = tuple(label for label, _, _ in line.phones)
    silences = (end - start for label, start, end in line.phones if label == SILENCE)
    gaps = (later[1] - former[2] for former, later in pairwise(line.phones) if later[1] > former[2])
    return line.phone_set, labels, tuple(silences), tuple(gaps)


def _count(of: BigramSet, line: LineData) -> Counter[Pair]:
    track = PhoneTrack(tier_of(line.phones), line.phone_set)
    try:
        return Counter({pair: int(n) for pair, n in coverage(of, [track]).needed.items()})
    except LabelError:
        return Counter()


def spoken(
    of: BigramSet, request: CoverageRequest, lines: list[Speech], told: Callable[[float], None]
) -> Coverage:
    """Return the coverage of what was asked for."""
    from lipwright import pipeline

    if request.every:
        return coverage(of)
    if not request.text:
        return coverage(of, lines)
    rows = [row for row in request.text.splitlines() if row.strip()]
    if not rows:
        raise TextError("no words", expected="a text")

    def each() -> Iterable[Speech]:
        for number, row in enumerate(rows):
            yield pipeline.say(row)
            told((number + 1) / len(rows))

    return coverage(of, each())


def coverage_view(
    found: Coverage,
    request: CoverageRequest,
    edits: tuple[Counter[Pair], Counter[Pair]],
    cells: Mapping[Pair, Cell],
) -> CoverageView:
    """Return coverage as the page takes it."""
    needed = tuple(_view(need, need.cumulative) for need in found.needs()[:SHOWN])
    missing = tuple(_view(step.need, step.covered) for step in found.order()[:SHOWN])
    source = "every pair" if request.every else "the text" if request.text else "the open lines"
    edited = tuple(
        EditedPair(pair, count, edits[1][pair]) for pair, count in edits[0].most_common(SHOWN)
    )
    return CoverageView(
        source=source,
        share=found.share,
        lines=found.lines,
        needed=needed,
        missing=missing,
        edited=edited,
        notes=found.notes,
        cells=tuple(cells.values()),
    )


def _view(need: Need, covered: float) -> NeedView:
    return NeedView(need.pair, need.amount, need.share, need.state, need.word, covered)
