"""Principal components of motion (Cao et al. 2004, section 5.1)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Components:
    """A basis in which motion is kept.

    Parameters
    ----------
    mean : (C,) float64
        Mean of the channels.
    basis : (K, C) float64
        Orthonormal rows, that of the greatest variance first.
    variance : (K,) float64
        Variance along each row.
    total : float
        Variance of all channels.
    """

    mean: Floats
    basis: Floats
    variance: Floats
    total: float

    def project(self, values: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return (T, C) motion as (T, K) coefficients."""
        return ((values - self.mean) @ self.basis.T).astype(np.float32)


def components(
    pieces: Iterable[NDArray[np.float32]], keep: float = 0.95, least: int = 5
) -> Components:
    """Learn the components of motion.

    Parameters
    ----------
    pieces : iterable of (T, C) float32
        The takes; at least one frame in all.
    keep : float
        Share of the variance that the components keep, 0..1.
    least : int
        Fewest components; as many as there are channels where there are fewer.
    """
    count, total, products = 0, np.zeros(0), np.zeros((0, 0))
    shift: Floats | None = None
    for piece in pieces:
        # About a fixed point near the mean, sums of products lose no digits.
        shift = np.mean(piece, axis=0, dtype=np.float64) if shift is None else shift
        centred = piece - shift
        count += len(piece)
        total = centred.sum(axis=0) + (total if total.size else 0.0)
        products = centred.T @ centred + (products if products.size else 0.0)
    assert shift is not None
    offset = total / count
    covariance = products / count - np.outer(offset, offset)
    variance, vectors = np.linalg.eigh(covariance)
    variance = np.clip(variance[::-1], 0.0, None)
    rows = vectors.T[::-1]
    # An eigenvector's sign is free: the same one is taken every time.
    strongest = np.take_along_axis(rows, np.abs(rows).argmax(axis=1)[:, None], axis=1)
    rows = rows * np.where(strongest < 0, -1.0, 1.0)
    whole = float(variance.sum())
    kept = np.cumsum(variance) / whole if whole > 0 else np.ones(len(variance))
    number = min(len(variance), max(least, 1 + int(np.searchsorted(kept, keep - 1e-12))))
    return Components(shift + offset, rows[:number].copy(), variance[:number].copy(), whole)
