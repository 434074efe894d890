"""Recorded motion told in the poses of a bigram set, so that any character can play it.

What the recorded channels do to the lips, the set's poses are asked to do (non-negative
least squares); what they do in silence is taken for rest. Poses that close belong to p, b,
m, f and v alone: each is reached where the lips are nearest anyway, and the other poses make
good what it changes. What no recording shows, the tongue, is the set's. The set's bounds
hold, and each pose gets the few keys that an animator edits.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.curves import reduced
from lipwright.phones import SILENCE

if TYPE_CHECKING:
    from lipwright.character.unmixing import Unmixing
    from lipwright.engines.bigram import BigramSet
    from lipwright.engines.motion.database import Database
    from lipwright.speech import Speech

Floats = NDArray[np.float64]

REACHED = 0.95
"""The weight that a closure's pose is brought to."""
WIDTH = 0.06
"""Seconds from the middle of a closure to where its pose is as it was."""
TOLERANCE = 0.02
"""By how much keys may be off, in weights."""
SILENT = 4000
"""Silent phones of a database that are looked at."""
LOOKED_AT = 40_000
"""Frames of it that say how far its shapes go."""


class Telling(Protocol):
    """How recorded channels are told in some poses."""

    @property
    def poses(self) -> tuple[str, ...]:
        """The poses that it gives; the others of a set stay at 0."""

    def weights(self, values: Floats, given: Floats) -> Floats:
        """Return weights (T, P) of channels (T, C), some of them given, (T, P), else NaN."""


@dataclass(frozen=True, slots=True, eq=False)
class ByShapes:
    """ARKit's shapes told in poses, by what both do to the lips of the built-in head.

    Parameters
    ----------
    way : Unmixing
    columns : list of int
        The channels that it takes.
    rest : (C,) float64
        The channels where nothing is said.
    gains : (len(columns),) float64
        What brings up shapes that a tracker scores far below what the face does.
    """

    way: Unmixing
    columns: list[int]
    rest: Floats
    gains: Floats

    @property
    def poses(self) -> tuple[str, ...]:
        """Those that can be seen on the lips."""
        return self.way.poses

    def weights(self, values: Floats, given: Floats) -> Floats:
        """Return the poses' weights."""
        return self.way.weights((values - self.rest)[:, self.columns] * self.gains, given)


@dataclass(frozen=True, slots=True, eq=False)
class AsPoses:
    """Channels that are poses already."""

    poses: tuple[str, ...]
    columns: list[int]

    def weights(self, values: Floats, given: Floats) -> Floats:
        """Return the poses' weights, at least as given."""
        own = np.clip(values[:, self.columns], 0.0, 1.0)
        return np.fmax(own, given)


def rest_of(database: Database) -> Floats:
    """Return a database's channels where nothing is said, (C,); zeros where that never is."""
    if SILENCE not in database.labels:
        return np.zeros(len(database.channels))
    label = database.labels.index(SILENCE)
    units = database.by_label[slice(*database.label_first[label : label + 2].tolist())]
    middle = (database.first[units] + database.last[units] - 1) // 2
    some = middle[:: max(1, len(middle) // SILENT)]
    return np.asarray(np.median(database.values[some], axis=0), np.float64)


@lru_cache(maxsize=4)
def by_shapes(database: Database, poses: tuple[str, ...]) -> ByShapes:
    """Return how a database's shapes are told; worked out once.

    Raises
    ------
    CharacterError
        If no channel, or no pose, moves the lips.
    """
    from lipwright.character.unmixing import evening, unmixing

    way = unmixing(database.channels, poses)
    columns = [database.channels.index(name) for name in way.channels]
    rest = rest_of(database)
    some = database.values[:: max(1, len(database.values) // LOOKED_AT)]
    return ByShapes(way, columns, rest, evening(some[:, columns] - rest[columns]))


def in_poses(animation: Animation, speech: Speech, of: BigramSet, telling: Telling) -> Animation:
    """Return an animation in the poses of a set.

    Parameters
    ----------
    animation : Animation
        Of recorded channels.
    speech : Speech
        What is said.
    of : BigramSet
        Whose poses, closures and bounds are kept, and whose curves are taken for poses that
        no recording shows: the tongue's.
    telling : Telling

    Returns
    -------
    Animation
        With keys: every sample lies within 0.02 of their curves.
    """
    from lipwright.engines.bigram import BigramEngine

    names = of.rules.names
    own = [names.index(pose) for pose in telling.poses]
    closing = [names.index(pose) for pose in dict.fromkeys(of.reach.values())]
    drawn = BigramEngine(of).animate(speech, animation.rate).at(animation.times)
    motion = np.asarray(animation.values, np.float64)
    given = np.full((len(animation), len(names)), np.nan)
    given[:, closing] = 0.0
    values = drawn.copy()
    values[:, own] = telling.weights(motion, given[:, own])
    given[:, closing], raised = _closures(values, animation, of, closing)
    values[:, own] = telling.weights(motion, given[:, own])
    _bound(values, of)
    keys = {
        name: reduced(animation.times, column, TOLERANCE)
        for name, column in zip(names, values.T, strict=True)
        if column.any()
    }
    report = {
        **animation.report,
        "told_in_poses_of": of.name,
        "poses_of_the_set": [pose for pose in names if pose not in telling.poses],
        "closures": raised,
    }
    return replace(
        animation, controls=names, values=values.astype(np.float32), keys=keys, report=report
    )


def _bound(values: Floats, of: BigramSet) -> None:
    """Keep poses within what those of higher priority leave them, as the set's ramps do."""
    names = of.rules.names
    for high, low, threshold in of.rules.bounds():
        if threshold <= 1.0:
            room = np.maximum(0.0, 1.0 - values[:, names.index(high.name)] / threshold)
            under = names.index(low.name)
            values[:, under] = np.minimum(values[:, under], room)


def _closures(
    values: Floats, animation: Animation, of: BigramSet, closing: Sequence[int]
) -> tuple[Floats, int]:
    """Return how far each closing pose goes, (T, len(closing)), and how many phones ask it."""
    from lipwright.engines.bigram.classes import reduction_for

    phones = animation.phones
    rows, _ = reduction_for(of, phones.phone_set).rows(phones)
    found, count = np.zeros((len(values), len(closing))), 0
    for label, start, end in rows:
        pose = of.reach.get(label)
        if pose is None:
            continue
        column = of.rules.names.index(pose)
        inside = _inside(start - animation.start, end - animation.start, animation)
        # Where the lips are nearest: most of the closure's own pose, least of what opens.
        apart = values[inside].sum(axis=1) - 2 * values[inside, column]
        middle = inside.start + int(apart.argmin())
        away = np.abs(animation.times - animation.times[middle]) / WIDTH
        own = found[:, closing.index(column)]
        np.maximum(own, REACHED * (0.5 + 0.5 * np.cos(np.pi * np.minimum(away, 1.0))), out=own)
        count += 1
    return found, count


def _inside(start: float, end: float, animation: Animation) -> slice:
    """Frames within a phone, or the nearest."""
    rate, count = animation.rate, len(animation)
    low, high = (math.ceil(instant * rate - 1e-9) for instant in (start, end))
    low, high = max(low, 0), min(high, count)
    if low < high:
        return slice(low, high)
    nearest = min(max(round(0.5 * (start + end) * rate), 0), count - 1)
    return slice(nearest, nearest + 1)
