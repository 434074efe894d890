"""The publication's five outputs: from a face, and back to poses; the one place for both.

Frank, Hoch, Trogemann, "The Face Model": the vowels /a/, /i/, /o,u/, the closing consonants
/b,m,p/, and /open/, each 0..1. Their animator set them by hand. Here they are read off
ARKit's shapes (L and R are the mean of both sides)::

    open   = n(jawOpen)
    o/u    = n(mouthPucker + mouthFunnel)
    spread = n(mouthStretch LR + mouthSmile LR + mouthDimple LR)
    press  = n(mouthClose + mouthPress LR + (mouthRollLower + mouthRollUpper) / 2)
    b/m/p  = press  (1 - open)
    i      = spread (1 - open)
    a      = open   (1 - max(o/u, spread))

where ``n`` brings a face's own range to 0..1: its 5th percentile to 0, its 99th to 1. Trackers
score one shape in hundredths and another in tenths; an animator uses the whole of each slider.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import InputError

Floats = NDArray[np.float64]

FIVE = ("a", "i", "o/u", "b/m/p", "open")
POSES = {"open": ("a", "open"), "wide": ("i",), "W": ("o/u",), "PBM": ("b/m/p",)}
"""The poses that play the five; of several, the greater counts."""
LOW, HIGH = 5, 99
"""Percentiles of a face's scores that become 0 and 1."""
STILL = 0.02
"""A range of scores below this is no movement: the output stays at 0."""

_SUMS: dict[str, dict[str, float]] = {
    "open": {"jawOpen": 1.0},
    "round": {"mouthPucker": 1.0, "mouthFunnel": 1.0},
    "spread": {
        f"mouth{name}{side}": 0.5
        for name in ("Stretch", "Smile", "Dimple")
        for side in ("Left", "Right")
    },
    "press": {
        "mouthClose": 1.0,
        "mouthPressLeft": 0.5,
        "mouthPressRight": 0.5,
        "mouthRollLower": 0.5,
        "mouthRollUpper": 0.5,
    },
}


@dataclass(frozen=True, slots=True, eq=False)
class FiveOfShapes:
    """How one face's shapes become the five.

    Parameters
    ----------
    channels : tuple of str
        Of the shapes, ARKit's names.
    low, high : (4,) float64
        What becomes 0 and 1 of opening, rounding, spreading and pressing.
    """

    channels: tuple[str, ...]
    low: Floats
    high: Floats

    @classmethod
    def fit(cls, channels: Sequence[str], values: NDArray[np.floating]) -> FiveOfShapes:
        """Find a face's range.

        Parameters
        ----------
        channels : sequence of str
        values : (T, C) float
            A stretch of its speech, 20 s or more.

        Raises
        ------
        InputError
            If there is no jawOpen among the channels, or it does not move.
        """
        if "jawOpen" not in channels:
            raise InputError(
                "no jawOpen among the controls", expected="ARKit's shapes, for the five outputs"
            )
        sums = _summed(channels, values)
        low, high = np.percentile(sums, (LOW, HIGH), axis=0)
        if high[0] - low[0] < STILL:
            raise InputError("jawOpen does not move", expected="a face that speaks")
        high = np.where(high - low < STILL, np.inf, high)
        return cls(tuple(channels), low, high)

    def five(self, values: NDArray[np.floating]) -> Floats:
        """Return the five of shapes (T, C): (T, 5), 0..1, in the order of :data:`FIVE`."""
        sums = _summed(self.channels, values)
        opening, rounding, spreading, pressing = np.clip(
            (sums - self.low) / (self.high - self.low), 0.0, 1.0
        ).T
        return np.stack(
            [
                opening * (1.0 - np.maximum(rounding, spreading)),
                spreading * (1.0 - opening),
                rounding,
                pressing * (1.0 - opening),
                opening,
            ],
            axis=1,
        )


def _summed(channels: Sequence[str], values: NDArray[np.floating]) -> Floats:
    """Return opening, rounding, spreading and pressing as they are scored, (T, 4)."""
    mix = np.zeros((len(channels), len(_SUMS)))
    for column, weights in enumerate(_SUMS.values()):
        for row, name in enumerate(channels):
            mix[row, column] = weights.get(name, 0.0)
    return np.asarray(np.asarray(values, np.float64) @ mix, np.float64)


def in_poses(values: NDArray[np.floating]) -> tuple[tuple[str, ...], Floats]:
    """Return poses and their weights, (T, 4), that play the five, (T, 5)."""
    columns = {name: np.asarray(values[:, place], np.float64) for place, name in enumerate(FIVE)}
    played = [np.maximum.reduce([columns[one] for one in names]) for names in POSES.values()]
    return tuple(POSES), np.stack(played, axis=1)
