"""The net at work: a few matrices and a logistic, in numpy; no training library.

Frank, Hoch, Trogemann, "Network Architecture": 27 x 9 inputs, 18 hidden units, 5 outputs.
They name no activation: hidden units are logistic, as nets of their day were, and outputs
linear, clipped to their range. How many layers and units there are is data.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class Layer:
    """Weights and biases of one layer.

    Parameters
    ----------
    weights : (I, O) float32
    bias : (O,) float32
    """

    weights: Singles
    bias: Singles


@dataclass(frozen=True, slots=True, eq=False)
class Network:
    """A feed-forward net: inputs are standardised, all layers but the last are logistic.

    Parameters
    ----------
    mean, deviation : (I,) float32
        Of the inputs in training.
    layers : tuple of Layer
        One after the other; each takes what the one before gives.
    """

    mean: Singles
    deviation: Singles
    layers: tuple[Layer, ...]

    @property
    def shape(self) -> tuple[int, ...]:
        """Units of each layer, inputs first: ``(243, 18, 5)``."""
        return (len(self.mean), *(len(layer.bias) for layer in self.layers))

    def standardised(self, inputs: Floats) -> Floats:
        """Return inputs in deviations from their mean in training, (T, I)."""
        return np.asarray((inputs - self.mean) / self.deviation, np.float64)

    def __call__(self, inputs: Floats) -> Floats:
        """Return the outputs, (T, O), not yet clipped.

        Parameters
        ----------
        inputs : (T, I) float64
            As :func:`~lipwright.engines.neural.features.features` gives them.
        """
        values = self.standardised(inputs)
        for number, layer in enumerate(self.layers, 1):
            values = values @ layer.weights.astype(np.float64) + layer.bias
            if number < len(self.layers):
                values = logistic(values)
        return values


def logistic(values: Floats) -> Floats:
    """Return ``1 / (1 + exp(-values))``, without overflow."""
    return np.asarray(0.5 * (1.0 + np.tanh(0.5 * values)), np.float64)
