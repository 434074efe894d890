"""The net as PyTorch learns it: what :mod:`lipwright.engines.neural.convolution` plays."""

from __future__ import annotations

import torch
from torch import Tensor, nn
from torch.nn import functional

from lipwright.engines.neural.live_model import STACKED
from lipwright.engines.neural.mel import BANDS
from tools.neural_model.shape import Shape

TAPS = 3


class Net(nn.Module):
    """Dilated convolutions.

    Parameters
    ----------
    shape : Shape
    poses, classes : int
        Outputs: poses, a closure, classes of mouth (learnt along, not played), doubt.
    dropped : float
        Share of units that are left out at random while learning.
    """

    def __init__(self, shape: Shape, poses: int, classes: int, dropped: float = 0.08) -> None:
        super().__init__()
        units = shape.units
        self.shape = shape
        self.dropped = dropped
        self.first = nn.Linear(BANDS * STACKED, units)
        self.taps = layers(units * TAPS, units, len(shape.dilations))
        self.back = layers(units, units, len(shape.dilations))
        self.out = nn.Linear(units, poses + 1 + classes + 1)

    def forward(self, bands: Tensor) -> Tensor:
        """Return the outputs before the logistic, (B, T, O).

        Parameters
        ----------
        bands : (B, 2 T + 2, 40)
            Frame ``k`` hears ``bands[2 k : 2 k + 4]``.
        """
        frames = (bands.shape[1] - STACKED) // 2 + 1
        last = 2 * frames - 1
        stacked = torch.cat([bands[:, i : i + last : 2] for i in range(STACKED)], dim=-1)
        passing = functional.relu(self.first(stacked))
        for dilation, taps, back in zip(self.shape.dilations, self.taps, self.back, strict=True):
            known = functional.pad(passing, (0, 0, dilation * (TAPS - 1), 0))
            instants = [known[:, i * dilation : i * dilation + frames] for i in range(TAPS)]
            units = functional.relu(taps(torch.cat(instants, dim=-1)))
            units = functional.dropout(units, self.dropped, self.training)
            passing = (instants[TAPS // 2] if self.shape.centred else passing) + back(units)
        found: Tensor = self.out(functional.relu(passing))
        return found


def layers(inputs: int, units: int, count: int) -> nn.ModuleList:
    """Return so many layers of one size."""
    return nn.ModuleList([nn.Linear(inputs, units) for _ in range(count)])
