"""The publication's Algorithm 1: branch and bound over short stretches (section 6.1).

Each stretch of ``h`` phones is searched exhaustively for the fewest jumps and, among
those, the least cost; the first ``advance`` nodes of it are kept and the next stretch
begins behind them. The paper says nothing of its bounds; here they are tight, so that it
is faster than published. The printed algorithm does not say whether a stretch knows the node
that was kept before it: here it does, else every border would be a jump. The time grows
exponentially with ``h``: it is here to compare with, and has a cap.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.graph import Graph, Nodes
from lipwright.engines.motion.search.costs import Costs, Floats
from lipwright.engines.motion.search.path import Path, Search, path_of
from lipwright.engines.motion.search.steps import checked, jumps_to_go, links
from lipwright.errors import InputError

Child = tuple[int, float, int, int]


def pq(h: int, advance: int = 1, seconds: float | None = None) -> Search:
    """Return the search PQ-Matching(``h``).

    Parameters
    ----------
    h : int
        Phones in a stretch; the paper takes 3 to 6.
    advance : int
        How many nodes of a stretch are kept: the paper's h_q, 1 as printed.
    seconds : float, optional
        Time for a whole search. A stretch that has used its share of what is left takes
        the best that it has found, and the path is marked as not complete.

    Raises
    ------
    InputError
        If the numbers make no sense.
    """
    if not 1 <= advance <= h:
        raise InputError(f"h = {h}, advance = {advance}", expected="1 <= advance <= h")
    if seconds is not None and not seconds > 0:
        raise InputError(f"{seconds} s", expected="more than 0 s")

    def search(graph: Graph, wanted: NDArray[np.integer], costs: Costs) -> Path:
        labels = checked(graph, wanted)
        end = None if seconds is None else time.perf_counter() + seconds
        nodes: list[int] = []
        complete = True
        while len(nodes) < len(labels):
            first = len(nodes)
            last = min(first + h, len(labels))
            stretch = _Stretch(graph, labels, costs, first, last)
            rest = -(-(len(labels) - first) // advance)
            found, whole = stretch.best(nodes[-1] if nodes else None, _share(end, rest))
            nodes += found[:advance]
            complete &= whole
        return replace(path_of(graph, nodes, costs), complete=complete)

    return search


def _share(end: float | None, stretches: int) -> float | None:
    """Until when the next stretch may search."""
    now = time.perf_counter()
    return None if end is None else now + max(end - now, 0.0) / stretches


class _Stretch:
    """One stretch of phones, searched by branch and bound, depth first.

    What a path has yet to cost is bounded from below by the fewest jumps from its node to
    the end of the stretch and by the best sound of each phone to come.
    """

    def __init__(
        self, graph: Graph, labels: Sequence[int], costs: Costs, first: int, last: int
    ) -> None:
        self._graph, self._costs = graph, costs
        self._nodes: list[Nodes] = [graph.having(label) for label in labels[first:last]]
        edges = [links(graph, a, b) for a, b in pairwise(self._nodes)]
        self._to_go = jumps_to_go(self._nodes, edges)
        self._sound: list[Floats] = [
            costs.sound(first + place, nodes) for place, nodes in enumerate(self._nodes)
        ]
        least = [float(sound.min()) for sound in self._sound]
        self._rest = [sum(least[place + 1 :]) for place in range(len(least))]

    def best(self, before: int | None, until: float | None) -> tuple[list[int], bool]:
        """Return the best nodes behind ``before``, and whether all were tried in time."""
        bound, found = (len(self._nodes) + 1, np.inf), list[int]()
        queues = [self._children(0, before, 0, 0.0, bound)]
        path: list[int] = []
        while queues:
            if found and until is not None and time.perf_counter() > until:
                return found, False
            child = next(queues[-1], None)
            # The queue is in order: what follows one that is too bad is worse.
            if child is None or child[:2] >= bound:
                queues.pop()
                if path:
                    path.pop()
                continue
            jumps, cost, node, so_far = child
            if len(queues) == len(self._nodes):
                bound, found = (jumps, cost), [*path, node]
                continue
            place = len(queues)
            path.append(node)
            queues.append(self._children(place, node, so_far, cost - self._rest[place - 1], bound))
        return found, True

    def _children(
        self, place: int, node: int | None, jumps: int, cost: float, bound: tuple[int, float]
    ) -> Iterator[Child]:
        """The nodes that can follow and be within the bound, the most promising first.

        Each with the least jumps and cost that a path through it can come to, and the
        jumps up to it.
        """
        nodes = self._nodes[place]
        total = np.full(len(nodes), jumps)
        if node is not None:
            total += 1
            after = self._graph.after(node)
            if len(after):
                total[np.isin(nodes, after)] -= 1
        least = total + self._to_go[place]
        within = np.flatnonzero(least <= bound[0])
        nodes, total, least = nodes[within], total[within], least[within]
        costs = cost + self._sound[place][within] + self._rest[place]
        if node is not None:
            costs = costs + self._costs.joining(np.array([node]), nodes)[0]
        order = np.lexsort((costs, least))
        if place + 1 == len(self._nodes):
            order = order[:1]
        columns = (least[order], costs[order], nodes[order], total[order])
        return zip(*(column.tolist() for column in columns), strict=True)
