"""The levels of one pose's curves that reproduce the recordings through the engine.

Fitting by synthesis: what is compared with a recording is what the engine makes of the
curves, the larger of two bigrams at each instant, bounded and softened. Where it is known
which bigram is the larger, that is linear in the levels; so bigrams are chosen, levels are
solved, and again. Frames far from anything that curves can do count less (Huber 1964).

A level is pulled towards what its phones do in all their pairs, and a phone's own levels
faintly towards the base set's: what no take shows stays as it was.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lipwright.engines.bigram.fit.stretches import LEVELS, Floats, Ints, Stretch

PULL = 3.0
"""How many frames' evidence a level's phones are worth."""
FAINT = 0.1
"""The same of the base set."""
ROUNDS = 7
STEP = 0.7
FAR = 3.0
"""Frames that differ by more than this many times the usual count less."""

Room = tuple[tuple[int, float], ...]


def phones_to_levels(count: int) -> Floats:
    """Return the matrix from phones' own levels to those of all pairs.

    Parameters
    ----------
    count : int
        How many classes there are.

    Returns
    -------
    (3 * count^2, 3 * count) float64
        A phone's levels are those where it begins, in its middle, and where it ends; at a
        boundary two phones have equal say.
    """
    made = np.zeros((count, count, LEVELS, count, LEVELS))
    for one in range(count):
        made[one, :, 0, one, 1] = 1.0
        made[one, :, 1, one, 2] = 0.5
        made[:, one, 2, one, 1] = 1.0
        made[:, one, 1, one, 0] += 0.5
    return made.reshape(LEVELS * count * count, LEVELS * count)


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
            self._rows(stretch, wanted, levels)
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

    def _rows(
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
    phones : (P,) float64
        The phones' own.
    rms : float
        Of the difference that remains, in weights.
    """

    levels: Floats
    phones: Floats
    rms: float


def solve_phones(problem: Problem, spread: Floats, keys: Ints, base: Floats) -> Found:
    """Fit phones' own levels alone: every pair is what its two phones are."""
    phones, matrix, rms = base.copy(), spread[keys], 0.0
    for _ in range(3):
        squares, products, rms = problem.evidence(spread @ phones, keys)
        squares = matrix.T @ squares @ matrix + FAINT * np.eye(len(base))
        phones = in_range(squares, matrix.T @ products + FAINT * base, phones)
    return Found(spread @ phones, phones, rms)


def solve_levels(problem: Problem, spread: Floats, keys: Ints, start: Found, base: Floats) -> Found:
    """Fit the levels of the pairs and of their phones together.

    Parameters
    ----------
    problem : Problem
    spread : (N, P) float64
        From :func:`phones_to_levels`.
    keys : (K,) int
        Levels that the takes show.
    start : Found
        Where to begin.
    base : (P,) float64
        The phones' levels in the base set.
    """
    count, own = len(keys), spread[keys]
    levels, phones = start.levels.copy(), start.phones.copy()
    best: tuple[float, Found] | None = None
    frames = sum(len(stretch.frames) for stretch in problem.stretches)
    for _ in range(ROUNDS):
        squares, products, rms = problem.evidence(levels, keys)
        apart = levels[keys] - own @ phones
        cost = frames * rms**2 + PULL * float(apart @ apart)
        if best is None or cost < best[0]:
            best = cost, Found(levels.copy(), phones.copy(), rms)
        system = np.zeros((count + len(base), count + len(base)))
        system[:count, :count] = squares + PULL * np.eye(count)
        system[:count, count:] = -PULL * own
        system[count:, :count] = -PULL * own.T
        system[count:, count:] = PULL * own.T @ own + FAINT * np.eye(len(base))
        target = np.concatenate((products, FAINT * base))
        now = np.concatenate((levels[keys], phones))
        moved = now + STEP * (in_range(system, target, now) - now)
        phones = moved[count:]
        levels = spread @ phones
        levels[keys] = moved[:count]
    assert best is not None
    return best[1]


def in_range(squares: Floats, products: Floats, start: Floats, rounds: int = 6) -> Floats:
    """Minimise ``x' A x / 2 - b' x`` with every x in 0..1, by an active set.

    Parameters
    ----------
    squares : (N, N) float64
        A, positive definite.
    products : (N,) float64
        b.
    start : (N,) float64
        What lies at an end of the range is held there until it pulls away from it.
    rounds : int
        At most.
    """
    x = start.copy()
    free = (x > 0) & (x < 1)
    for _ in range(rounds):
        pull = products - squares @ x
        free |= ((x <= 0) & (pull > 0)) | ((x >= 1) & (pull < 0))
        held = ~free
        rest = products[free] - squares[np.ix_(free, held)] @ x[held]
        x[free] = np.linalg.solve(squares[np.ix_(free, free)], rest)
        outside = (x < 0) | (x > 1)
        x = np.clip(x, 0.0, 1.0)
        if not outside.any():
            break
        free &= ~outside
    return x
