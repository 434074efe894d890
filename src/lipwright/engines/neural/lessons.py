"""What a net is taught: sound, the animation that goes with it, and whether they fit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.errors import InputError
from lipwright.sound import Sound

Floats = NDArray[np.float64]

LEAST = 1.0
"""Seconds: with less there is nothing to learn."""
FEW = 15.0
"""Seconds below which it is said that the publication used 20."""
DISAGREE = 0.5
"""Seconds by which an animation may begin or end beside its sound: margins are silence."""
STILL = 1e-4
"""A control whose deviation is below this does not move."""


@dataclass(frozen=True, slots=True, eq=False)
class Lesson:
    """Sound, and the animation that goes with it.

    Parameters
    ----------
    sound : Sound
    animation : Animation
        On the sound's clock.
    name : str
        Of the animation, for messages.
    heard : str
        Of the sound.
    """

    sound: Sound
    animation: Animation
    name: str
    heard: str = ""


def controls_of(lessons: Sequence[Lesson]) -> tuple[str, ...]:
    """Return the controls that all lessons have.

    Raises
    ------
    InputError
        If there are none, or they differ.
    """
    if not lessons:
        raise InputError("nothing to learn from", expected="sound and its animation")
    first = lessons[0]
    for lesson in lessons:
        if not len(lesson.animation) or not lesson.animation.controls:
            raise InputError("an animation without frames or controls", where=lesson.name)
        if lesson.animation.controls != first.animation.controls:
            raise InputError(
                f"has the controls {', '.join(lesson.animation.controls)}",
                where=lesson.name,
                expected=f"those of {first.name}: {', '.join(first.animation.controls)}",
            )
    return first.animation.controls


def shown(lesson: Lesson, times: Floats) -> tuple[NDArray[np.bool_], Floats]:
    """Return where a lesson's animation covers some instants, and its values there.

    Raises
    ------
    InputError
        If sound and animation disagree in length.
    """
    animation, sound = lesson.animation, lesson.sound
    end = animation.start + animation.duration
    if animation.start > DISAGREE or abs(end - sound.duration) > DISAGREE:
        raise InputError(
            f"an animation from {animation.start:.2f} to {end:.2f} s beside "
            f"{sound.duration:.2f} s of sound",
            where=lesson.name,
            expected=f"the two to agree within {DISAGREE:g} s",
            cure="cut both to the same moment, or check the frame rate",
        )
    both = (times >= animation.start - 1e-9) & (times <= animation.times[-1] + 1e-9)
    return both, animation.at(times[both])


def check_taught(targets: Floats, frame: float, lessons: Sequence[Lesson]) -> list[str]:
    """Refuse what is too little, or does not move; return the controls that stay still.

    Parameters
    ----------
    targets : (N, K) float64
    frame : float
        Seconds from one to the next.
    lessons : sequence of Lesson

    Raises
    ------
    InputError
    """
    seconds = len(targets) * frame
    if seconds < LEAST:
        raise InputError(f"{seconds:.2f} s to learn from", expected=f"{LEAST:g} s; 20 are better")
    still = np.flatnonzero(targets.std(axis=0) < STILL)
    controls = lessons[0].animation.controls
    if len(still) == len(controls):
        raise InputError(
            "no control moves",
            where=lessons[0].name,
            expected="an animation of a mouth that speaks",
        )
    return [controls[place] for place in still]


def check_units(hidden: Sequence[int]) -> None:
    """Refuse numbers of hidden units that no layer can have."""
    if not hidden or not all(1 <= units <= 4096 for units in hidden):
        raise InputError(f"hidden units {list(hidden)}", expected="1 to 4096 in each layer")


def about_of(
    lessons: Sequence[Lesson], seconds: float, error: float, constant: list[str]
) -> dict[str, Any]:
    """Return what is said of a training, in the model's file."""
    notes = list(dict.fromkeys(note for lesson in lessons for note in lesson.sound.notes))
    if seconds < FEW:
        notes.append(f"{seconds:.1f} s to learn from: the publication's net had 20")
    if constant:
        notes.append(f"does not move in the training, and will not: {', '.join(constant)}")
    return {
        "seconds": round(seconds, 3),
        "sounds": len(lessons),
        "error": round(error, 6),
        "constant": constant,
        "notes": notes,
    }
