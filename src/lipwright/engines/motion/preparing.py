"""One take, checked and cut into units: what can be done for each take alone.

A caller may do it in several processes, and keep what comes of it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.database import SOUND_PARAMETERS
from lipwright.engines.motion.take import Take
from lipwright.engines.motion.units import Cut, cut
from lipwright.errors import InputError

Features = Callable[[Take], NDArray[np.float32]]


@dataclass(frozen=True, slots=True, eq=False)
class Prepared:
    """A take, ready to be put into a database.

    Parameters
    ----------
    name : str
    channels : tuple of str
        Those that are learnt.
    values : (T, C) float32
    features : (T, 9) float32 or None
        None where there is no sound.
    rate, start : float
        Frames per second; seconds on the sound's clock.
    phone_set : str
    cut : Cut
    """

    name: str
    channels: tuple[str, ...]
    values: NDArray[np.float32]
    features: NDArray[np.float32] | None
    rate: float
    start: float
    phone_set: str
    cut: Cut


def prepare(
    take: Take, learn: Sequence[str] | None = None, features: Features | None = None
) -> Prepared:
    """Check a take and cut it into units.

    Parameters
    ----------
    take : Take
    learn : sequence of str, optional
        Channels that are learnt, in this order; all where it is not given.
    features : function, optional
        Returns a take's (T, 9) sound parameters, one row per frame of motion; asked only
        for takes that have sound.

    Raises
    ------
    InputError
        If the take cannot be used: it is named, with the reason.
    """
    where = f"take {take.name!r}"
    values = np.asarray(take.values)
    if values.ndim != 2 or values.shape[1] != len(take.channels) or not len(values):
        raise InputError(
            f"motion of shape {values.shape}",
            where=where,
            expected=f"some frames of {len(take.channels)} channels",
        )
    if not take.rate > 0 or not np.isfinite(take.rate) or not np.isfinite(take.start):
        raise InputError(
            f"{take.rate} frames per second from {take.start} s", where=where, expected="a rate > 0"
        )
    chosen = _chosen(take.channels, learn, where)
    values = np.ascontiguousarray(values[:, chosen], np.float32)
    if not np.isfinite(values).all():
        frame, channel = np.argwhere(~np.isfinite(values))[0]
        raise InputError(
            f"frame {frame} of {take.channels[chosen[channel]]!r} is no number",
            where=where,
            expected="gaps filled before",
        )
    sound = None
    if features is not None and take.sound is not None:
        sound = _checked_features(features(take), len(values), where)
    track = take.phones.normalised()
    return Prepared(
        take.name,
        tuple(take.channels[index] for index in chosen),
        values,
        sound,
        float(take.rate),
        float(take.start),
        track.phone_set,
        cut(track, len(values), take.rate, take.start, where),
    )


def _chosen(channels: Sequence[str], learn: Sequence[str] | None, where: str) -> list[int]:
    twice = next((name for name in channels if list(channels).count(name) > 1), None)
    if twice is not None:
        raise InputError(f"has the channel {twice!r} twice", where=where, expected="each once")
    place = {name: index for index, name in enumerate(channels)}
    wanted = list(channels if learn is None else learn)
    missing = [name for name in wanted if name not in place]
    if missing or not wanted:
        shown = ", ".join(map(repr, missing[:5])) or "any channel"
        raise InputError(
            f"lacks {shown}", where=where, expected="every channel that is to be learnt"
        )
    return [place[name] for name in wanted]


def _checked_features(
    features: NDArray[np.float32], frames: int, where: str
) -> NDArray[np.float32]:
    rows = np.ascontiguousarray(features, np.float32)
    if rows.shape != (frames, SOUND_PARAMETERS) or not np.isfinite(rows).all():
        raise InputError(
            f"sound parameters of shape {rows.shape}",
            where=where,
            expected=f"{frames} by {SOUND_PARAMETERS} finite numbers",
        )
    return rows
