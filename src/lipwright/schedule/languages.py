"""How a text sounds in any language of the synthesiser, for the aligner.

espeak-ng reads the whole text, so that numbers, liaisons and sandhi come out as they are
spoken, and says which word each phone belongs to (extra ``tts``). Its sound is thrown
away; what stays are the words as they were written, in IPA. Mandarin is read by
:mod:`lipwright.schedule.mandarin`, in the sounds of pinyin.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from lipwright.errors import LabelError, TextError
from lipwright.phones import SILENCE
from lipwright.schedule.align.acoustics import ways_of
from lipwright.schedule.align.pronouncing import Pronounced
from lipwright.schedule.say import say
from lipwright.schedule.say.voices import is_mandarin
from lipwright.schedule.say.words import nothing_to_say
from lipwright.speech import Speech

_PART = 4000  # characters that are read at once: memory grows with them
_ENDS = re.compile(r"(?<=[.!?…。！？।؟])\s+|\n\s*\n|(?<=[。！？])")
_SAME = 1e-6  # s


@dataclass(frozen=True, slots=True)
class Reading:
    """A text as a language reads it.

    Parameters
    ----------
    words : tuple of Pronounced
    language : str
        As the synthesiser names it.
    notes : tuple of str
        What the user should know.
    phone_set : str
        That the labels of the words belong to.
    """

    words: tuple[Pronounced, ...]
    language: str
    notes: tuple[str, ...] = ()
    phone_set: str = "ipa"


def read_text(text: str, language: str) -> Reading:
    """Return the words of a text, each with the ways it may sound.

    Parameters
    ----------
    text : str
        As people write it.
    language : str
        A language or voice of espeak-ng: ``"de"``, ``"pt-br"``.

    Raises
    ------
    TextError
        If there is nothing to say, no such language, or letters that it does not read.
    MissingExtraError
        If there is no synthesiser.

    Examples
    --------
    >>> [word.word for word in read_text("Das Haus ist 12 m hoch.", "de").words]
    ['Das', 'Haus', 'ist', '12', 'm', 'hoch']
    """
    if not any(map(str.isalnum, text)):
        raise nothing_to_say()
    if is_mandarin(language):
        return _read_mandarin(text)
    words: list[Pronounced] = []
    language_read = language
    notes: dict[str, None] = {}
    for part in _parts(text):
        speech = _read(part, language)
        language_read = speech.language
        notes |= dict.fromkeys(note.replace("spoken by", "read as") for note in speech.notes)
        words += _words(speech)
    return Reading(tuple(words), language_read, tuple(notes))


def _read_mandarin(text: str) -> Reading:
    from lipwright.schedule.mandarin import pronounce  # its tables are needed for no other

    words = tuple(Pronounced(word.text, word.acoustic()) for word in pronounce(text))
    return Reading(words, "cmn", phone_set="pinyin")


def _read(text: str, language: str) -> Speech:
    """Let the synthesiser read; what it refuses is said in the aligner's terms."""
    if language.split(":")[0] == "festival":
        raise TextError(f"no language {language!r}", expected="one such as de, fr, es, cmn")
    try:
        return say(text, voice=language)
    except TextError as error:
        found = error.found.replace("no voice", "no language")
        expected = error.expected.replace("a voice such as", "one such as")
        cure = error.cure.replace("--voice", "--language")
        raise TextError(found, where=error.where, expected=expected, cure=cure) from None


def _parts(text: str) -> Iterator[str]:
    """Cut a long text at ends of sentences, or else at spaces; nothing silent is given."""
    part = ""
    for sentence in _ENDS.split(text):
        pieces = [sentence] if len(sentence) <= _PART else _at_spaces(sentence)
        for piece in pieces:
            if part and len(part) + len(piece) > _PART:
                yield part
                part = ""
            part = f"{part} {piece}" if part else piece
            if not any(map(str.isalnum, part)):
                part = ""
    if part:
        yield part


def _at_spaces(sentence: str) -> list[str]:
    return re.findall(rf"\S.{{0,{_PART - 2}}}(?=\s|$)|\S{{1,{_PART}}}", sentence, re.DOTALL)


def _words(speech: Speech) -> Iterator[Pronounced]:
    """Give each word its phones; words that share a single phone become one."""
    phones = iter([phone for phone in speech.phones if phone.label != SILENCE])
    names: list[str] = []
    for word in speech.words:
        names.append(word.label)
        labels = []
        for phone in phones:
            labels.append(phone.label)
            if phone.end > word.end - _SAME:
                break
        if labels:
            yield _pronounced(" ".join(names), labels, speech.language)
            names = []


def _pronounced(word: str, labels: list[str], language: str) -> Pronounced:
    try:
        return Pronounced(word, ways_of(labels, language))
    except LabelError as error:
        raise error.at(f"pronunciation of {word!r}") from None
