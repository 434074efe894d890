"""The words of a Chinese text with the phones of each way to say them, for an aligner.

Numbers are said in several ways, and some characters; Latin words as the English
dictionary says them, or else as espeak-ng guesses them, or letter by letter.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from lipwright.errors import MissingExtraError, TextError
from lipwright.schedule.mandarin.pinyin import Syllable
from lipwright.schedule.mandarin.reading import Word, read
from lipwright.schedule.mandarin.sounds import is_glide, sounds

Phones = tuple[str, ...]
AcousticWay = tuple[tuple[str, Phones], ...]


@dataclass(frozen=True, slots=True)
class Pronounced:
    """A word and the ways to say it, in phones of the set ``pinyin``.

    Parameters
    ----------
    text : str
        As it was written.
    ways : tuple of tuple of str
        At least one; the most usual first.
    """

    text: str
    ways: tuple[Phones, ...]

    def acoustic(self) -> tuple[AcousticWay, ...]:
        """Return what an English acoustic model may hear: for each way, its phones with theirs.

        Where it is uncertain what a phone sounds like, a way comes several times.

        Examples
        --------
        >>> Pronounced("瓜", (("g", "u", "a"),)).acoustic()[0]
        (('g', ('g',)), ('u', ('w',)), ('a', ('aa',)))
        """
        from lipwright.schedule.align.acoustics import ways_by_table  # needed to align alone

        ways = ways_by_table([_with_glides(way) for way in self.ways], "pinyin")
        return tuple(tuple((phone.rstrip("-"), heard) for phone, heard in way) for way in ways)


def pronounce(text: str) -> tuple[Pronounced, ...]:
    """Return the words of a Chinese text with their pronunciations.

    Parameters
    ----------
    text : str
        Characters, pinyin, numbers, Latin words.

    Raises
    ------
    TextError
        If there is no word in it, or words are of unknown reading: all are named.
    MissingExtraError
        If the extra ``mandarin`` is not installed, and needed.

    Examples
    --------
    >>> pronounce("ni3 hao3")[0]
    Pronounced(text='ni3', ways=(('n', 'i'),))
    """
    words = [part for part in read(text) if isinstance(part, Word)]
    if not words:
        raise TextError("nothing is said in it", where="the text", expected="at least one word")
    foreign = dict.fromkeys(s.text for w in words for s in w.syllables if s.is_foreign)
    known = _english(foreign)
    unknown = [word for word in foreign if not known[word]]
    if unknown:
        raise TextError(
            f"no pronunciation for {', '.join(unknown)}",
            where="the text",
            cure="type: pip install 'lipwright[tts]', or write these words in characters",
        )
    return tuple(Pronounced(word.text, _ways(word, known)) for word in words)


def _ways(word: Word, known: dict[str, tuple[Phones, ...]]) -> tuple[Phones, ...]:
    if word.syllables[0].is_foreign:
        return known[word.syllables[0].text]
    return tuple(dict.fromkeys(_joined(way) for way in word.ways))


def _joined(way: Iterable[Syllable]) -> Phones:
    return tuple(phone for syllable in way for phone in sounds(syllable))


def _with_glides(way: Phones) -> Phones:
    """Mark glides as the table of sounds does: ``u-`` before another vowel."""
    return tuple(
        f"{phone}-" if is_glide(phone, following) else phone
        for phone, following in zip(way, (*way[1:], ""), strict=True)
    )


def _english(words: Iterable[str]) -> dict[str, tuple[Phones, ...]]:
    """Return English pronunciations in capitals; none where a word stays unknown."""
    from lipwright.schedule.align.lexicon import look_up  # reads a dictionary: only when needed

    found = {word: look_up(word.lower()) for word in words}
    found |= {word: _guess(word) for word, ways in found.items() if not ways}
    spelled = {word: _letters(word) for word in found if word.isupper() or len(word) == 1}
    return {
        word: tuple(
            dict.fromkeys(tuple(p.upper() for p in w) for w in (*spelled.get(word, ()), *ways))
        )
        for word, ways in found.items()
    }


def _guess(word: str) -> tuple[Phones, ...]:
    from lipwright.schedule.pronounce import pronounce as guess

    try:
        said = guess([word]).get(word, ())
    except MissingExtraError:
        return ()
    return (said,) if said else ()


def _letters(word: str) -> tuple[Phones, ...]:
    from lipwright.schedule.align.lexicon import look_up

    letters = [look_up(letter) or look_up(f"{letter}.") for letter in word.lower()]
    if not all(letters):
        return ()
    return (tuple(phone for ways in letters for phone in ways[-1]),)
