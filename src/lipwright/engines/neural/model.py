"""A trained model: how it hears, its net, and which controls it gives; and its file.

The file is JSON, ``"format": "lipwright/neural-model"``, a row of weights per line. Weights
are float32 and come back bit for bit. A file that is cut short, of another version, or whose
parts do not fit each other is refused.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural.features import Hearing
from lipwright.engines.neural.layer_file import unfit
from lipwright.engines.neural.network import Layer, Network
from lipwright.files import (
    convert,
    quote,
    read_document,
    write_atomically,
)

FORMAT, VERSION = "lipwright/neural-model", 1
Floats = NDArray[np.float64]
Singles = NDArray[np.float32]


@dataclass(frozen=True, slots=True, eq=False)
class Model:
    """What training gives and the engine needs.

    Parameters
    ----------
    controls : tuple of str
        K names, in the order of the net's outputs.
    low, high : (K,) float32
        What each is clipped to: 0..1, or the training's own range where that is wider.
    hearing : Hearing
    network : Network
    usual : float
        How far, in deviations, inputs of the training lay from their mean: all but the
        farthest hundredth.
    about : dict
        What it was trained on and how well that went: see
        :func:`~lipwright.engines.neural.training.train`.
    """

    controls: tuple[str, ...]
    low: Singles
    high: Singles
    hearing: Hearing
    network: Network
    usual: float
    about: dict[str, Any] = field(default_factory=dict)

    def outputs(self, inputs: Floats) -> Floats:
        """Return the controls (T, K) for what was heard (T, I)."""
        return np.asarray(np.clip(self.network(inputs), self.low, self.high), np.float64)

    def strange(self, inputs: Floats) -> float:
        """Return the share of frames that lie farther than training's from its mean."""
        far = np.sqrt(np.square(self.network.standardised(inputs)).mean(axis=1))
        return float(np.mean(far > self.usual))

    def to_bytes(self) -> bytes:
        """Return the content of the model's file."""
        layers = ",\n  ".join(
            f'{{"bias": {_row(layer.bias)}, "weights": [\n   {_rows(layer.weights)}\n  ]}}'
            for layer in self.network.layers
        )
        parts = [
            f'"format": {quote(FORMAT)}',
            f'"version": {VERSION}',
            f'"controls": {json.dumps(self.controls, ensure_ascii=False)}',
            f'"low": {_row(self.low)}',
            f'"high": {_row(self.high)}',
            f'"hearing": {msgspec.json.encode(self.hearing).decode()}',
            f'"about": {json.dumps(self.about, ensure_ascii=False, allow_nan=False)}',
            f'"usual": {self.usual!r}',
            f'"mean": {_row(self.network.mean)}',
            f'"deviation": {_row(self.network.deviation)}',
            f'"layers": [\n  {layers}\n ]',
        ]
        return ("{\n " + ",\n ".join(parts) + "\n}\n").encode()

    def save(self, path: str | Path) -> None:
        """Write the model's file.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        write_atomically(path, self.to_bytes())


def read_model(path: str | Path) -> Model:
    """Return the model in a file.

    Raises
    ------
    InputError
        If the file cannot be read.
    FileFormatError
        If it is no model, of another version, cut short, or its parts do not fit.
    """
    where = str(path)
    read = convert(read_document(path, format=FORMAT, version=VERSION), _Document, where)
    network = Network(
        _vector(read.mean),
        _vector(read.deviation),
        tuple(
            Layer(_matrix(layer.weights, where, number), _vector(layer.bias))
            for number, layer in enumerate(read.layers, 1)
        ),
    )
    _check(read, network, where)
    return Model(
        tuple(read.controls),
        _vector(read.low),
        _vector(read.high),
        read.hearing,
        network,
        read.usual,
        msgspec.to_builtins(read.about),
    )


class _Layer(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    bias: list[float]
    weights: list[list[float]]


class _About(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    seconds: float
    sounds: int
    error: float
    constant: list[str]
    notes: list[str]


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    controls: list[str]
    low: list[float]
    high: list[float]
    hearing: Hearing
    usual: float
    mean: list[float]
    deviation: list[float]
    layers: list[_Layer]
    about: _About


def _check(read: _Document, network: Network, where: str) -> None:
    """Refuse parts that do not fit each other."""
    width = read.hearing.inputs
    for number, layer in enumerate(network.layers, 1):
        wanted = (width, len(layer.bias))
        if layer.weights.shape != wanted:
            raise unfit(
                f"{' x '.join(map(str, layer.weights.shape))} weights",
                f"{where}, layer {number}",
                f"{wanted[0]} x {wanted[1]}",
            )
        width = len(layer.bias)
    if not network.layers:
        raise unfit("no layers", where, "one or more")
    counts = {"mean": read.hearing.inputs, "deviation": read.hearing.inputs}
    counts |= dict.fromkeys(("low", "high", "controls"), width)
    for name, count in counts.items():
        if len(getattr(read, name)) != count:
            raise unfit(f"{len(getattr(read, name))} numbers", f"{where}, at {name}", f"{count}")
    if len(set(read.controls)) != width or not width:
        raise unfit("controls of the same name, or none", where, "names that differ")
    if not (network.deviation > 0).all() or (_vector(read.low) > _vector(read.high)).any():
        raise unfit("a deviation of 0, or a range that is none", where, "a trained net")
    arrays = [network.mean, *(a for layer in network.layers for a in (layer.weights, layer.bias))]
    if not all(np.isfinite(array).all() for array in arrays):
        raise unfit("numbers beyond what a weight can be", where, "finite weights")


def _vector(values: list[float]) -> Singles:
    with np.errstate(over="ignore"):  # what float32 cannot hold is refused as not finite
        return np.array(values, np.float64).astype(np.float32)


def _matrix(rows: list[list[float]], where: str, number: int) -> Singles:
    if len({len(row) for row in rows}) > 1:
        raise unfit("rows of different lengths", f"{where}, layer {number}", "a matrix")
    with np.errstate(over="ignore"):
        return np.array(rows, np.float64).reshape(len(rows), -1).astype(np.float32)


def _row(values: Iterable[np.float32]) -> str:
    # Nine digits tell every float32 from its neighbours.
    return "[" + ", ".join(f"{float(value):.9g}" for value in values) + "]"


def _rows(matrix: Singles) -> str:
    return ",\n   ".join(map(_row, matrix))
