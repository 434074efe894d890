"""The network of everything that the words may sound like: a graph of phones.

Every pronunciation of every word is a path; between words, and at both ends, there may
be silence or noise. Phones are in context, across words too: a word's last phone has a
copy for each first phone that may follow, and so has a first phone for those before.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lipwright.schedule.align.model import STATES, AcousticModel

Pronunciations = Sequence[tuple[str, ...]]
PAUSE = -1  # the word index of what is no word


@dataclass(frozen=True, slots=True)
class Node:
    """A phone in the network.

    Parameters
    ----------
    phone : int
        Base phone of the model.
    word : int
        Index of its word; ``PAUSE`` between words.
    gap : int
        For a pause: the index of the word that it stands before.
    senones : tuple of int
        Its three states.
    """

    phone: int
    word: int
    gap: int
    senones: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Network:
    """Phones and what may follow what.

    Parameters
    ----------
    nodes : tuple of Node
        In the order of the words.
    before : tuple of tuple of (int, float)
        For each node, the nodes that it may follow, and the log probability of doing so.
    first, last : tuple of int
        Nodes that a line may start and end with.
    """

    nodes: tuple[Node, ...]
    before: tuple[tuple[tuple[int, float], ...], ...]
    first: tuple[int, ...]
    last: tuple[int, ...]

    @property
    def senones(self) -> NDArray[np.int64]:
        """The states, (3 N,) int: senones of all nodes one after the other."""
        return np.array([node.senones for node in self.nodes], np.int64).reshape(-1)


@dataclass(slots=True)
class _Builder:
    model: AcousticModel
    pause_cost: float
    noise_cost: float
    nodes: list[Node] = field(default_factory=list)
    before: list[list[tuple[int, float]]] = field(default_factory=list)

    def add(self, node: Node, before: list[tuple[int, float]]) -> int:
        self.nodes.append(node)
        self.before.append(before)
        return len(self.nodes) - 1

    def pause(self, gap: int, before: Sequence[int]) -> list[int]:
        """Add silence and noises that may follow each other; return their nodes."""
        triphones = self.model.triphones
        added = []
        for filler in sorted(triphones.fillers):
            cost = self.pause_cost if filler == triphones.silence else self.noise_cost
            states = tuple(int(s) for s in triphones.senones[filler])
            added.append(
                self.add(Node(filler, PAUSE, gap, states), [(b, cost) for b in before])
            )
        for node in added:
            cost = self.noise_cost
            self.before[node] += [(other, cost) for other in added if other != node]
        return added


def build_network(
    model: AcousticModel,
    words: Sequence[Pronunciations],
    *,
    pause_cost: float = -3.0,
    noise_cost: float = -8.0,
) -> Network:
    """Return the network of a line.

    Parameters
    ----------
    model : AcousticModel
    words : sequence of pronunciations
        For each spoken word all its pronunciations, in the model's base phones.
    pause_cost, noise_cost : float
        Log probability of silence, and of a noise, between two words.
    """
    builder = _Builder(model, pause_cost, noise_cost)
    silence = model.triphones.silence
    spoken = [[tuple(model.index(p) for p in way) for way in ways] for ways in words]
    starts = [sorted({way[0] for way in ways}) for ways in spoken]
    pause = builder.pause(0, [])
    first, ends = list(pause), dict[tuple[int, int], list[int]]()
    for index, ways in enumerate(spoken):
        following = starts[index + 1] if index + 1 < len(spoken) else []
        lefts = sorted({phone for phone, _ in ends})
        reached: dict[tuple[int, int], list[int]] = {}
        for way in ways:
            entries = [(silence, [(node, 0.0) for node in pause])]
            entries += [
                (left, [(node, 0.0) for node in ends[left, way[0]]])
                for left in lefts
                if (left, way[0]) in ends
            ]
            made = _add_word(builder, index, way, entries, [silence, *following])
            if index == 0:
                first += [node for node in made.heads]
            for right, nodes in made.tails.items():
                reached.setdefault((way[-1], right), []).extend(nodes)
        before_pause = [n for (_, right), nodes in reached.items() if right == silence for n in nodes]
        pause = builder.pause(index + 1, before_pause)
        ends = {key: nodes for key, nodes in reached.items() if key[1] != silence}
        last = before_pause + pause
    return Network(tuple(builder.nodes), tuple(map(tuple, builder.before)), tuple(first), tuple(last))


@dataclass(frozen=True, slots=True)
class _Made:
    heads: list[int]
    tails: dict[int, list[int]]


def _add_word(
    builder: _Builder,
    index: int,
    way: tuple[int, ...],
    entries: list[tuple[int, list[tuple[int, float]]]],
    rights: list[int],
) -> _Made:
    of = builder.model.triphones.of

    def node(phone: int, left: int, right: int, position: str) -> Node:
        return Node(phone, index, PAUSE, of(phone, left, right, position))

    if len(way) == 1:
        singles = {
            right: [builder.add(node(way[0], left, right, "single"), before) for left, before in entries]
            for right in rights
        }
        return _Made([n for nodes in singles.values() for n in nodes[:1]], singles)
    heads = [builder.add(node(way[0], left, way[1], "begin"), before) for left, before in entries]
    reached = heads
    for left, phone, right in zip(way, way[1:], way[2:], strict=False):
        reached = [
            builder.add(node(phone, left, right, "internal"), [(n, 0.0) for n in reached])
        ]
    tails = {
        right: [builder.add(node(way[-1], way[-2], right, "end"), [(n, 0.0) for n in reached])]
        for right in rights
    }
    return _Made(heads[:1], tails)
