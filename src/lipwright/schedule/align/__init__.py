"""Alignment: a sound and its words become phones in time.

The acoustic model and the dictionary are those inside pocketsphinx (BSD). Its decoder is
not used here: with its beams it refuses good recordings, and what it heard before changes
what it hears next. An exact search over the same model (:mod:`.viterbi`) does neither.

The way: text → tokens (:mod:`.text`, :mod:`.numbers`) → pronunciations (:mod:`.lexicon`)
→ a network of phones (:mod:`.network`); sound → features (:mod:`.features`) → scores
(:mod:`.scores`); both → the best path (:mod:`.viterbi`) → boundaries refined
(:mod:`.refine`). Long sounds go piece by piece (:mod:`.walk`).

Other languages than English go the same way, with words in IPA from the synthesiser
(:mod:`lipwright.schedule.languages`), or in any other phone set from a pronouncer of its
own, each sound mapped to the model's phones that are nearest to the ear
(:mod:`.acoustics`, :mod:`.pronouncing`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import SoundError, TextError
from lipwright.schedule.align.heard import Heard
from lipwright.schedule.align.lexicon import LexiconLike, Spoken, pronounced
from lipwright.schedule.align.model import STATES, load_model
from lipwright.schedule.align.network import shortest
from lipwright.schedule.align.prepare import prepared, with_noise_floor
from lipwright.schedule.align.pronouncing import Pronounced, as_spoken, in_own_labels
from lipwright.schedule.align.refine import OTHER_STAGES, STAGES, Stage
from lipwright.schedule.align.speech import as_speech, guessed_note
from lipwright.schedule.align.text import tokens
from lipwright.schedule.align.walk import walk
from lipwright.sound import Sound
from lipwright.speech import Speech

__all__ = ["Pronounced", "align", "align_words"]

_ENGLISH = ("en", "en-us")


def is_english(language: str) -> bool:
    """Whether the dictionary of the acoustic model, which is American, is for a language.

    Examples
    --------
    >>> is_english("en_US"), is_english("en-gb"), is_english("de")
    (True, False, False)
    """
    return language.strip().lower().replace("_", "-") in _ENGLISH


def align(
    sound: Sound,
    text: str,
    *,
    language: str = "en-us",
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
        Speech, of any rate and length.
    text : str
        What is said, as people write it: numbers, dates, money and abbreviations too.
    language : str
        That it is said in, as the synthesiser names it (``"de"``, ``"pt-br"``); all but
        ``"en"`` and ``"en-us"`` need the extra ``tts``.
    lexicon : path, mapping or None
        Pronunciations of English words: a file in the format of the CMU dictionary, or
        ``{"lipwright": "L IH P R AY T"}``. They come before the dictionary's own.
    progress : function, optional
        Called with 0..1 as the sound is gone through.

    Returns
    -------
    Speech
        Phones in ARPAbet without stress (pinyin for Mandarin, IPA for other languages),
        ``sil`` where nothing is said, without gaps; words as in ``text``; a confidence,
        0..1, for each phone, word and the line.

    Raises
    ------
    SoundError
        If the sound is silent, or too short for the words.
    TextError
        If nothing can be spoken, there is no such language, it is not written in this
        script, words have no known sounds, or a lexicon is given that is not for it.
    MissingExtraError
        If the language is not English and there is no synthesiser.
    """
    if not is_english(language):
        return _in_another_language(sound, text, language, lexicon, progress)
    written = tokens(text)
    spoken, guessed = pronounced(written, lexicon)
    heard = _heard(sound, prepared(sound), spoken, progress)
    labels = [token.label for token in spoken]
    notes = guessed_note(guessed)
    return as_speech(heard, labels, sound, text=text, source="align", notes=notes)


def _in_another_language(
    sound: Sound,
    text: str,
    language: str,
    lexicon: LexiconLike,
    progress: Callable[[float], None] | None,
) -> Speech:
    from lipwright.schedule.languages import read_text  # starts a program: only when needed

    if lexicon is not None:
        raise TextError(
            f"a lexicon, which is for English, with the language {language!r}",
            cure="leave it out",
        )
    prepared(sound)  # a sound that is of no use is refused before a program is started
    read = read_text(text, language)
    return align_words(
        sound,
        read.words,
        text=text,
        language=read.language,
        phone_set=read.phone_set,
        notes=read.notes,
        progress=progress,
    )


def align_words(
    sound: Sound,
    words: Sequence[Pronounced],
    *,
    text: str,
    language: str,
    phone_set: str = "ipa",
    notes: Sequence[str] = (),
    progress: Callable[[float], None] | None = None,
) -> Speech:
    """Return when each phone of some words sounds, in a language that is not English.

    Parameters
    ----------
    sound : Sound
        Of any rate and length.
    words : sequence of Pronounced
        In the order in which they are said, with the ways each of them may sound.
    text : str
        What is said, as people write it.
    language : str
        Its name, as it is to stand in the result.
    phone_set : str
        That the labels of the words belong to.
    notes : sequence of str
        What the pronouncer has to say.
    progress : function, optional
        Called with 0..1 as the sound is gone through.

    Returns
    -------
    Speech
        Phones in ``phone_set``, ``sil`` where nothing is said, without gaps; a
        confidence, 0..1, for each phone, word and the line.

    Raises
    ------
    SoundError
        If the sound is silent, or too short for the words.
    TextError
        If there are no words.
    LabelError
        If a word has no phones, or phones that the acoustic model does not know.
    """
    if not words:
        raise TextError("no words", where="the text", expected="what is said in the sound")
    samples = with_noise_floor(prepared(sound))
    heard = _heard(sound, samples, as_spoken(words, load_model()), progress, OTHER_STAGES)
    return as_speech(
        in_own_labels(heard, words),
        [word.word for word in words],
        sound,
        text=text,
        source="align",
        notes=notes,
        language=language,
        phone_set=phone_set,
    )


def _heard(
    sound: Sound,
    samples: NDArray[np.float32],
    spoken: Sequence[Spoken],
    progress: Callable[[float], None] | None,
    stages: Sequence[Stage] = STAGES,
) -> tuple[Heard, ...]:
    walked = walk(load_model(), samples, spoken, progress, stages)
    if not walked.phones:
        raise SoundError(
            f"{sound.duration:.3g} s is too short for {len(spoken)} words",
            expected=f"{shortest(spoken) * STATES * 0.01:.2g} s or more",
            cure="check that text and sound belong together",
        )
    return walked.phones
