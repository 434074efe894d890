"""How far a speaker's phones may leave the base set: found by leaving out what is said.

Every word (where no words are known, every pair) falls to one of a few parts. Levels are
found without a part's frames and held against them, for each strength; the strength that
foresees best what it has not seen is taken. All strengths use the same normal equations:
the takes are gone through once.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.bigram.fit.levels import Problem, pulled
from lipwright.engines.bigram.fit.prior import PHONE, Prior
from lipwright.engines.bigram.fit.stretches import Floats, Ints, Stretch

STRENGTHS = (0.3, 1.0, 3.0, 10.0, 30.0, 100.0)
"""How many frames' evidence it may be worth that a phone is as the base has it; the gain of
the base goes with it."""
PARTS = 5
FEWEST = 12
"""Words, or pairs, below which nothing is tried: the usual strength is taken."""


@dataclass(frozen=True, slots=True, eq=False)
class _Part:
    """Normal equations of the frames that are learnt from, and of those that are foreseen."""

    learnt: tuple[Floats, Floats]
    asked: tuple[Floats, Floats]


def with_strength(problem: Problem, expected: Prior, keys: Ints, levels: Floats) -> Prior:
    """Return what is expected, with phones pulled as strongly as foresees best.

    Parameters
    ----------
    problem : Problem
    expected : Prior
    keys : (K,) int
        Levels that the takes show.
    levels : (N,) float64
        All levels as they are now: they decide which bigram is the larger.
    """
    said = np.unique(np.concatenate([stretch.said for stretch in problem.stretches]))
    if (said >= 0).sum() < FEWEST:
        return expected
    parts = _parts(problem, keys, levels)
    tried = [_pulled_by(expected, strength) for strength in STRENGTHS]
    missed = [sum(_missed(part, one, keys) for part in parts) for one in tried]
    return tried[int(np.argmin(missed))]


def _pulled_by(expected: Prior, phone: float) -> Prior:
    return replace(expected, strength=expected.strength * (phone / PHONE))


def _parts(problem: Problem, keys: Ints, levels: Floats) -> list[_Part]:
    place = np.full(len(levels), -1, dtype=np.int64)
    place[keys] = np.arange(len(keys))
    count = len(keys)
    # The last one is all frames: what is learnt from is the rest beside a part.
    squares = np.zeros((2 * PARTS + 1, count, count))
    products = np.zeros((2 * PARTS + 1, count))
    for stretch, wanted in zip(problem.stretches, problem.wanted, strict=True):
        matrix, target, _ = problem.rows(stretch, wanted, levels)
        own = place[stretch.keys]
        for number, frames in enumerate(_chosen(stretch, problem.half)):
            if frames.any():
                rows = matrix[frames]
                squares[number][np.ix_(own, own)] += rows.T @ rows
                products[number][own] += rows.T @ target[frames]
    return [
        _Part(
            (squares[-1] - squares[2 * part], products[-1] - products[2 * part]),
            (squares[2 * part + 1], products[2 * part + 1]),
        )
        for part in range(PARTS)
    ]


def _chosen(stretch: Stretch, half: float) -> list[NDArray[np.bool_]]:
    """For each part the frames that softening mixes with it, and its own; then all."""
    near = np.ones(1 + 2 * int(np.ceil(half * stretch.clock.rate)))
    found = []
    for part in range(PARTS):
        asked = (stretch.said >= 0) & (stretch.said % PARTS == part)
        beside = np.convolve(asked, near)[len(near) // 2 :][: len(asked)] > 0
        found += [beside, asked]
    return [*found, np.ones(len(stretch.said), dtype=bool)]


def _missed(part: _Part, expected: Prior, keys: Ints) -> float:
    """What is missed of the frames that are asked for, less a constant."""
    count, (squares, products) = len(keys), part.learnt
    matrix = expected.matrix[keys]
    system = pulled(expected, matrix)
    system[:count, :count] += squares
    target = np.concatenate((products, expected.strength * expected.centre))
    found = np.clip(np.linalg.solve(system, target)[:count], 0.0, 1.0)
    squares, products = part.asked
    return float(found @ squares @ found - 2 * products @ found)
