"""The recordings beside the project that measures are taken on, and how they are compared."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright.phones import PhoneTrack

DATA = Path(__file__).parents[1] / ".." / "shared" / "data"
Samples = NDArray[np.float32]


def is_damaged(samples: Samples) -> bool:
    """Whether bytes were lost in the file, which turns what follows into loud noise."""
    return bool(np.mean(np.abs(samples) > 0.5) > 0.01)


def starts(track: PhoneTrack) -> list[tuple[str, float]]:
    """Labels and starts of the phones that are not silence."""
    return [(phone.label, phone.start) for phone in track if phone.label != "sil"]


def matched(one: list[tuple[str, float]], other: list[tuple[str, float]]) -> list[float]:
    """Differences in start of phones that edit distance pairs with their like, seconds."""
    rows, columns = len(one), len(other)
    cost = np.zeros((rows + 1, columns + 1))
    cost[:, 0], cost[0, :] = np.arange(rows + 1), np.arange(columns + 1)
    for i in range(rows):
        for j in range(columns):
            change = cost[i, j] + (one[i][0] != other[j][0])
            cost[i + 1, j + 1] = min(change, cost[i, j + 1] + 1, cost[i + 1, j] + 1)
    pairs = []
    i, j = rows, columns
    while i and j:
        same = one[i - 1][0] == other[j - 1][0]
        if cost[i, j] == cost[i - 1, j - 1] + (not same):
            i, j = i - 1, j - 1
            if same:
                pairs.append(one[i][1] - other[j][1])
        elif cost[i, j] == cost[i - 1, j] + 1:
            i -= 1
        else:
            j -= 1
    return pairs
