"""An animated mouth held against a recorded one: the figures of DESIGN section 11.

All is compared at the middle of each frame of the recordings, at one lag for all pairs:
that within 40 ms either way at which the openings agree best. Correlations are taken
within each pair and averaged. Where units differ, a mouth is measured in its own range,
the 5th to the 95th percentile over all pairs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lipwright.curves import Floats
from lipwright.errors import InputError
from lipwright.evaluate.closures import KINDS, SHARES, Closures, Mouths, closures
from lipwright.evaluate.curve import Curve, span, turns
from lipwright.evaluate.recording import Recording
from lipwright.phones import SILENCE, PhoneTrack

LAGS = np.arange(-8, 9) * 0.005
TURN = 0.10
"""A change of direction counts if the mouth goes back by this share of its range."""
NEAR = 0.12
"""Seconds within which two peaks can be the same."""
SETTLED = 0.2
"""Seconds next to speech in which a mouth prepares, or comes to rest: no silence yet."""
FEWEST = 3


@dataclass(frozen=True, slots=True, eq=False)
class Pair:
    """An animation's mouth, and a recorded one of the same speech on the same clock.

    Parameters
    ----------
    opening, breadth : Curve
        Of the animated character, as measured on its mesh: how far its lips are apart, and
        from corner to corner; in any unit.
    recording : Recording
    phones : PhoneTrack
        When each phone sounds; without phones, closures and silence are not measured.
    name : str
        In errors.
    """

    opening: Curve
    breadth: Curve
    recording: Recording
    phones: PhoneTrack
    name: str = ""


@dataclass(frozen=True, slots=True)
class Likeness:
    """How alike two measures run.

    Parameters
    ----------
    correlation : float
        Mean over the pairs, each within itself; a mouth that does not move has 0.
    rms : float
        Of the difference, where one gain and offset for all pairs bring the animation
        closest; as a share of the recording's range.
    """

    correlation: float
    rms: float


@dataclass(frozen=True, slots=True)
class Peaks:
    """When the mouth is most open.

    Parameters
    ----------
    recorded : int
    met : float or None
        Share of the recorded peaks that have one of the animation within 120 ms.
    median_ms, later_ms : float or None
        Median time between the two, and how much later the animation's is.
    """

    recorded: int
    met: float | None
    median_ms: float | None
    later_ms: float | None


@dataclass(frozen=True, slots=True)
class Beside:
    """A figure of the animation beside the same one of the recording.

    Parameters
    ----------
    animation, recording : float
    """

    animation: float
    recording: float


@dataclass(frozen=True, slots=True)
class MotionReport:
    """What :func:`compare` finds.

    Parameters
    ----------
    pairs, frames : int
        How much was compared.
    lag_ms : float
        How much later the recorded faces move than the animations; within 40 either way.
    opening : Likeness
        Of the opening with the gap between the inner lips.
    rounding : Likeness
        Of the narrowing with that from corner to corner.
    pucker : Likeness or None
        Of the narrowing with how far the lips are scored to be rounded.
    peaks : Peaks
        Of the opening.
    closures : dict of str to Closures
        For ``"p b m"`` and ``"f v"``; empty where no phones are known.
    closed_share : dict of str to float
        Each kind is closed up to this share of a mouth's range.
    silence : Beside or None
        Mean speed of the opening in silences, ranges per second.
    turns : Beside
        Changes of direction of the opening per second.
    turn_share : float
        They count from this share of a mouth's range.
    """

    pairs: int
    frames: int
    lag_ms: float
    opening: Likeness
    rounding: Likeness
    pucker: Likeness | None
    peaks: Peaks
    closures: dict[str, Closures]
    closed_share: dict[str, float]
    silence: Beside | None
    turns: Beside
    turn_share: float


def compare(pairs: Sequence[Pair]) -> MotionReport:
    """Hold animations against recordings.

    Parameters
    ----------
    pairs : sequence of Pair

    Raises
    ------
    InputError
        If there are no pairs, or a recording does not move.
    """
    if not pairs:
        raise InputError("nothing to compare", expected="an animation and a recording")
    for pair in pairs:
        if np.ptp(pair.recording.opening.values) == 0 or np.ptp(pair.recording.breadth.values) == 0:
            raise InputError("the recorded mouth does not move", where=pair.name)
    lag = best_lag(pairs)
    ours = [pair.opening.later(lag).at(pair.recording.opening.times) for pair in pairs]
    theirs = [pair.recording.opening.values for pair in pairs]
    narrow = [-pair.breadth.later(lag).at(pair.recording.breadth.times) for pair in pairs]
    ranges = span(np.concatenate(ours)), span(np.concatenate(theirs))
    spoken = [
        Mouths(pair.opening.later(lag), pair.recording.opening, ranges, pair.phones)
        for pair in pairs
        if len(pair.phones)
    ]
    scaled = [
        [_share(values, limits) for values in side]
        for side, limits in zip((ours, theirs), ranges, strict=True)
    ]
    times = [pair.recording.opening.times for pair in pairs]
    return MotionReport(
        len(pairs),
        sum(map(len, ours)),
        round(1e3 * lag, 3),
        _likeness(ours, theirs),
        _likeness(narrow, [-pair.recording.breadth.values for pair in pairs]),
        _pucker(pairs, lag),
        _peaks(times, *scaled),
        {kind: closures(spoken, kind) for kind in KINDS} if spoken else {},
        dict(SHARES),
        _silence(pairs, times, *scaled),
        Beside(*(_turns_per_second(times, side) for side in scaled)),
        TURN,
    )


def best_lag(pairs: Sequence[Pair]) -> float:
    """Return the lag of :data:`LAGS`, in seconds, at which the openings agree best."""
    means = [
        np.mean(
            [
                correlation(
                    pair.opening.later(lag).at(pair.recording.opening.times),
                    pair.recording.opening.values,
                )
                for pair in pairs
            ]
        )
        for lag in LAGS.tolist()
    ]
    best = np.flatnonzero(np.isclose(means, np.max(means), rtol=0, atol=1e-12))
    return float(LAGS[best[np.argmin(np.abs(LAGS[best]))]])


def correlation(one: Floats, other: Floats) -> float:
    """Return Pearson's correlation; 0 where one of the two does not change."""
    one, other = one - one.mean(), other - other.mean()
    norm = float(np.sqrt((one @ one) * (other @ other)))
    return float(one @ other) / norm if norm > 1e-20 else 0.0


def _likeness(ours: list[Floats], theirs: list[Floats]) -> Likeness:
    alike = np.mean([correlation(a, b) for a, b in zip(ours, theirs, strict=True)])
    a, b = np.concatenate(ours), np.concatenate(theirs)
    low, high = span(b)
    rest = b.std() * np.sqrt(max(1 - correlation(a, b) ** 2, 0.0))
    return Likeness(float(alike), float(rest / max(high - low, 1e-12)))


def _pucker(pairs: Sequence[Pair], lag: float) -> Likeness | None:
    ours, theirs = [], []
    for pair in pairs:
        pucker = pair.recording.pucker
        if pucker is not None and np.ptp(pucker.values) > 0:
            ours.append(-pair.breadth.later(lag).at(pucker.times))
            theirs.append(pucker.values)
    return _likeness(ours, theirs) if ours else None


def _share(values: Floats, limits: tuple[float, float]) -> Floats:
    low, high = limits
    return (values - low) / max(high - low, 1e-12)


def _peaks(times: list[Floats], ours: list[Floats], theirs: list[Floats]) -> Peaks:
    apart: list[float] = []
    recorded = 0
    for clock, mine, face in zip(times, ours, theirs, strict=True):
        known, made = clock[turns(face, TURN)[0]], clock[turns(mine, TURN)[0]]
        recorded += len(known)
        for time in known.tolist() if len(made) else []:
            off = float(made[np.abs(made - time).argmin()]) - time
            if abs(off) <= NEAR:
                apart.append(1e3 * off)
    if not recorded:
        return Peaks(0, None, None, None)
    if not apart:
        return Peaks(recorded, 0.0, None, None)
    median, later = float(np.median(np.abs(apart))), float(np.median(apart))
    return Peaks(recorded, len(apart) / recorded, round(median, 3), round(later, 3))


def _turns_per_second(times: list[Floats], values: list[Floats]) -> float:
    count = sum(sum(map(len, turns(one, TURN))) for one in values)
    return count / sum(float(np.ptp(clock)) for clock in times)


def _silence(
    pairs: Sequence[Pair], times: list[Floats], ours: list[Floats], theirs: list[Floats]
) -> Beside | None:
    speeds: tuple[list[Floats], list[Floats]] = ([], [])
    for pair, clock, *both in zip(pairs, times, ours, theirs, strict=True):
        if not len(pair.phones):
            continue
        silent = np.ones(len(clock) - 1, dtype=bool)
        for phone in pair.phones:
            if phone.label != SILENCE:
                silent &= (clock[1:] < phone.start - SETTLED) | (clock[:-1] > phone.end + SETTLED)
        for found, values in zip(speeds, both, strict=True):
            found.append(np.abs(np.diff(values) / np.diff(clock))[silent])
    moving = [np.concatenate(side) for side in speeds if side]
    if not moving or len(moving[0]) < FEWEST:
        return None
    return Beside(float(moving[0].mean()), float(moving[1].mean()))
