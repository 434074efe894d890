"""A trained net of PyTorch's as a live model: weights on the grid that the runtime sums in."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from lipwright.engines.neural import mel
from lipwright.engines.neural.convolution import WEIGHT_STEP, Affine, Block, Convolutions
from lipwright.engines.neural.live_model import LiveModel
from tools.neural_model.spoken import POSES

if TYPE_CHECKING:
    from torch import nn

    from tools.neural_model.net import Net


def converted(net: Net, about: dict[str, Any]) -> LiveModel:
    """Return what the runtime plays of a trained net; it does not show closures yet."""
    count, shape = len(POSES), net.shape
    out = affine(net.out)

    def rows(first: int, last: int) -> Affine:
        return Affine(np.ascontiguousarray(out.weights[:, first:last]), out.bias[first:last])

    blocks = tuple(
        Block(dilation, affine(taps), affine(back), shape.centred)
        for dilation, taps, back in zip(shape.dilations, net.taps, net.back, strict=True)
    )
    return LiveModel(
        POSES,
        np.zeros(count),
        np.ones(count),
        Convolutions(affine(net.first), blocks),
        shape.ahead - shape.late,
        shape.both_ways,
        mel.DEPTH,
        0,
        (0,),
        (),
        (rows(0, count),),
        True,
        rows(out.weights.shape[1] - 1, out.weights.shape[1]),
        rows(count, count + 1),
        None,
        about,
    )


def affine(layer: nn.Module) -> Affine:
    """Return a layer on the grid."""

    def grid(values: Any) -> Any:
        found = np.rint(values.detach().double().numpy() / WEIGHT_STEP) * WEIGHT_STEP
        return np.ascontiguousarray(found)

    weight, bias = layer.parameters()
    return Affine(np.ascontiguousarray(grid(weight).T), grid(bias))
