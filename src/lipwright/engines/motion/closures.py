"""Closures: p, b and m end closed, f and v end in contact (Cao et al. 2004, section 8).

What closed means is learnt: in each recorded p, b and m the frame with the least opening;
half of them are at most as open as the *level*. A closure that stays above it is pulled, at
its own least opening, toward the recorded closed frame that is most like it, just as far as
the level asks. The pull rises and falls as a raised cosine, as wide as natural speed needs:
no channel moves faster than nearly all recorded motion does, or than it did before. What
is closed already is not touched: a pull ends where a closure of the other kind is at its best.
Of phones that may have been heard wrongly, only those are pulled that recorded motion brings
near to closed by itself.

All of it is done on channels as they were recorded, not on components: what components
leave out is little motion, but it is what parts the lips or lets them meet.

Opening is whatever the caller measures on a motion, once, or for each kind of closure what
lies between the parts that it brings together. For ARKit's names and for FaceFX's poses it is
known here.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.recorded import Ints, Recorded

Floats = NDArray[np.float64]
_Integer = TypeVar("_Integer", bound=np.integer)
Opening = Callable[[Floats], NDArray[np.floating]]
"""How far the lips are apart in each frame of (T, C): (T,), less is more closed; or (T, 2): how
far the lips are apart, and how far the lower lip is from the upper teeth, as :data:`KINDS`."""

KINDS = (("p", "b", "m"), ("f", "v"))
EXAMPLES = 48  # closed frames that are kept of each kind
UNITS = 4000  # of a kind that are looked at
FRAMES = 40000  # whose speeds are
WIDTHS = (0.09, 0.11, 0.14, 0.18, 0.22)
"""Seconds from the middle of a pull to where it is nothing, from preferred to last."""
HOLD = 0.02
"""Seconds to either side that a pull lasts in full, at most a fifth of the phone."""
EDGE = 0.15
"""Share of a phone at either end in which its closure is not looked for."""
QUICK = 99.9
"""Percentile of recorded speeds that counts as the greatest natural one."""
_POSES = ("open", "pbm", "fv")  # what opens, and what makes each kind of closure
BELIEVED = 0.35
"""Share of a line's opening, from the level up, above which an unsure phone is no closure."""
_TRIED = 17  # strengths of a pull that are tried at once, twice


@dataclass(frozen=True, slots=True, eq=False)
class Closed:
    """What closed means for one kind of phone.

    Parameters
    ----------
    labels : tuple of str
        The phones.
    level : float
        Opening that a closure must come down to.
    frames : (E, C) float64
        Recorded closed faces, each at most that open.
    """

    labels: tuple[str, ...]
    level: float
    frames: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Closing:
    """All that closing needs of a database.

    Parameters
    ----------
    kinds : tuple of Closed
    speeds : (C,) float64
        Greatest natural speed of each channel, per second.
    rate : float
        Frames per second at which the speeds were measured.
    """

    kinds: tuple[Closed, ...]
    speeds: Floats
    rate: float


def opening_of(channels: Sequence[str]) -> Opening | None:
    """Return how shapes of ARKit, or FaceFX's poses, open the mouth; None for other names.

    Of ARKit's, the jaw parts the lips, ``mouthClose`` brings them together again, and each
    lip is drawn away by its own shapes. Of the poses, ``open`` parts what each closure brings
    together: ``PBM`` the lips, ``FV`` the lower lip and the upper teeth. A closure is as
    complete as its own pose is: one lip that leaves the teeth does not close the lips.

    Examples
    --------
    >>> opening = opening_of(["jawOpen", "mouthClose"])
    >>> round(float(opening(np.array([[0.5, 0.4]]))[0]), 9)
    0.1
    >>> opening_of(["open", "PBM", "FV"])(np.array([[0.25, 0.0, 1.0]])).tolist()
    [[0.25, -0.75]]
    """
    weights = {"jawopen": 1.0, "mouthclose": -1.0}
    for lip in ("mouthlowerdown", "mouthupperup"):
        weights |= {lip + side: 0.25 for side in ("left", "right")}
    names = [name.casefold() for name in channels]
    if set(_POSES) <= set(names):
        parts, *closing = (names.index(name) for name in _POSES)
        return lambda motion: motion[:, [parts]] - motion[:, closing]
    if "jawopen" not in names:
        return None
    row = np.array([weights.get(name, 0.0) for name in names])
    return lambda motion: motion @ row


def learn_closing(data: Recorded, opening: Opening) -> Closing:
    """Learn from a database what closed is, and how fast a face is.

    Parameters
    ----------
    data : Recorded
    opening : callable
        ``opening(motion (T, C)) -> (T,)``.
    """
    names = np.array([label.casefold() for label in data.labels])
    kinds = []
    for labels in KINDS:
        wanted = np.isin(names, labels)
        units = np.flatnonzero(wanted[np.asarray(data.label)])
        if len(units):
            kinds.append(_learn_kind(data, labels, evenly(units, UNITS), opening))
    return Closing(tuple(kinds), _speeds(data), data.rate)


def close(
    motion: Floats,
    rate: float,
    phones: Sequence[tuple[str, float, float]],
    closing: Closing,
    opening: Opening,
    *,
    unsure: bool = False,
) -> int:
    """Close the mouth in every phone that must be closed.

    Parameters
    ----------
    motion : (T, C) float64
        Channels, changed in place; frame k is at ``(k + 0.5) / rate``.
    rate : float
        Frames per second.
    phones : sequence of (label, start, end)
        Seconds, on the clock of the motion.
    closing : Closing
    opening : callable
        What the closing was learnt with.
    unsure : bool
        Whether phones may have been heard wrongly.

    Returns
    -------
    int
        How many phones had to be pulled.
    """
    kinds = {label: kind for kind in closing.kinds for label in kind.labels}
    asked = [
        (kinds[name], _inside(start, end, rate, len(motion)), min(HOLD, 0.2 * (end - start)))
        for label, start, end in phones
        if (name := label.casefold()) in kinds
    ]
    believed = {
        kind.labels: _believed(motion, kind, opening) if unsure else np.inf
        for kind in closing.kinds
    }
    pulled = 0
    for place, (kind, near, hold) in enumerate(asked):
        middle, least = _least(motion, near, kind, opening)
        if not kind.level < least <= believed[kind.labels]:
            continue
        # What closes before and behind it in the other way must not be undone.
        beside = [
            next((one for one in some if one[0] is not kind), None)
            for some in (asked[place::-1], asked[place:])
        ]
        stops = [_least(motion, one[1], one[0], opening)[0] if one else None for one in beside]
        room = [np.inf if stop is None else abs(stop - middle) / rate for stop in stops]
        _pull(motion, rate, middle, kind, closing, opening, hold, room)
        pulled += 1
    return pulled


def _believed(motion: Floats, kind: Closed, opening: Opening) -> float:
    """Return how open an unsure closure may be before it is pulled."""
    widest = float(np.percentile(_apart(opening, motion, kind.labels), 95))
    return kind.level + BELIEVED * max(widest - kind.level, 0.0)


def _least(motion: Floats, near: slice, kind: Closed, opening: Opening) -> tuple[int, float]:
    """Return the frame in which a closure is most closed, and how open it is there."""
    openings = _apart(opening, motion[near], kind.labels)
    best = int(openings.argmin())
    return near.start + best, float(openings[best])


def evenly(items: NDArray[_Integer], count: int) -> NDArray[_Integer]:
    """Return at most ``count`` of the items, evenly spread over them."""
    if len(items) <= count:
        return items
    return items[np.linspace(0, len(items) - 1, count).astype(np.int64)]


def _apart(opening: Opening, motion: Floats, labels: tuple[str, ...]) -> NDArray[np.floating]:
    """How far apart is what a kind of phone brings together, in each frame."""
    found = opening(motion)
    return found if found.ndim == 1 else found[:, KINDS.index(labels)]


def _learn_kind(data: Recorded, labels: tuple[str, ...], units: Ints, opening: Opening) -> Closed:
    first, count = data.first[units], data.last[units] - data.first[units]
    starts = np.cumsum(count) - count
    rows = np.repeat(first - starts, count) + np.arange(count.sum())
    frames = np.asarray(data.values[rows], np.float64)
    openings = _apart(opening, frames, labels)
    least = np.minimum.reduceat(openings, starts)
    level = float(np.median(least))
    # The first frame of each unit that is its least; of those, the ones that are closed.
    found = np.flatnonzero(openings == np.repeat(least, count))
    _, lone = np.unique(np.repeat(np.arange(len(units)), count)[found], return_index=True)
    closed = found[lone][least <= level]
    # Spread over the shapes that closed faces have: along their first component.
    spread = closed[np.argsort(np.asarray(data.frames[rows[closed], 0]), kind="stable")]
    return Closed(labels, level, frames[evenly(spread, EXAMPLES)])


def _speeds(data: Recorded) -> Floats:
    inside = np.ones(len(data.values) - 1, np.bool_)
    inside[data.take_first[1:-1] - 1] = False  # from one take to the next is no motion
    rows = evenly(np.flatnonzero(inside), FRAMES)
    if not len(rows):
        return np.full(data.values.shape[1], np.inf)
    moved = np.abs(data.values[rows + 1] - data.values[rows]) * data.rate
    return np.asarray(np.percentile(moved, QUICK, axis=0), np.float64)


def _inside(start: float, end: float, rate: float, count: int) -> slice:
    """Frames within a phone, without its edges where that leaves any; at least the nearest."""
    for edge in (EDGE * (end - start), 0.0):
        low = int(np.ceil((start + edge) * rate - 0.5 - 1e-9))
        high = int(np.ceil((end - edge) * rate - 0.5 - 1e-9))
        low, high = max(low, 0), min(high, count)
        if low < high:
            return slice(low, high)
    nearest = min(max(round(0.5 * (start + end) * rate - 0.5), 0), count - 1)
    return slice(nearest, nearest + 1)


def _pull(
    motion: Floats,
    rate: float,
    middle: int,
    kind: Closed,
    closing: Closing,
    opening: Opening,
    hold: float,
    room: Sequence[float],
) -> None:
    """Pull the frames around ``middle`` until that one is closed.

    ``hold`` is how long it lasts in full to either side, ``room`` the seconds before and
    behind it within which it has to end.
    """
    open_face = motion[middle].copy()
    apart = ((kind.frames - open_face) ** 2).sum(axis=1)
    pull = kind.frames[apart.argmin()] - open_face
    pull *= _strength(open_face, pull, kind, opening)
    lag = max(1, round(rate / closing.rate))
    for width in WIDTHS:
        reach = int(width * rate)
        low, high = max(middle - reach, 0), min(middle + reach + 1, len(motion))
        frames = np.arange(low, high)
        ends = np.minimum(np.where(frames < middle, room[0], room[1]), width)
        # At the very frame of another closure there is no room; that frame alone is shared.
        held = np.minimum(hold, 0.5 * ends)
        away = (np.abs(frames - middle) / rate - held) / np.maximum(ends - held, 1e-9)
        share = 0.5 + 0.5 * np.cos(np.pi * np.clip(away, 0.0, 1.0))
        around = slice(max(low - lag, 0), min(high + lag, len(motion)))
        before = motion[around]
        after = before.copy()
        after[low - around.start : high - around.start] += share[:, None] * pull
        if _natural(before, after, lag, rate, closing.speeds):
            break
    motion[around] = after


def _strength(face: Floats, pull: Floats, kind: Closed, opening: Opening) -> float:
    """Return the least share of a pull, 0..1, that brings the opening down to the level."""
    low, high = 0.0, 1.0
    for _ in range(2):
        shares = np.linspace(low, high, _TRIED)
        openings = _apart(opening, face + shares[:, None] * pull, kind.labels)
        enough = np.flatnonzero(openings <= kind.level)
        if not len(enough):
            return high
        low, high = float(shares[max(enough[0] - 1, 0)]), float(shares[enough[0]])
    return high


def _natural(before: Floats, after: Floats, lag: int, rate: float, speeds: Floats) -> bool:
    """Whether nothing moves faster than is natural, or than it did before."""
    if len(after) <= lag:
        return True
    was, now = (np.abs(x[lag:] - x[:-lag]).max(axis=0) * (rate / lag) for x in (before, after))
    return bool((now <= np.maximum(was, speeds) * (1 + 1e-9)).all())
