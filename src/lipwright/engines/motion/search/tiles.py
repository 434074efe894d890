"""The tiles of a line in the plain graph, and where in the database each may come from.

Greedy matching from the left gives the latest place where the k-th tile can end, from the
right the earliest. Between the latest start and the earliest end lies the tile's core,
which every path with the fewest jumps takes from one piece of a take; so the candidates
of a tile are the places where its core occurs, far fewer than units.

A core of one or two phones occurs very often in a large database. Of more than
``MOST`` places, not all are candidates: for each pair of borders that the tile can have,
of the places that fit them at most ``LOOKED_AT``, spread evenly over all, are compared by
sound, and the ``KEPT`` nearest are candidates; so is what greedy matching takes. The same
line gets the same candidates every time.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lipwright.engines.motion.graph import Nodes, UnitGraph
from lipwright.engines.motion.search.costs import Costs, Floats
from lipwright.engines.motion.search.greedy import longest_matches

MOST = 2048
LOOKED_AT = 1024
KEPT = 128


@dataclass(frozen=True, slots=True, eq=False)
class Tile:
    """A tile: which phones it may and must hold, and where those occur.

    Parameters
    ----------
    least, first, last, most : int
        ``first`` to ``last`` (exclusive) is its core, ``least`` to ``most`` what it can hold.
    units : (O,) int64
        The units of the core's first phone.
    leads, tails : tuple of (P,) int64
        ``leads[j]`` are the places in ``units`` of those that also match the j phones before
        the core, ``tails[j]`` of those that match the j phones after it.
    narrowed : bool
        Whether the core occurs elsewhere, too.
    """

    least: int
    first: int
    last: int
    most: int
    units: Nodes
    leads: tuple[Nodes, ...]
    tails: tuple[Nodes, ...]
    narrowed: bool


def tiles(graph: UnitGraph, labels: Sequence[int], costs: Costs) -> list[Tile]:
    """Return the tiles that a line falls into where jumps are fewest."""
    earliest, latest = bounds(graph, labels)
    edges = list(zip(earliest, latest, earliest[1:], latest[1:], strict=False))
    ranges = [graph.index.places(labels[first:last]) for _, first, last, _ in edges]
    many = [high - low > MOST for low, high in ranges]
    matched = longest_matches(graph, labels, costs) if any(many) else np.zeros(0, np.int64)
    found = []
    for edge, (low, high), narrowed in zip(edges, ranges, many, strict=True):
        if narrowed:
            own = np.append(_nearest(graph, labels, costs, *edge), matched[edge[1]])
            units = np.unique(own)
        else:
            units = graph.index.suffixes[low:high].astype(np.int64)
        found.append(_tile(graph, labels, edge, units, narrowed))
    return found


def bounds(graph: UnitGraph, labels: Sequence[int]) -> tuple[list[int], list[int]]:
    """Return the earliest and latest place of every tile border, where jumps are fewest."""
    reach: list[int] = []
    for start in range(len(labels)):
        if reach and reach[-1] == len(labels):
            reach.append(len(labels))
        else:
            reach.append(start + graph.index.longest(labels, start)[0])
    latest = [0]
    while latest[-1] < len(labels):
        latest.append(reach[latest[-1]])
    earliest = [len(labels)]
    for _ in latest[1:]:
        earliest.append(bisect_left(reach, earliest[-1]))
    return earliest[::-1], latest


def _nearest(
    graph: UnitGraph,
    labels: Sequence[int],
    costs: Costs,
    least: int,
    first: int,
    last: int,
    most: int,
) -> Nodes:
    """The units of a core's first phone that sound nearest, for each pair of borders."""
    chosen = []
    ends = most
    for begin in range(first, least - 1, -1):
        for end in range(last, ends + 1):
            low, high = graph.index.places(labels[begin:end])
            if low == high:
                ends = end - 1
                break
            count = min(high - low, LOOKED_AT)
            places = low + np.arange(count) * (high - low) // count
            units = graph.index.suffixes[places].astype(np.int64)
            if count > KEPT:
                away = run_sounds(costs, units, begin, end)
                units = units[np.argpartition(away, KEPT)[:KEPT]]
            chosen.append(units + (first - begin))
    return np.concatenate(chosen)


def run_sounds(costs: Costs, units: Nodes, begin: int, end: int) -> Floats:
    """How far each run of units sounds from some wanted phones, summed over the phones."""
    phones = np.arange(begin, end)
    every = units[:, None] + (phones - begin)
    away = costs.unit_sounds(np.tile(phones, len(units)), every.ravel())
    summed: Floats = away.reshape(every.shape).sum(axis=1)
    return summed


def _tile(
    graph: UnitGraph,
    labels: Sequence[int],
    edges: tuple[int, int, int, int],
    units: Nodes,
    narrowed: bool,
) -> Tile:
    least, first, last, most = edges
    label, take = graph.database.label, graph.database.take
    every = np.arange(len(units))

    def extended(by: int, places: Nodes, phone: int) -> Nodes:
        there = units[places] + by
        inside = (there >= 0) & (there < len(label))
        places, there = places[inside], there[inside]
        fits = (label[there] == labels[phone]) & (take[there] == take[units[places]])
        matching: Nodes = places[fits]
        return matching

    leads, tails = [every], [every]
    for phone in range(first - 1, least - 1, -1):
        leads.append(extended(phone - first, leads[-1], phone))
    for phone in range(last, most):
        tails.append(extended(phone - first, tails[-1], phone))
    return Tile(least, first, last, most, units, tuple(leads), tuple(tails), narrowed)
