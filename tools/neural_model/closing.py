"""When a closure is shown: chosen on voices that were left out while learning."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural.live_model import Closing, LiveModel
from lipwright.engines.neural.stream import Hearing
from tools.neural_model.hearing import Heard, bands_of
from tools.neural_model.shape import Shape
from tools.neural_model.spoken import POSES

CLOSED = 0.85
"""PBM from which on lips are closed."""
LEAVES = {"open": 0.0, "W": 0.4, "wide": 0.4, "ShCh": 0.4, "FV": 0.4}
"""What a closed mouth leaves of other poses."""
WITHIN = 2
"""Frames by which a closure may come early or late and still be the one that was meant."""
WIDE = 0.3
"""How much likelier than hardly a closure is surely."""
SHUT = 0.72
"""The share of the way at which the lips are open by less than 15 % of their range."""
_LIKELY = np.arange(0.3, 0.96, 0.01)


def with_closing(model: LiveModel, shape: Shape, heard: Heard) -> LiveModel:
    """Return a model that shows closures: so that as many are made up as are missed.

    Parameters
    ----------
    model : LiveModel
    shape : Shape
        Of its net.
    heard : Heard
        Lines that it has not learnt from.
    """
    likely, shut = closures(model, shape, heard)
    apart = [abs(np.subtract(*met_and_true(likely > limit, shut))) for limit in _LIKELY]
    sure = min(float(_LIKELY[int(np.argmin(apart))]) + (1 - SHUT) * WIDE, 1.0)
    closing = Closing("PBM", LEAVES, round(sure - WIDE, 2), round(sure, 2))
    return replace(model, closing=closing)


def closures(
    model: LiveModel, shape: Shape, heard: Heard
) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """Return how likely the lips are closed at each frame of all lines, and whether they are."""
    assert model.closed is not None
    asked = replace(
        model,
        controls=("closed",),
        low=np.zeros(1),
        high=np.ones(1),
        instants=(0,),
        bands=(),
        layers=(model.closed,),
        logistic=True,
        closed=None,
        closing=None,
    )
    bands = bands_of(heard, shape, np.random.default_rng(0))
    poses = heard.poses[:, POSES.index("PBM")]
    likely, shut, start = [], [], 0
    for length in heard.lengths.tolist():
        part = slice(start, start + length)
        known = poses[part][::2] > CLOSED
        hearing = Hearing(asked)
        told = [hearing.hear(bands[part].astype(np.float64)), hearing.to_the_end(len(known))]
        likely.append(np.concatenate([one.values[:, 0] for one in told])[: len(known)])
        shut.append(np.r_[np.zeros(shape.late, bool), known][: len(known)])
        start += length
    return np.concatenate(likely), np.concatenate(shut)


def met_and_true(ours: NDArray[np.bool_], meant: NDArray[np.bool_]) -> tuple[float, float]:
    """Return the share of closures that are met, and the share of ours that were meant."""
    return _share(meant, ours), _share(ours, meant)


def _share(spells: NDArray[np.bool_], others: NDArray[np.bool_]) -> float:
    """Return the share of spells beside which the others have one."""
    edges = np.flatnonzero(np.diff(np.r_[False, spells, False])).reshape(-1, 2)
    near = np.convolve(others, np.ones(2 * WITHIN + 1), "same") > 0.5
    return float(np.mean([near[start:end].any() for start, end in edges])) if len(edges) else 1.0
