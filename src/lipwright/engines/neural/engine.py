"""The neural engine: sound in, a model's controls out.

A model of the publication's kind (Frank, Hoch, Trogemann) answers 25 times a second, a live
model fifty times. Between frames a cubic runs that neither overshoots nor has corners
(Fritsch and Butland 1984), so that any rate can be had. Words and phones are handed on where
the line has them; the net needs none.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.curves import reduced
from lipwright.engines.neural.features import check_audible, features, frame_times
from lipwright.engines.neural.live_model import FRAME, LiveModel
from lipwright.engines.neural.model import Model
from lipwright.engines.neural.stream import hear_all
from lipwright.errors import InputError
from lipwright.sound import Sound
from lipwright.speech import Speech

Floats = NDArray[np.float64]

FASTEST = 10_000.0
TOLERANCE = 0.02
"""By how much keys may be off, in weights."""
UNSURE = 0.2
"""A live model is unsure where the opening may be off by this share of its range."""
LONGEST_SPELL = 0.2
"""Seconds: spells of doubt that are shorter are not told, and shorter gaps between them closed."""
MOVES = 0.05
"""A frame in which no control exceeds this is one of rest."""


@dataclass(frozen=True, slots=True, eq=False)
class Answer:
    """What a model says of a sound, at its own frames.

    Parameters
    ----------
    times : (T,) float64
    values : (T, K) float64
    facts : dict
        For the report.
    """

    times: Floats
    values: Floats
    facts: dict[str, Any]


class NeuralEngine:
    """Animates speech with a trained net.

    Parameters
    ----------
    model : Model or LiveModel
    name : str
        What reports call it.
    """

    def __init__(self, model: Model | LiveModel, name: str = "") -> None:
        self.model = model
        self.name = name

    def animate(self, speech: Speech, rate: float = 60.0) -> Animation:
        """Return the animation of a line.

        Parameters
        ----------
        speech : Speech
            With its sound; phones and words may be empty.
        rate : float
            Frames per second.

        Returns
        -------
        Animation
            Of the model's controls, from 0 to the end of the sound, with keys: every frame
            of the net lies within 0.02 of their curves. The report of a model of the
            publication's kind has ``unlike_training``, the share of frames that sound like
            nothing in the training; that of a live model ``confidence`` (0..1), ``unsure``
            (where it is: pairs of seconds) and ``speaks`` (share of frames in which the mouth
            moves).

        Raises
        ------
        InputError
            If there is no sound, or the rate is out of range.
        SoundError
            If the sound is too short or silent.
        """
        if not 1 <= rate <= FASTEST:
            raise InputError(f"{rate:g} frames per second", expected=f"1 to {FASTEST:g}")
        if speech.sound is None:
            raise InputError(
                "no sound: the neural engine hears, it reads no phones",
                cure="give the recording too, or choose another engine",
            )
        model = self.model
        say = said_live if isinstance(model, LiveModel) else said
        answer = say(model, speech.sound)  # type: ignore[arg-type]
        times = np.arange(int(speech.sound.duration * rate + 1e-9) + 1) / rate
        values = np.clip(smooth(answer.times, answer.values, times), model.low, model.high)
        keys = {
            name: reduced(answer.times, column, TOLERANCE)
            for name, column in zip(model.controls, answer.values.T, strict=True)
        }
        return Animation(
            model.controls,
            values.astype(np.float32),
            rate,
            keys=keys,
            phones=speech.phones,
            words=speech.words,
            engine="neural",
            report={"model": self.name, **answer.facts},
        )


def said(model: Model, sound: Sound) -> Answer:
    """Return what a model of the publication's kind makes of a sound."""
    heard = features(sound, model.hearing)
    facts = {
        "net": "-".join(map(str, model.network.shape)),
        "unlike_training": round(model.strange(heard), 4),
    }
    return Answer(frame_times(sound, model.hearing), model.outputs(heard), facts)


def said_live(model: LiveModel, sound: Sound) -> Answer:
    """Return what a live model makes of a sound; as a stream would, where it can stream."""
    check_audible(sound)
    frames = hear_all(sound.samples, sound.rate, model)
    values = frames.values.astype(np.float64)
    facts = {
        "net": "-".join(map(str, model.shape)),
        "confidence": round(float(1.0 - np.minimum(frames.doubt / UNSURE, 2.0).mean() / 2.0), 4),
        "unsure": spells(frames.doubt > UNSURE),
        "speaks": round(float((values > MOVES).any(axis=1).mean()), 4),
    }
    return Answer(frames.times, values, facts)


def spells(unsure: NDArray[np.bool_]) -> list[list[float]]:
    """Return where frames are unsure for a while: pairs of seconds.

    Examples
    --------
    >>> spells(np.arange(50) // 15 == 1)
    [[0.3, 0.6]]
    """
    edges = np.flatnonzero(np.diff(np.r_[False, unsure, False]))
    found: list[list[float]] = []
    for start, end in edges.reshape(-1, 2) * FRAME:
        if found and start - found[-1][1] < LONGEST_SPELL:
            found[-1][1] = round(float(end), 3)
        else:
            found.append([round(float(start), 3), round(float(end), 3)])
    return [spell for spell in found if spell[1] - spell[0] >= LONGEST_SPELL]


def smooth(times: Floats, values: Floats, at: Floats) -> Floats:
    """Return values between evenly spaced frames, monotone wherever the frames are.

    Parameters
    ----------
    times : (T,) float64
        Evenly spaced.
    values : (T, K) float64
    at : (N,) float64
        What lies outside takes the nearest frame's value.

    Returns
    -------
    (N, K) float64
    """
    if len(times) < 2:
        return np.repeat(values[:1], len(at), axis=0)
    step = times[1] - times[0]
    rises = np.diff(values, axis=0)
    same = rises[:-1] * rises[1:] > 0
    # The harmonic mean of both sides' slopes; flat where the curve turns.
    total = np.where(same, rises[:-1] + rises[1:], 1.0)
    slopes = np.zeros_like(values)
    slopes[1:-1] = np.where(same, 2.0 * rises[:-1] * rises[1:] / total, 0.0)
    place = np.clip((at - times[0]) / step, 0.0, len(times) - 1)
    left = np.minimum(place.astype(np.intp), len(times) - 2)
    x = (place - left)[:, None]
    bend = x * x * (3.0 - 2.0 * x)
    return np.asarray(
        values[left] * (1.0 - bend)
        + values[left + 1] * bend
        + slopes[left] * x * (1.0 - x) ** 2
        + slopes[left + 1] * x * x * (x - 1.0),
        np.float64,
    )
