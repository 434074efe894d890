"""A live model: how it hears, its convolutions, its last layers; and its file.

It answers fifty times a second: frame ``j`` is the instant ``0.02 j`` s, for which it hears
what was said before and :attr:`LiveModel.latency` more. The file is JSON,
``"format": "lipwright/live-model"``; a layer is a line
(:mod:`~lipwright.engines.neural.layer_file`). A file that is cut short, of another version, or
whose parts do not fit each other is refused.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural import mel
from lipwright.engines.neural.convolution import Affine, Block, Convolutions, applied, on_grid
from lipwright.engines.neural.layer_file import WrittenLayer, read_layer, unfit, written
from lipwright.engines.neural.network import logistic
from lipwright.files import convert, quote, read_document, write_atomically

FORMAT, VERSION = "lipwright/live-model", 1
FRAME = 0.02
"""Seconds from frame to frame."""
STACKED = 4
"""Mel frames that the first layer hears at once; the newest two are new."""
MOST_AHEAD = 100
DEPTHS = (10, 120)  # dB
Floats = NDArray[np.float64]


class Closing(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a closed mouth does to the controls.

    Parameters
    ----------
    control : str
        Which goes to 1.
    leaves : dict of str to float
        The share of others that is left.
    doubted, sure : float
        How likely a closure must be, 0..1, to begin to be shown, and to be shown whole.
    """

    control: str
    leaves: dict[str, float]
    doubted: float
    sure: float


@dataclass(frozen=True, slots=True, eq=False)
class LiveModel:
    """What a stream and the engine need.

    Parameters
    ----------
    controls : tuple of str
        K names.
    low, high : (K,) float64
        What each is clipped to.
    net : Convolutions
    ahead : int
        Frames that are heard beyond the one that is answered.
    both_ways : bool
        Whether the loudness is that of the whole recording: such a model cannot stream.
    depth : float
        dB below the loudness under which it hears nothing.
    own : int
        Which frame is answered, 0 or before: of it are the doubt and the closure.
    instants : tuple of int
        Frames, 0 or before, of which the last layers take what the convolutions make.
    bands : tuple of int
        Frames, 0 or before, of which they take the bands themselves; may be empty.
    layers : tuple of Affine
        The last layers; logistic units between them.
    logistic : bool
        Whether the outputs are logistic too; else they are linear.
    doubt : Affine
        ``C`` to 1: the logarithm of how far off the opening may be, as a share of its range.
    closed : Affine, optional
        ``C`` to 1: whether the lips are closed, before the logistic.
    closing : Closing, optional
        What follows from that.
    about : dict
        What it was trained on: ``seconds``, ``sounds`` and ``notes``; of one that was taught
        also ``error`` and ``constant`` (:func:`~lipwright.engines.neural.teaching.teach`), of
        one that comes with Lipwright ``times``, ``steps`` and ``seed``.
    """

    controls: tuple[str, ...]
    low: Floats
    high: Floats
    net: Convolutions
    ahead: int
    both_ways: bool
    depth: float
    own: int
    instants: tuple[int, ...]
    bands: tuple[int, ...]
    layers: tuple[Affine, ...]
    logistic: bool
    doubt: Affine
    closed: Affine | None = None
    closing: Closing | None = None
    about: dict[str, Any] = field(default_factory=dict)

    @property
    def latency(self) -> float:
        """Seconds of sound after a frame's instant that must be heard before it is answered."""
        return self.ahead * FRAME + (mel.WINDOW - mel.HOP) / mel.RATE

    @property
    def shape(self) -> tuple[int, ...]:
        """Units of each layer, inputs first: ``(160, 96, …, 9)``; a block counts as one."""
        blocks = (len(block.back.bias) for block in self.net.blocks)
        last = (len(layer.bias) for layer in self.layers)
        return (len(self.net.first.weights), self.net.units, *blocks, *last)

    @property
    def behind(self) -> int:
        """Frames before the newest that the last layers still hear."""
        return -min((self.own, *self.instants, *self.bands))

    @property
    def taken(self) -> int:
        """Numbers that the last layers take in."""
        return len(self.instants) * self.net.units + len(self.bands) * mel.BANDS

    def taken_in(self, rows: Floats) -> Floats:
        """Return what the last layers take in at every frame but the first few.

        Parameters
        ----------
        rows : (behind + T, C + 40) float64
            For each frame what the convolutions made of it, and its own bands.

        Returns
        -------
        (T, taken) float64
        """
        units, count = self.net.units, len(rows) - self.behind
        made, bands = rows[:, :units], rows[:, units:]
        parts = [made[self.behind + back :][:count] for back in self.instants]
        parts += [bands[self.behind + back :][:count] for back in self.bands]
        return np.concatenate(parts, axis=1)

    def answered(self, rows: Floats) -> tuple[Floats, Floats]:
        """Return the controls and the doubt at every frame but the first few.

        Parameters
        ----------
        rows : (behind + T, C + 40) float64
            See :meth:`taken_in`.

        Returns
        -------
        values : (T, K) float64
        doubt : (T,) float64
            How far off the opening may be, as a share of its range.
        """
        values = through(self.layers, self.taken_in(rows))
        values = np.clip(logistic(values) if self.logistic else values, self.low, self.high)
        made = rows[self.behind + self.own :][: len(values), : self.net.units]
        made = np.ascontiguousarray(made)
        doubt = np.exp(np.minimum(applied(self.doubt, made)[:, 0], 0.0))
        if self.closed is not None and self.closing is not None:
            values = self._closed(values, logistic(applied(self.closed, made)[:, 0]))
        return values, doubt

    def _closed(self, values: Floats, likely: Floats) -> Floats:
        """Close the lips where a closure is likely."""
        closing = self.closing
        assert closing is not None
        share = np.clip((likely - closing.doubted) / (closing.sure - closing.doubted), 0.0, 1.0)
        share = share * share * (3.0 - 2.0 * share)
        shut = values.copy()
        for name, left in closing.leaves.items():
            shut[:, self.controls.index(name)] *= 1.0 - (1.0 - left) * share
        place = self.controls.index(closing.control)
        shut[:, place] = np.maximum(shut[:, place], share)
        return shut

    def to_bytes(self) -> bytes:
        """Return the content of the model's file."""
        named: list[tuple[str, Any]] = [
            ("controls", list(self.controls)),
            ("low", self.low.tolist()),
            ("high", self.high.tolist()),
            ("ahead", self.ahead),
            ("both_ways", self.both_ways),
            ("depth", self.depth),
            ("own", self.own),
            ("instants", list(self.instants)),
            ("bands", list(self.bands)),
            ("logistic", self.logistic),
            ("closing", msgspec.to_builtins(self.closing)),
            ("about", self.about),
        ]
        rows = [f'"format": {quote(FORMAT)}', f'"version": {VERSION}']
        rows += [
            f'"{name}": {json.dumps(value, ensure_ascii=False, allow_nan=False)}'
            for name, value in named
        ]
        rows.append(f'"first": {written(self.net.first)}')
        blocks = ",\n  ".join(
            f'{{"dilation": {block.dilation}, "centred": {json.dumps(block.centred)},\n'
            f'   "taps": {written(block.taps)},\n'
            f'   "back": {written(block.back)}}}'
            for block in self.net.blocks
        )
        rows.append(f'"blocks": [\n  {blocks}\n ]')
        layers = ",\n  ".join(map(written, self.layers))
        rows.append(f'"layers": [\n  {layers}\n ]')
        rows.append(f'"doubt": {written(self.doubt)}')
        rows.append(f'"closed": {written(self.closed) if self.closed else "null"}')
        return ("{\n " + ",\n ".join(rows) + "\n}\n").encode()

    def save(self, path: str | Path) -> None:
        """Write the model's file.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        write_atomically(path, self.to_bytes())


def through(layers: Sequence[Affine], inputs: Floats) -> Floats:
    """Return what last layers answer to inputs (T, I): neither clipped nor logistic."""
    values = inputs
    for number, layer in enumerate(layers, 1):
        values = applied(layer, values)
        if number < len(layers):
            values = on_grid(logistic(values))
    return values


def read_live_model(path: str | Path) -> LiveModel:
    """Return the live model in a file.

    Raises
    ------
    InputError
        If the file cannot be read.
    FileFormatError
        If it is no live model, of another version, cut short, or its parts do not fit.
    """
    where = str(path)
    read = convert(read_document(path, format=FORMAT, version=VERSION), _Document, where)
    units = read.first.units
    blocks = tuple(
        Block(
            block.dilation,
            read_layer(block.taps, f"{where}, block {number}", units, 3 * units),
            read_layer(block.back, f"{where}, block {number}", units, units),
            block.centred,
        )
        for number, block in enumerate(read.blocks, 1)
    )
    net = Convolutions(read_layer(read.first, where, units, STACKED * mel.BANDS), blocks)
    _check(read, where)
    layers, width = [], len(read.instants) * units + len(read.bands) * mel.BANDS
    for number, layer in enumerate(read.layers, 1):
        layers.append(read_layer(layer, f"{where}, layer {number}", layer.units, width))
        width = layer.units
    if width != len(read.controls):
        raise unfit(f"{width} outputs", where, f"{len(read.controls)}")
    closed = read_layer(read.closed, f"{where}, at closed", 1, units) if read.closed else None
    return LiveModel(
        tuple(read.controls),
        np.array(read.low, np.float64),
        np.array(read.high, np.float64),
        net,
        read.ahead,
        read.both_ways,
        read.depth,
        read.own,
        tuple(read.instants),
        tuple(read.bands),
        tuple(layers),
        read.logistic,
        read_layer(read.doubt, f"{where}, at doubt", 1, units),
        closed,
        read.closing,
        msgspec.to_builtins(read.about),
    )


class _Block(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    dilation: int
    centred: bool
    taps: WrittenLayer
    back: WrittenLayer


class _About(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    seconds: float
    sounds: int
    error: float | msgspec.UnsetType = msgspec.UNSET
    constant: list[str] | msgspec.UnsetType = msgspec.UNSET
    times: int | msgspec.UnsetType = msgspec.UNSET
    steps: int | msgspec.UnsetType = msgspec.UNSET
    seed: int | msgspec.UnsetType = msgspec.UNSET
    notes: list[str] = []


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    controls: list[str]
    low: list[float]
    high: list[float]
    ahead: int
    both_ways: bool
    depth: float
    own: int
    instants: list[int]
    bands: list[int]
    logistic: bool
    closing: Closing | None
    about: _About
    first: WrittenLayer
    blocks: list[_Block]
    layers: list[WrittenLayer]
    doubt: WrittenLayer
    closed: WrittenLayer | None


def _check(read: _Document, where: str) -> None:
    """Refuse parts that do not fit each other."""
    count = len(read.controls)
    if not count or len(set(read.controls)) != count:
        raise unfit("controls of the same name, or none", where, "names that differ")
    if len(read.low) != count or len(read.high) != count:
        raise unfit("another number of ranges than of controls", where, f"{count}")
    if (np.array(read.low) > np.array(read.high)).any():
        raise unfit("a range that is none", where, "low below high")
    if not 0 <= read.ahead <= MOST_AHEAD:
        raise unfit(f"{read.ahead} frames ahead", where, f"0 to {MOST_AHEAD}")
    if not DEPTHS[0] <= read.depth <= DEPTHS[1]:
        raise unfit(f"a depth of {read.depth:g} dB", where, "{} to {} dB".format(*DEPTHS))
    if not -MOST_AHEAD <= read.own <= 0:
        raise unfit(f"an answer {read.own} frames away", where, f"{-MOST_AHEAD} to 0")
    for name, instants in (("instants", read.instants), ("bands", read.bands)):
        rising = sorted(set(instants)) == instants
        if not rising or any(not -MOST_AHEAD <= back <= 0 for back in instants):
            raise unfit(f"the {name} {instants}", where, f"rising, from {-MOST_AHEAD} to 0")
    if not read.layers:
        raise unfit("no layers", where, "one or more")
    if any(not 1 <= block.dilation <= 4096 for block in read.blocks):
        raise unfit("a dilation that cannot be", where, "1 to 4096 frames")
    closing = read.closing
    if closing is None:
        return
    named = {closing.control, *closing.leaves}
    if not named <= set(read.controls) or not 0 <= closing.doubted < closing.sure <= 1:
        raise unfit("a closing that does not fit the controls", where, "names of controls")
