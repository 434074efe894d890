"""How unusual each unit is: its motion beside that of all units of its phone and neighbours.

One recording of a phone has a speaker's chance in it. Of units that fit equally well, the
one that moves as most do is the likeliest. What most do is the mean over units of the same
phone between the same neighbours; the fewer there are of them, the more it is drawn to the
mean of those with one neighbour in common, and of the phone alone.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

POINTS = 5
"""At how many instants, at even shares of a unit's time, motion is compared."""
FAITH = 3.0
"""How many units the wider mean counts for."""


def unusual(
    points: NDArray[np.floating], label: NDArray[np.integer], take: NDArray[np.integer]
) -> NDArray[np.float32]:
    """Return how far each unit moves from what is usual.

    Parameters
    ----------
    points : (U, P, K) float
        The motion of units at P instants each.
    label, take : (U,) int

    Returns
    -------
    (U,) float32
        The root mean square distance, in the unit of ``points``.
    """
    rows = np.asarray(points, np.float64).reshape(len(points), -1)
    own = np.asarray(label, np.int64) + 1
    joined = np.asarray(take)[1:] == np.asarray(take)[:-1]
    before, after = np.zeros_like(own), np.zeros_like(own)
    before[1:][joined] = own[:-1][joined]
    after[:-1][joined] = own[1:][joined]
    many = int(own.max(initial=0)) + 1
    alone = _means(own, rows, np.broadcast_to(rows.mean(axis=0), rows.shape))
    left = _means(own * many + before, rows, alone)
    right = _means(own * many + after, rows, alone)
    usual = _means((own * many + before) * many + after, rows, left + right - alone)
    away = ((rows - usual) ** 2).sum(axis=1) / points.shape[1]
    found: NDArray[np.float32] = np.sqrt(away).astype(np.float32)
    return found


def _means(keys: NDArray[np.int64], rows: Floats, wider: Floats) -> Floats:
    """The mean of the rows with each key, drawn to what is given for each row."""
    _, group, count = np.unique(keys, return_inverse=True, return_counts=True)
    group = group.ravel()
    sums = np.stack([np.bincount(group, column) for column in rows.T], axis=1)
    found: Floats = (sums[group] + FAITH * wider) / (count[group] + FAITH)[:, None]
    return found
