"""The best path of any graph: dynamic programming over phones and nodes.

First the fewest jumps to each node and from it, which is cheap; then the least cost,
only over nodes on a path with the fewest jumps of all. On the merged graph this is
:func:`~lipwright.engines.motion.search.optimal.optimal`; on the plain one it finds the
same as that does, slower.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.graph import Graph, Nodes
from lipwright.engines.motion.search.costs import Costs, Floats
from lipwright.engines.motion.search.steps import cheapest, cheapest_jumps, jumps_to_go, links


@dataclass(frozen=True, slots=True, eq=False)
class _Layer:
    """The nodes of one phone that lie on a path with the fewest jumps.

    ``before``: jumps up to each. ``left``, ``right``: edges from the layer before.
    """

    nodes: Nodes
    before: NDArray[np.int64]
    left: Nodes
    right: Nodes


def best_nodes(graph: Graph, labels: Sequence[int], costs: Costs) -> Nodes:
    """Return the nodes of the path with the fewest jumps and, among those, the least cost."""
    if not labels:
        return np.zeros(0, np.int64)
    layers = _layers(graph, labels)
    so_far = costs.sound(0, layers[0].nodes)
    sources = [np.zeros(len(so_far), np.int64)]
    for place in range(1, len(layers)):
        so_far, source = _step(costs, layers[place - 1], layers[place], so_far)
        so_far = so_far + costs.sound(place, layers[place].nodes)
        sources.append(source)
    path = np.zeros(len(layers), np.int64)
    at = int(so_far.argmin())
    for place in reversed(range(len(layers))):
        path[place] = layers[place].nodes[at]
        at = int(sources[place][at])
    return path


def _step(costs: Costs, last: _Layer, layer: _Layer, so_far: Floats) -> tuple[Floats, Nodes]:
    """Cheapest cost up to each node of a layer, without its own sound, and from where."""
    through = so_far[layer.left] + costs.joinings(last.nodes[layer.left], layer.nodes[layer.right])
    best, source = cheapest(through, layer.left, layer.right, len(layer.nodes))
    for jumps in np.unique(last.before):
        left = np.flatnonzero(last.before == jumps)
        right = np.flatnonzero(layer.before == jumps + 1)
        if not len(right):
            continue
        value, which = cheapest_jumps(costs, last.nodes[left], so_far[left], layer.nodes[right])
        better = value < best[right]
        best[right[better]] = value[better]
        source[right[better]] = left[which[better]]
    return best, source


def _layers(graph: Graph, labels: Sequence[int]) -> list[_Layer]:
    every = [graph.having(label) for label in labels]
    edges = [links(graph, a, b) for a, b in pairwise(every)]
    before = [np.zeros(len(every[0]), np.int64)]
    for nodes, (left, right) in zip(every[1:], edges, strict=True):
        here = np.full(len(nodes), before[-1].min() + 1)
        np.minimum.at(here, right, before[-1][left])
        before.append(here)
    after = jumps_to_go(every, edges)
    fewest = int((before[0] + after[0]).min())
    kept = [b + a == fewest for b, a in zip(before, after, strict=True)]
    none = np.zeros(0, np.int64)
    layers = [_Layer(every[0][kept[0]], before[0][kept[0]], none, none)]
    for place, (left, right) in enumerate(edges, start=1):
        # On such a path an edge goes between nodes with equally many jumps before them.
        on = kept[place - 1][left] & kept[place][right]
        on &= before[place - 1][left] == before[place][right]
        layers.append(
            _Layer(
                every[place][kept[place]],
                before[place][kept[place]],
                np.cumsum(kept[place - 1])[left[on]] - 1,
                np.cumsum(kept[place])[right[on]] - 1,
            )
        )
    return layers
