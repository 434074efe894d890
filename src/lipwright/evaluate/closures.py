"""Whether lips meet where a recorded face's lips meet, and how far apart in time.

A face counts as closed where its opening is at most a share of its range. The lower lip of
an /f/ meets the teeth and leaves a gap between the lips: its share is greater. What a
recorded face did not close is not asked of the animation: speakers leave closures out, and
one can fall between two frames of video.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lipwright.curves import Floats
from lipwright.evaluate.curve import Curve
from lipwright.phones import SILENCE, PhoneTrack

KINDS = {"p b m": ("p", "b", "m", "bmp"), "f v": ("f", "v")}
SHARES = {"p b m": 0.15, "f v": 0.35}
"""Closed: at most this share of a mouth's range is open."""
AROUND = 0.06
"""Seconds beside a phone in which its closure is looked for."""
DEPTH = 0.10
"""A closure lasts while the mouth is open by no more than this share of its range beyond
the least that it comes to."""
FARTHEST = 0.3
"""Seconds beyond a phone at which its closure is taken to have ended."""


@dataclass(frozen=True, slots=True)
class Closures:
    """How the closures of one kind of phone were met.

    Parameters
    ----------
    phones : int
        How many such phones there are.
    recorded : int
        At how many of them the recorded face is closed.
    met : float or None
        Share of these at which the animation is closed too.
    median_ms, within_40_ms : float or None
        Time between the two closures, where both are closed, and the share of those that
        are at most 40 ms apart: between their middles; next to a silence, in which a mouth
        may stay closed, between the edges that face the speech.
    later_ms : float or None
        Median of how much later the animation closes.
    own : int
        At how many of the phones the animation is closed.
    own_met : float or None
        Share of these at which the recorded face is closed too.
    """

    phones: int
    recorded: int
    met: float | None
    median_ms: float | None
    within_40_ms: float | None
    later_ms: float | None
    own: int = 0
    own_met: float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Mouths:
    """The same stretch of speech in animation and recording, with each one's range.

    Parameters
    ----------
    animation, recording : Curve
        Openings on one clock.
    ranges : tuple of two (low, high)
        Of the animation and of the recording.
    phones : PhoneTrack
    """

    animation: Curve
    recording: Curve
    ranges: tuple[tuple[float, float], tuple[float, float]]
    phones: PhoneTrack


def closures(mouths: Sequence[Mouths], kind: str) -> Closures:
    """Measure the closures of one of :data:`KINDS`."""
    count, met, apart, own = 0, [], [], []
    for one in mouths:
        phones = list(one.phones)
        for index, phone in enumerate(phones):
            if phone.label not in KINDS[kind]:
                continue
            count += 1
            silent = (
                index == 0 or phones[index - 1].label == SILENCE,
                index == len(phones) - 1 or phones[index + 1].label == SILENCE,
            )
            ours, theirs = (
                _closed(curve, limits, SHARES[kind], phone.start, phone.end)
                for curve, limits in zip((one.animation, one.recording), one.ranges, strict=True)
            )
            if ours is not None:
                own.append(theirs is not None)
            if theirs is None:
                continue
            met.append(ours is not None)
            if ours is not None:
                apart.append(_moment(ours, silent) - _moment(theirs, silent))
    found = _summary(count, met, 1e3 * np.array(apart))
    return replace(found, own=len(own), own_met=float(np.mean(own)) if own else None)


def _closed(
    curve: Curve, limits: tuple[float, float], share: float, start: float, end: float
) -> tuple[float, float] | None:
    """Return when the mouth is closed around a phone, or None."""
    near = (curve.times >= start - AROUND) & (curve.times <= end + AROUND)
    if not near.any():
        return None
    inside = np.flatnonzero(near)
    least = int(inside[curve.values[inside].argmin()])
    low, high = limits
    if curve.values[least] > low + share * (high - low):
        return None
    threshold = max(low, curve.values[least]) + DEPTH * (high - low)
    open_ = np.flatnonzero(curve.values > threshold)
    after = int(np.searchsorted(open_, least))
    first = _edge(curve, int(open_[after - 1]), 1, threshold) if after else -np.inf
    last = _edge(curve, int(open_[after]), -1, threshold) if after < len(open_) else np.inf
    return max(first, start - FARTHEST), min(last, end + FARTHEST)


def _edge(curve: Curve, outer: int, step: int, threshold: float) -> float:
    """Return when the curve crosses the threshold between an open frame and a closed one."""
    inner = outer + step
    share = (curve.values[outer] - threshold) / (curve.values[outer] - curve.values[inner])
    return float(curve.times[outer] + share * (curve.times[inner] - curve.times[outer]))


def _moment(closed: tuple[float, float], silent: tuple[bool, bool]) -> float:
    if silent[0] != silent[1]:
        return closed[1] if silent[0] else closed[0]
    return 0.5 * (closed[0] + closed[1])


def _summary(count: int, met: list[bool], apart_ms: Floats) -> Closures:
    if not len(apart_ms):
        return Closures(count, len(met), float(np.mean(met)) if met else None, None, None, None)
    return Closures(
        count,
        len(met),
        float(np.mean(met)),
        float(np.median(np.abs(apart_ms))),
        float(np.mean(np.abs(apart_ms) <= 40.0)),
        float(np.median(apart_ms)),
    )
