"""From rows to tiers: units of time, rounding, and whether the times fit the sound.

Overlaps of up to 10 ms, which rounding makes, are closed in the middle (DESIGN section
4); all others are errors that name both labels. Where times make no sense, the error
guesses the mistake.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lipwright.errors import LabelError
from lipwright.phones import SILENCE
from lipwright.schedule.labels.rows import Row, Unit
from lipwright.timeline import Interval, Tier

ROUNDING = 0.010
"""Seconds by which neighbours may overlap."""

MARGIN = 0.1
"""Seconds by which labels may run on after the sound."""

TIMIT_RATE = 16000
_SHORTEST_LINE = 0.05
_GIVE_RATE = "the times look like samples: give their rate"
_TO_SECONDS = "the times look like milliseconds: divide them by 1000"


def in_seconds(rows: Sequence[Row], unit: Unit, rate: int | None, where: str) -> list[Row]:
    """Return rows in seconds.

    Parameters
    ----------
    rows : sequence of Row
        With times in ``unit``.
    unit : str
        What the file's times count.
    rate : int, optional
        Samples per second: whole numbers are then samples, whatever the format says.
    where : str
        The file, for errors.

    Raises
    ------
    LabelError
        If times that should be in 100 ns are far too small for that.
    """
    are_whole = all(row.start.is_integer() and row.end.is_integer() for row in rows)
    if unit == "seconds" and not (rate and are_whole):
        return list(rows)
    per_second = rate or (TIMIT_RATE if unit == "samples" else 10_000_000)
    end = max((row.end for row in rows), default=0.0)
    if unit == "100 ns" and rate is None and 0 < end / per_second < _SHORTEST_LINE:
        raise LabelError(
            f"whole numbers that end at {end:.0f}",
            where=where,
            expected="times in units of 100 ns, or seconds with a point",
            cure="if these are samples, give their rate; if milliseconds, divide them by 1000",
        )
    return [replace(row, start=row.start / per_second, end=row.end / per_second) for row in rows]


def tier(rows: Sequence[Row], where: str, *, overlap: float = ROUNDING) -> Tier:
    """Return rows (in seconds) as a tier; silence that takes no time is left out.

    Neighbours that overlap by up to ``overlap`` seconds meet in the middle.

    Raises
    ------
    LabelError
        If a label takes no time or runs backwards, or two overlap by more than rounding
        explains: it names the labels and their places.
    """
    kept: list[Row] = []
    for row in rows:
        if row.label == SILENCE and row.end == row.start:
            continue
        if row.start < -MARGIN:
            raise LabelError(
                f"{row.label!r} starts at {row.start:.6g} s",
                where=f"{where}, {row.place}",
                expected="times from 0 on",
            )
        if kept and row.start < kept[-1].end:
            kept[-1], row = _parted(kept[-1], row, where, overlap)
        kept.append(row)
    return Tier(tuple(_interval(row, where) for row in kept))


def _parted(a: Row, b: Row, where: str, overlap: float) -> tuple[Row, Row]:
    if a.end - b.start > overlap + 1e-9 or b.start < a.start:
        kind = "starts before" if b.start < a.start else "overlaps"
        raise LabelError(
            f"{b.label!r} ({b.start:.6g} to {b.end:.6g} s) {kind}"
            f" {a.label!r} ({a.start:.6g} to {a.end:.6g} s)",
            where=f"{where}, {b.place}",
            expected="labels in order, without overlap",
        )
    middle = 0.5 * (a.end + b.start)
    return replace(a, end=middle), replace(b, start=middle)


def _interval(row: Row, where: str) -> Interval:
    try:
        return Interval(row.label, row.start, row.end, row.confidence)
    except LabelError as error:
        raise error.at(f"{where}, {row.place}") from None


def check_against(phones: Tier, duration: float, rate: int, where: str) -> None:
    """Refuse labels that do not fit their sound.

    Parameters
    ----------
    phones : Tier
        In seconds.
    duration : float
        The sound's length in seconds.
    rate : int
        The sound's samples per second, for the guess.
    where : str
        The file, for errors.

    Raises
    ------
    LabelError
        If they run on after its end by more than 0.1 s, or end before a fiftieth of it.
    """
    end = phones.end
    if not (end > duration + MARGIN or 0 < end < 0.02 * duration):
        return
    raise LabelError(
        f"the labels end at {end:.6g} s, the sound at {duration:.6g} s",
        where=where,
        expected="labels of this sound",
        cure=_mistake(end, duration, rate),
    )


def _mistake(end: float, duration: float, rate: int) -> str:
    ratio = end / duration
    if 500 < ratio < 1100:
        return _TO_SECONDS
    samples = {rate, 8000, 16000, 22050, 44100, 48000}
    if any(0.5 < ratio / count < 1.1 for count in samples):
        return _GIVE_RATE
    # Samples that were read as units of 100 ns, or at another rate than their own.
    if any(0.5 < ratio * 1e7 / count < 1.1 for count in samples):
        return _GIVE_RATE
    if any(0.9 < ratio * TIMIT_RATE / count < 1.1 for count in samples - {TIMIT_RATE}):
        return "the samples may be counted at another rate: give it"
    return "check that they belong together"
