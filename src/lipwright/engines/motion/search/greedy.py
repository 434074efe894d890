"""The publication's Algorithm 2: the longest match, again and again (section 6.2).

It finds the fewest jumps (Theorem 1). Of longest matches that tie, the one that sounds
nearest is taken. In the plain graph they are found by the label index; at most 64 that
tie are compared, spread evenly over all, the same every time. In the merged graph they
are found layer by layer, all paths at once, and the best of all is taken: what the
paper's depth-first step finds, in time linear in the edges.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.graph import Graph, Nodes, UnitGraph
from lipwright.engines.motion.search.costs import Costs
from lipwright.engines.motion.search.path import Path, path_of
from lipwright.engines.motion.search.steps import cheapest, checked, links

MOST_TIED = 64
Tile = tuple[int, int, int, int]


def greedy(graph: Graph, wanted: NDArray[np.integer], costs: Costs) -> Path:
    """Search by longest matches: the fewest jumps, fast.

    Parameters
    ----------
    graph : Graph
    wanted : (N,) int
        Indices of labels.
    costs : Costs
    """
    labels = checked(graph, wanted)
    if isinstance(graph, UnitGraph):
        return path_of(graph, longest_matches(graph, labels, costs), costs)
    nodes: list[int] = []
    while len(nodes) < len(labels):
        nodes += _longest(graph, labels, len(nodes), costs)
    return path_of(graph, nodes, costs)


def tiles(graph: UnitGraph, labels: Sequence[int]) -> list[Tile]:
    """Return the greedy tiles: start, length, and the range of the index that begins so."""
    found, start = [], 0
    while start < len(labels):
        length, low, high = graph.index.longest(labels, start)
        found.append((start, length, low, high))
        start += length
    return found


def longest_matches(graph: UnitGraph, labels: Sequence[int], costs: Costs) -> Nodes:
    """Return the units of the longest matches that sound nearest, one for each label."""
    found = tiles(graph, labels)
    if not found:
        return np.zeros(0, np.int64)
    starts, lengths, lows, highs = np.array(found).T
    counts = np.minimum(highs - lows, MOST_TIED)
    tile = np.repeat(np.arange(len(found)), counts)
    turn = _counted(counts)
    places = lows[tile] + turn * (highs - lows)[tile] // counts[tile]
    tied = graph.index.suffixes[places].astype(np.int64)
    away = _sounds(costs, tied, starts[tile], lengths[tile])
    begins = np.cumsum(counts) - counts
    chosen = [
        at + int(away[at : at + count].argmin())
        for at, count in zip(begins.tolist(), counts.tolist(), strict=True)
    ]
    return np.repeat(tied[chosen], lengths) + _counted(lengths)


def _counted(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    """0, 1, … for each count, one after the other."""
    ends = np.cumsum(counts)
    return np.arange(ends[-1]) - np.repeat(ends - counts, counts)


def _sounds(costs: Costs, first: Nodes, starts: Nodes, lengths: Nodes) -> NDArray[np.float64]:
    """How far each match sounds from its stretch of what is wanted, summed over its units."""
    within = _counted(lengths)
    every = costs.unit_sounds(
        np.repeat(starts, lengths) + within, np.repeat(first, lengths) + within
    )
    summed: NDArray[np.float64] = np.add.reduceat(every, np.cumsum(lengths) - lengths)
    return summed


def _longest(graph: Graph, labels: Sequence[int], start: int, costs: Costs) -> list[int]:
    """The longest path with the labels from ``start``; of those, the one that sounds nearest."""
    nodes = graph.having(labels[start])
    so_far = costs.sound(start, nodes)
    layers, sources = [nodes], [np.zeros(0, np.int64)]
    for place in range(start + 1, len(labels)):
        following = graph.having(labels[place])
        left, right = links(graph, nodes, following)
        if not len(right):
            break
        best, source = cheapest(so_far[left], left, right, len(following))
        reached = source >= 0
        nodes = following[reached]
        so_far = best[reached] + costs.sound(place, nodes)
        layers.append(nodes)
        sources.append(source[reached])
    at = int(so_far.argmin())
    path = []
    for layer, source in zip(reversed(layers), reversed(sources), strict=True):
        path.append(int(layer[at]))
        at = int(source[at]) if len(source) else 0
    return path[::-1]
