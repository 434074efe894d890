"""Sound alone becomes phones, in any language: what each instant sounds like, no words.

Any phone may follow any other, as often as phones do in English: a loop over the 39 phones
of the acoustic model without their neighbours, and its pauses, searched exactly
(:mod:`.align.viterbi`). The model knows American English only; a sound of another language
is heard as the nearest of its phones. Boundaries are then moved as in alignment.

The recogniser's own loop (pocketsphinx, ``allphone``) is slower and less right;
``bench.by_ear`` has the figures.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import SoundError
from lipwright.phones import SILENCE
from lipwright.schedule.align.features import RATE
from lipwright.schedule.align.heard import NO_TOKEN, Heard
from lipwright.schedule.align.model import AcousticModel, load_model, model_folder
from lipwright.schedule.align.network import PAUSE, Network, Node
from lipwright.schedule.align.piece import through
from lipwright.schedule.align.prepare import pieces, prepared, with_noise_floor
from lipwright.schedule.align.refine import OTHER_STAGES, refine
from lipwright.schedule.align.speech import as_speech
from lipwright.sound import Sound
from lipwright.speech import Speech

NOTE = "phones by ear, of English and without words: the text or labels give better ones"
_LEAST = 0.06  # s of vowels that are speech; clicks, tones and gusts have fewer
_FOLLOWING = 4.0  # weight of what follows what; the sound's frames are far from independent
_RAREST = -12.0  # log probability
_CHANGE = 8.0  # what a new phone is given, against that weight
_UNSURE = -99.0  # nats per frame: no phone is to look sure


def hear(sound: Sound, *, progress: Callable[[float], None] | None = None) -> Speech:
    """Return what a sound sounds like, and when, in the phones of English.

    Parameters
    ----------
    sound : Sound
        Speech in any language, of any rate and length.
    progress : function, optional
        Called with 0..1 as the sound is gone through.

    Returns
    -------
    Speech
        Phones in ARPAbet and no words; its confidence is 0.

    Raises
    ------
    SoundError
        If there is no speech in the sound.
    """
    samples = prepared(sound)
    heard: list[Heard] = []
    for start, stop in pieces(samples):
        heard += _placed(samples[start:stop], start / RATE)
        if progress:
            progress(stop / len(samples))
    if sum(phone.end - phone.start for phone in heard if phone.label[0] in "aeiou") < _LEAST:
        raise SoundError("no speech in it", expected="a voice", cure="check the recording")
    speech = as_speech(heard, (), sound, text="", source="ear", language="")
    return replace(speech, confidence=0.0, notes=(NOTE,))


def _placed(samples: NDArray[np.float32], seconds: float) -> list[Heard]:
    """Hear a piece that starts at ``seconds``."""
    heard = through(load_model(), _loop(), with_noise_floor(samples))
    if not heard:
        heard = (Heard(SILENCE, 0.0, len(samples) / RATE, NO_TOKEN, _UNSURE),)
    return [
        replace(
            phone,
            start=phone.start + seconds,
            end=phone.end + seconds,
            token=NO_TOKEN,
            margin=_UNSURE,
        )
        for phone in refine(heard, samples, OTHER_STAGES)
    ]


@cache
def _loop() -> Network:
    """Return the network in which any phone follows any."""
    model = load_model()
    follows = _FOLLOWING * np.maximum(_follows(model), _RAREST) + _CHANGE
    count = len(model.phones)
    return Network(
        tuple(_node(model, phone) for phone in range(count)),
        tuple(tuple(enumerate(follows[:, phone].tolist())) for phone in range(count)),
        tuple((phone, 0.0) for phone in range(count)),
        tuple(range(count)),
    )


def _node(model: AcousticModel, phone: int) -> Node:
    states = tuple(int(state) for state in model.triphones.senones[phone])
    return Node(phone, PAUSE if phone in model.triphones.fillers else 0, states, ends=True)


def _follows(model: AcousticModel) -> NDArray[np.float64]:
    """Return the log probability that a phone (row) is followed by another, in English.

    It is the recogniser's own model of phones; its pauses and noises are one.
    """
    from pocketsphinx import Config, LogMath, NGramModel

    folder = model_folder() / "en-us"
    logarithm = LogMath()
    config = Config(hmm=str(folder / "en-us"), lm=None, dict=None, loglevel="FATAL")
    known = NGramModel(config, logarithm, str(folder / "en-us-phone.lm.bin"))
    fillers = model.triphones.fillers
    names = ["SIL" if i in fillers else name.upper() for i, name in enumerate(model.phones)]
    steps = [[known.prob([after, before]) for after in names] for before in names]
    return np.asarray(np.log(1.0001) * np.array(steps, np.float64))
