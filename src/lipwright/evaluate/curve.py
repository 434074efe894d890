"""A measure of a mouth over time, and where it turns."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.curves import Floats, check_series

Ints = NDArray[np.intp]


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """One measure over time.

    Parameters
    ----------
    times : (T,) float64
        Seconds, increasing.
    values : (T,) float64
        In any unit.

    Raises
    ------
    InputError
        If the lengths differ, a number is not finite, or times do not increase.
    """

    times: Floats
    values: Floats

    def __post_init__(self) -> None:
        check_series(self.times, self.values, "value")

    def at(self, times: Floats) -> Floats:
        """Return the values at ``times``: linear in between, held outside."""
        return np.interp(times, self.times, self.values)

    def later(self, seconds: float) -> Curve:
        """Return the same curve, that much later."""
        return Curve(self.times + seconds, self.values)


def span(values: Floats) -> tuple[float, float]:
    """Return what values lie between, outliers left out: 5th and 95th percentile."""
    low, high = np.percentile(values, (5, 95))
    return float(low), float(high)


def turns(values: Floats, threshold: float) -> tuple[Ints, Ints]:
    """Return where values change direction by more than a threshold.

    A turn counts once the values have gone back by more than ``threshold`` from it: what
    trembles by less is no turn. Where values begin and end is none.

    Parameters
    ----------
    values : (T,) float64
    threshold : float
        In the values' unit.

    Returns
    -------
    highs, lows : (N,) int
        Places of the greatest and of the least values; one after the other in time.

    Examples
    --------
    >>> import numpy as np
    >>> turns(np.array([0.0, 1.0, 0.95, 1.0, 0.2, 0.3, 0.9]), 0.1)
    (array([1]), array([4]))
    """
    highs: list[int] = []
    lows: list[int] = []
    high = low = 0
    rising: bool | None = None
    for index, value in enumerate(values.tolist()):
        if value > values[high]:
            high = index
        if value < values[low]:
            low = index
        if rising is not False and values[high] - value > threshold:
            if rising:
                highs.append(high)
            rising, low = False, index
        elif rising is not True and value - values[low] > threshold:
            if rising is False:
                lows.append(low)
            rising, high = True, index
    return np.array(highs, dtype=np.intp), np.array(lows, dtype=np.intp)
