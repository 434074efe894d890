"""The live nets at work: convolutions over time, exact on any machine.

Weights are whole multiples of 2⁻¹², what layers pass on are whole multiples of 2⁻¹⁰ and
bounded. So every product and every sum of a layer fits a double without rounding, and the
order in which a machine sums cannot change a bit: frames one at a time, a thousand at once,
another processor, another library of linear algebra give the same.

Their shape is that of temporal convolutional networks (Bai, Kolter & Koltun 2018): each block
hears three instants, farther apart from block to block, and adds to what passes by: to the
newest of the three in a net that only looks back, to the middle one in a net that may wait.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Memory: TypeAlias = list[Floats]
"""What a net keeps of the past: for each block the inputs that it will hear again."""

WEIGHT_STEP = 2.0**-12
STEP = 2.0**-10
MOST = 63.0
"""What a unit passes on lies within ± this; wider nets are refused by :data:`WIDEST`."""
GREATEST = 128.0
"""A weight lies within ± this."""
WIDEST = 4096
"""Inputs to a unit: 2^12 products of 19 and 16 bits are sums of 47 bits; a double has 53."""


@dataclass(frozen=True, slots=True, eq=False)
class Affine:
    """A layer's weights and biases, on the grid of :data:`WEIGHT_STEP`.

    Parameters
    ----------
    weights : (I, O) float64
    bias : (O,) float64
    """

    weights: Floats
    bias: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Block:
    """Three instants ``dilation`` frames apart, through units, added to one of them.

    Parameters
    ----------
    dilation : int
    taps : Affine
        ``3 C`` inputs, the earliest instant first, to ``C`` units.
    back : Affine
        From the units to what is added.
    centred : bool
        Whether it is added to the middle instant; else to the newest.
    """

    dilation: int
    taps: Affine
    back: Affine
    centred: bool = False

    @property
    def reach(self) -> int:
        """How many frames back it hears."""
        width = len(self.taps.bias)
        return self.dilation * (len(self.taps.weights) // width - 1)


@dataclass(frozen=True, slots=True, eq=False)
class Convolutions:
    """The net without its last layer.

    Parameters
    ----------
    first : Affine
        From a frame's stacked bands to ``C`` units.
    blocks : tuple of Block
    """

    first: Affine
    blocks: tuple[Block, ...]

    @property
    def units(self) -> int:
        """How many numbers a frame becomes: C."""
        return len(self.first.bias)

    @property
    def reach(self) -> int:
        """How many frames back the net hears."""
        return sum(block.reach for block in self.blocks)

    @property
    def delay(self) -> int:
        """How many frames before the newest lies the one that the net speaks of."""
        return sum(block.dilation for block in self.blocks if block.centred)

    def rest(self) -> Memory:
        """Return the memory of a net that has heard nothing yet."""
        return [np.zeros((block.reach, self.units)) for block in self.blocks]

    def settled(self) -> Memory:
        """Return the memory of a net that has heard silence for as long as it remembers."""
        memory = self.rest()
        self(np.zeros((self.reach + 1, len(self.first.weights))), memory)
        return memory

    def __call__(self, heard: Floats, memory: Memory) -> Floats:
        """Return what the net makes of further frames.

        Parameters
        ----------
        heard : (T, I) float64
            On the grid: see :func:`on_grid`.
        memory : Memory
            Of the frames before; changed in place.

        Returns
        -------
        (T, C) float64
            0 or more.
        """
        passing = np.maximum(_through(self.first, [heard]), 0.0)
        for number, block in enumerate(self.blocks):
            known = np.concatenate([memory[number], passing])
            memory[number] = known[len(passing) :]
            instants = [
                known[start : start + len(passing)]
                for start in range(0, block.reach + 1, block.dilation)
            ]
            units = np.maximum(_through(block.taps, instants), 0.0)
            if block.centred:
                passing = instants[len(instants) // 2]
            passing = _bounded(passing + _through(block.back, [units]))
        return np.maximum(passing, 0.0)


def on_grid(values: Floats) -> Floats:
    """Return values as the net takes them: multiples of :data:`STEP`, bounded."""
    return _bounded(np.rint(values / STEP) * STEP)


def applied(layer: Affine, values: Floats) -> Floats:
    """Return what a layer makes of values on the grid: exact sums, not yet rounded."""
    return np.asarray(values @ layer.weights + layer.bias)


def _through(layer: Affine, parts: Sequence[Floats]) -> Floats:
    """Return what a layer makes of values that lie side by side, on the grid."""
    width = len(layer.weights) // len(parts)
    total = parts[0] @ layer.weights[:width] + layer.bias
    for number, part in enumerate(parts[1:], 1):
        total += part @ layer.weights[number * width : (number + 1) * width]
    total /= STEP
    np.rint(total, out=total)
    total *= STEP
    return _bounded(total)


def _bounded(values: Floats) -> Floats:
    return np.asarray(np.clip(values, -MOST, MOST))
