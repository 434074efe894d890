"""The levels of one pose's curves that reproduce the recordings through the engine.

Fitting by synthesis: what is compared with a recording is what the engine makes of the
curves, the larger of two bigrams at each instant, bounded and softened. Where it is known
which bigram is the larger, that is linear in the levels; so bigrams are chosen, levels are
solved, and again. Frames far from anything that curves can do count less (Huber 1964).

Levels are pulled towards what :mod:`~lipwright.engines.bigram.fit.prior` expects of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.bigram.fit.prior import Prior
from lipwright.engines.bigram.fit.stretches import Floats, Ints, Stretch

ROUNDS = 5
STEP = 0.7
FAR = 3.0
"""Frames that differ by more than this many times the usual count less."""

Bools = NDArray[np.bool_]
Room = tuple[tuple[int, float], ...]


@dataclass(slots=True, eq=False)
class Problem:
    """One pose's levels, to be found.

    Parameters
    ----------
    stretches : sequence of Stretch
    wanted : sequence of (F,) float64
        For each stretch the weights to be reached.
    room : tuple of (int, float)
        Poses of ``above`` that bound this one, each with its threshold C.
    half : float
        Half-width of the softening, seconds.
    """

    stretches: Sequence[Stretch]
    wanted: Sequence[Floats]
    room: Room
    half: float

    def evidence(self, levels: Floats, keys: Ints) -> tuple[Floats, Floats, float]:
        """Return the normal equations of the used levels, and the mean square that is left.

        Parameters
        ----------
        levels : (N,) float64
            All levels as they are now: they decide which bigram is the larger.
        keys : (K,) int
            Those that are used.
        """
        place = np.full(len(levels), -1, dtype=np.int64)
        place[keys] = np.arange(len(keys))
        squares, products = np.zeros((len(keys), len(keys))), np.zeros(len(keys))
        rows = [
            self.rows(stretch, wanted, levels)
            for stretch, wanted in zip(self.stretches, self.wanted, strict=True)
        ]
        left = np.concatenate([found[2] for found in rows])
        usual = float(np.sqrt(np.mean(left**2)))
        for stretch, (matrix, wanted, rest) in zip(self.stretches, rows, strict=True):
            weight = FAR * usual / np.maximum(np.abs(rest), FAR * usual + 1e-12)
            weighed = matrix * weight[:, None]
            own = place[stretch.keys]
            squares[np.ix_(own, own)] += matrix.T @ weighed
            products[own] += weighed.T @ wanted
        return squares, products, usual

    def rows(
        self, stretch: Stretch, frames: Floats, levels: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """How frames depend on the levels, what is wanted of them, and how far off it is."""
        own = levels[stretch.keys]
        lanes, room = self._lanes(stretch, own)
        instants = np.arange(lanes.shape[1])
        lane = lanes.argmax(axis=0)
        free = lanes[lane, instants] <= room
        shares = np.zeros((len(instants), len(own)))
        for side in (0, 1):
            near = stretch.near[lane, instants, side]
            shares[instants, near] += stretch.share[lane, instants, side] * free
        matrix = stretch.clock.soften(shares, self.half)
        wanted = frames - stretch.clock.soften(np.where(free, 0.0, room), self.half)
        return matrix, wanted, wanted - matrix @ own

    def made(self, levels: Floats) -> list[Floats]:
        """Return what the engine makes of levels, for each stretch (F,)."""
        found = []
        for stretch in self.stretches:
            lanes, room = self._lanes(stretch, levels[stretch.keys])
            curve = np.minimum(lanes.max(axis=0), room)
            found.append(stretch.clock.soften(curve, self.half))
        return found

    def _lanes(self, stretch: Stretch, own: Floats) -> tuple[Floats, Floats]:
        """The curves of even and of odd bigrams, and what other poses leave to them."""
        lanes = (own[stretch.near] * stretch.share).sum(axis=2)
        room = np.full(lanes.shape[1], np.inf)
        for above, threshold in self.room:
            room = np.minimum(room, np.maximum(1 - stretch.above[above] / threshold, 0.0))
        return lanes, room


@dataclass(frozen=True, slots=True, eq=False)
class Found:
    """What a fit finds for one pose.

    Parameters
    ----------
    levels : (N,) float64
        Of all pairs.
    causes : (Q,) float64
        What they are pulled towards: the base set's gain, and each phone's deviations.
    rms : float
        Of the difference that remains, in weights.
    """

    levels: Floats
    causes: Floats
    rms: float


def solve_causes(problem: Problem, expected: Prior, keys: Ints) -> Found:
    """Fit gain and phones alone: every pair is what they make of it."""
    causes, matrix, rms = expected.centre.copy(), expected.matrix[keys], 0.0
    for _ in range(3):
        squares, products, rms = problem.evidence(expected.levels(causes), keys)
        squares = matrix.T @ squares @ matrix + np.diag(expected.strength)
        products = matrix.T @ products + expected.strength * expected.centre
        causes = np.asarray(np.linalg.solve(squares, products), dtype=np.float64)
    return Found(expected.levels(causes), causes, rms)


def solve_levels(problem: Problem, expected: Prior, keys: Ints, start: Found) -> Found:
    """Fit the levels of the pairs together with gain and phones.

    Parameters
    ----------
    problem : Problem
    expected : Prior
    keys : (K,) int
        Levels that the takes show.
    start : Found
        Where to begin.
    """
    count, matrix = len(keys), expected.matrix[keys]
    levels, causes = start.levels.copy(), start.causes.copy()
    best: tuple[float, Found] | None = None
    frames = sum(len(stretch.frames) for stretch in problem.stretches)
    bounded = np.arange(count + len(causes)) < count
    pull = pulled(expected, matrix)
    for _ in range(ROUNDS):
        squares, products, rms = problem.evidence(levels, keys)
        apart, off = levels[keys] - matrix @ causes, causes - expected.centre
        cost = frames * rms**2 + expected.pair * float(apart @ apart)
        cost += float(off @ (expected.strength * off))
        if best is None or cost < best[0]:
            best = cost, Found(levels.copy(), causes.copy(), rms)
        system = pull.copy()
        system[:count, :count] += squares
        target = np.concatenate((products, expected.strength * expected.centre))
        now = np.concatenate((levels[keys], causes))
        moved = now + STEP * (in_range(system, target, now, bounded) - now)
        causes = moved[count:]
        levels = expected.levels(causes)
        levels[keys] = moved[:count]
    assert best is not None
    return best[1]


def pulled(expected: Prior, matrix: Floats) -> Floats:
    """Return what pulls levels to causes, and causes to their centre, (K + Q, K + Q).

    Parameters
    ----------
    expected : Prior
    matrix : (K, Q) float64
        Its rows for the levels that are sought.
    """
    pull = expected.pair
    corner = pull * matrix.T @ matrix + np.diag(expected.strength)
    return np.block([[pull * np.eye(len(matrix)), -pull * matrix], [-pull * matrix.T, corner]])


def in_range(
    squares: Floats, products: Floats, start: Floats, bounded: Bools, rounds: int = 6
) -> Floats:
    """Minimise ``x' A x / 2 - b' x`` with some x in 0..1, by an active set.

    Parameters
    ----------
    squares : (N, N) float64
        A, positive definite.
    products : (N,) float64
        b.
    start : (N,) float64
        What lies at an end of the range is held there until it pulls away from it.
    bounded : (N,) bool
        Which x must lie in 0..1.
    rounds : int
        At most.
    """
    x = start.copy()
    free = ~bounded | ((x > 0) & (x < 1))
    for _ in range(rounds):
        pull = products - squares @ x
        free |= ((x <= 0) & (pull > 0)) | ((x >= 1) & (pull < 0))
        held = ~free
        rest = products[free] - squares[np.ix_(free, held)] @ x[held]
        x[free] = np.linalg.solve(squares[np.ix_(free, free)], rest)
        outside = bounded & ((x < 0) | (x > 1))
        x[bounded] = np.clip(x[bounded], 0.0, 1.0)
        if not outside.any():
            break
        free &= ~outside
    return x
