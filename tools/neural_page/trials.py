"""One trial: a net is taught some pieces and asked for others, in the publication's five."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural.five import FiveOfShapes
from lipwright.engines.neural.training import DECAY, HIDDEN, fit_network
from tools.neural_page.pieces import Piece

Floats = NDArray[np.float64]
Targets = Callable[[Piece], Floats]

WRONG = 0.25
"""An output that is off by more than a quarter of its range is one to correct."""


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """What a net gave, and what was wanted.

    Parameters
    ----------
    given, wanted : (T, 5) float64
    taught : (5,) float64
        The mean of what it was taught: what is known without any sound.
    """

    given: Floats
    wanted: Floats
    taught: Floats

    @property
    def rms(self) -> float:
        """Root mean square error of all outputs."""
        return float(np.sqrt(np.square(self.given - self.wanted).mean()))

    @property
    def unexplained(self) -> float:
        """Share of the outputs' variance about what was taught that is left: 0 perfect, 1 none."""
        left = np.square(self.given - self.wanted).sum()
        return float(left / np.square(self.wanted - self.taught).sum())

    @property
    def correlations(self) -> list[float]:
        """Of each output with what was wanted; 0 where one of them does not move."""
        pairs = zip(self.given.T, self.wanted.T, strict=True)
        return [
            float(np.corrcoef(a, b)[0, 1]) if a.std() > 1e-6 and b.std() > 1e-6 else 0.0
            for a, b in pairs
        ]

    def wrong(self, by: float = WRONG) -> float:
        """Share of frames in which some output is off by more."""
        return float((np.abs(self.given - self.wanted).max(axis=1) > by).mean())

    def wrong_values(self, by: float = WRONG) -> float:
        """Share of values, five a frame, that are off by more."""
        return float((np.abs(self.given - self.wanted) > by).mean())

    def wrong_at_rest(self, by: float = WRONG) -> float:
        """Share of frames that would be off if the mean of the training were held."""
        return float((np.abs(self.taught - self.wanted).max(axis=1) > by).mean())


def five_of(pieces: Sequence[Piece]) -> Targets:
    """Return how shapes become the five; the face's range is that of these pieces."""
    way = FiveOfShapes.fit(pieces[0].channels, np.concatenate([piece.shapes for piece in pieces]))
    return lambda piece: way.five(piece.shapes)


def trial(
    taught: Sequence[Piece],
    unseen: Sequence[Piece],
    *,
    hidden: int = HIDDEN,
    seed: int = 0,
    decay: float = DECAY,
    targets: Targets | None = None,
    lesson: Targets | None = None,
    wanted: Targets | None = None,
) -> Trial:
    """Teach a net and try it.

    Parameters
    ----------
    taught, unseen : sequence of Piece
    hidden, seed : int
    decay : float
        See :func:`~lipwright.engines.neural.training.fit_network`.
    targets : function, optional
        From a piece to what is to be shown, (T, 5); the five of its face if not given.
    lesson, wanted : function, optional
        Of what is taught and of what is asked for, where these are not alike.
    """
    own = targets or five_of(taught)
    lesson, wanted = lesson or own, wanted or own
    heard = np.concatenate([piece.heard for piece in taught])
    shown = np.concatenate([lesson(piece) for piece in taught])
    network = fit_network(heard, shown, [hidden], seed, decay=decay)
    given = np.clip(network(np.concatenate([piece.heard for piece in unseen])), 0.0, 1.0)
    return Trial(given, np.concatenate([wanted(piece) for piece in unseen]), shown.mean(axis=0))


def mean_of(figures: Sequence[float]) -> float:
    """Return the mean of some draws."""
    return float(np.mean(figures))
