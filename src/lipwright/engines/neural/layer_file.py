"""A layer in a live model's file: a line of base64, for nobody edits weights.

Whole numbers of 16 or 32 bits, little endian, in units of 2⁻¹²: what
:mod:`~lipwright.engines.neural.convolution` sums exactly comes back bit for bit.
"""

from __future__ import annotations

import base64
import binascii

import msgspec
import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural.convolution import GREATEST, WEIGHT_STEP, WIDEST, Affine
from lipwright.errors import FileFormatError


class WrittenLayer(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What the file holds of a layer.

    Parameters
    ----------
    inputs, units : int
    bits : int
        Of each number, 16 or 32.
    weights, bias : str
        Base64, inputs by units in rows, and units.
    """

    inputs: int
    units: int
    bits: int
    weights: str
    bias: str


def written(layer: Affine) -> str:
    """Return a layer as an object of JSON."""
    parts = [np.rint(part / WEIGHT_STEP) for part in (layer.weights, layer.bias)]
    bits = 16 if max(np.abs(part).max(initial=0.0) for part in parts) < 2**15 else 32
    weights, bias = (
        base64.b64encode(part.astype(f"<i{bits // 8}").tobytes()).decode() for part in parts
    )
    count, units = layer.weights.shape
    return (
        f'{{"inputs": {count}, "units": {units}, "bits": {bits},'
        f' "weights": "{weights}", "bias": "{bias}"}}'
    )


def read_layer(read: WrittenLayer, where: str, units: int, inputs: int) -> Affine:
    """Return a layer, which must have so many units and inputs.

    Raises
    ------
    FileFormatError
        If it has others, or its weights are damaged.
    """
    if (read.inputs, read.units) != (inputs, units) or not 1 <= inputs <= WIDEST or units < 1:
        raise unfit(f"{read.inputs} x {read.units} weights", where, f"{inputs} x {units}")
    if read.bits not in (16, 32):
        raise unfit(f"weights of {read.bits} bits", where, "16 or 32")
    weights = _numbers(read.weights, read.bits, inputs * units, where)
    bias = _numbers(read.bias, read.bits, units, where)
    return Affine(weights.reshape(inputs, units), bias)


def _numbers(text: str, bits: int, count: int, where: str) -> NDArray[np.float64]:
    try:
        data = base64.b64decode(text, validate=True)
    except (binascii.Error, ValueError):
        raise unfit("weights that are no base64", where, "a trained net") from None
    if len(data) * 8 != count * bits:
        raise unfit(f"{len(data)} bytes of weights", where, f"{count * bits // 8}")
    values = np.frombuffer(data, f"<i{bits // 8}").astype(np.float64) * WEIGHT_STEP
    if np.abs(values).max(initial=0.0) > GREATEST:
        raise unfit("weights beyond what sums can hold", where, f"within ± {GREATEST:g}")
    return values


def unfit(found: str, where: str, expected: str) -> FileFormatError:
    """Return the error for a model whose parts do not fit each other."""
    cure = "the model is damaged: train it again"
    return FileFormatError(found, where=where, expected=expected, cure=cure)
