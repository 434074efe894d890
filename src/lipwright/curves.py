"""Curves over time: piecewise-linear keys, and animations sampled at a rate.

Keys are what artists draw and what the bigram stages work on; an
:class:`~lipwright.animation.Animation` is what an engine returns. This module holds the
keys. It reads and writes nothing.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lipwright.errors import InputError

Floats = NDArray[np.float64]


def check_series(times: Floats, values: Floats, what: str) -> None:
    """Refuse values over time that make no sense; ``what`` names one of them.

    Raises
    ------
    InputError
        If the lengths differ, a number is not finite, or times do not increase.
    """
    if times.ndim != 1 or times.shape != values.shape:
        raise InputError(
            f"{times.shape} times and {values.shape} values", expected="as many values as times"
        )
    # A set has thousands of curves: what is right must be seen in a few calls.
    if not (np.isfinite(times).all() and np.isfinite(values).all()):
        raise InputError(f"a {what} is not finite", expected="finite numbers")
    rising = times[1:] > times[:-1]
    if not rising.all():
        late = int(rising.argmin()) + 1
        raise InputError(
            f"{what} {late + 1} at {times[late]:.6g} does not come after the one before it",
            expected="times that increase",
        )


@dataclass(frozen=True, slots=True, eq=False)
class Keys:
    """A piecewise-linear curve; zero outside its keys.

    Parameters
    ----------
    times : (N,) float64
        Strictly increasing; seconds, or a share of a bigram's span.
    values : (N,) float64
        Weights at these times.

    Raises
    ------
    InputError
        If the lengths differ, a number is not finite, or times do not increase.

    Examples
    --------
    >>> Keys.of([(0, 0), (1, 1), (2, 0)]).at([0.5, 1.0, 3.0])
    array([0.5, 1. , 0. ])
    """

    times: Floats
    values: Floats

    def __post_init__(self) -> None:
        check_series(self.times, self.values, "key")

    @classmethod
    def of(cls, pairs: ArrayLike) -> Keys:
        """Build keys from ``(time, value)`` pairs."""
        array = np.asarray(pairs, dtype=np.float64).reshape(-1, 2)
        return cls(array[:, 0].copy(), array[:, 1].copy())

    def __len__(self) -> int:
        return len(self.times)

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Keys)
            and np.array_equal(self.times, other.times)
            and np.array_equal(self.values, other.values)
        )

    def __hash__(self) -> int:
        return hash((self.times.tobytes(), self.values.tobytes()))

    def at(self, times: ArrayLike) -> Floats:
        """Return the values at ``times``, zero outside the keys."""
        where = np.asarray(times, dtype=np.float64)
        if not len(self.times):
            return np.zeros_like(where)
        return np.interp(where, self.times, self.values, left=0.0, right=0.0)

    def pairs(self) -> list[tuple[float, float]]:
        """Return the keys as ``(time, value)`` pairs."""
        return list(zip(self.times.tolist(), self.values.tolist(), strict=True))


def reduced(times: ArrayLike, values: ArrayLike, tolerance: float) -> Keys:
    """Return the few keys of a curve that keep it within a tolerance at every sample.

    The sample farthest from the line between two keys becomes a key, and again on both sides
    of it (Ramer 1972; Douglas, Peucker 1973), with distance measured in value.

    Parameters
    ----------
    times : (N,) float
        Increasing.
    values : (N,) float
    tolerance : float
        The farthest that a sample may lie from the keys' curve.

    Examples
    --------
    >>> reduced([0, 1, 2, 3, 4], [0, 0.5, 1, 0.5, 0], 0.01).pairs()
    [(0.0, 0.0), (2.0, 1.0), (4.0, 0.0)]
    """
    at, sought = np.asarray(times, np.float64), np.asarray(values, np.float64)
    last = len(at) - 1
    kept = {0, last} if last >= 0 else set()
    open_spans = [(0, last)]
    while open_spans:
        low, high = open_spans.pop()
        if high - low < 2:
            continue
        inside = slice(low + 1, high)
        line = np.interp(at[inside], at[[low, high]], sought[[low, high]])
        apart = np.abs(sought[inside] - line)
        far = int(apart.argmax())
        if apart[far] > tolerance:
            middle = low + 1 + far
            kept.add(middle)
            open_spans += [(low, middle), (middle, high)]
    chosen = sorted(kept)
    return Keys(at[chosen], sought[chosen])
