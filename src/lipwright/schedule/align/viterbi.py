"""The most likely path through a network: exact, without beams, so that it never fails.

Forney (1973). All states of the network are one vector that moves on frame by frame.
Beams, as pocketsphinx itself has them, refuse good recordings now and then; the networks
here are small enough to do without.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.schedule.align.model import STATES, AcousticModel
from lipwright.schedule.align.network import Network

_NEVER = np.float32(-1e30)


@dataclass(frozen=True, slots=True)
class Stretch:
    """A node of the network from one frame up to another."""

    node: int
    start: int
    end: int


@dataclass(frozen=True, slots=True)
class _Arcs:
    """Transitions as arrays.

    ``stay`` and ``move`` (S,): log probability of staying in a state, of coming from the
    one before it in its phone. ``before``, ``cost`` (N, B): states that each phone may be
    entered from, and their log probability; filled up with what can never be.
    """

    stay: NDArray[np.float32]
    move: NDArray[np.float32]
    before: NDArray[np.int64]
    cost: NDArray[np.float32]


def best_path(
    model: AcousticModel,
    network: Network,
    scores: NDArray[np.float32],
    columns: NDArray[np.int64],
    *,
    whole: bool = True,
) -> tuple[Stretch, ...]:
    """Return the phones of the most likely path.

    Parameters
    ----------
    scores : (T, U) float32
        Log likelihood of each senone in each frame.
    columns : (S,) int
        Column of ``scores`` for each state of the network.
    whole : bool
        Whether the path has to reach the network's end; else it stops at the end of
        the word, or in the pause, that is most likely to be reached.

    Returns
    -------
    tuple of Stretch
        Without gaps; empty if the frames are too few for the phones.
    """
    arcs = _arcs(model, network)
    value, moved, entered = _forward(network, arcs, scores, columns)
    last = network.last if whole else [i for i, node in enumerate(network.nodes) if node.ends]
    ends = STATES * np.array(last) + STATES - 1
    end = int(ends[value[ends].argmax()])
    if value[end] < 0.5 * _NEVER:
        return ()
    return _trace(arcs, moved, entered, end)


def _arcs(model: AcousticModel, network: Network) -> _Arcs:
    phones = np.array([node.phone for node in network.nodes])
    stay, leave = model.stay[phones], model.leave[phones]
    move = np.full_like(stay, _NEVER)
    move[:, 1:] = leave[:, :-1]
    width = max(len(sources) for sources in network.before)
    before = np.zeros((len(phones), width), np.int64)
    cost = np.full((len(phones), width), _NEVER, np.float32)
    for node, sources in enumerate(network.before):
        for column, (source, weight) in enumerate(sources):
            before[node, column] = STATES * source + STATES - 1
            cost[node, column] = weight + leave[source, -1]
    return _Arcs(stay.reshape(-1), move.reshape(-1), before, cost)


def _forward(
    network: Network,
    arcs: _Arcs,
    scores: NDArray[np.float32],
    columns: NDArray[np.int64],
) -> tuple[NDArray[np.float32], NDArray[np.bool_], NDArray[np.uint16]]:
    states = len(arcs.stay)
    entry = np.arange(0, states, STATES)
    rows = np.arange(len(entry))
    value = np.full(states, _NEVER, np.float32)
    for node, weight in network.first:
        value[STATES * node] = weight
    value += scores[0][columns]
    moved = np.zeros((len(scores), states), np.bool_)
    entered = np.zeros((len(scores), len(entry)), np.uint16)
    came = np.full(states, _NEVER, np.float32)
    for t in range(1, len(scores)):
        came[1:] = value[:-1]
        came += arcs.move
        options = value[arcs.before] + arcs.cost
        choice = options.argmax(axis=1)
        came[entry] = options[rows, choice]
        entered[t] = choice
        value = value + arcs.stay
        np.greater(came, value, out=moved[t])
        np.maximum(came, value, out=value)
        value += scores[t][columns]
        np.maximum(value, _NEVER, out=value)
    return value, moved, entered


def _trace(
    arcs: _Arcs, moved: NDArray[np.bool_], entered: NDArray[np.uint16], end: int
) -> tuple[Stretch, ...]:
    stretches: list[Stretch] = []
    state, stop = end, len(moved)
    for t in range(len(moved) - 1, 0, -1):
        if not moved[t, state]:
            continue
        node, within = divmod(state, STATES)
        if within:
            state -= 1
        else:
            stretches.append(Stretch(node, t, stop))
            state, stop = int(arcs.before[node, entered[t, node]]), t
    stretches.append(Stretch(state // STATES, 0, stop))
    return tuple(reversed(stretches))
