"""Rhubarb Lip Sync's TSV: ``seconds <tab> shape`` on each line, the last one the end.

Its nine mouth shapes, A to H and X, are said in the nine FaceFX poses as its own
documentation describes them. A shape holds until the next one: there is nothing between.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from lipwright.animation import Animation
from lipwright.errors import FileFormatError
from lipwright.files import read_bytes

RATE = 100.0
LONGEST = 24 * 3600.0
CONTROLS = ("open", "W", "wide", "FV", "PBM", "tRoof")
SHAPES: dict[str, dict[str, float]] = {
    "A": {"PBM": 1.0},  # p b m: closed, pressed
    "B": {"open": 0.14, "wide": 0.35},  # k s t, ee: slightly open, teeth clenched
    "C": {"open": 0.40, "wide": 0.15},  # eh, ae: open
    "D": {"open": 0.70},  # aa: wide open
    "E": {"open": 0.40, "W": 0.35},  # ao, er: slightly rounded
    "F": {"open": 0.12, "W": 0.90},  # uw, ow, w: puckered
    "G": {"FV": 1.0},  # f v
    "H": {"open": 0.35, "tRoof": 0.80},  # long l
    "X": {},  # idle
}


def is_rhubarb(path: str | Path) -> bool:
    """Whether a file's name is that of a table of Rhubarb's."""
    return Path(path).suffix.lower() == ".tsv"


def read_rhubarb(path: str | Path) -> Animation:
    """Read a TSV of Rhubarb's as an animation of the nine poses.

    Raises
    ------
    FileFormatError
        If a line is not a time and a shape: it names the line.
    InputError
        If the file cannot be read.
    """
    try:
        lines = read_bytes(path).decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise FileFormatError("is no text", where=str(path), expected="Rhubarb's TSV") from None
    cues = [_cue(line, f"{path}, line {n}") for n, line in enumerate(lines, 1) if line.strip()]
    if not cues:
        raise FileFormatError("is empty", where=str(path), expected="Rhubarb's TSV")
    starts = np.array([time for time, _ in cues])
    if np.any(np.diff(starts) < 0):
        raise FileFormatError("times go back", where=str(path), expected="times in order")
    weights = np.array([[SHAPES[shape].get(name, 0.0) for name in CONTROLS] for _, shape in cues])
    times = np.arange(math.ceil(starts[-1] * RATE) + 1) / RATE
    row = np.searchsorted(starts, times + 1e-9, side="right") - 1
    values = np.where(row[:, None] >= 0, weights[np.maximum(row, 0)], 0.0)
    return Animation(CONTROLS, values.astype(np.float32), RATE, engine="rhubarb")


def _cue(line: str, where: str) -> tuple[float, str]:
    cells = line.split()
    expected = f"seconds and one of {' '.join(SHAPES)}"
    if len(cells) != 2 or cells[1] not in SHAPES:
        raise FileFormatError(repr(line[:40]), where=where, expected=expected)
    try:
        time = float(cells[0])
    except ValueError:
        raise FileFormatError(repr(line[:40]), where=where, expected=expected) from None
    if not 0 <= time <= LONGEST:
        raise FileFormatError(f"time {cells[0]}", where=where, expected="0 to 86400 s")
    return time, cells[1]
