"""Learning a model from sound and the animation that goes with it, by back-propagation.

Frank, Hoch, Trogemann, "Network Architecture" and "Discussion": a three-layer net with
back-propagation, taught with 20 s that an animator had animated by hand, a value per
control every 40 ms. The learning is scikit-learn's; what is left here is what it is taught.
Any controls can be learnt. Each is brought to one deviation first, so that a control that
moves by hundredths is learnt as well as one that moves by tenths.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.engines.neural.features import Hearing, features, frame_times
from lipwright.engines.neural.model import Model
from lipwright.engines.neural.network import Layer, Network
from lipwright.errors import InputError, MissingExtraError, SoundError
from lipwright.sound import Sound

Floats = NDArray[np.float64]

HIDDEN = 18
LEAST = 1.0
"""Seconds: with less there is nothing to learn."""
FEW = 15.0
"""Seconds below which it is said that the publication used 20."""
DISAGREE = 0.5
"""Seconds by which an animation may begin or end beside its sound: margins are silence."""
STILL = 1e-4
"""A control whose deviation is below this does not move."""
DECAY, RATE, PASSES = 5.0, 0.01, 200
"""Weight decay, step and passes over the data: what did best on unseen speech, 20 s taught."""
TAUGHT = 500
"""Frames in 20 s: with more of them less decay is needed."""
_SPREAD = 99
_WIDER = 1.25


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


def train(
    lessons: Sequence[Lesson],
    *,
    hidden: Sequence[int] = (HIDDEN,),
    hearing: Hearing | None = None,
    seed: int = 0,
) -> Model:
    """Learn a model.

    Parameters
    ----------
    lessons : sequence of Lesson
        All with the same controls.
    hidden : sequence of int
        Units of each hidden layer.
    hearing : Hearing, optional
        As published where it is not given.
    seed : int
        Of the first weights and the order of the frames: the same gives the same model.

    Returns
    -------
    Model
        Its ``about`` holds ``seconds``, ``sounds``, ``error`` (root mean square on the
        training itself), ``constant`` (controls that did not move) and ``notes``.

    Raises
    ------
    InputError
        If there is too little, an animation and its sound disagree in length, controls
        differ, or none of them moves.
    SoundError
        If a sound is silent or too short.
    MissingExtraError
        If the extra ``train`` is not installed.
    """
    hearing = hearing or Hearing()
    controls = _controls(lessons)
    _check_units(hidden)
    pairs = [_frames(lesson, hearing) for lesson in lessons]
    inputs = np.concatenate([heard for heard, _ in pairs])
    targets = np.concatenate([shown for _, shown in pairs])
    seconds = len(inputs) * hearing.frame
    if seconds < LEAST:
        raise InputError(f"{seconds:.2f} s to learn from", expected=f"{LEAST:g} s; 20 are better")
    still = np.flatnonzero(targets.std(axis=0) < STILL)
    if len(still) == len(controls):
        raise InputError(
            "no control moves",
            where=lessons[0].name,
            expected="an animation of a mouth that speaks",
        )
    network = fit_network(inputs, targets, hidden, seed)
    far = np.sqrt(np.square(network.standardised(inputs)).mean(axis=1))
    model = Model(
        controls,
        np.minimum(targets.min(axis=0), 0.0).astype(np.float32),
        np.maximum(targets.max(axis=0), 1.0).astype(np.float32),
        hearing,
        network,
        _WIDER * float(np.percentile(far, _SPREAD)),
    )
    error = float(np.sqrt(np.square(model.outputs(inputs) - targets).mean()))
    constant = [controls[place] for place in still]
    model.about.update(_about(lessons, seconds, error, constant))
    return model


def fit_network(
    inputs: Floats,
    targets: Floats,
    hidden: Sequence[int],
    seed: int = 0,
    *,
    decay: float = DECAY,
) -> Network:
    """Return the net that back-propagation finds.

    Parameters
    ----------
    inputs : (N, I) float64
    targets : (N, K) float64
    hidden : sequence of int
    seed : int
    decay : float
        What pulls weights to 0; at 0 it is plain back-propagation.

    Raises
    ------
    MissingExtraError
        If the extra ``train`` is not installed.
    """
    try:
        from sklearn.neural_network import MLPRegressor
    except ImportError:
        raise MissingExtraError.of("training a net", "train") from None
    mean, deviation = inputs.mean(axis=0), np.maximum(inputs.std(axis=0), 1e-3)
    middle, spread = targets.mean(axis=0), np.maximum(targets.std(axis=0), STILL)
    wanted = (targets - middle) / spread
    teacher = MLPRegressor(
        hidden_layer_sizes=tuple(hidden),
        activation="logistic",
        solver="adam",
        alpha=decay * min(1.0, TAUGHT / len(inputs)),  # a batch's share of it, not the whole's
        learning_rate_init=RATE,
        max_iter=PASSES,
        n_iter_no_change=PASSES,
        random_state=seed,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # that it stops before nothing is left to learn is meant
        teacher.fit((inputs - mean) / deviation, wanted[:, 0] if wanted.shape[1] == 1 else wanted)
    weights, biases = list(teacher.coefs_), list(teacher.intercepts_)
    weights[-1] = weights[-1] * spread
    biases[-1] = biases[-1] * spread + middle
    layers = [
        Layer(np.asarray(one, np.float32), np.asarray(bias, np.float32))
        for one, bias in zip(weights, biases, strict=True)
    ]
    return Network(mean.astype(np.float32), deviation.astype(np.float32), tuple(layers))


def _frames(lesson: Lesson, hearing: Hearing) -> tuple[Floats, Floats]:
    """Return what is heard and what is shown, where there are both."""
    animation, sound = lesson.animation, lesson.sound
    try:
        heard, times = features(sound, hearing), frame_times(sound, hearing)
    except SoundError as error:
        raise error.at(lesson.heard or lesson.name) from None
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
    return heard[both], animation.at(times[both])


def _controls(lessons: Sequence[Lesson]) -> tuple[str, ...]:
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


def _check_units(hidden: Sequence[int]) -> None:
    if not hidden or not all(1 <= units <= 4096 for units in hidden):
        raise InputError(f"hidden units {list(hidden)}", expected="1 to 4096 in each layer")


def _about(
    lessons: Sequence[Lesson], seconds: float, error: float, constant: list[str]
) -> dict[str, Any]:
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
