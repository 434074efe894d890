"""Takes as the bigram engine sees them: which keys make the curve at every instant.

A curve of a pair has three levels between two zeros: in the middle of the first phone, at
the boundary, in the middle of the second. On a fine clock each instant lies in one bigram
of even number and one of odd number (stage 2 takes the larger); in each it is a mixture of
two neighbouring keys. Long takes are cut into stretches, so that memory stays small.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.bigram.classes import reduction_for
from lipwright.engines.bigram.engine import BigramEngine
from lipwright.engines.bigram.fit.takes import FaceTake
from lipwright.engines.bigram.model import BigramSet
from lipwright.engines.bigram.preparation import Spans, prepare
from lipwright.errors import LabelError
from lipwright.phones import SILENCE

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

LEVELS = 3
PLACES = np.array([0.0, 0.25, 0.5, 0.75, 1.0])
"""Of the keys, where the boundary is at 0.5."""
FRAMES = 50
"""Of a stretch, at most."""
FINE = 100.0
"""Instants per second, at least."""
REACH = 0.16
"""The widest softening, seconds."""


@dataclass(frozen=True, slots=True)
class Clock:
    """The fine clock of takes of one rate.

    Parameters
    ----------
    rate : float
        Frames per second of the takes.
    """

    rate: float

    @property
    def steps(self) -> int:
        """Instants per frame."""
        return int(np.ceil(FINE / self.rate - 1e-9))

    @property
    def margin(self) -> int:
        """Instants before the first frame and after the last."""
        return int(np.ceil(REACH * self.rate * self.steps))

    def times(self, take: FaceTake) -> Floats:
        """All instants of a take, seconds."""
        count = (len(take.values) - 1) * self.steps + 1 + 2 * self.margin
        fine = self.rate * self.steps
        return take.start + 0.5 / self.rate + (np.arange(count) - self.margin) / fine

    def soften(self, values: Floats, half: float) -> Floats:
        """Return what stage 6 makes of a curve, at the frames.

        Parameters
        ----------
        values : (S, ...) float64
            At all instants of some frames, margins included.
        half : float
            Half-width of the triangle, seconds.
        """
        last = len(values) - 2 * self.margin
        reach = int(np.ceil(half * self.rate * self.steps)) - 1
        weights = 1 - np.abs(np.arange(-reach, reach + 1)) / (half * self.rate * self.steps)
        found = np.zeros((-(-last // self.steps), *values.shape[1:]))
        # Sums of strided rows: a product of small matrices starts threads that cost more.
        for first, weight in enumerate(weights / weights.sum(), self.margin - reach):
            found += weight * values[first : first + last : self.steps]
        return found


@dataclass(frozen=True, slots=True, eq=False)
class Stretch:
    """At most :data:`FRAMES` frames of a take.

    Parameters
    ----------
    clock : Clock
    keys : (K,) int
        The numbers of the levels that matter here, see :meth:`Pairs.key`.
    near : (2, S, 2) int
        For both lanes and each instant the two keys beside it, as places in ``keys``.
    share : (2, S, 2) float
        How much each of them counts; 0 for the zeros at a curve's ends.
    above : (A, S) float
        Weights of the poses that the takes do not show, as the base set has them.
    frames : (F, P) float
        The recorded weights.
    said : (F,) int
        The number of the word that is spoken, or of the pair where no words are known; -1
        for neither.
    """

    clock: Clock
    keys: Ints
    near: Ints
    share: Floats
    above: Floats
    frames: Floats
    said: Ints

    @property
    def held(self) -> Floats:
        """``above`` at the frames, (A, F)."""
        clock = self.clock
        return self.above[:, clock.margin :: clock.steps][:, : len(self.frames)]


@dataclass(frozen=True, slots=True)
class Pairs:
    """The pairs of a set's classes by number.

    Parameters
    ----------
    labels : tuple of str
        The classes, silence included.
    """

    labels: tuple[str, ...]

    def key(self, first: str, second: str) -> int:
        """The number of a pair's first level; the other two follow."""
        row, column = self.labels.index(first), self.labels.index(second)
        return LEVELS * (row * len(self.labels) + column)


def places(boundary: float) -> Floats:
    """Where the five keys lie in a bigram whose boundary is there."""
    return np.where(PLACES <= 0.5, 2 * PLACES * boundary, 1 - 2 * (1 - PLACES) * (1 - boundary))


def stretches(
    takes: Sequence[FaceTake], base: BigramSet, pairs: Pairs, above: Sequence[str]
) -> list[Stretch]:
    """Return takes in stretches.

    Parameters
    ----------
    takes : sequence of FaceTake
    base : BigramSet
        Whose classes and settings are used.
    pairs : Pairs
    above : sequence of str
        Poses whose curves stay the base's.

    Raises
    ------
    LabelError
        If phones have no class, or no length.
    """
    engine = BigramEngine(base)
    columns = [base.rules.names.index(pose) for pose in above]
    found: list[Stretch] = []
    words = sorted({word.label for take in takes for word in take.words} - {SILENCE, ""})
    numbers = {word: number for number, word in enumerate(words)}
    for take in takes:
        try:
            solved = engine.solve(take.phones)
            rows, _ = reduction_for(base, take.phones.phone_set).rows(take.phones)
        except LabelError as error:
            raise error.at(take.name) from None
        settings = base.rules.settings
        spans = prepare(rows, settings.padding, settings.silence_reach)
        clock = Clock(take.rate)
        times = clock.times(take)
        near, share = _lanes(spans, pairs, times)
        fine = clock.rate * clock.steps
        held = engine.sample(solved, float(times[0]), len(times), fine)[:, columns].T
        said = _words_said(take, numbers) if numbers else _pairs_said(take, spans, pairs)
        found += _cut(take, clock, near, share, held, said)
    return found


def _words_said(take: FaceTake, numbers: Mapping[str, int]) -> Ints:
    """Which word each frame shows; -1 for none."""
    said = np.full(len(take.values), -1, dtype=np.int64)
    for word in take.words:
        if word.label in numbers:
            here = (take.times >= word.start) & (take.times < word.end)
            said[here] = numbers[word.label]
    return said


def _pairs_said(take: FaceTake, spans: Spans, pairs: Pairs) -> Ints:
    """Which pair's boundary is the nearest at each frame; -1 where nothing is said."""
    keys = np.array([pairs.key(*pair) // LEVELS for pair in spans.pairs], dtype=np.int64)
    between = 0.5 * (spans.boundary[:-1] + spans.boundary[1:])
    said = keys[np.searchsorted(between, take.times)]
    within = (take.times >= spans.first[0]) & (take.times < spans.last[-1])
    return np.where(within, said, -1)


def _lanes(spans: Spans, pairs: Pairs, times: Floats) -> tuple[Ints, Floats]:
    """Keys beside each instant and their shares, for even and odd bigrams."""
    near = np.zeros((2, len(times), 2), dtype=np.int64)
    share = np.zeros((2, len(times), 2))
    edges = np.searchsorted(times, np.stack((spans.first, spans.last)))
    for number, (first, second) in enumerate(spans.pairs):
        here = slice(*edges[:, number])
        start, middle, end = spans.first[number], spans.boundary[number], spans.last[number]
        own = times[here]
        place = np.where(
            own <= middle,
            0.5 * (own - start) / (middle - start),
            1 - 0.5 * (end - own) / (end - middle),
        )
        left = np.clip(np.searchsorted(PLACES, place, side="right") - 1, 0, LEVELS)
        part = (place - PLACES[left]) / (PLACES[left + 1] - PLACES[left])
        beside = np.stack((left, left + 1), axis=1)
        inner = (beside > 0) & (beside <= LEVELS)
        lane = number & 1
        near[lane, here] = pairs.key(first, second) + np.clip(beside - 1, 0, LEVELS - 1)
        share[lane, here] = np.where(inner, np.stack((1 - part, part), axis=1), 0.0)
    return near, share


def _cut(
    take: FaceTake, clock: Clock, near: Ints, share: Floats, held: Floats, said: Ints
) -> list[Stretch]:
    found = []
    for first in range(0, len(take.values), FRAMES):
        frames = np.asarray(take.values[first : first + FRAMES], dtype=np.float64)
        low = first * clock.steps
        high = low + (len(frames) - 1) * clock.steps + 1 + 2 * clock.margin
        spoken = share[:, low:high] > 0
        keys, places = np.unique(near[:, low:high][spoken], return_inverse=True)
        local = np.zeros(spoken.shape, dtype=np.int64)
        local[spoken] = places
        if len(keys):
            here = slice(low, high)
            own = said[first : first + FRAMES]
            found.append(Stretch(clock, keys, local, share[:, here], held[:, here], frames, own))
    return found
