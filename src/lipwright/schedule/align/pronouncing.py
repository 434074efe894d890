"""Words as any language sounds them, for an acoustic model that knows another one's phones.

A pronouncer writes each word in its own labels (IPA, pinyin) and says what each label
sounds like in the phones of the acoustic model, which are those of American English:
one or several a label. The aligner searches with the model's phones; here what it heard
becomes the word's own labels again.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from lipwright.errors import LabelError
from lipwright.schedule.align.heard import NO_TOKEN, Heard
from lipwright.schedule.align.lexicon import Pronunciation, Spoken
from lipwright.schedule.align.model import AcousticModel

Way = tuple[tuple[str, tuple[str, ...]], ...]


@dataclass(frozen=True, slots=True)
class Pronounced:
    """A word and the ways it may sound.

    Parameters
    ----------
    word : str
        As the user wrote it.
    ways : tuple of tuple of (str, tuple of str)
        One or more pronunciations: each of its labels, with the acoustic model's phones
        (ARPAbet, lower case, at least one) that sound like it.

    Examples
    --------
    >>> Pronounced("Zug", ((("ts", ("t", "s")), ("uː", ("uw",)), ("k", ("k",))),)).heard_as()
    {('t', 's', 'uw', 'k'): (('ts', ('t', 's')), ('uː', ('uw',)), ('k', ('k',)))}
    """

    word: str
    ways: tuple[Way, ...]

    def heard_as(self) -> dict[Pronunciation, Way]:
        """Return the way that each sequence of acoustic phones means: the first that has it."""
        found: dict[Pronunciation, Way] = {}
        for way in self.ways:
            found.setdefault(tuple(phone for _, phones in way for phone in phones), way)
        return found


def as_spoken(words: Sequence[Pronounced], model: AcousticModel) -> tuple[Spoken, ...]:
    """Return the words as the network of phones takes them.

    Raises
    ------
    LabelError
        If a word has no phones, or phones that the model does not know.
    """
    result = []
    for word in words:
        ways = tuple(word.heard_as())
        unknown = {phone for way in ways for phone in way} - set(model.phones)
        if unknown or not ways or not all(phones for way in word.ways for _, phones in way):
            found = f"unknown phones {' '.join(sorted(unknown))}" if unknown else "no phones"
            raise LabelError(
                found,
                where=f"pronunciation of {word.word!r}",
                expected="one or more phones of the acoustic model for each label",
            )
        result.append(Spoken(word.word, ((ways,),)))
    return tuple(result)


def in_own_labels(heard: Sequence[Heard], words: Sequence[Pronounced]) -> tuple[Heard, ...]:
    """Return what was heard in the labels of the words' own phone set.

    Parameters
    ----------
    heard : sequence of Heard
        In the phones of the acoustic model; the index of each one's token is its word's.
    words : sequence of Pronounced
    """
    result: list[Heard] = []
    for token, group in groupby(heard, key=lambda phone: phone.token):
        phones = list(group)
        if token == NO_TOKEN:
            result += phones
            continue
        way = words[token].heard_as()[tuple(phone.label for phone in phones)]
        result += _merged(phones, way)
    return tuple(result)


def _merged(phones: Sequence[Heard], way: Way) -> Iterator[Heard]:
    first = 0
    for label, sounds in way:
        parts = phones[first : first + len(sounds)]
        first += len(sounds)
        seconds = [part.end - part.start for part in parts]
        weighed = sum(part.margin * each for part, each in zip(parts, seconds, strict=True))
        margin = weighed / sum(seconds) if sum(seconds) else parts[0].margin
        yield Heard(label, parts[0].start, parts[-1].end, parts[0].token, margin)
