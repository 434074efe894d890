"""A set flattened to arrays, so that placing a line's curves is a few numpy calls."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.bigram.model import Bigram, BigramSet, Pair
from lipwright.engines.bigram.polyline import Floats, Ints
from lipwright.engines.bigram.preparation import Spans
from lipwright.engines.bigram.stand_in import STAND_IN, stand_in


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """Keys of a line's bigrams, placed in time: stage 1.

    Parameters
    ----------
    bigram : (K,) int
        Which bigram of the line each key belongs to.
    pose : (K,) int
        Which pose, in the order of the stages.
    times, values : (K,) float64
        Seconds and weights.
    """

    bigram: Ints
    pose: NDArray[np.int16]
    times: Floats
    values: Floats


@dataclass(slots=True)
class Table:
    """The keys of every bigram that has been asked for, in flat arrays.

    A bigram enters when a line first needs it; stand-ins are built then.

    Parameters
    ----------
    of : BigramSet
    order : tuple of str
        The poses in the order of the stages.
    """

    of: BigramSet
    order: tuple[str, ...]
    index: dict[Pair, int] = field(default_factory=dict)
    bigrams: list[Bigram] = field(default_factory=list)
    _rows: list[np.ndarray] = field(default_factory=list)
    _flat: np.ndarray = field(default_factory=lambda: np.zeros((0, 4)))
    _first: Ints = field(default_factory=lambda: np.zeros(1, dtype=np.int64))

    def rows_of(self, pairs: list[Pair]) -> Ints:
        """Return each pair's number in the table, adding what is new."""
        known = self.index
        new = [pair for pair in dict.fromkeys(pairs) if pair not in known]
        for pair in new:
            bigram = self.of.bigrams.get(pair) or stand_in(self.of, pair)
            known[pair] = len(self.bigrams)
            self.bigrams.append(bigram)
            self._rows.append(self._keys(bigram))
        if new:
            self._gather()
        return np.array([known[pair] for pair in pairs], dtype=np.int64)

    def for_set(self, of: BigramSet, order: tuple[str, ...]) -> Table:
        """Return a table of another set that keeps the rows of bigrams that both share."""
        table = Table(of, order)
        if order != self.order:
            return table
        for pair, number in self.index.items():
            known = self.bigrams[number]
            same = known is of.bigrams.get(pair)
            if not same and pair not in of.bigrams:
                same = known.source == STAND_IN and of.singles is self.of.singles
            if same:
                table.index[pair] = len(table.bigrams)
                table.bigrams.append(known)
                table._rows.append(self._rows[number])
        table._gather()
        return table

    def _gather(self) -> None:
        if self._rows:
            self._flat = np.concatenate(self._rows)
            self._first = np.concatenate(([0], np.cumsum([len(rows) for rows in self._rows])))

    def _keys(self, bigram: Bigram) -> np.ndarray:
        """Rows of (pose, share of the first phone, share of the second, weight)."""
        rows = []
        for number, pose in enumerate(self.order):
            keys = bigram.curves.get(pose)
            if keys is None:
                continue
            times = keys.times
            if times[0] < bigram.boundary < times[-1] and bigram.boundary not in times:
                times = np.sort(np.append(times, bigram.boundary))
            rows.append(
                np.stack(
                    (
                        np.full(len(times), float(number)),
                        times,
                        np.full(len(times), bigram.boundary),
                        keys.at(times),
                    ),
                    axis=1,
                )
            )
        return np.concatenate(rows) if rows else np.zeros((0, 4))

    def place(self, spans: Spans, warp: str) -> Placed:
        """Return the keys of a line's bigrams in time.

        ``linear`` stretches each bigram as a whole (section 3.2.1); ``boundary`` pins its
        own boundary to that of the two phones.
        """
        numbers = self.rows_of(spans.pairs)
        counts = np.diff(self._first)[numbers]
        bigram = np.repeat(np.arange(len(numbers)), counts)
        offset = np.cumsum(counts) - counts
        rows = self._flat[np.repeat(self._first[numbers] - offset, counts) + np.arange(len(bigram))]
        pose, share, boundary, values = rows.T
        start, middle, end = spans.first[bigram], spans.boundary[bigram], spans.last[bigram]
        if warp == "linear":
            times = start + share * (end - start)
        else:
            times = np.where(
                share <= boundary,
                start + share / boundary * (middle - start),
                end - (1 - share) / (1 - boundary) * (end - middle),
            )
        return Placed(bigram, pose.astype(np.int16), times, values)
