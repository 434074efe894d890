"""What a search returns, what it is asked, and what stands in for a phone that is missing."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.database import Database
from lipwright.engines.motion.graph import Graph
from lipwright.engines.motion.search.costs import Costs
from lipwright.phones import SILENCE

Wanted = NDArray[np.integer]


@dataclass(frozen=True, slots=True)
class StandIn:
    """A phone that the database lacks, and what is used for it.

    Parameters
    ----------
    place : int
        Which of the wanted phones.
    wanted, used : str
    alike : bool
        Whether both are of one class; else there was none of its class.
    """

    place: int
    wanted: str
    used: str
    alike: bool


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """One unit for each wanted phone.

    Parameters
    ----------
    units : (N,) int64
        The units whose motion is taken.
    nodes : (N,) int64
        The graph's nodes: the units themselves in the plain graph.
    jump : (N,) bool
        Where the graph has no edge from the node before; never at the first.
    cost : float
        Sum of sound and joining distances.
    complete : bool
        Whether the search came to its end within its time.
    stand_ins : tuple of StandIn
    """

    units: NDArray[np.int64]
    nodes: NDArray[np.int64]
    jump: NDArray[np.bool_]
    cost: float
    complete: bool = True
    stand_ins: tuple[StandIn, ...] = ()

    @property
    def jumps(self) -> int:
        """How many neighbours here were not neighbours in a take."""
        return int(self.jump.sum())


Search = Callable[[Graph, Wanted, Costs], Path]


def path_of(graph: Graph, nodes: Sequence[int] | NDArray[np.int64], costs: Costs) -> Path:
    """Return the path through some nodes, with its jumps and its cost."""
    through = np.asarray(nodes, np.int64)
    jump = np.zeros(len(through), np.bool_)
    if len(through) > 1:
        sources, places = graph.before(through[1:])
        jump[1:] = True
        jump[1 + places[sources == through[places]]] = False
    return Path(graph.units(through), through, jump, costs.total(through))


def find(
    search: Search,
    graph: Graph,
    phones: Sequence[str],
    costs: Costs,
    class_of: Callable[[str], str] | None = None,
) -> Path:
    """Search for phones by label; one that the database lacks gets a stand-in.

    Parameters
    ----------
    search : function
        :func:`greedy`, :func:`optimal` or what :func:`pq` returns.
    graph : Graph
    phones : sequence of str
        In the notation of the database.
    costs : Costs
    class_of : function, optional
        Class of a label: phones of one class look alike.
    """
    wanted, stand_ins = label_indices(graph.database, phones, class_of)
    return replace(search(graph, wanted, costs), stand_ins=stand_ins)


def find_several(
    search: Search,
    graph: Graph,
    phones: Sequence[str],
    costs: Costs,
    class_of: Callable[[str], str] | None = None,
    count: int = 1,
) -> list[Path]:
    """Search as often as asked, each time for units that no path before has used.

    The paths have the jumps that the search allows, and equal merit but for their cost: the
    mean of their motions has less of one recording's chance in it. The best comes first.
    """
    paths: list[Path] = []
    for _ in range(count):
        paths.append(find(search, graph, phones, costs, class_of))
        costs = costs.without(paths[-1].units)
    return paths


def label_indices(
    database: Database, phones: Sequence[str], class_of: Callable[[str], str] | None = None
) -> tuple[NDArray[np.int64], tuple[StandIn, ...]]:
    """Return the database's indices of labels, and what stands in for those it lacks.

    The stand-in is the most frequent label of the same class; where there is none, the
    most frequent sound, for silence silence's nearest: whatever there is.
    """
    known = {label: index for index, label in enumerate(database.labels)}
    chosen: dict[str, tuple[str, bool]] = {}
    stand_ins = []
    for place, phone in enumerate(phones):
        if phone in known:
            continue
        if phone not in chosen:
            chosen[phone] = _stand_in(database, phone, class_of)
        used, alike = chosen[phone]
        stand_ins.append(StandIn(place, phone, used, alike))
    indices = [known[chosen[phone][0] if phone in chosen else phone] for phone in phones]
    return np.array(indices, np.int64), tuple(stand_ins)


def _stand_in(
    database: Database, phone: str, class_of: Callable[[str], str] | None
) -> tuple[str, bool]:
    counts = np.diff(database.label_first)
    frequent = [database.labels[index] for index in np.argsort(-counts, kind="stable")]
    if class_of is not None:
        like = class_of(phone)
        for label in frequent:
            if class_of(label) == like:
                return label, True
    return next((label for label in frequent if label != SILENCE), frequent[0]), False
