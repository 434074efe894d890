"""Steps that the searches share: edges between two sets of nodes, and the cheapest jumps."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.graph import Graph, Nodes
from lipwright.engines.motion.search.costs import Costs, Floats
from lipwright.errors import InputError

_FEWEST, _SMALLEST = 64, 1 << 13
_LARGEST = 1 << 17


def checked(graph: Graph, wanted: NDArray[np.integer]) -> list[int]:
    """Return wanted labels as a list.

    Raises
    ------
    InputError
        If one of them is no label of the database.
    """
    labels: list[int] = np.asarray(wanted).tolist()
    known = len(graph.database.labels)
    if labels and not 0 <= min(labels) <= max(labels) < known:
        wrong = next(label for label in labels if not 0 <= label < known)
        raise InputError(f"label {wrong}", expected=f"0 to {known - 1}, as the database has them")
    return labels


def links(graph: Graph, left: Nodes, right: Nodes) -> tuple[Nodes, Nodes]:
    """Return the edges from ``left`` (ascending) to ``right``, as places in both."""
    sources, places = graph.before(right)
    if not len(left) or not len(sources):
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    found = np.minimum(np.searchsorted(left, sources), len(left) - 1)
    there = left[found] == sources
    return found[there], places[there]


def jumps_to_go(
    every: Sequence[Nodes], edges: Sequence[tuple[Nodes, Nodes]]
) -> list[NDArray[np.int64]]:
    """Return the fewest jumps from each node to the last phone.

    Parameters
    ----------
    every : sequence of (M,) int
        The nodes of each phone, at least one phone.
    edges : sequence of two arrays
        From the nodes of each phone to those of the next, as :func:`links` returns them.
    """
    go = [np.zeros(len(every[-1]), np.int64)]
    for nodes, (left, right) in zip(every[-2::-1], edges[::-1], strict=True):
        here = np.full(len(nodes), go[-1].min() + 1)
        np.minimum.at(here, left, go[-1][right])
        go.append(here)
    return go[::-1]


def cheapest(values: Floats, sources: Nodes, places: Nodes, count: int) -> tuple[Floats, Nodes]:
    """Return for each of ``count`` places the least value and its source; inf and -1 for none.

    Of equal values the first counts.
    """
    best, source = np.full(count, np.inf), np.full(count, -1, np.int64)
    order = np.lexsort((values, places))
    at = places[order]
    first = order[np.append(True, at[1:] != at[:-1])] if len(at) else order
    best[places[first]], source[places[first]] = values[first], sources[first]
    return best, source


def cheapest_jumps(costs: Costs, left: Nodes, so_far: Floats, right: Nodes) -> tuple[Floats, Nodes]:
    """Return for each right node the cheapest way to jump to it, and from which left one.

    Exactly the least of ``so_far`` and joining: the left nodes are tried in order of
    what they cost so far, and a right node is done when the next one alone costs more
    than its best.

    Parameters
    ----------
    costs : Costs
    left : (A,) int
    so_far : (A,) float64
        What the path to each left node costs.
    right : (B,) int

    Returns
    -------
    best : (B,) float64
    source : (B,) int
        Place in ``left``.
    """
    order = np.argsort(so_far, kind="stable")
    ordered, ascending = left[order], so_far[order]
    begins = costs.begins(right)
    best, source = np.full(len(right), np.inf), np.zeros(len(right), np.int64)
    open_places = np.arange(len(right))
    at, many = 0, _FEWEST
    while at < len(order) and len(open_places):
        most = _LARGEST // len(open_places)
        last = at + max(1, min(max(many, _SMALLEST // len(open_places)), most))
        # Right nodes as rows: each one's least is then found in one stretch of memory.
        sums = costs.between(begins, costs.ends(ordered[at:last]))
        sums += ascending[at:last]
        which = sums.argmin(axis=1)
        least = sums[np.arange(len(open_places)), which]
        better = least < best[open_places]
        improved = open_places[better]
        best[improved] = least[better]
        source[improved] = order[at + which[better]]
        at, many = last, 2 * many
        if at < len(order):
            still = best[open_places] > ascending[at]
            open_places, begins = open_places[still], begins[still]
    return best, source
