"""The most likely path through a network: exact, without beams, so that it never fails.

Forney 1973. All states of the network are one vector, moved on one frame at a time.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.schedule.align.model import STATES, AcousticModel
from lipwright.schedule.align.network import Network

_NEVER = np.float32(-1e30)


@dataclass(frozen=True, slots=True)
class Path:
    """A path through a network.

    Parameters
    ----------
    states : (T,) int
        State of each frame: three per node.
    score : float
        Log likelihood of the path.
    """

    states: NDArray[np.int64]
    score: float


@dataclass(frozen=True, slots=True)
class Transitions:
    """A network's transitions as arrays.

    Parameters
    ----------
    stay, move : (S,) float32
        Log probability of staying in a state, and of coming from the one before it;
        a node's first state has no state before it.
    before : (N, B) int
        States that each node's first state may be entered from, filled up with any state.
    cost : (N, B) float32
        Their log probabilities; ``-1e30`` where filled up.
    """

    stay: NDArray[np.float32]
    move: NDArray[np.float32]
    before: NDArray[np.int64]
    cost: NDArray[np.float32]


def transitions(model: AcousticModel, network: Network, *, series: int = 1) -> Transitions:
    """Return the arrays for frames that are 10 ms / ``series`` apart."""
    phones = np.array([node.phone for node in network.nodes])
    stay = model.stay[phones] / series
    leave = np.log1p(-np.exp(np.minimum(stay, -1e-6)))
    move = np.full_like(stay, _NEVER)
    move[:, 1:] = leave[:, :-1]
    width = max((len(b) for b in network.before), default=0) or 1
    before = np.zeros((len(phones), width), np.int64)
    cost = np.full((len(phones), width), _NEVER, np.float32)
    for node, sources in enumerate(network.before):
        for column, (source, weight) in enumerate(sources):
            before[node, column] = STATES * source + STATES - 1
            cost[node, column] = weight + leave[source, -1]
    return Transitions(stay.reshape(-1), move.reshape(-1).astype(np.float32), before, cost)


def best_path(
    network: Network, arcs: Transitions, scores: NDArray[np.float32], columns: NDArray[np.int64],
    *, must_end: bool = True,
) -> Path:
    """Return the best path.

    Parameters
    ----------
    scores : (T, U) float32
        Log likelihood of each senone in each frame.
    columns : (S,) int
        Column of ``scores`` for each state of the network.
    must_end : bool
        Whether the path has to reach the network's end; else it ends in its best state.
    """
    frames = len(scores)
    states = len(arcs.stay)
    entry = np.arange(0, states, STATES)
    rows = np.arange(len(entry))
    value = np.full(states, _NEVER, np.float32)
    value[STATES * np.array(network.first)] = 0.0
    value += scores[0][columns]
    moved = np.zeros((frames, states), np.bool_)
    entered = np.zeros((frames, len(entry)), np.uint8)
    for t in range(1, frames):
        came = np.empty(states, np.float32)
        came[1:] = value[:-1]
        came += arcs.move
        options = value[arcs.before] + arcs.cost
        choice = options.argmax(axis=1)
        entered[t] = choice
        came[entry] = options[rows, choice]
        stayed = value + arcs.stay
        np.greater(came, stayed, out=moved[t])
        value = np.where(moved[t], came, stayed)
        value += scores[t][columns]
    ends = STATES * np.array(network.last) + STATES - 1
    end = int(ends[value[ends].argmax()]) if must_end else int(value.argmax())
    path = np.empty(frames, np.int64)
    state = end
    for t in range(frames - 1, -1, -1):
        path[t] = state
        if t and moved[t, state]:
            node, within = divmod(state, STATES)
            state = state - 1 if within else int(arcs.before[node, entered[t, node]])
    return Path(path, float(value[end]))
