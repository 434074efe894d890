"""Sound and animation from files, and the neural model that is learnt from them.

As in :mod:`lipwright.pipeline`: an animation is our own lossless file, a CSV of any
program's, or one with ARKit's shapes; its controls are learnt as they are, or as the
publication's five.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np

from lipwright.animation import Animation
from lipwright.errors import InputError

if TYPE_CHECKING:
    from lipwright.engines.neural.live_model import LiveModel
    from lipwright.engines.neural.model import Model

TimeIs = Literal["start", "middle"]
Hears = Literal["whole", "live", "published"]


def train_model(
    pairs: Sequence[tuple[str | Path, str | Path]],
    *,
    hears: Hears = "whole",
    five: bool = False,
    hidden: Sequence[int] | None = None,
    seed: int = 0,
    time_is: TimeIs | None = None,
) -> Model | LiveModel:
    """Learn a neural model from sounds and the animations that go with them.

    Parameters
    ----------
    pairs : sequence of (sound, animation)
        Files; see :func:`read_animation`.
    hears : str
        With which ears: ``"whole"`` or ``"live"``, those of the models that come with
        Lipwright; or ``"published"``, Frank, Hoch and Trogemann's net, taught from nothing.
    five : bool
        Whether ARKit's shapes become the publication's five outputs (a, i, o/u, b/m/p,
        open) first.
    hidden : sequence of int, optional
        Units of each hidden layer; 18 as published, else 64.
    seed : int
        The same gives the same model.
    time_is : str, optional
        See :func:`read_animation`.

    Raises
    ------
    InputError
        If a file cannot be used, there is too little, or lengths disagree.
    MissingExtraError
        If the extra ``train`` is not installed.
    """
    from lipwright.engines.neural import teaching
    from lipwright.engines.neural.built_in import live_model
    from lipwright.engines.neural.lessons import Lesson
    from lipwright.engines.neural.teaching import teach
    from lipwright.engines.neural.training import HIDDEN, train
    from lipwright.sound_files import read_sound

    lessons, said = [], []
    for sound, file in pairs:
        animation, notes = read_animation(file, time_is)
        lessons.append(Lesson(read_sound(sound), animation, str(file), str(sound)))
        said += [f"{Path(file).name}: {note}" for note in notes]
    if five:
        lessons = [
            replace(lesson, animation=animation)
            for lesson, animation in zip(
                lessons, in_five([lesson.animation for lesson in lessons]), strict=True
            )
        ]
    if hears == "published":
        model: Model | LiveModel = train(lessons, hidden=hidden or (HIDDEN,), seed=seed)
    else:
        ears = live_model(hears)
        model = teach(lessons, ears, hidden=hidden or (teaching.HIDDEN,), seed=seed)
    model.about["notes"] = [*said, *model.about["notes"]]
    return model


def read_animation(path: str | Path, time_is: TimeIs | None = None) -> tuple[Animation, list[str]]:
    """Return the animation in a file, and what the user should know of it.

    Parameters
    ----------
    path : path
        ``.json`` in the lossless format, or ``.csv``.
    time_is : str, optional
        Of a CSV: whether a row's time is when its frame begins (``"start"``) or its instant
        (``"middle"``). ``"start"`` for ARKit's shapes, else ``"middle"``, if not given.

    Raises
    ------
    InputError
        If it cannot be read, or is of another kind.
    """
    suffix = Path(path).suffix.lower()
    if suffix == ".json":
        return Animation.load(path), []
    if suffix != ".csv":
        raise InputError(
            f"the suffix {suffix!r}", where=str(path), expected="an animation in .json or .csv"
        )
    from lipwright.engines.motion.capture import read_motion
    from lipwright.engines.motion.capture.blendshapes import arkit_name

    motion = read_motion(path, time_is=time_is or "start")
    middle = 0.5 / motion.rate
    if time_is is None and not any(map(arkit_name, motion.channels)):
        middle = 0.0
    animation = Animation(motion.channels, motion.values, motion.rate, motion.start + middle)
    return animation, list(motion.notes)


def in_five(animations: Sequence[Animation]) -> list[Animation]:
    """Return animations of ARKit's shapes as the publication's five outputs.

    The range of the face is taken from all of them together.

    Raises
    ------
    InputError
        If they have no jawOpen, it does not move, or their controls differ.
    """
    from lipwright.engines.neural.five import FIVE, FiveOfShapes

    channels = animations[0].controls
    if any(one.controls != channels for one in animations):
        raise InputError("animations with different controls", expected="the same in all")
    way = FiveOfShapes.fit(channels, np.concatenate([one.values for one in animations]))
    return [
        replace(one, controls=FIVE, values=way.five(one.values).astype(np.float32), keys={})
        for one in animations
    ]
