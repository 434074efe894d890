"""From the times that a file gives its rows to frames at one even rate.

A row's time is when its frame begins: the frame covers the time from there to the next
row, and its value holds in the middle. Frames that are missing are filled along a straight
line; rows that come unevenly are drawn onto an even grid. Both are said.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.capture.motion import Floats
from lipwright.errors import FileFormatError

RATES = (23.976, 24, 25, 29.97, 30, 48, 50, 59.94, 60, 90, 100, 119.88, 120, 150, 200, 240)
"""Rates that cameras have; one so near is taken for exact."""
NEAR = 0.0015
UNEVEN = 0.2
"""Share of a frame by which rows may come early or late before they are drawn even."""
LONGEST_GAP = 0.5
"""Seconds of missing frames that are filled."""
SLOWEST, FASTEST = 10.0, 1000.0
OWN_CLOCK = 1000.0
"""A first time beyond this, in seconds, is a clock's and not the sound's."""
FEWEST = 4
_TIMECODE = re.compile(r"(\d{1,2}):(\d{1,2}):(\d{1,2})[:;](\d+(?:\.\d+)?)", re.ASCII)
_COUNTED = (24, 25, 30, 48, 50, 60, 100, 120, 240)


@dataclass(slots=True)
class Clock:
    """When each row of a file begins.

    Parameters
    ----------
    times : (N,) float64
        Seconds, as the file counts them.
    own : bool
        Whether the file's clock is its own, so that its first row is the sound's start.
    rate : float, optional
        Frames per second, where the file says it.
    notes : list of str
    """

    times: Floats
    own: bool = False
    rate: float | None = None
    notes: list[str] = field(default_factory=list)


def clock_of_seconds(times: Floats, *, milliseconds: bool | None) -> Clock:
    """Return the clock of a column of times; ``None`` looks whether it counts milliseconds."""
    notes = []
    if milliseconds is None and len(times) > 1 and float(np.median(np.diff(times))) >= 0.5:
        milliseconds = True
        notes.append("times are read as milliseconds")
    times = times / 1e3 if milliseconds else times
    own = bool(len(times)) and not -OWN_CLOCK / 10 < times[0] < OWN_CLOCK
    if own:
        notes.append(f"its clock begins at {times[0]:.0f} s: the first frame is taken as 0 s")
    return Clock(times, own, None, notes)


def clock_of_frames(frames: Floats, rate: float) -> Clock:
    """Return the clock of a column of frame numbers; its first row is the sound's start."""
    return Clock(frames / rate, True, rate)


def clock_of_timecodes(codes: Sequence[str], places: Sequence[str], rate: float | None) -> Clock:
    """Return the clock of SMPTE timecodes ``HH:MM:SS:FF.fff``, as Live Link Face writes them.

    Parameters
    ----------
    codes : sequence of str
        ``FF.fff`` are frames and thousandths of a frame.
    places : sequence of str
        Where each stands.
    rate : float, optional
        Frames per second; without it the least usual rate that has room for all ``FF``.

    Raises
    ------
    FileFormatError
        If one is no timecode.
    """
    parts = np.zeros((len(codes), 4))
    for number, code in enumerate(codes):
        match = _TIMECODE.fullmatch(code.strip())
        if match is None:
            raise FileFormatError(
                f"{code.strip()[:40]!r}",
                where=places[number],
                expected="a timecode HH:MM:SS:FF.fff",
            )
        parts[number] = [float(group) for group in match.groups()]
    seconds = parts[:, :3] @ [3600.0, 60.0, 1.0]
    seconds += 86400.0 * np.cumsum(np.diff(seconds, prepend=seconds[:1]) < -43200.0)
    notes = []
    if rate is None:
        rate, sure = _counted_rate(parts[:, 3], seconds)
        if not sure:
            notes.append(f"shorter than a second: {rate:g} frames per second are assumed")
    return Clock(seconds + parts[:, 3] / rate, True, None, notes)


def _counted_rate(frames: Floats, seconds: Floats) -> tuple[float, bool]:
    """The rate at which frames of a second are counted, and whether a whole second says so."""
    top = float(np.floor(frames).max(initial=0)) + 1
    rate = next((float(known) for known in _COUNTED if known >= top), top)
    sure = bool(np.unique(seconds).size > 2 or top > 50)
    return (rate if sure else max(rate, 60.0)), sure


@dataclass(frozen=True, slots=True, eq=False)
class Grid:
    """An even grid, and where on it the rows of a file lie.

    Parameters
    ----------
    positions : (N,) float64
        In frames from the first.
    kept : (N,) int
        The rows they belong to.
    count : int
        Frames of the grid.
    rate, start : float
    notes : tuple of str
    """

    positions: Floats
    kept: NDArray[np.intp]
    count: int
    rate: float
    start: float
    notes: tuple[str, ...]

    def lay(self, values: Floats) -> NDArray[np.float32]:
        """Return values of the rows (rows, C) as frames (count, C)."""
        rows = values[self.kept]
        if len(rows) == self.count and np.array_equal(self.positions, np.arange(self.count)):
            return rows.astype(np.float32)
        at = np.arange(self.count, dtype=np.float64)
        columns = [np.interp(at, self.positions, column) for column in rows.T]
        return np.stack(columns, axis=1).astype(np.float32)


def even(clock: Clock, places: Sequence[str], where: str) -> Grid:
    """Find the even grid that rows lie on.

    Raises
    ------
    FileFormatError
        If times go back, there are too few rows, or a rate that no camera has.
    """
    times, notes = clock.times, list(clock.notes)
    steps = np.diff(times)
    back = np.flatnonzero(steps < 0)
    if len(back):
        raise FileFormatError(
            f"{times[back[0] + 1]:g} s comes after {times[back[0]]:g} s",
            where=places[back[0] + 1],
            expected="times that increase",
        )
    kept = np.concatenate([[0], 1 + np.flatnonzero(steps > 0)]).astype(np.intp)[: len(times)]
    if len(kept) < len(times):
        notes.append(f"{len(times) - len(kept)} rows repeat the time before: left out")
    times = times[kept]
    if len(times) < FEWEST:
        raise FileFormatError(f"{len(times)} frames", where=where, expected=f"{FEWEST} or more")
    rate, positions = _rate(times, clock.rate)
    # Milliseconds taken for frames come to 1000 exactly, or a rounding beside it.
    if not SLOWEST <= round(rate, 6) < FASTEST:
        raise FileFormatError(
            f"{rate:.4g} frames per second",
            where=where,
            expected=f"{SLOWEST:g} or more, and fewer than {FASTEST:g}",
            cure="check whether the times are seconds, milliseconds or frames",
        )
    notes += _missing(positions, times, rate, [places[row] for row in kept])
    start = 0.0 if clock.own else float(times[0])
    count = round(float(positions[-1])) + 1
    return Grid(positions, kept, count, rate, start, tuple(notes))


def _rate(times: Floats, known: float | None) -> tuple[float, Floats]:
    """Return the rate, and each row's place in frames: whole where rows come evenly."""
    steps = np.diff(times)
    middle = float(np.median(steps))
    index = np.concatenate([[0], np.cumsum(np.maximum(np.round(steps / middle), 1))])
    step, first = np.polyfit(index, times, 1)
    rate = known or _usual(1 / float(step))
    if known is None and np.abs(times - (first + step * index)).max() * rate <= UNEVEN:
        return rate, index
    if known is None:
        rate = _usual(1 / float(steps[steps < 1.75 * middle].mean()), 5 * NEAR)
    places = (times - times[0]) * rate
    whole = np.round(places)
    if np.abs(places - whole).max() <= UNEVEN and np.diff(whole).min() > 0:
        return rate, whole
    return rate, places


def _usual(rate: float, near: float = NEAR) -> float:
    nearest = min(RATES, key=lambda known: abs(known - rate))
    return float(nearest) if abs(nearest - rate) <= near * nearest else rate


def _missing(positions: Floats, times: Floats, rate: float, places: list[str]) -> list[str]:
    notes = []
    steps = np.diff(positions)
    if not np.array_equal(positions, np.round(positions)):
        notes.append(f"rows come unevenly: drawn onto {rate:.6g} frames per second")
    longest = int(np.argmax(steps))
    gap = (float(steps[longest]) - 1) / rate
    if gap > LONGEST_GAP:
        raise FileFormatError(
            f"{gap:.2f} s without a frame before it",
            where=places[longest + 1],
            expected=f"gaps of at most {LONGEST_GAP:g} s",
            cure="cut the take there into two",
        )
    lost = int(np.maximum(np.round(steps) - 1, 0).sum())
    if lost:
        share = lost / (round(float(positions[-1])) + 1)
        notes.append(f"{lost} frames ({share:.1%}) missing, at most {gap:.2f} s: filled")
    return notes
