"""The net as PyTorch learns it: what :mod:`lipwright.engines.neural.convolution` plays."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional

from lipwright.engines.neural.live_model import STACKED
from lipwright.engines.neural.mel import BANDS

TAPS = 3


@dataclass(frozen=True, slots=True)
class Shape:
    """What kind of net is learnt.

    Parameters
    ----------
    ahead : int
        Frames of 20 ms that are heard beyond the one whose face is learnt.
    late : int
        By how many frames the answer is stamped later than the face it was taught.
    both_ways : bool
        Whether loudness is that of the whole recording.
    closing : tuple of two float
        How likely a closure must be to begin to be shown, and to be shown whole.
    units : int
    dilations : tuple of int
    """

    ahead: int
    late: int
    both_ways: bool
    closing: tuple[float, float]
    units: int = 96
    dilations: tuple[int, ...] = (1, 2, 4, 8, 16, 1)


WHOLE = Shape(ahead=4, late=0, both_ways=True, closing=(0.6, 0.9))
LIVE = Shape(ahead=1, late=1, both_ways=False, closing=(0.4, 0.7))
"""Faces move some 25 ms later than curves are drawn (docs/english-set.md), so a live answer may
be 20 ms later than drawn: it has heard a frame more, and waits for none."""


class Net(nn.Module):
    """Dilated convolutions that look back only.

    Parameters
    ----------
    shape : Shape
    poses, classes : int
        Outputs: poses, a closure, classes of mouth (learnt along, not played), doubt.
    dropped : float
        Share of units that are left out at random while learning.
    """

    def __init__(self, shape: Shape, poses: int, classes: int, dropped: float = 0.15) -> None:
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
            passing = passing + back(units)
        found: Tensor = self.out(functional.relu(passing))
        return found


def layers(inputs: int, units: int, count: int) -> nn.ModuleList:
    """Return so many layers of one size."""
    return nn.ModuleList([nn.Linear(inputs, units) for _ in range(count)])
