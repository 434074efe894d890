"""Labelled stretches of time: intervals and tiers, in seconds, half-open.

One type serves words, phones and silences alike. Nothing here knows what a label
means; :mod:`lipwright.phones` does.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from lipwright.errors import LabelError


@dataclass(frozen=True, slots=True)
class Interval:
    """A label from ``start`` up to, but without, ``end``.

    Parameters
    ----------
    label : str
        What is there: a word, a phone, ``sil``.
    start, end : float
        Seconds; ``start`` < ``end``.
    confidence : float or None
        How sure the source is, 0..1; None where it does not say.

    Raises
    ------
    LabelError
        If a time is not finite, or the interval is empty or reversed.
    """

    label: str
    start: float
    end: float
    confidence: float | None = None

    def __post_init__(self) -> None:
        if not (math.isfinite(self.start) and math.isfinite(self.end)):
            raise LabelError(
                f"{self.label!r} runs from {self.start} to {self.end} s", expected="finite times"
            )
        if self.end <= self.start:
            raise LabelError(
                f"{self.label!r} runs from {self.start:.6g} to {self.end:.6g} s",
                expected="an end after its start",
            )

    @property
    def duration(self) -> float:
        """Length in seconds."""
        return self.end - self.start

    @property
    def middle(self) -> float:
        """The instant half-way, in seconds."""
        return 0.5 * (self.start + self.end)

    def __contains__(self, time: float) -> bool:
        return self.start <= time < self.end

    def shifted(self, by: float) -> Interval:
        """Return the interval moved by ``by`` seconds."""
        return replace(self, start=self.start + by, end=self.end + by)


@dataclass(frozen=True, slots=True)
class Tier:
    """Intervals in order of time, without overlaps; gaps are allowed.

    Raises
    ------
    LabelError
        If two neighbours are out of order or overlap: it names both.

    Examples
    --------
    >>> tier = Tier.of(("hello", 0.0, 0.4), ("there", 0.4, 0.9))
    >>> tier.at(0.4).label
    'there'
    >>> tier.end
    0.9
    """

    intervals: tuple[Interval, ...] = ()

    def __post_init__(self) -> None:
        for index, (a, b) in enumerate(zip(self.intervals, self.intervals[1:], strict=False)):
            if b.start < a.end:
                kind = "starts before" if b.start < a.start else "overlaps"
                raise LabelError(
                    f"{b.label!r} at {b.start:.6g} s {kind} {a.label!r}"
                    f" ({a.start:.6g} to {a.end:.6g} s)",
                    where=f"interval {index + 2}",
                    expected="intervals in order, without overlap",
                )

    @classmethod
    def of(cls, *triples: tuple[str, float, float]) -> Tier:
        """Build a tier from ``(label, start, end)`` triples."""
        return cls(tuple(Interval(label, start, end) for label, start, end in triples))

    @classmethod
    def from_iterable(cls, intervals: Iterable[Interval]) -> Tier:
        """Build a tier from intervals in order."""
        return cls(tuple(intervals))

    def __iter__(self) -> Iterator[Interval]:
        return iter(self.intervals)

    def __len__(self) -> int:
        return len(self.intervals)

    def __getitem__(self, index: int) -> Interval:
        return self.intervals[index]

    @property
    def start(self) -> float:
        """Start of the first interval in seconds; 0 if there is none."""
        return self.intervals[0].start if self.intervals else 0.0

    @property
    def end(self) -> float:
        """End of the last interval in seconds; 0 if there is none."""
        return self.intervals[-1].end if self.intervals else 0.0

    @property
    def labels(self) -> tuple[str, ...]:
        """The labels in order."""
        return tuple(interval.label for interval in self.intervals)

    def index_at(self, time: float) -> int | None:
        """Return the index of the interval that holds ``time``, or None in a gap."""
        index = bisect_right(self.intervals, time, key=lambda interval: interval.start) - 1
        return index if index >= 0 and time in self.intervals[index] else None

    def at(self, time: float) -> Interval | None:
        """Return the interval that holds ``time`` (seconds), or None in a gap."""
        index = self.index_at(time)
        return None if index is None else self.intervals[index]

    def shifted(self, by: float) -> Tier:
        """Return the tier moved by ``by`` seconds."""
        return Tier(tuple(interval.shifted(by) for interval in self.intervals))

    def within(self, start: float, end: float) -> Tier:
        """Return the intervals that touch ``start``..``end``, whole."""
        return Tier(tuple(i for i in self.intervals if i.end > start and i.start < end))
