"""Recorded faces: lengths measured on a face, a row per frame of its video."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lipwright.curves import Floats
from lipwright.errors import FileFormatError
from lipwright.evaluate.curve import Curve
from lipwright.files import read_bytes

GAP, WIDTH, PUCKER = "lipGapInner", "lipWidth", "mouthPucker"
FEWEST = 4


@dataclass(frozen=True, slots=True, eq=False)
class Recording:
    """A recorded mouth; every curve's instants are the middles of the video's frames.

    Parameters
    ----------
    opening : Curve
        The gap between the inner lips.
    breadth : Curve
        From corner to corner.
    pucker : Curve, optional
        How far the lips are rounded, where that was scored too.
    """

    opening: Curve
    breadth: Curve
    pucker: Curve | None = None


def read_recording(measured: str | Path, shapes: str | Path | None = None) -> Recording:
    """Read a measured face.

    Parameters
    ----------
    measured : path
        CSV with the columns ``time`` (seconds; a frame covers the time from there to the
        next), ``lipGapInner`` and ``lipWidth``, in any unit.
    shapes : path, optional
        CSV with the columns ``time`` and ``mouthPucker``.

    Raises
    ------
    FileFormatError
        If a column is missing or a cell is no number: it names the line.
    InputError
        If a file cannot be read, or times do not increase.
    """
    times, (gap, width) = _columns(measured, (GAP, WIDTH))
    pucker = None
    if shapes is not None:
        own, (rounded,) = _columns(shapes, (PUCKER,))
        pucker = Curve(_middles(own), rounded)
    middles = _middles(times)
    return Recording(Curve(middles, gap), Curve(middles, width), pucker)


def _middles(times: Floats) -> Floats:
    return times + 0.5 * float(np.median(np.diff(times)))


def _columns(path: str | Path, names: tuple[str, ...]) -> tuple[Floats, tuple[Floats, ...]]:
    """Return the column ``time`` and those named."""
    wanted = ("time", *names)
    try:
        lines = read_bytes(path).decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise FileFormatError("is no text", where=str(path), expected="a CSV file") from None
    table = csv.reader(lines)
    header = [cell.strip() for cell in next(table, [])]
    missing = [name for name in wanted if name not in header]
    if missing:
        raise FileFormatError(
            f"no column {', '.join(missing)}",
            where=str(path),
            expected=f"a CSV file with the columns {', '.join(wanted)}",
        )
    places = [header.index(name) for name in wanted]
    rows = [
        [_number(row, place, f"{path}, line {table.line_num}") for place in places]
        for row in table
        if row
    ]
    if len(rows) < FEWEST:
        raise FileFormatError(f"{len(rows)} frames", where=str(path), expected=f"{FEWEST} or more")
    columns = np.array(rows, dtype=np.float64).T
    late = np.flatnonzero(np.diff(columns[0]) <= 0)
    if len(late):
        raise FileFormatError(
            f"time {columns[0][late[0] + 1]:g} s comes after {columns[0][late[0]]:g} s",
            where=str(path),
            expected="times that increase",
        )
    return columns[0], tuple(columns[1:])


def _number(row: list[str], place: int, where: str) -> float:
    cell = row[place] if place < len(row) else ""
    try:
        value = float(cell)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise FileFormatError(f"{cell!r}", where=where, expected="a finite number")
    return value
