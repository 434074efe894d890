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

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural.features import Hearing, features, frame_times
from lipwright.engines.neural.lessons import (
    STILL,
    Lesson,
    about_of,
    check_taught,
    check_units,
    controls_of,
    shown,
)
from lipwright.engines.neural.model import Model
from lipwright.engines.neural.network import Layer, Network
from lipwright.errors import MissingExtraError, SoundError

Floats = NDArray[np.float64]

HIDDEN = 18
DECAY, RATE, PASSES = 5.0, 0.01, 200
"""Weight decay, step and passes over the data: what did best on unseen speech, 20 s taught."""
TAUGHT = 500
"""Frames in 20 s: with more of them less decay is needed."""
_SPREAD = 99
_WIDER = 1.25


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
    controls = controls_of(lessons)
    check_units(hidden)
    pairs = [_frames(lesson, hearing) for lesson in lessons]
    inputs = np.concatenate([heard for heard, _ in pairs])
    targets = np.concatenate([shown for _, shown in pairs])
    constant = check_taught(targets, hearing.frame, lessons)
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
    seconds = len(inputs) * hearing.frame
    model.about.update(about_of(lessons, seconds, error, constant))
    return model


def fit_network(
    inputs: Floats,
    targets: Floats,
    hidden: Sequence[int],
    seed: int = 0,
    *,
    decay: float = DECAY,
    passes: int = PASSES,
    rate: float = RATE,
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
    passes : int
        Over the data.
    rate : float
        Of learning.

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
        learning_rate_init=rate,
        max_iter=passes,
        n_iter_no_change=passes,
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
    try:
        heard, times = features(lesson.sound, hearing), frame_times(lesson.sound, hearing)
    except SoundError as error:
        raise error.at(lesson.heard or lesson.name) from None
    both, values = shown(lesson, times)
    return heard[both], values
