"""Animation: named controls over time, and its lossless file (DESIGN section 8).

What every engine returns and every exporter takes. Frame ``k`` is the instant
``start + k / rate``. The file keeps the frames to the last bit of a float32, the
phones and words behind them, and how they were made.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray

from lipwright.curves import Keys
from lipwright.errors import FileFormatError, InputError
from lipwright.files import check_document, convert, parse_json, quote, read_bytes, write_atomically
from lipwright.phones import PhoneTrack
from lipwright.timeline import Interval, Tier

FORMAT = "lipwright/animation"
VERSION = 1


@dataclass(frozen=True, slots=True, eq=False)
class Animation:
    """Named controls over time.

    Parameters
    ----------
    controls : tuple of str
        K names.
    values : (T, K) float32
        Weights, 0..1 unless a set says otherwise.
    rate : float
        Frames per second.
    start : float
        Seconds of the first frame on the sound's clock; negative where the mouth moves
        before the sound does.
    keys : dict of str to Keys
        The piecewise-linear curve behind a control, where the engine has one.
    phones : PhoneTrack
        The phones that were animated.
    words : Tier
        The words, where known.
    engine : str
        ``"bigram"``, ``"motion"`` or ``"neural"``.
    report : dict
        What the engine has to say: the set's name, stand-ins, settings. JSON values only.

    Raises
    ------
    InputError
        If the shape does not fit the names, names repeat, or a number is not finite.
    """

    controls: tuple[str, ...]
    values: NDArray[np.float32]
    rate: float
    start: float = 0.0
    keys: dict[str, Keys] = field(default_factory=dict)
    phones: PhoneTrack = field(default_factory=lambda: PhoneTrack(Tier()))
    words: Tier = field(default_factory=Tier)
    engine: str = ""
    report: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.values.ndim != 2 or self.values.shape[1] != len(self.controls):
            raise InputError(
                f"frames of shape {self.values.shape} for {len(self.controls)} controls",
                expected="(frames, controls)",
            )
        if len(set(self.controls)) != len(self.controls):
            raise InputError("a control's name stands twice", expected="names that differ")
        if not np.isfinite(self.values).all():
            frame, control = np.argwhere(~np.isfinite(self.values))[0]
            raise InputError(
                f"{self.controls[control]!r} is not finite in frame {frame}",
                expected="finite numbers",
            )
        if not (np.isfinite(self.rate) and self.rate > 0 and np.isfinite(self.start)):
            raise InputError(f"{self.rate} frames per second from {self.start} s")

    def __len__(self) -> int:
        return len(self.values)

    @property
    def times(self) -> NDArray[np.float64]:
        """The instant of each frame, (T,) seconds."""
        return self.start + np.arange(len(self.values)) / self.rate

    @property
    def duration(self) -> float:
        """From the first frame to the end of the last, in seconds."""
        return len(self.values) / self.rate

    def control(self, name: str) -> NDArray[np.float32]:
        """Return one control's values, (T,).

        Raises
        ------
        InputError
            If there is no such control.
        """
        if name not in self.controls:
            raise InputError(f"no control {name!r}", expected=f"one of {', '.join(self.controls)}")
        return self.values[:, self.controls.index(name)]

    def at(self, times: ArrayLike) -> NDArray[np.float64]:
        """Return the controls at ``times`` (seconds), (N, K): linear between frames."""
        where = np.atleast_1d(np.asarray(times, dtype=np.float64))
        own = self.times
        columns = [np.interp(where, own, column) for column in self.values.T]
        return np.stack(columns, axis=1) if columns else np.zeros((len(where), 0))

    def save(self, path: str | Path) -> None:
        """Write the lossless file.

        Raises
        ------
        OutputError
            If it cannot be written.
        InputError
            If ``path`` does not end in ``.json``: other formats need a character too, and are
            written by :func:`lipwright.save`.
        """
        if Path(path).suffix.lower() != ".json":
            raise InputError(
                f"{Path(path).suffix!r} is not the lossless format",
                where=str(path),
                expected="a name in .json",
                cure="for other formats use lipwright.save(performance, path)",
            )
        write_atomically(path, self.to_bytes())

    def to_bytes(self) -> bytes:
        """Return the content of the lossless file."""
        head = [
            f'"format": {quote(FORMAT)}',
            f'"version": {VERSION}',
            f'"engine": {quote(self.engine)}',
            f'"rate": {_number(self.rate)}',
            f'"start": {_number(self.start)}',
            f'"controls": {json.dumps(self.controls, ensure_ascii=False)}',
            f'"phone_set": {quote(self.phones.phone_set)}',
            f'"phones": {_lines(map(interval_row, self.phones))}',
            f'"words": {_lines(map(interval_row, self.words))}',
            f'"report": {json.dumps(self.report, ensure_ascii=False, allow_nan=False)}',
        ]
        if self.keys:
            rows = (f"{quote(name)}: {_pairs(keys)}" for name, keys in self.keys.items())
            head.append('"keys": {\n  ' + ",\n  ".join(rows) + "\n }")
        head.append(f'"frames": {_lines(map(_frame, self.values))}')
        return ("{\n " + ",\n ".join(head) + "\n}\n").encode()

    @classmethod
    def from_bytes(cls, data: bytes, where: str = "animation") -> Animation:
        """Return the animation that the content of a lossless file holds.

        Raises
        ------
        FileFormatError
            If the content is broken: it names the place.
        """
        value = check_document(parse_json(data, where), where, format=FORMAT, version=VERSION)
        read = convert(value, _Document, where)
        width = len(read.controls)
        for index, row in enumerate(read.frames):
            if len(row) != width:
                raise FileFormatError(
                    f"{len(row)} values",
                    where=f"{where}, frame {index}",
                    expected=f"{width}, one for each control",
                )
        with np.errstate(over="ignore"):  # what float32 cannot hold is refused as not finite
            frames = np.array(read.frames, dtype=np.float32).reshape(len(read.frames), width)
        try:
            return cls(
                tuple(read.controls),
                frames,
                read.rate,
                read.start,
                {name: Keys.of(pairs) for name, pairs in read.keys.items()},
                PhoneTrack(_tier(read.phones), read.phone_set),
                _tier(read.words),
                read.engine,
                read.report,
            )
        except InputError as error:
            place = f"{where}, {error.where}" if error.where else where
            raise FileFormatError(
                error.found, where=place, expected=error.expected, cure=error.cure
            ) from None

    @classmethod
    def load(cls, path: str | Path) -> Animation:
        """Return the animation in a lossless file."""
        return cls.from_bytes(read_bytes(path), str(path))


Row = tuple[str, float, float] | tuple[str, float, float, float]


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    rate: float
    controls: list[str]
    frames: list[list[float]]
    start: float = 0.0
    engine: str = ""
    phone_set: str = "arpabet"
    phones: list[list[str | float | None]] = []
    words: list[list[str | float | None]] = []
    keys: dict[str, list[tuple[float, float]]] = {}
    report: dict[str, Any] = {}


def _tier(rows: list[list[str | float | None]]) -> Tier:
    return Tier(tuple(interval_from_row(row) for row in rows))


def interval_from_row(row: list[str | float | None]) -> Interval:
    """Return the interval of a ``[label, start, end]`` row, or one with a confidence."""
    if len(row) not in (3, 4) or not isinstance(row[0], str):
        raise FileFormatError(f"the row {row!r}", expected="[label, start, end]")
    numbers = [value for value in row[1:] if isinstance(value, int | float)]
    if len(numbers) != len(row) - 1:
        raise FileFormatError(f"the row {row!r}", expected="[label, start, end]")
    return Interval(row[0], numbers[0], numbers[1], numbers[2] if len(row) == 4 else None)


def _number(value: float) -> str:
    return _short(repr(float(value)))


def _short(text: str) -> str:
    # A JSON reader takes -0 for the whole number 0 and loses the sign.
    return text if text == "-0.0" else text.removesuffix(".0")


def interval_row(interval: Interval) -> str:
    """Return the ``[label, start, end]`` row of an interval, with its confidence where known."""
    numbers = [interval.start, interval.end]
    if interval.confidence is not None:
        numbers.append(interval.confidence)
    return f"[{quote(interval.label)}, {', '.join(_number(number) for number in numbers)}]"


def _frame(row: NDArray[np.float32]) -> str:
    return "[" + ", ".join(_short(str(value)) for value in row) + "]"


def _pairs(keys: Keys) -> str:
    return "[" + ", ".join(f"[{_number(t)}, {_number(v)}]" for t, v in keys.pairs()) + "]"


def _lines(rows: map[str]) -> str:
    body = ",\n  ".join(rows)
    return f"[\n  {body}\n ]" if body else "[]"
