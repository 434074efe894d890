"""Lines that were recorded and left out: what is wanted of a search, and what was true."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.database import Database
from lipwright.engines.motion.graph import Graph
from lipwright.engines.motion.joining import join
from lipwright.engines.motion.learnt import Known
from lipwright.engines.motion.rasta_plp import Features
from lipwright.engines.motion.search import (
    Costs,
    Search,
    find_several,
    label_indices,
    several,
    wanted_sound,
)
from lipwright.engines.motion.splicing import PairTable
from lipwright.phones import load_reduction

Floats = NDArray[np.float64]
Units = NDArray[np.int64]
Finding = Callable[["Base", "Line"], Callable[[], "Found"]]
"""Makes ready what a search is given, and returns the search."""


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """Units for a line, (N,), or several paths of them, (M, N).

    Parameters
    ----------
    units : (N,) or (M, N) int
    jumps : int
        Of the first path.
    complete : bool
        Whether the search came to its end in its time.
    """

    units: Units
    jumps: int
    complete: bool = True


@dataclass(frozen=True, slots=True, eq=False)
class Base:
    """A database with what its engine keeps at hand."""

    database: Database
    graph: Graph
    pairs: PairTable
    known: Known


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """Phones that were recorded one after the other.

    Parameters
    ----------
    labels : tuple of str
    spans : (N, 2) float64
        Seconds.
    heard : Features
    true : (T, C) float32
        The motion at the database's own rate.
    """

    labels: tuple[str, ...]
    spans: Floats
    heard: Features
    true: NDArray[np.float32]


def line(left_out: Database, first: int, count: int) -> Line:
    """Return some units of takes left out, as a line; takes follow one another.

    Parameters
    ----------
    left_out : Database
        Of the takes left out.
    first, count : int
        The first unit, and how many.
    """
    spans = np.asarray(left_out.spans[first : first + count], np.float64).copy()
    low, high = int(np.floor(spans[0, 0])), int(np.ceil(spans[-1, 1]))
    spans[0, 0], spans[-1, 1] = low, high
    spans[1:, 0] = spans[:-1, 1]
    rate = left_out.rate
    return Line(
        tuple(left_out.labels[label] for label in left_out.label[first : first + count]),
        (spans - low) / rate,
        Features(np.asarray(left_out.features[low:high]), rate),
        np.asarray(left_out.values[low:high]),
    )


def alike(search: Search, count: int) -> Finding:
    """Return what finds so many paths of equal merit by a search, for their mean."""

    def ready(base: Base, said: Line) -> Callable[[], Found]:
        _, sound = _wanted(base.database, said)
        costs = Costs(base.graph, sound)

        def find() -> Found:
            paths = find_several(search, base.graph, said.labels, costs, count=count)
            units = np.stack([path.units for path in paths])
            return Found(units, paths[0].jumps, paths[0].complete)

        return find

    return ready


def one_path(search: Search) -> Finding:
    """Return what finds a single path by one of the publication's searches, or ours."""

    def ready(base: Base, said: Line) -> Callable[[], Found]:
        wanted, sound = _wanted(base.database, said)
        costs = Costs(base.graph, sound)

        def find() -> Found:
            path = search(base.graph, wanted, costs)
            return Found(path.units, path.jumps, path.complete)

        return find

    return ready


def by_cost(paths: int) -> Finding:
    """Return what finds so many paths by their cost alone."""

    def ready(base: Base, said: Line) -> Callable[[], Found]:
        wanted, sound = _wanted(base.database, said)
        classes, lengths = _classes(base.database), np.diff(said.spans)[:, 0]

        def find() -> Found:
            units = several(base.database, wanted, lengths, classes, sound, paths)
            first, take = units[0], base.database.take
            follows = (first[1:] == first[:-1] + 1) & (take[first[1:]] == take[first[:-1]])
            return Found(units, int((~follows).sum()))

        return find

    return ready


def _wanted(database: Database, said: Line) -> tuple[Units, NDArray[np.float32]]:
    wanted, _ = label_indices(database, said.labels)
    return wanted, wanted_sound(database, said.heard.values, said.heard.rate, 0.0, said.spans)


def _classes(database: Database) -> Units:
    reduction = load_reduction(database.phone_set)
    names = [reduction.of(label)[0][0].label for label in database.labels]
    return np.array([names.index(name) for name in names], np.int64)


@dataclass(frozen=True, slots=True)
class Result:
    """What a search is worth on a line.

    Parameters
    ----------
    seconds : float
        Of the search alone.
    jumps : int
    rms : float
        Root of the mean square distance of the joined motion from the recorded one, over
        the recordings' deviation from their mean face: 1 is that face held still.
    """

    seconds: float
    jumps: int
    rms: float
    complete: bool = True


def tried(base: Base, said: Line, find: Finding, runs: int = 1) -> Result:
    """Search, join, and hold the motion against what was recorded.

    Parameters
    ----------
    base : Base
    said : Line
    find : function
    runs : int
        The search is run as often; the median is taken.
    """
    search, times = find(base, said), []
    for _ in range(runs):
        begun = time.perf_counter()
        found = search()
        times.append(time.perf_counter() - begun)
    made = motion(base, said, found.units)
    count = min(len(made), len(said.true))
    away = made[:count] - said.true[:count]
    rms = float(np.sqrt((away**2).sum(axis=1).mean())) / base.database.deviation
    return Result(float(np.median(times)), found.jumps, rms, found.complete)


def motion(base: Base, said: Line, units: Units) -> NDArray[np.float32]:
    """Return the motion of paths, joined as the engine joins them, at the database's rate."""
    return join(
        base.database,
        units,
        said.spans,
        base.database.rate,
        learnt=base.known.learnt,
        features=said.heard,
        opening=base.known.opening,
        phones=said.labels,
        pairs=base.pairs,
    ).motion
