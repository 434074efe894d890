"""The fewest jumps and, among those, the least sum of sound and joining distances.

The three criteria that the paper's exhaustive search wants (section 6), found exactly.
On the plain graph by dynamic programming over tiles (see
:mod:`~lipwright.engines.motion.search.tiles`): the candidates of a tile are the places
where its core occurs, far fewer than units, and only seams within the slack are tried.
Where a core occurs more often than can be compared in milliseconds, only the nearest in
sound are candidates: jumps are still the fewest, and the cost is no more than greedy
matching's, but another path may cost a little less. The path says that it is not complete.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.graph import Graph, Nodes, UnitGraph
from lipwright.engines.motion.search.costs import Costs, Floats
from lipwright.engines.motion.search.layered import best_nodes
from lipwright.engines.motion.search.path import Path, path_of
from lipwright.engines.motion.search.steps import cheapest_jumps, checked
from lipwright.engines.motion.search.tiles import Tile, run_sounds, tiles


def optimal(graph: Graph, wanted: NDArray[np.integer], costs: Costs) -> Path:
    """Search for the path with the fewest jumps and, among those, the least cost.

    Parameters
    ----------
    graph : Graph
    wanted : (N,) int
        Indices of labels.
    costs : Costs

    Returns
    -------
    Path
        Exact where it is complete.
    """
    labels = checked(graph, wanted)
    if isinstance(graph, UnitGraph) and labels:
        nodes, whole = _by_tiles(graph, labels, costs)
        return replace(path_of(graph, nodes, costs), complete=whole)
    return path_of(graph, best_nodes(graph, labels, costs), costs)


@dataclass(frozen=True, slots=True, eq=False)
class _Reached:
    """Cheapest ways through a tile.

    ``cost`` (O,): with the core's own sound. ``begin`` (O,): the phone that the tile begins
    with. ``source`` (O,): place in the units of the tile before.
    """

    cost: Floats
    begin: Nodes
    source: Nodes


def _by_tiles(graph: UnitGraph, labels: Sequence[int], costs: Costs) -> tuple[Nodes, bool]:
    """Return the nodes, and whether all places of all tiles were compared."""
    found = tiles(graph, labels, costs)
    ways = [_through_first(found[0], costs)]
    for last, tile in pairwise(found):
        ways.append(_through(last, ways[-1], tile, costs))
    nodes = np.zeros(len(labels), np.int64)
    at, end = int(ways[-1].cost.argmin()), len(labels)
    for tile, way in zip(reversed(found), reversed(ways), strict=True):
        begin = int(way.begin[at])
        nodes[begin:end] = tile.units[at] + np.arange(begin - tile.first, end - tile.first)
        at, end = int(way.source[at]), begin
    return nodes, not any(tile.narrowed for tile in found)


def _through_first(tile: Tile, costs: Costs) -> _Reached:
    zeros = np.zeros(len(tile.units), np.int64)
    return _Reached(run_sounds(costs, tile.units, tile.first, tile.last), zeros, zeros)


def _through(last: Tile, way: _Reached, tile: Tile, costs: Costs) -> _Reached:
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
    return _Reached(best + run_sounds(costs, tile.units, tile.first, tile.last), begin, source)


def _exits(tile: Tile, way: _Reached, costs: Costs) -> list[tuple[Nodes, Floats]]:
    """For each place where a tile can end: the occurrences that reach it, and their costs."""
    cost = way.cost.copy()
    exits = []
    for on, places in enumerate(tile.tails):
        if on:
            phone = tile.last + on - 1
            cost[places] += costs.sound(phone, tile.units[places] + (phone - tile.first))
        exits.append((places, cost[places]))
    return exits
