"""CSV of blendshapes: a row per frame (ARKit, Live Link Face, tracked video, own tables).

How a row's time is read (a value holds in the middle of its frame, always):

=================== ============================================================
column              the frame begins
=================== ============================================================
``time`` (s or ms)  at that time of the sound: row ``t`` holds at ``t + 0.5 / rate``;
                    with ``time_is="middle"`` it holds at ``t`` itself
``Timecode``        Live Link Face's; the first row is the sound's start
``frame``           at the frame's number over ``rate``; the first row is the sound's start
none                row after row at ``rate``; the first row is the sound's start
=================== ============================================================

A table of Lipwright's own export gives instants: ``time_is="middle"``.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Literal

import numpy as np

from lipwright.engines.motion.capture.blendshapes import arkit_name, learnt
from lipwright.engines.motion.capture.motion import Floats, Motion
from lipwright.engines.motion.capture.tables import Table, read_table
from lipwright.engines.motion.capture.timing import (
    Clock,
    clock_of_frames,
    clock_of_seconds,
    clock_of_timecodes,
    even,
)
from lipwright.errors import FileFormatError

TimeIs = Literal["start", "middle"]

_SECONDS = re.compile(r"(time|timestamps?|t|seconds|secs?)[\s_]*[\[(]?(s|secs?|seconds)?[\])]?")
_MILLISECONDS = re.compile(
    r"(time|timestamps?|t)[\s_]*[\[(]?(ms|msecs?|millis|milliseconds)[\])]?|ms|milliseconds"
)
_FRAMES = re.compile(r"frames?[\s_]*(number|no|index|id|count)?")
_NO_CHANNEL = re.compile(r"blendshapecount|take|slate|fps|rate|confidence|success")
_SLACK = 0.01


def read_csv(path: str | Path, *, rate: float | None = None, time_is: TimeIs = "start") -> Motion:
    """Read blendshapes over time.

    Parameters
    ----------
    path : path
    rate : float, optional
        Frames per second, for a table that counts frames instead of seconds; of timecodes
        it says how many frames make a second.
    time_is : str
        Whether a row's time is when its frame begins (``"start"``) or its instant.

    Raises
    ------
    FileFormatError
        If the table has no times or channels, a cell is no finite number, times go back, or
        more than half a second is missing.
    InputError
        If the file cannot be read.
    """
    table = read_table(path)
    timing, channels = _columns(table)
    numbers = np.arange(len(table.rows), dtype=np.float64)
    if channels and (lost := table.blank(channels)):
        table, numbers = table.without(lost), np.delete(numbers, sorted(lost))
    chosen, left_out = learnt([table.header[column] for column in channels])
    if not chosen:
        raise FileFormatError(
            f"no channel of a mouth among {len(channels)} columns",
            where=f"{table.where}, line 1",
            expected="names such as jawOpen",
        )
    _check_names(table, [channels[i] for i in chosen], tuple(chosen.values()))
    values = table.numbers([channels[i] for i in chosen])
    clock, places = _clock(table, timing, rate, numbers)
    grid = even(clock, places, table.where)
    values, said = _in_range(values, tuple(chosen.values()))
    notes = [*said, *grid.notes]
    if left_out:
        notes.append(f"not learnt from: {_some(left_out)}")
    early = 0.5 / grid.rate if time_is == "middle" and not clock.own else 0.0
    return Motion(
        tuple(chosen.values()),
        grid.lay(values),
        grid.rate,
        grid.start - early,
        tuple(notes),
        "blendshapes",
        table.where,
    )


def _columns(table: Table) -> tuple[dict[str, int], list[int]]:
    """Return the columns that tell the time, by kind, and those that hold channels."""
    timing: dict[str, int] = {}
    channels = []
    for column, name in enumerate(table.header):
        flat = name.lower()
        if flat == "timecode":
            timing.setdefault("timecode", column)
        elif _MILLISECONDS.fullmatch(flat):
            timing.setdefault("milliseconds", column)
        elif _SECONDS.fullmatch(flat):
            timing.setdefault("seconds", column)
        elif _FRAMES.fullmatch(flat):
            timing.setdefault("frame", column)
        elif name and not _NO_CHANNEL.fullmatch(flat):
            channels.append(column)
    return timing, channels


def _clock(
    table: Table, timing: dict[str, int], rate: float | None, numbers: Floats
) -> tuple[Clock, list[str]]:
    """Return when each row begins, and its place for messages; ``numbers`` count the rows."""
    kind = next((k for k in ("timecode", "seconds", "milliseconds", "frame") if k in timing), "")
    column = timing.get(kind, 0)
    places = [table.place(row, column) for row in range(len(table.rows))]
    if kind == "timecode":
        codes = [row[column] for row in table.rows]
        return clock_of_timecodes(codes, places, rate), places
    if kind in ("seconds", "milliseconds"):
        exact = True if kind == "milliseconds" else _says_seconds(table.header[column])
        return clock_of_seconds(table.numbers([column])[:, 0], milliseconds=exact), places
    if rate is None:
        found = f"only the column {table.header[column]!r} for the time" if kind else "no times"
        raise FileFormatError(
            found,
            where=f"{table.where}, line 1",
            expected="a column 'time' (seconds), 'time_ms' or 'Timecode'",
            cure="else say how many frames make a second",
        )
    return clock_of_frames(table.numbers([column])[:, 0] if kind else numbers, rate), places


def _says_seconds(name: str) -> bool | None:
    """False where a column's name says that it counts seconds; None where it does not say."""
    return False if re.search(r"sec|[\s_\[(]s[\])]?$", name.lower()) else None


def _check_names(table: Table, columns: list[int], names: tuple[str, ...]) -> None:
    """Refuse two spellings of one channel."""
    for number, name in enumerate(names):
        if name in names[:number]:
            one, other = (table.header[columns[i]] for i in (names.index(name), number))
            raise FileFormatError(
                f"the columns {one!r} and {other!r} both mean {name}",
                where=f"{table.where}, line 1",
                expected="each channel once",
            )


def _in_range(values: Floats, names: tuple[str, ...]) -> tuple[Floats, list[str]]:
    """Bring per cents to 0..1, and say which ARKit values go beyond; other units may be any."""
    if not len(values) or not any(arkit_name(name) for name in names):
        return values, []
    notes = []
    moving = values.max(axis=0)[np.ptp(values, axis=0) > 0]
    if len(moving) and np.median(moving) > 2:
        values = values / 100
        notes.append("values are read as per cent")
    low, high = values.min(axis=0), values.max(axis=0)
    beyond = np.flatnonzero((low < -_SLACK) | (high > 1 + _SLACK))
    if len(beyond):
        said = tuple(f"{names[i]} {low[i]:.3g} to {high[i]:.3g}" for i in beyond)
        notes.append(f"beyond 0..1, kept: {_some(said)}")
    return values, notes


def _some(names: tuple[str, ...], count: int = 4) -> str:
    more = len(names) - count
    return ", ".join(names[:count]) + (f" and {more} more" if more > 0 else "")
