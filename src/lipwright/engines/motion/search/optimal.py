"""The fewest jumps and, among those, the least sum of sound and joining distances.

The three criteria that the paper's exhaustive search wants (section 6), found exactly.
On the plain graph by dynamic programming over tiles: greedy matching from the left
gives the latest place where the k-th tile can end, from the right the earliest. Between
the latest start and the earliest end lies the tile's core, which every path with the
fewest jumps takes from one piece of a take; so the candidates of a tile are the places
where its core occurs, far fewer than units, and only seams within the slack are tried.

In a very large database a short string occurs so often that comparing each place of one
tile with each of the next would take minutes. Where a core occurs more than ``MOST`` times,
``MOST`` places spread evenly over the database are looked at, for each way to lengthen the
core, and the ``KEPT`` cheapest of these are joined. Jumps stay the fewest; the cost may be a
little above the least, and the path says that it is not complete.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.closures import evenly
from lipwright.engines.motion.graph import Graph, Nodes, UnitGraph
from lipwright.engines.motion.search.costs import Costs, Floats
from lipwright.engines.motion.search.layered import best_nodes
from lipwright.engines.motion.search.path import Path, path_of
from lipwright.engines.motion.search.steps import cheapest_jumps, checked

MOST = 1500
"""Places of a tile's core that are all compared."""
KEPT = 200
"""The cheapest of them that are joined, where there are more."""


def optimal(graph: Graph, wanted: NDArray[np.integer], costs: Costs) -> Path:
    """Search for the path with the fewest jumps and, among those, the least cost.

    Parameters
    ----------
    graph : Graph
    wanted : (N,) int
        Indices of labels.
    costs : Costs
    """
    labels = checked(graph, wanted)
    if isinstance(graph, UnitGraph) and labels:
        nodes, whole = _by_tiles(graph, labels, costs)
        return replace(path_of(graph, nodes, costs), complete=whole)
    return path_of(graph, best_nodes(graph, labels, costs), costs)


@dataclass(frozen=True, slots=True, eq=False)
class _Tile:
    """A tile: which phones it may and must hold, and where those occur.

    ``first`` to ``last`` (exclusive) is its core, ``least`` to ``most`` what it can hold.
    ``units`` are the units of the core's first phone, ``(O,)``. ``leads[j]`` are the places
    in ``units`` of those that also match the j phones before the core, ``tails[j]`` of
    those that match the j phones after it. ``whole``: whether all places are there.
    """

    least: int
    first: int
    last: int
    most: int
    units: Nodes
    leads: tuple[Nodes, ...]
    tails: tuple[Nodes, ...]
    whole: bool


@dataclass(frozen=True, slots=True, eq=False)
class _Reached:
    """Cheapest ways through a tile.

    ``cost`` (O,): with the core's own sound. ``begin`` (O,): the phone that the tile begins
    with. ``source`` (O,): place in the units of the tile before.
    """

    cost: Floats
    begin: Nodes
    source: Nodes


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


def _by_tiles(graph: UnitGraph, labels: Sequence[int], costs: Costs) -> tuple[Nodes, bool]:
    """Return the nodes, and whether all places of all tiles were compared."""
    earliest, latest = bounds(graph, labels)
    found = [
        _tile(graph, labels, costs, *edges)
        for edges in zip(earliest, latest, earliest[1:], latest[1:], strict=False)
    ]
    ways = [_through_first(found[0], costs)]
    for last, tile in pairwise(found):
        ways.append(_through(last, ways[-1], tile, costs))
    nodes = np.zeros(len(labels), np.int64)
    at, end = int(ways[-1].cost.argmin()), len(labels)
    for tile, way in zip(reversed(found), reversed(ways), strict=True):
        begin = int(way.begin[at])
        nodes[begin:end] = tile.units[at] + np.arange(begin - tile.first, end - tile.first)
        at, end = int(way.source[at]), begin
    return nodes, all(tile.whole for tile in found)


def _tile(
    graph: UnitGraph,
    labels: Sequence[int],
    costs: Costs,
    least: int,
    first: int,
    last: int,
    most: int,
) -> _Tile:
    every = graph.index.occurrences(labels[first:last])
    if len(every) <= MOST:
        return _with_ends(graph, labels, (least, first, last, most), every.astype(np.int64), True)
    some = [
        evenly(graph.index.occurrences(labels[begin:end]), MOST) + np.int64(first - begin)
        for begin, end in product(range(least, first + 1), range(last, most + 1))
    ]
    units = np.unique(np.concatenate(some))
    tile = _with_ends(graph, labels, (least, first, last, most), units, False)
    kept = _cheapest(tile, _core(tile, costs))
    return _with_ends(graph, labels, (least, first, last, most), units[kept], False)


def _cheapest(tile: _Tile, cost: Floats) -> Nodes:
    """The places that cost least, as many for each way in which a tile can be longer."""
    kept = []
    for lead, tail in product(tile.leads, tile.tails):
        both = np.intersect1d(lead, tail, assume_unique=True)
        order = np.argsort(cost[both], kind="stable")[:KEPT]
        kept.append(both[order])
    return np.unique(np.concatenate(kept))


def _with_ends(
    graph: UnitGraph,
    labels: Sequence[int],
    edges: tuple[int, int, int, int],
    units: Nodes,
    whole: bool,
) -> _Tile:
    """Return a tile with what its places hold before and after its core."""
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
    return _Tile(least, first, last, most, units, tuple(leads), tuple(tails), whole)


def _core(tile: _Tile, costs: Costs) -> Floats:
    """How far each occurrence of a core sounds from what is wanted."""
    phones = np.arange(tile.first, tile.last)
    units = tile.units[:, None] + (phones - tile.first)
    away = costs.unit_sounds(np.tile(phones, len(units)), units.ravel())
    summed: Floats = away.reshape(units.shape).sum(axis=1)
    return summed


def _through_first(tile: _Tile, costs: Costs) -> _Reached:
    zeros = np.zeros(len(tile.units), np.int64)
    return _Reached(_core(tile, costs), zeros, zeros)


def _through(last: _Tile, way: _Reached, tile: _Tile, costs: Costs) -> _Reached:
    """Cheapest ways through a tile, over all seams with the one before it."""
    exits = _exits(last, way, costs)
    best = np.full(len(tile.units), np.inf)
    begin = np.zeros(len(tile.units), np.int64)
    source = np.zeros(len(tile.units), np.int64)
    lead = np.zeros(len(tile.units))
    for back, places in enumerate(tile.leads):
        border = tile.first - back
        if back:
            lead[places] += costs.sound(border, tile.units[places] - back)
        leaving, so_far = exits[border - last.last]
        if not len(places) or not len(leaving):
            continue
        value, which = cheapest_jumps(
            costs,
            last.units[leaving] + (border - 1 - last.first),
            so_far,
            tile.units[places] - back,
        )
        value += lead[places]
        better = value < best[places]
        chosen = places[better]
        best[chosen], begin[chosen] = value[better], border
        source[chosen] = leaving[which[better]]
    return _Reached(best + _core(tile, costs), begin, source)


def _exits(tile: _Tile, way: _Reached, costs: Costs) -> list[tuple[Nodes, Floats]]:
    """For each place where a tile can end: the occurrences that reach it, and their costs."""
    cost = way.cost.copy()
    exits = []
    for on, places in enumerate(tile.tails):
        if on:
            phone = tile.last + on - 1
            cost[places] += costs.sound(phone, tile.units[places] + (phone - tile.first))
        exits.append((places, cost[places]))
    return exits
