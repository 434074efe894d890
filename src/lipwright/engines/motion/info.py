"""What a database holds: how much of each phone, of pairs and of threes, and what is thin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.database import Database
from lipwright.phones import SILENCE, load_phone_set

THIN = 10
"""A phone with fewer units than this is thin."""
_SPARE = ("ax",)
"""Labels that most dictionaries do without: a database does not lack them."""


@dataclass(frozen=True, slots=True)
class Coverage:
    """How many different strings of phones of some length occur.

    Parameters
    ----------
    different : int
        How many occur at least once.
    once : int
        How many occur only once.
    possible : int
        How many the phones that occur could form, silence next to silence apart.
    """

    different: int
    once: int
    possible: int

    @property
    def share(self) -> float:
        """Those that occur, of those that are possible, 0..1."""
        return self.different / self.possible if self.possible else 0.0


@dataclass(frozen=True, slots=True)
class Info:
    """What a database holds.

    Parameters
    ----------
    takes, frames, units, nodes : int
        ``nodes``: of the graph, fewer than units where they are merged.
    minutes : float
        Of motion.
    takes_with_sound : int
    units_per_phone : dict of str to int
        The most frequent first.
    thin : tuple of str
        Phones with few units.
    bigrams, trigrams : Coverage
    variance : tuple of float
        Share of the motion's variance of each component.
    """

    takes: int
    takes_with_sound: int
    minutes: float
    frames: int
    units: int
    nodes: int
    units_per_phone: dict[str, int]
    thin: tuple[str, ...]
    bigrams: Coverage
    trigrams: Coverage
    variance: tuple[float, ...]


def info(database: Database) -> Info:
    """Count what a database holds."""
    counts = np.diff(database.label_first)
    order = np.argsort(-counts, kind="stable")
    per_phone = {database.labels[index]: int(counts[index]) for index in order}
    total = database.total_variance
    merged = database.merged
    return Info(
        takes=len(database.take_start),
        takes_with_sound=int(database.take_has_sound.sum()),
        minutes=len(database.frames) / database.rate / 60.0,
        frames=len(database.frames),
        units=len(database.label),
        nodes=len(database.label if merged is None else merged.representative),
        units_per_phone=per_phone,
        thin=tuple(label for label, count in per_phone.items() if count < THIN),
        bigrams=_coverage(database, 2),
        trigrams=_coverage(database, 3),
        variance=tuple(float(one / total) if total else 0.0 for one in database.variance),
    )


def lacking(database: Database) -> tuple[str, ...]:
    """Return the phones of the database's notation that no unit has, in the notation's order."""
    there = {*database.labels, *_SPARE}
    known = load_phone_set(database.phone_set).labels
    return tuple(label for label in known if label not in there)


def pair_counts(database: Database) -> NDArray[np.int64]:
    """Return how often each label comes before each other in a take, (L, L) int64."""
    labels = len(database.labels)
    whole = database.take[1:] == database.take[:-1]
    first, second = database.label[:-1][whole], database.label[1:][whole]
    key = first.astype(np.int64) * labels + second
    return np.bincount(key, minlength=labels * labels).reshape(labels, labels)


def _coverage(database: Database, length: int) -> Coverage:
    labels = len(database.labels)
    number = max(len(database.label) - length + 1, 0)
    key: NDArray[np.int64] = np.zeros(number, np.int64)
    for depth in range(length):
        key = key * labels + database.label[depth : depth + number]
    whole = database.take[length - 1 :][:number] == database.take[:number]
    counts = np.unique(key[whole], return_counts=True)[1]
    silent = SILENCE in database.labels
    # Walks of this length over all pairs but silence with silence.
    walks = np.ones(labels, np.int64)
    for _ in range(length - 1):
        after_silence = walks.sum() - walks[database.labels.index(SILENCE)] if silent else 0
        walks = np.full(labels, walks.sum())
        if silent:
            walks[database.labels.index(SILENCE)] = after_silence
    return Coverage(len(counts), int((counts == 1).sum()), int(walks.sum()))
