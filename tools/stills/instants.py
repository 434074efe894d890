"""Which sounds are shown, and the instant at which the shape of each is fullest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lipwright.animation import Animation
from lipwright.errors import InputError

NEARLY = 0.98
"""Of a shape that is held, what is at least this share of the fullest counts as held."""


@dataclass(frozen=True, slots=True)
class Shown:
    """A sound to look at.

    Parameters
    ----------
    name : str
        Its class in the Common Phoneme Set's spelling.
    phone : str
        Its label as the synthesiser gives it.
    word : str
        The word in which it is looked at.
    poses : tuple of str
        The pose that makes its shape, in each set that may animate it.
    """

    name: str
    phone: str
    word: str
    poses: tuple[str, ...]


SHOWN = (
    Shown("/p/", "p", "Pop", ("PBM", "mandibles_in")),
    Shown("/aa/", "ɑː", "Pop", ("open", "mouth_open")),
    Shown("/uw/", "uː", "shoe", ("W", "mouth_OO")),
    Shown("/f/", "f", "Father's", ("FV", "bite")),
)
LINE = "Pop! Father's new shoe."


@dataclass(frozen=True, slots=True)
class Instant:
    """When a sound is seen best.

    Parameters
    ----------
    seconds : float
        On the clock of the sound.
    level : float
        How full its pose is then.
    """

    seconds: float
    level: float


def fullest(animation: Animation, shown: Shown) -> Instant:
    """Return the middle of the frames in which a sound's pose is fullest.

    Of a sound that its word has more than once the one with the fullest shape is taken, the
    first of equals.

    Raises
    ------
    InputError
        If the word is not said or lacks the sound, or the animation has none of its poses.
    """
    pose = next((name for name in shown.poses if name in animation.controls), None)
    if pose is None:
        raise InputError(
            f"no pose for {shown.name}", expected=f"one of {', '.join(shown.poses)} in the set"
        )
    levels, times = animation.control(pose), animation.times
    best: Instant | None = None
    for phone in animation.phones.tier:
        word = animation.words.at(phone.middle)
        if phone.label != shown.phone or word is None or word.label != shown.word:
            continue
        inside = np.flatnonzero((times >= phone.start) & (times < phone.end))
        level = float(levels[inside].max(initial=0.0))
        if len(inside) and (best is None or level > best.level):
            held = times[inside[levels[inside] >= NEARLY * level]]
            best = Instant(float(held[len(held) // 2]), level)
    if best is None:
        raise InputError(f"{shown.name} is not said in {shown.word!r}")
    return best
