"""The neural engine: sound in, a model's controls out (Frank, Hoch, Trogemann).

The net answers 25 times a second, as published. Between its frames a cubic runs that
neither overshoots nor has corners (Fritsch and Butland 1984), so that any rate can be had.
Words and phones are handed on where the line has them; the net needs none.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.curves import reduced
from lipwright.engines.neural.features import features, frame_times
from lipwright.engines.neural.model import Model
from lipwright.errors import InputError
from lipwright.speech import Speech

Floats = NDArray[np.float64]

FASTEST = 10_000.0
TOLERANCE = 0.02
"""By how much keys may be off, in weights."""


class NeuralEngine:
    """Animates speech with a trained net.

    Parameters
    ----------
    model : Model
    name : str
        What reports call it.
    """

    def __init__(self, model: Model, name: str = "") -> None:
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
            of the net lies within 0.02 of their curves. The report's ``unlike_training`` is the
            share of frames that sound like nothing in the training.

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
        heard = features(speech.sound, self.model.hearing)
        given = self.model.outputs(heard)
        own = frame_times(speech.sound, self.model.hearing)
        times = np.arange(int(speech.sound.duration * rate + 1e-9) + 1) / rate
        values = np.clip(smooth(own, given, times), self.model.low, self.model.high)
        keys = {
            name: reduced(own, column, TOLERANCE)
            for name, column in zip(self.model.controls, given.T, strict=True)
        }
        return Animation(
            self.model.controls,
            values.astype(np.float32),
            rate,
            keys=keys,
            phones=speech.phones,
            words=speech.words,
            engine="neural",
            report={
                "model": self.name,
                "net": "-".join(map(str, self.model.network.shape)),
                "unlike_training": round(self.model.strange(heard), 4),
            },
        )


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
