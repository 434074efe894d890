"""What is expected of the levels of pairs before any take is looked at.

A level is expected to be the base set's, times a gain that all pairs of a pose share, moved
by what its phones do in all their pairs. So a pair that few takes show, or none, keeps how
the base set lets neighbours show through, and takes what is this speaker's from its phones.
A phone shown in one word only would take that word's context as its own: phones are pulled
towards the base more strongly than a pair is pulled towards its phones.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lipwright.engines.bigram.fit.stretches import LEVELS, Floats, Pairs, places
from lipwright.engines.bigram.model import BigramSet
from lipwright.engines.bigram.stand_in import stand_in
from lipwright.phones import SILENCE

PAIR, PHONE, GAIN = 3.0, 10.0, 10.0
"""How many frames' evidence these are worth: that a pair is what its phones make of it, that
a phone is as the base has it, and that the pose is as strong as there."""


@dataclass(frozen=True, slots=True, eq=False)
class Prior:
    """Levels as ``matrix @ causes``: a gain of the base, and deviations of each phone.

    Parameters
    ----------
    matrix : (N, Q) float64
        From causes to the levels of all pairs.
    centre : (Q,) float64
        What is expected of the causes.
    strength : (Q,) float64
        How many frames' evidence that is worth.
    pair : float
        The same of a level against what its causes make of it.
    """

    matrix: Floats
    centre: Floats
    strength: Floats
    pair: float = PAIR

    def levels(self, causes: Floats) -> Floats:
        """Return the levels of all pairs, (N,), in 0..1."""
        return np.clip(self.matrix @ causes, 0.0, 1.0)


def prior(base: BigramSet, pairs: Pairs, pose: str) -> Prior:
    """Return what is expected of one pose."""
    spread = phones_to_levels(len(pairs.labels))
    own = spread.shape[1]
    return Prior(
        np.column_stack((levels_of(base, pairs, pose), spread)),
        np.concatenate(([1.0], np.zeros(own))),
        np.concatenate(([GAIN], np.full(own, PHONE))),
    )


def levels_of(base: BigramSet, pairs: Pairs, pose: str) -> Floats:
    """Return the levels of all pairs in a set, (3 * C^2,); silence with itself has none."""
    count = len(pairs.labels)
    levels = np.zeros((count, count, LEVELS))
    for row, first in enumerate(pairs.labels):
        for column, second in enumerate(pairs.labels):
            if (first, second) != (SILENCE, SILENCE):
                bigram = base.bigrams.get((first, second)) or stand_in(base, (first, second))
                keys = bigram.curves.get(pose)
                if keys is not None:
                    levels[row, column] = keys.at(places(bigram.boundary)[1:-1])
    return levels.ravel()


def phones_of(levels: Floats, count: int) -> Floats:
    """Return phones' own levels, (3 * C,), as the mean over all their pairs.

    Parameters
    ----------
    levels : (3 * C^2,) float64
    count : int
        C, how many classes there are.
    """
    of = levels.reshape(count, count, LEVELS)
    begins = of[:, :, 1].mean(axis=0)
    middle = np.concatenate((of[:, :, 0], of[:, :, 2].T), axis=1).mean(axis=1)
    ends = of[:, :, 1].mean(axis=1)
    return np.stack((begins, middle, ends), axis=1).ravel()


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
