"""How well each instant of a sound fits each state of the acoustic model."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.schedule.align.model import AcousticModel


def senone_scores(
    model: AcousticModel, features: NDArray[np.float32], senones: NDArray[np.int64]
) -> NDArray[np.float32]:
    """Return log likelihoods of states.

    Parameters
    ----------
    model : AcousticModel
    features : (F, T, D) float32
        Feature streams.
    senones : (U,) int
        The states that are asked for.

    Returns
    -------
    (T, U) float32
        Natural logarithms of densities, summed over the streams.
    """
    result = np.zeros((features.shape[1], len(senones)), np.float32)
    owners = model.owner[senones]
    for owner in np.unique(owners):
        columns = np.flatnonzero(owners == owner)
        for stream, frames in enumerate(features):
            density = _densities(model, int(owner), stream, frames)
            best = density.max(axis=1, keepdims=True)
            weights = model.weights[stream][:, senones[columns]]
            mixed = np.exp(density - best) @ weights
            result[:, columns] += np.log(np.maximum(mixed, 1e-30)) + best
    return result


def _densities(
    model: AcousticModel, owner: int, stream: int, frames: NDArray[np.float32]
) -> NDArray[np.float32]:
    precision = model.precisions[owner, stream]
    mean = model.means[owner, stream]
    constant = model.offsets[owner, stream] - 0.5 * (precision * mean**2).sum(axis=1)
    squares = (frames**2) @ (-0.5 * precision).T
    return np.asarray(squares + frames @ (precision * mean).T + constant, np.float32)
