"""The network of everything that the words may sound like: a graph of phones.

Every pronunciation of every word of every spoken form is a path; between words, and at
both ends, there may be silence or noise. Phones are in context, across words too: a
word's last phone has a copy for each first phone that may follow, and a first phone one
for each last phone before.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lipwright.schedule.align.lexicon import Pronunciation, Spoken, Ways
from lipwright.schedule.align.model import AcousticModel

PAUSE = -1
_PAUSE_COST = -3.0
_NOISE_COST = -8.0
_SKIP_COST = -1.0

Arc = tuple[int, float]


@dataclass(frozen=True, slots=True)
class Node:
    """A phone in the network.

    Parameters
    ----------
    phone : int
        Base phone of the model.
    token : int
        Index of the token that it belongs to; ``PAUSE`` between words.
    senones : tuple of int
        Its three states.
    ends : bool
        Whether a token, or a pause after it, may end with it.
    """

    phone: int
    token: int
    senones: tuple[int, ...]
    ends: bool = False


@dataclass(frozen=True, slots=True)
class Network:
    """Phones and what may follow what.

    Parameters
    ----------
    nodes : tuple of Node
        In the order of the tokens.
    before : tuple of tuple of (int, float)
        For each node, the nodes that it may follow, and the log probability of doing so.
    first : tuple of (int, float)
        Nodes that a path may start with.
    last : tuple of int
        Nodes that the whole line may end with.
    """

    nodes: tuple[Node, ...]
    before: tuple[tuple[Arc, ...], ...]
    first: tuple[Arc, ...]
    last: tuple[int, ...]


@dataclass(slots=True)
class _Front:
    """Where the network may go on: after pauses, or directly after a word's last phone.

    ``direct`` is by (last phone, the first phone that must follow).
    """

    pauses: list[int] = field(default_factory=list)
    direct: dict[tuple[int, int], list[int]] = field(default_factory=dict)
    finals: list[int] = field(default_factory=list)

    def join(self, other: _Front) -> None:
        self.pauses += other.pauses
        self.finals += other.finals
        for key, nodes in other.direct.items():
            self.direct.setdefault(key, []).extend(nodes)


def build_network(model: AcousticModel, tokens: Sequence[Spoken], *, entries: int = 1) -> Network:
    """Return the network of a line.

    Parameters
    ----------
    model : AcousticModel
    tokens : sequence of Spoken
    entries : int
        How many of the first tokens a path may start with: more than one where words
        of the text may be missing from the sound.
    """
    builder = _Builder(model)
    front = builder.pause([])
    builder.first += [(node, 0.0) for node in front.pauses]
    for index, token in enumerate(tokens):
        after = _starts(model, tokens[index + 1]) if index + 1 < len(tokens) else []
        entry = _SKIP_COST * (index > 0) if index < entries else None
        joined = _Front()
        for form in token.forms:
            joined.join(builder.form(index, form, front, after, entry))
        front = joined
    return Network(
        tuple(builder.nodes),
        tuple(map(tuple, builder.before)),
        tuple(builder.first),
        tuple(front.finals),
    )


def _starts(model: AcousticModel, token: Spoken) -> list[int]:
    return sorted({model.index(way[0]) for form in token.forms for way in form[0]})


@dataclass(slots=True)
class _Builder:
    model: AcousticModel
    nodes: list[Node] = field(default_factory=list)
    before: list[list[Arc]] = field(default_factory=list)
    first: list[Arc] = field(default_factory=list)

    def add(self, node: Node, before: Sequence[Arc]) -> int:
        self.nodes.append(node)
        self.before.append(list(before))
        return len(self.nodes) - 1

    def pause(self, before: Sequence[int]) -> _Front:
        """Add silence and noises that may follow each other."""
        triphones = self.model.triphones
        pauses: list[int] = []
        for filler in sorted(triphones.fillers):
            cost = _PAUSE_COST if filler == triphones.silence else _NOISE_COST
            states = tuple(int(s) for s in triphones.senones[filler])
            node = Node(filler, PAUSE, states, ends=True)
            pauses.append(self.add(node, [(b, cost) for b in before]))
        for pause in pauses:
            self.before[pause] += [(other, _NOISE_COST) for other in pauses if other != pause]
        return _Front(pauses, {}, pauses + list(before))

    def form(
        self,
        token: int,
        form: Sequence[Ways],
        front: _Front,
        after: list[int],
        entry: float | None,
    ) -> _Front:
        """Add the words of a spoken form after ``front``; return where it ends."""
        for place, ways in enumerate(form):
            inner = place + 1 < len(form)
            following = (
                sorted({self.model.index(way[0]) for way in form[place + 1]}) if inner else after
            )
            front = self.word(token, ways, front, following, entry)
            entry = None
        return front

    def word(
        self, token: int, ways: Ways, front: _Front, following: list[int], entry: float | None
    ) -> _Front:
        """Add all pronunciations of a word."""
        silence = self.model.triphones.silence
        result = _Front()
        silent: list[int] = []
        for way in ways:
            phones = tuple(map(self.model.index, way))
            tails = self.way(token, phones, front, [silence, *following], entry)
            for right, nodes in tails.items():
                if right == silence:
                    silent += nodes
                else:
                    result.direct.setdefault((phones[-1], right), []).extend(nodes)
        after = self.pause(silent)
        result.pauses, result.finals = after.pauses, after.finals
        return result

    def way(
        self,
        token: int,
        way: tuple[int, ...],
        front: _Front,
        rights: list[int],
        entry: float | None,
    ) -> dict[int, list[int]]:
        """Add one pronunciation; return its last nodes by the phone that must follow."""
        lefts = [(self.model.triphones.silence, front.pauses)]
        lefts += [(left, nodes) for (left, to), nodes in front.direct.items() if to == way[0]]
        heads: list[int] = []
        tails: dict[int, list[int]] = {}
        for left, nodes in lefts:
            arcs = [(node, 0.0) for node in nodes]
            if len(way) > 1:
                heads.append(self.add(self._node(token, way[0], left, way[1], "begin"), arcs))
                continue
            for right in rights:
                node = self._node(token, way[0], left, right, "single")
                heads.append(self.add(node, arcs))
                tails.setdefault(right, []).append(heads[-1])
        if entry is not None:
            self.first.append((heads[0], entry))
        if len(way) == 1:
            return tails
        for left, phone, right in zip(way, way[1:], way[2:], strict=False):
            arcs = [(node, 0.0) for node in heads]
            heads = [self.add(self._node(token, phone, left, right, "internal"), arcs)]
        arcs = [(node, 0.0) for node in heads]
        return {
            right: [self.add(self._node(token, way[-1], way[-2], right, "end"), arcs)]
            for right in rights
        }

    def _node(self, token: int, phone: int, left: int, right: int, position: str) -> Node:
        senones = self.model.triphones.of(phone, left, right, position)
        return Node(phone, token, senones, ends=position in ("end", "single"))


def shortest(tokens: Sequence[Spoken]) -> int:
    """Return how many phones the tokens have at least."""

    def least(ways: Sequence[Pronunciation]) -> int:
        return min(len(way) for way in ways)

    return sum(min(sum(map(least, form)) for form in token.forms) for token in tokens)


def columns(network: Network) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the distinct senones of a network, and the column of each of its states."""
    senones = np.array([node.senones for node in network.nodes], np.int64).reshape(-1)
    unique, places = np.unique(senones, return_inverse=True)
    return unique, places
