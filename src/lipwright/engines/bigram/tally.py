"""Counting the pairs of lines, one line at a time; nothing of a line is kept.

Pairs are those that the engine would place: phones reduced to the set's classes, gaps
filled with silence, silence at both ends of a line (DESIGN section 4).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from lipwright.engines.bigram.classes import reduction_for
from lipwright.engines.bigram.model import BigramSet, Pair
from lipwright.engines.bigram.polyline import Floats, Ints
from lipwright.engines.bigram.preparation import Row, Spans, prepare
from lipwright.errors import LabelError
from lipwright.phones import SILENCE, PhoneTrack, load_phone_set
from lipwright.speech import Speech
from lipwright.timeline import Tier

Unit = Literal["count", "time"]


@dataclass(frozen=True, slots=True)
class Nearest:
    """A phone that no class of the set is exact for.

    Attributes
    ----------
    classes : str
        What stands in for it.
    share : float
        Of all phones of the lines, 0..1.
    """

    classes: str
    share: float


def has_curve(of: BigramSet, label: str) -> bool:
    """Whether a class can be made from a single-phone curve; silence needs none."""
    return label == SILENCE or label in of.singles


@dataclass(slots=True)
class Tally:
    """What has been counted so far.

    Parameters
    ----------
    of, reduction, within_words, silence, by
        See :func:`~lipwright.engines.bigram.coverage.coverage`.
    """

    of: BigramSet
    reduction: str | None = None
    within_words: bool = False
    silence: bool = True
    by: Unit = "count"
    amounts: dict[Pair, float] = field(default_factory=dict)
    nearest: dict[Pair, float] = field(default_factory=dict)
    words: dict[Pair, str] = field(default_factory=dict)
    lines: int = 0
    phones: int = 0
    _heard: Counter[tuple[str, str]] = field(default_factory=Counter)

    def add(self, line: PhoneTrack | Speech) -> None:
        """Count the pairs of a line.

        Raises
        ------
        LabelError
            If a phone has no class, or words are asked for and the line has none.
        """
        track, words = (line.phones, line.words) if isinstance(line, Speech) else (line, Tier())
        labels = [label for label in track.tier.labels if label != SILENCE]
        if self.within_words and labels and not len(words):
            raise LabelError("has phones but no words", cure="count across words")
        rows, report = reduction_for(self.of, track.phone_set, self.reduction).rows(track)
        self._check(rows)
        settings = self.of.rules.settings
        spans = prepare(rows, settings.padding, settings.silence_reach)
        self.lines += 1
        self.phones += len(labels)
        self._heard.update((n, report.stand_ins[n]) for n in labels if n in report.stand_ins)
        if spans.labels:
            self._count(spans, words, _inexact(spans, track, set(report.stand_ins)))

    def _check(self, rows: Sequence[Row]) -> None:
        classes = load_phone_set(self.of.phone_set).labels
        unknown = dict.fromkeys(label for label, _, _ in rows if label not in classes)
        if unknown:
            raise LabelError(
                f"{', '.join(map(repr, unknown))}: not classes of the set {self.of.name!r}",
                expected=f"labels among {' '.join(classes)}",
                cure="correct the reduction file",
            )

    def _count(self, spans: Spans, words: Tier, inexact: list[bool]) -> None:
        lengths = 0.5 * (spans.last - spans.first)
        inside = _places(words, spans).tolist()
        for index, pair in enumerate(spans.pairs):
            one, other = inside[index], inside[index + 1]
            if self.within_words and (one < 0 or one != other):
                continue
            if not self.silence and SILENCE in pair:
                continue
            amount = float(lengths[index]) if self.by == "time" else 1
            self.amounts[pair] = self.amounts.get(pair, 0) + amount
            if inexact[index] or inexact[index + 1]:
                self.nearest[pair] = self.nearest.get(pair, 0) + amount
            self._show(pair, words, one, other)

    def _show(self, pair: Pair, words: Tier, one: int, other: int) -> None:
        """Keep a word for the pair: the shortest; one word is better than two neighbours."""
        places = dict.fromkeys(place for place in (one, other) if place >= 0)
        if not places:
            return
        text = " ".join(words[place].label for place in places)
        known = self.words.get(pair)
        if known is None or _clarity(text) < _clarity(known):
            self.words[pair] = text

    def most_needed(self, classes: tuple[str, ...]) -> dict[Pair, float]:
        """Return the pairs, most needed first; of equals the first in the phone set."""
        place = {label: index for index, label in enumerate(classes)}

        def rank(item: tuple[Pair, float]) -> tuple[float, int, int]:
            (first, second), amount = item
            return -amount, place[first], place[second]

        return dict(sorted(self.amounts.items(), key=rank))

    def nearest_phones(self) -> dict[str, Nearest]:
        """Return the phones that only a nearest class stands in for, most frequent first."""
        found = sorted(self._heard.items(), key=lambda item: (-item[1], item[0]))
        return {label: Nearest(to, count / self.phones) for (label, to), count in found}


def _clarity(words: str) -> tuple[int, int]:
    return words.count(" "), len(words)


def _places(tier: Tier, spans: Spans) -> Ints:
    """Return which interval each phone's middle lies in; -1 for none, and for silence."""
    if not len(tier):
        return np.full(len(spans.labels), -1)
    starts = np.array([interval.start for interval in tier])
    ends = np.array([interval.end for interval in tier])
    middles: Floats = 0.5 * (spans.starts + spans.ends)
    found = np.searchsorted(starts, middles, side="right") - 1
    silent = np.array([label == SILENCE for label in spans.labels])
    return np.where((found >= 0) & (middles < ends[found]) & ~silent, found, -1)


def _inexact(spans: Spans, track: PhoneTrack, stand_ins: set[str]) -> list[bool]:
    """Return for each prepared phone whether its class is only the nearest one."""
    if not stand_ins:
        return [False] * len(spans.labels)
    labels = track.tier.labels
    return [
        place >= 0 and labels[place] in stand_ins for place in _places(track.tier, spans).tolist()
    ]
