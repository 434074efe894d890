"""A layout of markers: where they lie on the recorded face, and how they move.

Its axes are those of the recording, which nobody states. What tells them is the layout
itself: a face bulges to the front, and what moves most is its lower part, which an opening
mouth takes down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import InputError
from lipwright.markers import marker_labels

Floats = NDArray[np.float64]

FEWEST = 8
"""Markers; fewer do not tell how a face lies."""
_STILL = 1e-4
_MOST = 0.95


@dataclass(frozen=True, eq=False)
class MarkerLayout:
    """Markers on a recorded face.

    Parameters
    ----------
    labels : tuple of str
        M names.
    rest : (M, 3) float64, metres
        The face at rest.
    mean : (M, 3) float64, metres
        The mean displacement from rest.
    basis : (K, M, 3) float64
        The components of motion about the mean.
    variance : (K,) float64
        Of each component's coefficients.
    where : str
        Of which database, in errors.
    """

    labels: tuple[str, ...]
    rest: Floats
    mean: Floats
    basis: Floats
    variance: Floats
    where: str = "markers"

    def __post_init__(self) -> None:
        if len(self.labels) < FEWEST:
            raise InputError(
                f"{len(self.labels)} markers", where=self.where, expected=f"{FEWEST} or more"
            )
        numbers = (self.rest, self.mean, self.basis, self.variance)
        if not all(np.isfinite(each).all() for each in numbers):
            raise InputError("a place that is no finite number", where=self.where)
        if not np.linalg.svd(self.rest - self.rest.mean(axis=0), compute_uv=False)[1] > 1e-3:
            raise InputError("markers at one place or in one line", where=self.where)
        if float(np.linalg.norm(self.opening, axis=1).max()) < _STILL:
            raise InputError("markers that do not move", where=self.where)

    @classmethod
    def of(
        cls,
        channels: Sequence[str],
        rest: Floats,
        mean: Floats,
        basis: Floats,
        variance: Floats,
        where: str = "markers",
    ) -> MarkerLayout:
        """Return the layout of a database's channels.

        Parameters
        ----------
        channels : sequence of str
            ``"chin.x", "chin.y", "chin.z", …``
        rest : (M, 3) float64, metres
        mean : (3 M,) float64, metres
        basis : (K, 3 M) float64
        variance : (K,) float64
        where : str
        """
        labels = marker_labels(channels)
        places = (len(labels), 3)
        return cls(
            labels,
            np.asarray(rest, np.float64).reshape(places),
            np.asarray(mean, np.float64).reshape(places),
            np.asarray(basis, np.float64).reshape(-1, *places),
            np.asarray(variance, np.float64),
            where,
        )

    @cached_property
    def opening(self) -> Floats:
        """The motion that there is most of, away from rest, (M, 3), one standard step of it."""
        moves = np.concatenate(
            [self.mean[None], np.sqrt(self.variance)[:, None, None] * self.basis]
        ).reshape(1 + len(self.basis), -1)
        _, sizes, ways = np.linalg.svd(moves, full_matrices=False)
        way = sizes[0] * ways[0].reshape(-1, 3)
        return np.asarray(way if float((way * self.mean).sum()) >= 0 else -way)

    @cached_property
    def axes(self) -> Floats:
        """A first guess of the head's left, up and front, as rows (3, 3)."""
        front = _bulge(self.rest)
        sizes = np.linalg.norm(self.opening, axis=1) ** 2
        low = np.average(self.rest, axis=0, weights=sizes) - self.rest.mean(axis=0)
        moved = sizes @ (self.opening / (np.linalg.norm(self.opening, axis=1)[:, None] + 1e-12))
        # Where most moves lies below; which way it moves says more of how upright the head is.
        low -= front * (low @ front)
        moved -= front * (moved @ front)
        down = moved / (np.linalg.norm(moved) or 1.0)
        down = down if down @ low >= 0 else -down
        up = -down
        return np.stack([np.cross(up, front), up, front])

    @cached_property
    def lowered(self) -> Floats:
        """How much each marker goes down as the mouth opens, (M,), 0..1."""
        down = -(self.opening @ self.axes[1])
        down = down if down[np.argmax(np.abs(down))] > 0 else -down
        most = float(np.quantile(down, _MOST)) or float(down.max())
        return np.asarray(np.clip(down / most, 0.0, 1.0))


def _bulge(points: Floats) -> Floats:
    """Return where a shell of points bulges: away from the middle of the sphere through them.

    The side is the sphere's; of a shallow shell its own plane tells the direction better.
    """
    middle = points.mean(axis=0)
    offset = points - middle
    system = np.concatenate([2 * offset, np.ones((len(points), 1))], axis=1)
    found = np.linalg.lstsq(system, (offset**2).sum(axis=1), rcond=1e-3)[0]
    flat = np.linalg.svd(offset, full_matrices=False)[2][2]
    away = -found[:3] / (np.linalg.norm(found[:3]) or 1.0)
    way = flat if flat @ away >= 0 else -flat
    mixed = way + away
    return np.asarray(mixed / np.linalg.norm(mixed))
