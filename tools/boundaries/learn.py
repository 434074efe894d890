"""Learning: which of the instants near a boundary divides its two phones.

Softmax over the instants, cross-entropy with a narrow peak at the true time, Adam with
decoupled decay (Kingma & Ba 2015; Loshchilov & Hutter 2019), a cosine of learning rates.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.schedule.align.boundaries import BoundaryNetwork

Weights = dict[str, NDArray[np.float32]]

_BATCH = 256
_RATE = 2e-3
_DECAY = 0.01
_DECAYS = ("sound", "second")


@dataclass(frozen=True, slots=True, eq=False)
class Examples:
    """Boundaries to learn from.

    Parameters
    ----------
    around : (B, C, D) float32
        The sound at each of the instants.
    left, right : (B,) int
        Phones before and after.
    target : (B, C) float32
        How much of the boundary lies at each instant; sums to 1.
    """

    around: NDArray[np.float32]
    left: NDArray[np.int64]
    right: NDArray[np.int64]
    target: NDArray[np.float32]


def learnt(
    phones: tuple[str, ...],
    examples: Examples,
    rng: np.random.Generator,
    *,
    widths: tuple[int, int] = (48, 24),
    rounds: int = 8,
) -> BoundaryNetwork:
    """Return the network that fits the examples."""
    weights = _start(len(phones), examples.around.shape[2], widths, rng)
    first = {name: np.zeros_like(value) for name, value in weights.items()}
    second = {name: np.zeros_like(value) for name, value in weights.items()}
    batches = max(1, len(examples.left) // _BATCH)
    for step in range(rounds * batches):
        if step % batches == 0:
            order = rng.permutation(len(examples.left))
        chosen = np.sort(order[step % batches * _BATCH :][:_BATCH])
        slopes = _slopes(BoundaryNetwork(phones, **weights), examples, chosen)
        rate = _RATE * 0.5 * (1 + np.cos(np.pi * step / (rounds * batches)))
        for name, slope in slopes.items():
            first[name] = 0.9 * first[name] + 0.1 * slope
            second[name] = 0.999 * second[name] + 0.001 * slope**2
            mean = first[name] / (1 - 0.9 ** (step + 1))
            size = np.sqrt(second[name] / (1 - 0.999 ** (step + 1))) + 1e-8
            decay = _DECAY * weights[name] if name in _DECAYS else 0.0
            weights[name] = (weights[name] - rate * (mean / size + decay)).astype(np.float32)
    return BoundaryNetwork(phones, **weights)


def _start(phones: int, inputs: int, widths: tuple[int, int], rng: np.random.Generator) -> Weights:
    one, two = widths
    drawn = {
        "sound": rng.normal(0, inputs**-0.5, (inputs, one)),
        "left": rng.normal(0, 0.3, (phones, one)),
        "right": rng.normal(0, 0.3, (phones, one)),
        "offset": np.zeros(one),
        "second": rng.normal(0, one**-0.5, (one, two)),
        "second_offset": np.zeros(two),
        "score": rng.normal(0, two**-0.5, two),
    }
    return {name: value.astype(np.float32) for name, value in drawn.items()}


def _slopes(network: BoundaryNetwork, examples: Examples, chosen: NDArray[np.int64]) -> Weights:
    """Return the gradient of the loss over some of the examples."""
    around, target = examples.around[chosen], examples.target[chosen]
    left, right = examples.left[chosen], examples.right[chosen]
    boundaries, instants, inputs = around.shape
    rows = boundaries * instants
    phones = (network.left[left] + network.right[right] + network.offset)[:, None, :]
    one = np.maximum(around @ network.sound + phones, 0).reshape(rows, -1)
    two = np.maximum(one @ network.second + network.second_offset, 0)
    scores = (two @ network.score).reshape(boundaries, instants)
    share = np.exp(scores - scores.max(axis=1, keepdims=True))
    share /= share.sum(axis=1, keepdims=True)
    error = ((share - target) / boundaries).reshape(rows, 1)
    to_two = error * network.score * (two > 0)
    to_one = to_two @ network.second.T * (one > 0)
    per_boundary = to_one.reshape(boundaries, instants, -1).sum(axis=1)
    to_left, to_right = np.zeros_like(network.left), np.zeros_like(network.right)
    np.add.at(to_left, left, per_boundary)
    np.add.at(to_right, right, per_boundary)
    return {
        "sound": around.reshape(rows, inputs).T @ to_one,
        "left": to_left,
        "right": to_right,
        "offset": per_boundary.sum(axis=0),
        "second": one.T @ to_two,
        "second_offset": to_two.sum(axis=0),
        "score": two.T @ error[:, 0],
    }
