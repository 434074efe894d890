"""The graph of units, plain and merged (Cao et al. 2004, sections 5.2 and 5.3).

A node of the plain graph is a unit, with an edge to the unit that followed it in its
take. A node of the merged graph is a cluster of units, with the edges of all of them: a
directed graph in which a node has several labels and several sounds. Both answer the
same questions, which is all that a search asks.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.database import Database, Merged
from lipwright.engines.motion.label_index import LabelIndex
from lipwright.errors import InputError

Nodes = NDArray[np.int64]


class Graph(ABC):
    """What a search asks of a graph.

    Parameters
    ----------
    database : Database
    """

    def __init__(self, database: Database) -> None:
        self.database = database

    @cached_property
    def index(self) -> LabelIndex:
        """Finds strings of labels among the units."""
        held = self.database
        return LabelIndex(
            held.suffixes, held.keys, held.label, held.take, held.take_unit, len(held.labels)
        )

    def pairs(self, first: int, second: int) -> NDArray[np.int32]:
        """Return the units of one label whose successor in their take has another."""
        return self.index.occurrences([first, second])

    @abstractmethod
    def having(self, label: int) -> Nodes:
        """Return the nodes with a label, ascending: the paper's anime array."""

    @abstractmethod
    def units(self, nodes: Nodes) -> Nodes:
        """Return the units whose motion the nodes have."""

    @abstractmethod
    def before(self, nodes: Nodes) -> tuple[Nodes, Nodes]:
        """Return the edges into nodes: where each comes from, and its place in ``nodes``.

        In order of places.
        """

    @abstractmethod
    def after(self, node: int) -> Nodes:
        """Return the nodes that a node has edges to, ascending."""

    @abstractmethod
    def sounds(self, nodes: Nodes) -> tuple[Nodes, Nodes]:
        """Return the units whose sounds the nodes have, and where each node's begin."""


class UnitGraph(Graph):
    """A node for every unit."""

    def having(self, label: int) -> Nodes:  # noqa: D102 - as in the base
        first = self.database.label_first
        return self.database.by_label[first[label] : first[label + 1]].astype(np.int64)

    def units(self, nodes: Nodes) -> Nodes:  # noqa: D102
        return nodes

    def before(self, nodes: Nodes) -> tuple[Nodes, Nodes]:  # noqa: D102
        take = self.database.take
        places = np.flatnonzero((nodes > 0) & (take[nodes - 1] == take[nodes]))
        return nodes[places] - 1, places

    def after(self, node: int) -> Nodes:  # noqa: D102
        take = self.database.take
        follows = node + 1 < len(take) and take[node + 1] == take[node]
        return np.arange(node + 1, node + 2 if follows else node + 1)

    def sounds(self, nodes: Nodes) -> tuple[Nodes, Nodes]:  # noqa: D102
        return nodes, np.arange(len(nodes))


class MergedGraph(Graph):
    """A node for every cluster of units of like motion.

    Raises
    ------
    InputError
        If the database was built without clusters.
    """

    def __init__(self, database: Database) -> None:
        super().__init__(database)
        if database.merged is None:
            raise InputError(
                "its units are not clustered",
                where=str(database.folder),
                cure="build it with --clusters",
            )
        self.merged: Merged = database.merged

    def having(self, label: int) -> Nodes:  # noqa: D102
        first = self.merged.node_first
        return self.merged.node[first[label] : first[label + 1]].astype(np.int64)

    def units(self, nodes: Nodes) -> Nodes:  # noqa: D102
        return self.merged.representative[nodes].astype(np.int64)

    def before(self, nodes: Nodes) -> tuple[Nodes, Nodes]:  # noqa: D102
        return _lists(self.merged.before, self.merged.before_first, nodes)

    def after(self, node: int) -> Nodes:  # noqa: D102
        first = self.merged.after_first
        return self.merged.after[first[node] : first[node + 1]].astype(np.int64)

    def sounds(self, nodes: Nodes) -> tuple[Nodes, Nodes]:  # noqa: D102
        members, places = _lists(self.merged.member, self.merged.member_first, nodes)
        return members, np.searchsorted(places, np.arange(len(nodes)))


def _lists(entries: NDArray[np.int32], first: Nodes, nodes: Nodes) -> tuple[Nodes, Nodes]:
    """The entries of several nodes one after the other, each with its node's place."""
    begins = first[nodes]
    counts = first[nodes + 1] - begins
    places = np.repeat(np.arange(len(nodes)), counts)
    within = np.arange(len(places)) - np.repeat(np.cumsum(counts) - counts, counts)
    return entries[begins[places] + within].astype(np.int64), places


def graph_of(database: Database) -> Graph:
    """Return the merged graph where the database has clusters, else the plain one."""
    return UnitGraph(database) if database.merged is None else MergedGraph(database)
