"""Sound alone becomes words and phones: pocketsphinx with its own language model.

The words that it hears are then aligned as if they were given (:mod:`.align`). Where it
hears sounds but no words, phones are taken by ear (:mod:`.by_ear`), so that the mouth still
moves.
American English only; names and rare words come out as what sounds like them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipwright.phones import SILENCE
from lipwright.schedule.align.features import RATE
from lipwright.schedule.align.heard import NO_TOKEN, Heard
from lipwright.schedule.align.lexicon import Spoken, look_up
from lipwright.schedule.align.model import load_model, model_folder
from lipwright.schedule.align.piece import align_piece
from lipwright.schedule.align.prepare import pieces, prepared
from lipwright.schedule.align.refine import refine
from lipwright.schedule.align.speech import as_speech
from lipwright.schedule.by_ear import hear
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Tier

if TYPE_CHECKING:
    from pocketsphinx import Decoder

_DOUBTFUL = 0.5
_WITHOUT_WORDS = "no words understood: phones only, by ear"


@dataclass(frozen=True, slots=True)
class _Word:
    spelling: str
    chance: float


def recognise(sound: Sound, *, progress: Callable[[float], None] | None = None) -> Speech:
    """Return what is said in a sound, and when.

    Parameters
    ----------
    sound : Sound
        English speech, of any rate and length.
    progress : function, optional
        Called with 0..1 as the sound is gone through.

    Returns
    -------
    Speech
        As :func:`lipwright.schedule.align.align` returns it; the confidence of a word is
        the recogniser's own. Without words, but with phones, where none was understood.

    Raises
    ------
    SoundError
        If there is no speech in the sound.
    """
    samples = prepared(sound)
    heard: list[Heard] = []
    words: list[_Word] = []
    for start, stop in pieces(samples):
        piece = samples[start:stop]
        found = _words(piece)
        heard += _placed(piece, found, start / RATE, len(words))
        words += found
        if progress:
            progress(stop / len(samples))
    if not words:
        return replace(hear(sound), source="recognise", notes=(_WITHOUT_WORDS,))
    labels = [word.spelling for word in words]
    speech = as_speech(heard, labels, sound, text=" ".join(labels), source="recognise")
    return _with_chances(speech, heard, words)


def _words(samples: NDArray[np.float32]) -> list[_Word]:
    decoder = _decoder()
    _run(decoder, samples)
    found = []
    for segment in decoder.seg() or ():
        spelling = segment.word.partition("(")[0]
        if spelling and spelling[0] not in "<[+" and look_up(spelling):
            found.append(_Word(spelling, min(1.0, float(segment.prob))))
    return found


def _placed(
    samples: NDArray[np.float32], words: Sequence[_Word], seconds: float, before: int
) -> list[Heard]:
    """Align the words of a piece that starts at ``seconds`` after ``before`` words."""
    tokens = [Spoken(word.spelling, ((look_up(word.spelling),),)) for word in words]
    heard = align_piece(load_model(), samples, tokens) if tokens else ()
    if not heard:
        heard = (Heard(SILENCE, 0.0, len(samples) / RATE, NO_TOKEN, 0.0),)
    return [
        replace(
            phone,
            start=phone.start + seconds,
            end=phone.end + seconds,
            token=phone.token if phone.is_pause else phone.token + before,
        )
        for phone in refine(heard, samples)
    ]


def _with_chances(speech: Speech, heard: Sequence[Heard], words: Sequence[_Word]) -> Speech:
    """Put the recogniser's own confidence into words and line."""
    tokens = [token for token, _ in groupby(p.token for p in heard if not p.is_pause)]
    chances = [round(words[token].chance, 3) for token in tokens]
    tier = Tier(tuple(replace(w, confidence=c) for w, c in zip(speech.words, chances, strict=True)))
    durations = [word.duration for word in tier]
    line = float(np.average(chances, weights=durations)) if chances else 0.0
    notes = (f"confidence {line:.2f}: recognised words may be wrong; give the text",)
    return replace(
        speech, words=tier, confidence=round(line, 3), notes=notes if line < _DOUBTFUL else ()
    )


def _run(decoder: Decoder, samples: NDArray[np.float32]) -> None:
    noise = np.random.default_rng(0).normal(0.0, 1.0, len(samples))
    pcm = np.clip(samples * 32767.0 + noise, -32768, 32767).astype(np.int16)
    # Without a fresh front end, what was heard before changes what is heard now.
    decoder.reinit_feat()
    decoder.start_utt()
    try:
        decoder.process_raw(pcm.tobytes(), full_utt=True)
    finally:
        decoder.end_utt()  # an utterance left open fails all later ones


@cache
def _decoder() -> Decoder:
    from pocketsphinx import Decoder

    folder = model_folder() / "en-us"
    return Decoder(
        hmm=str(folder / "en-us"),
        lm=str(folder / "en-us.lm.bin"),
        dict=str(folder / "cmudict-en-us.dict"),
        samprate=RATE,
        loglevel="FATAL",
        dither=False,
    )
