"""A take cut into units, one per phone (Cao et al. 2004, section 5.1: *animes*).

Positions inside motion are counted in frames: frame k covers k to k + 1 and shows what
is seen at k + 0.5. A unit has an exact span of positions, which touches those of its
neighbours, and whole frames, at least one: a phone shorter than a frame has the frame
that its middle falls into, which its neighbour has too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import InputError
from lipwright.phones import SILENCE, PhoneTrack

GAP = 0.010
"""Seconds; a longer gap between phones is silence, a shorter one a label file's rounding."""

_GRAIN = 2.0**-16
# Frames; spans are whole multiples, so that moving them along a database loses nothing.


@dataclass(frozen=True, slots=True, eq=False)
class Cut:
    """The units of one take.

    Parameters
    ----------
    labels : tuple of str
        A phone each.
    spans : (U, 2) float64
        Begin and end as positions in the take's frames; the end of one is the begin of
        the next.
    """

    labels: tuple[str, ...]
    spans: NDArray[np.float64]


def cut(phones: PhoneTrack, frames: int, rate: float, start: float, where: str) -> Cut:
    """Cut a take at its phones; what lies outside the motion is left out.

    Parameters
    ----------
    phones : PhoneTrack
        Seconds on the sound's clock.
    frames : int
        Frames of motion.
    rate : float
        Frames per second.
    start : float
        Seconds on the sound's clock at which the motion starts.
    where : str
        The take's name in errors.

    Raises
    ------
    InputError
        If no phone lies within the motion.
    """
    labels: list[str] = []
    edges: list[tuple[float, float]] = []
    for phone in phones:
        begin, end = phone.start, phone.end
        if edges and begin - edges[-1][1] > GAP:
            labels.append(SILENCE)
            edges.append((edges[-1][1], begin))
        elif edges:
            begin = 0.5 * (edges[-1][1] + begin)
            edges[-1] = (edges[-1][0], begin)
        labels.append(phone.label)
        edges.append((begin, end))
    spans = (np.array(edges, np.float64).reshape(-1, 2) - start) * rate
    spans = np.rint(np.clip(spans, 0.0, frames) / _GRAIN) * _GRAIN
    inside = spans[:, 1] > spans[:, 0]
    if not inside.any():
        heard = f"{phones.tier.start:.2f} to {phones.tier.end:.2f} s" if len(phones) else "none"
        raise InputError(
            f"no phone falls into its motion (phones: {heard})",
            where=where,
            expected=f"phones between {start:.2f} and {start + frames / rate:.2f} s",
        )
    kept = np.flatnonzero(inside)
    return Cut(tuple(labels[index] for index in kept), spans[kept])


def whole_frames(
    spans: NDArray[np.float64], frames: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return first and last (exclusive) frame of each span: those whose instants it holds."""
    first = np.ceil(spans[:, 0] - 0.5).astype(np.int64)
    last = np.ceil(spans[:, 1] - 0.5).astype(np.int64)
    short = last <= first
    middle = np.minimum(np.floor(spans.mean(axis=1)).astype(np.int64), frames - 1)
    first = np.where(short, middle, first)
    return first, np.where(short, middle + 1, last)


def at_positions(
    values: NDArray[np.float32], positions: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return (T, D) values at positions of any shape, linear between frames, held at the ends."""
    place = np.clip(positions - 0.5, 0.0, len(values) - 1.0)
    below = np.minimum(np.floor(place).astype(np.int64), max(len(values) - 2, 0))
    share = (place - below)[..., None]
    above = np.minimum(below + 1, len(values) - 1)
    result: NDArray[np.float64] = values[below] * (1.0 - share) + values[above] * share
    return result


def at_points(
    values: NDArray[np.float32], spans: NDArray[np.float64], points: int
) -> NDArray[np.float64]:
    """Return each span's values at the middles of equal parts: (U, ``points``, D).

    So spans of any length compare: the paper's normalised duration.
    """
    share = (np.arange(points) + 0.5) / points
    return at_positions(values, spans[:, :1] + (spans[:, 1:] - spans[:, :1]) * share)


def seams(
    frames: NDArray[np.float32], spans: NDArray[np.float64], step: float
) -> NDArray[np.float64]:
    """Return the state of motion at each span's begin and end: (U, 2, 2K).

    Value, and velocity times ``step``. Neighbours in a take share a seam: the end of the
    one equals the begin of the next.

    Parameters
    ----------
    frames : (T, K) float32
        A take.
    spans : (U, 2) float64
    step : float
        Frames of movement that weigh as much as the same distance in place.
    """
    value = at_positions(frames, spans)
    velocity = at_positions(frames, spans + 0.5) - at_positions(frames, spans - 0.5)
    return np.concatenate((value, velocity * step), axis=-1)
