"""Alignment: a sound and its words become phones in time.

The acoustic model and the dictionary are those inside pocketsphinx (BSD). Its decoder is
not used here: with its beams it refuses good recordings, and what it heard before changes
what it hears next. An exact search over the same model (:mod:`.viterbi`) does neither.

The way: text → tokens (:mod:`.text`, :mod:`.numbers`) → pronunciations (:mod:`.lexicon`)
→ a network of phones (:mod:`.network`); sound → features (:mod:`.features`) → scores
(:mod:`.scores`); both → the best path (:mod:`.viterbi`) → boundaries refined
(:mod:`.refine`). Long sounds go piece by piece (:mod:`.walk`).
"""

from __future__ import annotations

from collections.abc import Callable

from lipwright.errors import SoundError
from lipwright.schedule.align.lexicon import LexiconLike, pronounced
from lipwright.schedule.align.model import STATES, load_model
from lipwright.schedule.align.network import shortest
from lipwright.schedule.align.prepare import prepared
from lipwright.schedule.align.speech import as_speech, guessed_note
from lipwright.schedule.align.text import tokens
from lipwright.schedule.align.walk import walk
from lipwright.sound import Sound
from lipwright.speech import Speech

__all__ = ["align"]


def align(
    sound: Sound,
    text: str,
    *,
    lexicon: LexiconLike = None,
    progress: Callable[[float], None] | None = None,
) -> Speech:
    """Return when each phone of a text sounds.

    The same sound and text give the same result, whatever was aligned before. For any
    audible sound that is long enough for its words an alignment comes back; where the
    words do not fit, its confidence says so.

    Parameters
    ----------
    sound : Sound
        English speech, of any rate and length.
    text : str
        What is said, as people write it: numbers, dates, money and abbreviations too.
    lexicon : path, mapping or None
        Pronunciations of words: a file in the format of the CMU dictionary, or
        ``{"lipwright": "L IH P R AY T"}``. They come before the dictionary's own.
    progress : function, optional
        Called with 0..1 as the sound is gone through.

    Returns
    -------
    Speech
        Phones in ARPAbet without stress, ``sil`` where nothing is said, without gaps;
        words as in ``text``; a confidence, 0..1, for each phone, word and the line.

    Raises
    ------
    SoundError
        If the sound is silent, or too short for the words.
    TextError
        If nothing can be spoken, a script is not Latin, or words have no known sounds.
    """
    written = tokens(text)
    spoken, guessed = pronounced(written, lexicon)
    samples = prepared(sound)
    walked = walk(load_model(), samples, spoken, progress)
    if not walked.phones:
        raise SoundError(
            f"{sound.duration:.3g} s is too short for {len(spoken)} words",
            expected=f"{shortest(spoken) * STATES * 0.01:.2g} s or more",
            cure="check that text and sound belong together",
        )
    labels = [token.label for token in spoken]
    notes = guessed_note(guessed)
    return as_speech(walked.phones, labels, sound, text=text, source="align", notes=notes)
