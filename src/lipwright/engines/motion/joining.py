"""From a path of units to a motion (Cao et al. 2004, section 6.3).

Each unit is warped to its phone's time, units that were not neighbours are blended, a
learnt low-pass takes the rest of the seams away, all of it on components. Then closures
close, on channels. Which units are taken is the search's work.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion import warping
from lipwright.engines.motion.closures import Closed, Closing, Opening, close, learn_closing
from lipwright.engines.motion.lowpass import cut_offs, low_pass
from lipwright.engines.motion.rasta_plp import Features, between
from lipwright.engines.motion.recorded import (
    Floats,
    Ints,
    Recorded,
    at,
    motion_of,
    take_bounds,
    takes,
)
from lipwright.engines.motion.rests import rest
from lipwright.engines.motion.splicing import (
    Course,
    Pairs,
    PairTable,
    Splice,
    blend,
    find_splices,
)
from lipwright.errors import InputError
from lipwright.phones import SILENCE


@dataclass(frozen=True, slots=True, eq=False)
class Learnt:
    """What the smoothing and closing of a database's results is learnt from it.

    Parameters
    ----------
    cut_offs : (K,) float64
        Hz, of each component's low-pass.
    closing : Closing or None
        None where nobody knows what opens the mouth.
    """

    cut_offs: Floats
    closing: Closing | None

    def document(self) -> dict[str, Any]:
        """Return it as plain lists and numbers, for a file."""
        closing = self.closing
        return {
            "cut_offs": self.cut_offs.tolist(),
            "closing": closing
            and {
                "speeds": closing.speeds.tolist(),
                "rate": closing.rate,
                "kinds": [
                    {"labels": kind.labels, "level": kind.level, "frames": kind.frames.tolist()}
                    for kind in closing.kinds
                ],
            },
        }

    @classmethod
    def of(cls, document: dict[str, Any]) -> Learnt:
        """Return what :meth:`document` wrote."""
        found = document["closing"]
        closing = found and Closing(
            tuple(
                Closed(tuple(kind["labels"]), kind["level"], np.array(kind["frames"]))
                for kind in found["kinds"]
            ),
            np.array(found["speeds"]),
            found["rate"],
        )
        return cls(np.array(document["cut_offs"]), closing)


@dataclass(frozen=True, slots=True, eq=False)
class Joined:
    """A motion, and where each frame of it comes from.

    Parameters
    ----------
    motion : (T, C) float32
        Channels; frame k is at ``start + (k + 0.5) / rate``.
    components : (T, K) float64
        The same before closures are closed.
    start, rate : float
        Seconds; frames per second.
    unit : (T,) int64
        The unit that each frame follows.
    source : (T,) float64
        The frame of the database, between two of them where the time is warped.
    splices : tuple of Splice
        The jumps.
    pulled : int
        How many phones had to be closed.
    """

    motion: NDArray[np.float32]
    components: Floats
    start: float
    rate: float
    unit: Ints
    source: Floats
    splices: tuple[Splice, ...]
    pulled: int


def learn(data: Recorded, opening: Opening | None = None) -> Learnt:
    """Learn from a database what :func:`join` needs besides its arrays.

    Parameters
    ----------
    data : Recorded
    opening : callable, optional
        ``opening(motion (T, C)) -> (T,)``; without it closures are left as they come.
    """
    closing = None if opening is None else learn_closing(data, opening)
    return Learnt(cut_offs(takes(data), data.rate), closing)


def join(
    data: Recorded,
    units: Sequence[int] | NDArray[np.integer],
    spans: NDArray[np.floating],
    rate: float,
    *,
    learnt: Learnt | None = None,
    features: Features | None = None,
    opening: Opening | None = None,
    phones: Sequence[str] | None = None,
    pairs: Pairs | None = None,
    unsure: bool = False,
) -> Joined:
    """Turn a path of units into a motion.

    Parameters
    ----------
    data : Recorded
        The database.
    units : (N,) or (M, N) int
        A unit for each phone; of M paths, the mean of their motions is taken, which has
        less of one recording's chance in it, and what is told of units is the first's.
    spans : (N, 2) float64
        Seconds of each phone, in order; a gap belongs to the phone before it.
    rate : float
        Frames per second of the result.
    learnt : Learnt, optional
        Of :func:`learn`; without it nothing is smoothed or closed.
    features : Features, optional
        Of the wanted sound; without it units are warped evenly.
    opening : callable, optional
        What ``learnt`` was learnt with; without it nothing is closed.
    phones : (N,) str, optional
        What is spoken, where it is not the units' own labels: after stand-ins and clusters.
        Also tells which phones must be closed.
    pairs : callable, optional
        Finds connected pairs; a :class:`PairTable` is made where it is left out.
    unsure : bool
        Whether ``phones`` may have been heard wrongly.

    Raises
    ------
    InputError
        If there are no phones, not one span per unit, or spans out of order.
    """
    paths = np.atleast_2d(np.asarray(units, np.int64))
    held = _spans(paths, spans)
    start, end = float(held[0, 0]), float(held[-1, 1])
    count = max(1, round((end - start) * rate))
    times: Floats = start + (np.arange(count, dtype=np.float64) + 0.5) / rate
    found = cache(pairs or PairTable(data))  # paths of one line ask for the same pairs
    courses = _courses(data, paths, held, phones, features)
    sources = [_sources(data, course, times) for course in courses]
    unit = np.stack([one.units[phone] for one, (phone, _) in zip(courses, sources, strict=True)])
    source = np.stack([positions for _, positions in sources])
    own = at(data, source.ravel(), *take_bounds(data, unit.ravel()))
    splices = [find_splices(data, course, found) for course in courses]
    drawn = blend(data, courses, splices, times, own.reshape(*unit.shape, -1))
    frames: Floats = drawn.mean(axis=0)
    if learnt is not None:
        frames = low_pass(frames, rate, learnt.cut_offs)
    motion, pulled = motion_of(data, frames), 0
    if learnt is not None and learnt.closing is not None and opening is not None:
        timed = zip(courses[0].spoken, *(held - start).T.tolist(), strict=True)
        pulled = close(motion, rate, list(timed), learnt.closing, opening, unsure=unsure)
    return Joined(
        motion=motion.astype(np.float32),
        components=frames,
        start=start,
        rate=rate,
        unit=unit[0],
        source=source[0],
        splices=tuple(splices[0]),
        pulled=pulled,
    )


def _spans(paths: Ints, spans: NDArray[np.floating]) -> Floats:
    held = np.array(spans, np.float64)
    count = paths.shape[1]
    if not count or held.shape != (count, 2):
        raise InputError(
            f"{count} units and spans of shape {held.shape}",
            expected="one unit or more, each with its start and end",
        )
    held[:-1, 1] = held[1:, 0]
    if not (np.isfinite(held).all() and (held[:, 1] > held[:, 0]).all()):
        raise InputError("phones out of order, or without length", expected="spans that follow")
    return held


def _courses(
    data: Recorded,
    paths: Ints,
    spans: Floats,
    phones: Sequence[str] | None,
    features: Features | None,
) -> list[Course]:
    """Return the course of each path (M, N); their warps are found all at once."""
    spoken = [
        tuple([data.labels[label] for label in data.label[units]] if phones is None else phones)
        for units in paths
    ]
    each = _warps(data, paths, spans, spoken, features)
    return [
        Course(units, spans, labels, warp)
        for units, labels, warp in zip(paths, spoken, each, strict=True)
    ]


def _warps(
    data: Recorded,
    paths: Ints,
    spans: Floats,
    spoken: Sequence[Sequence[str]],
    features: Features | None,
) -> Floats:
    """Warp of each phone of each path, (M, N, KNOTS); a silence has nothing to go by: even."""
    found = warping.linear(paths.size).reshape(*paths.shape, -1)
    speech = np.array([[label != SILENCE for label in labels] for labels in spoken])
    if features is None or not speech.any():
        return found
    heard = _at_shares(features.values, (spans - features.start) * features.rate, warping.KNOTS)
    wanted = np.broadcast_to(heard, (len(paths), *heard.shape))[speech]
    units = data.spans[paths[speech]]
    recorded = _at_shares(data.features, units, 2 * warping.KNOTS - 1)
    found[speech] = warping.warps(wanted / data.sound_scale, recorded / data.sound_scale)
    return found


def _at_shares(values: NDArray[np.floating], ends: NDArray[np.floating], count: int) -> Floats:
    """Return frames at even shares of each span (N, 2), which counts in frames: (N, count, C)."""
    positions = ends[:, :1] + np.linspace(0.0, 1.0, count) * np.diff(ends, axis=1) - 0.5
    return between(values, positions.ravel()).reshape(*positions.shape, -1)


def _sources(data: Recorded, course: Course, times: Floats) -> tuple[Ints, Floats]:
    """Phone of each instant, and the frame of the database that answers it."""
    phone = np.clip(
        np.searchsorted(course.spans[:, 0], times, "right") - 1, 0, len(course.units) - 1
    )
    start, end = course.spans[phone].T
    warps = course.warps
    place = (times - start) / (end - start) * (warps.shape[1] - 1)
    knot = np.clip(place.astype(np.int64), 0, warps.shape[1] - 2)
    rise = warps[phone, knot + 1] - warps[phone, knot]
    share = warps[phone, knot] + (place - knot) * rise
    units = course.units[phone]
    first, last = data.spans[units].T
    positions = first + share * (last - first)
    silent = np.array([label == SILENCE for label in course.spoken])[phone]
    many = len(course.units) > 1
    edges = ((phone == 0) & many, (phone == len(course.units) - 1) & many)
    known = (units, times - start, end - start, *edges)
    positions[silent] = rest(data, *(one[silent] for one in known))
    # Where a take is followed frame by frame, rounding must not come between.
    return phone, np.round(positions - 0.5, 9)
