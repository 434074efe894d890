"""A live model with a handful of random weights: what a stream promises holds for any net."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from lipwright.engines.neural import mel
from lipwright.engines.neural.convolution import WEIGHT_STEP, Affine, Block, Convolutions
from lipwright.engines.neural.live_model import STACKED, Closing, LiveModel

UNITS = 8


def tiny(
    seed: int = 0, *, ahead: int = 1, both_ways: bool = False, centred: bool = False
) -> LiveModel:
    """A net of two blocks that gives ``open`` and ``PBM``."""
    rng = np.random.default_rng(seed)

    def affine(inputs: int, units: int) -> Affine:
        def grid(values: np.ndarray) -> np.ndarray:
            return np.asarray(np.rint(values / WEIGHT_STEP) * WEIGHT_STEP)

        weights = rng.normal(0, 2 * inputs**-0.5, (inputs, units))
        return Affine(grid(weights), grid(rng.normal(0, 0.3, units)))

    blocks = tuple(
        Block(d, affine(3 * UNITS, UNITS), affine(UNITS, UNITS), centred) for d in (1, 3)
    )
    return LiveModel(
        ("open", "PBM"),
        np.zeros(2),
        np.ones(2),
        Convolutions(affine(STACKED * mel.BANDS, UNITS), blocks),
        ahead,
        both_ways,
        mel.DEPTH,
        0,
        (-2, 0),
        (-1, 0),
        (affine(2 * UNITS + 2 * mel.BANDS, 5), affine(5, 2)),
        True,
        affine(UNITS, 1),
        affine(UNITS, 1),
        Closing("PBM", {"open": 0.0}, 0.4, 0.7),
        {"seconds": 0.0, "sounds": 0, "error": 0.0, "constant": [], "notes": []},
    )


def without_closing(model: LiveModel) -> LiveModel:
    """The same net, closures not shown."""
    return replace(model, closed=None, closing=None)


def voice(seconds: float, rate: int = 16000, seed: int = 0) -> np.ndarray:
    """Something that changes as speech does: a buzz that comes and goes, and some hiss."""
    rng = np.random.default_rng(seed)
    times = np.arange(int(seconds * rate)) / rate
    buzz = np.sign(np.sin(2 * np.pi * 120 * times)) * (np.sin(2 * np.pi * 3 * times) > 0)
    return (0.1 * buzz + rng.normal(0, 0.01, len(times))).astype(np.float32)
