"""What joining needs of a database, and frames of it at any instant.

Between two frames motion follows a cubic through them (Catmull and Rom 1974), at a frame
it is that frame. Where a take ends, motion is carried on by the velocity it had there,
which dies down in a twentieth of a second: a straight line would leave the face soon.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

FADE = 0.05
"""Seconds in which the velocity at the end of a take dies down to a third."""
MEASURED = 0.025
"""Seconds over which the velocity at the end of a take is measured, at least a frame."""


class Recorded(Protocol):
    """The arrays of a database that turn a path of units into motion.

    ``frames`` (F, K) are components, all takes one after the other; the motion of one is
    ``mean + frames @ basis``, which is near the recorded ``values`` (F, C). ``features``
    (F, 9) are RASTA-PLP, zeros where a take has no sound; ``sound_scale`` (9,) is their
    deviation. Unit ``u`` has ``labels[label[u]]``, lasts from ``spans[u, 0]`` to
    ``spans[u, 1]`` in frames, of which number k shows the instant k + 0.5, and holds the
    whole frames ``first[u]`` up to, without, ``last[u]``; its successor in its take is
    ``u + 1``. Take ``n`` has the frames from ``take_first[n]`` to ``take_first[n + 1]``.
    """

    @property
    def frames(self) -> NDArray[np.float32]: ...  # noqa: D102
    @property
    def values(self) -> NDArray[np.float32]: ...  # noqa: D102
    @property
    def features(self) -> NDArray[np.float32]: ...  # noqa: D102
    @property
    def label(self) -> NDArray[np.integer]: ...  # noqa: D102
    @property
    def first(self) -> NDArray[np.integer]: ...  # noqa: D102
    @property
    def last(self) -> NDArray[np.integer]: ...  # noqa: D102
    @property
    def take(self) -> NDArray[np.integer]: ...  # noqa: D102
    @property
    def spans(self) -> NDArray[np.floating]: ...  # noqa: D102
    @property
    def take_first(self) -> NDArray[np.integer]: ...  # noqa: D102
    @property
    def sound_scale(self) -> NDArray[np.floating]: ...  # noqa: D102
    @property
    def mean(self) -> NDArray[np.floating]: ...  # noqa: D102
    @property
    def basis(self) -> NDArray[np.floating]: ...  # noqa: D102
    @property
    def labels(self) -> tuple[str, ...]: ...  # noqa: D102
    @property
    def rate(self) -> float: ...  # noqa: D102


def take_bounds(data: Recorded, units: Ints) -> tuple[Ints, Ints]:
    """Return first and last (exclusive) frame of the takes that units lie in."""
    take = data.take[units]
    bounds = data.take_first
    return np.asarray(bounds[take], np.int64), np.asarray(bounds[take + 1], np.int64)


def takes(data: Recorded) -> list[NDArray[np.float32]]:
    """Return the components of each take."""
    bounds = data.take_first.tolist()
    return [data.frames[a:b] for a, b in pairwise(bounds)]


def motion_of(data: Recorded, components: NDArray[np.floating]) -> Floats:
    """Return channels (T, C) of components (T, K)."""
    result: Floats = components @ np.asarray(data.basis, np.float64) + data.mean
    return result


def at(data: Recorded, positions: Floats, low: Ints, high: Ints) -> Floats:
    """Return components between frames, and beyond the ends of a take.

    Parameters
    ----------
    data : Recorded
    positions : (N,) float64
        In frames of the database; a whole number is that frame.
    low, high : (N,) int64
        First and last (exclusive) frame of each one's take.

    Returns
    -------
    (N, K) float64
    """
    held = np.clip(positions, low, high - 1)
    below = np.floor(held).astype(np.int64)
    found = np.zeros((len(positions), data.frames.shape[1]))
    for offset, weight in zip((-1, 0, 1, 2), _cubic(held - below), strict=True):
        found += weight[:, None] * data.frames[np.clip(below + offset, low, high - 1)]
    for beyond, end, inward in ((low - positions, low, 1), (positions - high + 1, high - 1, -1)):
        if (outside := np.flatnonzero(beyond > 0)).size:
            bounds = (low[outside], high[outside])
            found[outside] += _carried(data, beyond[outside], end[outside], inward, bounds)
    return found


def _cubic(u: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """Weights of the frames before, at, after and beyond, at a share ``u`` of the way."""
    v = 1 - u
    return (
        -0.5 * u * v * v,
        v * (1 + u - 1.5 * u * u),
        u * (1 + v - 1.5 * v * v),
        -0.5 * u * u * v,
    )


def _carried(
    data: Recorded, beyond: Floats, end: Ints, inward: int, bounds: tuple[Ints, Ints]
) -> Floats:
    """How far the velocity at a take's end carries motion ``beyond`` frames past it."""
    reach = max(1, round(MEASURED * data.rate))
    inner = np.clip(end + inward * reach, bounds[0], bounds[1] - 1)
    span = np.maximum(np.abs(end - inner), 1)[:, None]
    velocity = (data.frames[end].astype(np.float64) - data.frames[inner]) / span
    fade = FADE * data.rate
    result: Floats = velocity * (fade * -np.expm1(-beyond / fade))[:, None]
    return result
