"""A speaker's, a character's or a studio's own controls, learnt on top of a live model.

The convolutions have heard a hundred voices and stay as they are; what is learnt is a small
net from what they make of the sound, at several instants, to the controls. So seconds are
enough to begin with and minutes give the speaker's own way. The learning is scikit-learn's;
several nets that differ in their first weights are learnt, and answer together.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural.convolution import GREATEST, WEIGHT_STEP, Affine
from lipwright.engines.neural.features import check_audible
from lipwright.engines.neural.lessons import (
    Lesson,
    about_of,
    check_taught,
    check_units,
    controls_of,
    shown,
)
from lipwright.engines.neural.live_model import FRAME, LiveModel, through
from lipwright.engines.neural.network import Network
from lipwright.engines.neural.stream import hear_all
from lipwright.engines.neural.training import fit_network
from lipwright.errors import SoundError
from lipwright.sound import Sound

Floats = NDArray[np.float64]

HIDDEN = 64
REACH = (-6, -3, 0, 3, 6)
"""Frames around the one that is answered of which it is taken what the convolutions make."""
HEARD = tuple(range(-12, 13))
"""Frames around it whose bands are taken too."""
REACH_BACK, HEARD_BACK = (-8, -6, -4, -2, 0), tuple(range(-16, 1))
"""The same of a model that streams."""
NETS = 3
STILLEST = 0.01
"""Units that deviate by less, in training, are not listened to."""
DECAY, RATE = 6.0, 0.002
"""Weight decay and step: what did best on sentences left out, ten minutes taught."""
BROADEST = 2.0
"""How far answers are moved away from their mean, at most, to be as broad as what was shown."""
FRAMES, MOST = 300_000, 150
"""Frames that are gone through in all, however many there are; and passes, at most."""


def teach(
    lessons: Sequence[Lesson],
    ears: LiveModel,
    *,
    hidden: Sequence[int] = (HIDDEN,),
    seed: int = 0,
) -> LiveModel:
    """Learn a live model of any controls.

    Parameters
    ----------
    lessons : sequence of Lesson
        All with the same controls.
    ears : LiveModel
        Whose convolutions hear.
    hidden : sequence of int
        Units of each hidden layer.
    seed : int
        The same gives the same model.

    Returns
    -------
    LiveModel
        Its ``about`` holds ``seconds``, ``sounds``, ``error``, ``constant`` and ``notes``.

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
    controls = controls_of(lessons)
    check_units(hidden)
    ears = with_reach(ears)
    pairs = [_frames(lesson, ears) for lesson in lessons]
    inputs = np.concatenate([heard for heard, _ in pairs])
    targets = np.concatenate([values for _, values in pairs])
    constant = check_taught(targets, FRAME, lessons)
    passes = min(MOST, -(-FRAMES // len(inputs)))
    nets = [
        fit_network(inputs, targets, hidden, seed + number, decay=DECAY, passes=passes, rate=RATE)
        for number in range(NETS)
    ]
    layers = broadened(together(nets), inputs, targets)
    error = float(np.sqrt(np.square(through(layers, inputs) - targets).mean()))
    return replace(
        ears,
        controls=controls,
        low=np.minimum(targets.min(axis=0), 0.0),
        high=np.maximum(targets.max(axis=0), 1.0),
        layers=layers,
        logistic=False,
        closed=None,
        closing=None,
        about=about_of(lessons, len(inputs) * FRAME, error, constant),
    )


def with_reach(ears: LiveModel) -> LiveModel:
    """Return ears whose last layers hear several instants: around the frame, if they may wait."""
    reach, heard = (REACH, HEARD) if ears.both_ways else (REACH_BACK, HEARD_BACK)
    later = heard[-1]
    return replace(
        ears,
        ahead=ears.ahead + later,
        own=-later,
        instants=tuple(around - later for around in reach),
        bands=tuple(around - later - ears.net.delay for around in heard),
    )


def heard_by(ears: LiveModel, sound: Sound) -> Floats:
    """Return what the last layers take in at every frame of a sound, (T, instants x C)."""
    width = ears.taken
    passed_on = replace(
        ears,
        controls=tuple(map(str, range(width))),
        low=np.full(width, -np.inf),
        high=np.full(width, np.inf),
        layers=(Affine(np.eye(width), np.zeros(width)),),
        logistic=False,
        closed=None,
    )
    return hear_all(sound.samples, sound.rate, passed_on).values.astype(np.float64)


def together(nets: Sequence[Network]) -> tuple[Affine, ...]:
    """Return layers that answer what several nets of one shape answer on the average."""
    layers = []
    for number in range(len(nets[0].layers)):
        parts = [net.layers[number] for net in nets]
        weights = [part.weights.astype(np.float64) for part in parts]
        biases = [part.bias.astype(np.float64) for part in parts]
        last = number == len(nets[0].layers) - 1
        if number == 0:
            for place, net in enumerate(nets):
                weights[place], biases[place] = _raw(net, weights[place], biases[place])
        if last and number == 0:
            found = np.mean(weights, axis=0), np.mean(biases, axis=0)
        elif last:
            found = np.concatenate(weights) / len(nets), np.mean(biases, axis=0)
        elif number == 0:
            found = np.concatenate(weights, axis=1), np.concatenate(biases)
        else:
            found = _side_by_side(weights), np.concatenate(biases)
        layers.append(Affine(_on_weight_grid(found[0]), _on_weight_grid(found[1])))
    return tuple(layers)


def broadened(layers: tuple[Affine, ...], inputs: Floats, targets: Floats) -> tuple[Affine, ...]:
    """Return layers whose answers are as broad as what was shown.

    A net gives the mean of what it cannot tell apart, so that lips which close a little sooner
    or later each time would never close. Each control is moved away from its mean until its
    deviation is that of the targets (Toda and Tokuda 2007 do so to spectra), twice as far at
    most.

    Parameters
    ----------
    layers : tuple of Affine
    inputs : (N, I) float64
    targets : (N, K) float64
    """
    answers = through(layers, inputs)
    narrow = answers.std(axis=0)
    gain = np.clip(targets.std(axis=0) / np.maximum(narrow, 1e-9), 1.0, BROADEST)
    last, mean = layers[-1], answers.mean(axis=0)
    weights, bias = last.weights * gain, mean + (last.bias - mean) * gain
    return (*layers[:-1], Affine(_on_weight_grid(weights), _on_weight_grid(bias)))


def _raw(net: Network, weights: Floats, bias: Floats) -> tuple[Floats, Floats]:
    """Return a first layer that takes inputs as they are; those that never moved are left out."""
    moved = net.deviation > STILLEST
    own = np.where(moved[:, None], weights / net.deviation[:, None].astype(np.float64), 0.0)
    return own, bias - net.mean.astype(np.float64) @ own


def _side_by_side(parts: Sequence[Floats]) -> Floats:
    high, wide = parts[0].shape
    found = np.zeros((high * len(parts), wide * len(parts)))
    for number, part in enumerate(parts):
        found[number * high : (number + 1) * high, number * wide : (number + 1) * wide] = part
    return found


def _on_weight_grid(values: Floats) -> Floats:
    kept = np.clip(values, -GREATEST, GREATEST)
    return np.ascontiguousarray(np.rint(kept / WEIGHT_STEP) * WEIGHT_STEP)


def _frames(lesson: Lesson, ears: LiveModel) -> tuple[Floats, Floats]:
    """Return what the last layers take in and what is shown, where there are both."""
    try:
        check_audible(lesson.sound)
    except SoundError as error:
        raise error.at(lesson.heard or lesson.name) from None
    heard = heard_by(ears, lesson.sound)
    both, values = shown(lesson, np.arange(len(heard), dtype=np.float64) * FRAME)
    return heard[both], values
