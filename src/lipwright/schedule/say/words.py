"""The user's words: what of them is spoken, and when each of them sounds.

A text is cut at white space and after dashes. What no voice can speak (emoji, control
characters, invisible marks) is dropped; everything else stays as it was written, so
that a word comes out as the user knows it. Numbers and signs are the synthesiser's to
read: ``$5`` remains one word.
"""

from __future__ import annotations

import re
import unicodedata
from bisect import bisect_right
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from lipwright.errors import TextError
from lipwright.timeline import Interval, Tier

_TOKENS = re.compile(r"[^\s—–…]+[—–…]*|[—–…]+")
_AROUND = ".,;:!?…\"'“”„‚‘’«»‹›()[]{}<>¡¿—–-*_~`|。，、！？：；「」『』（）《》・।॥؟،؛"
# Forms of letters that exist for the look of them; a voice knows the plain ones.
_LOOKS = ("<font>", "<wide>", "<narrow>", "<isolated>", "<initial>", "<medial>", "<final>")
_IN_CIRCLES = range(0x2460, 0x2500)
_SMALL_CAPITAL = "LATIN LETTER SMALL CAPITAL "
_LIGATURES = range(0xFB00, 0xFB07)
_JOINERS = "\u200c\u200d"
_FIRST_PICTURE = 0x2190  # arrows, boxes, dingbats and emoji; ° and № come before
_SPOKEN_SIGNS = "%&@#*\\/"
_WITHOUT_SPACES = ("CJK", "HIRAGANA", "KATAKANA", "THAI", "LAO", "KHMER", "MYANMAR")


@dataclass(frozen=True, slots=True)
class Utterance:
    """A text made ready to speak.

    Parameters
    ----------
    spoken : str
        What the synthesiser gets.
    words : tuple of str
        The user's words, without the punctuation around them.
    starts : tuple of int
        Where in ``spoken`` each word begins.
    """

    spoken: str
    words: tuple[str, ...]
    starts: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class TimedPhone:
    """A phone with the place in the spoken text that it comes from.

    Parameters
    ----------
    label : str
        In the track's phone set.
    start, end : float
        Seconds.
    position : int
        Index of the character where its word begins.
    """

    label: str
    start: float
    end: float
    position: int


def prepare(text: str) -> Utterance:
    """Return what is spoken of a text.

    Raises
    ------
    TextError
        If nothing in it can be spoken.

    Examples
    --------
    >>> prepare("Hello,  'world' 🙂!").words
    ('Hello', 'world', '!')
    """
    parts: list[str] = []
    words: list[str] = []
    starts: list[int] = []
    length, end = 0, 0
    for token in _TOKENS.finditer(text):
        plain = _speakable(token.group())
        if not plain:
            continue
        gap = text[end : token.start()]
        # A blank line ends a sentence.
        between = ("\n\n" if gap.count("\n") > 1 else " " if gap else "") if parts else ""
        starts.append(length + len(between))
        words.append(plain.strip(_AROUND) or plain)
        parts.append(between + _with_plain_digits(plain))
        length += len(parts[-1])
        end = token.end()
    spoken = "".join(parts)
    if not any(_is_spoken(character) for character in spoken):
        raise nothing_to_say()
    return Utterance(spoken, tuple(words), tuple(starts))


def nothing_to_say() -> TextError:
    """Return the error for a text without a word."""
    return TextError("nothing to say", where="the text", expected="at least one word")


def script_of(character: str) -> str:
    """Return the name of a letter's script as Unicode spells it, or nothing.

    Examples
    --------
    >>> script_of("é"), script_of("Ж"), script_of("7")
    ('LATIN', 'CYRILLIC', '')
    """
    category = unicodedata.category(character)
    if category == "Co":
        return "PRIVATE"
    if category[0] not in "LM":
        return ""
    name = unicodedata.name(character, "").split(" ")[0].split("-")[0]
    return "" if name in ("COMBINING", "MODIFIER", "FEMININE", "MASCULINE", "MICRO") else name


def _speakable(token: str) -> str:
    kept = []
    plain = unicodedata.normalize("NFC", token)
    for before, character, after in zip(" " + plain, plain, plain[1:] + " ", strict=False):
        category = unicodedata.category(character)
        if character in _JOINERS:
            joins = script_of(before) and script_of(after)
            kept.append(character if joins else "")
        elif ord(character) in _IN_CIRCLES or not _is_dropped(character, category):
            kept.append(_without_looks(character))
    return "".join(kept)


def _with_plain_digits(text: str) -> str:
    """Digits of any script as 0 to 9, which every voice reads in its own language."""
    return "".join(
        str(unicodedata.digit(each)) if unicodedata.category(each) == "Nd" else each
        for each in text
    )


def _is_dropped(character: str, category: str) -> bool:
    picture = category in ("So", "Sk") and ord(character) >= _FIRST_PICTURE
    selects_a_look = 0xFE00 <= ord(character) <= 0xFE0F
    return picture or selects_a_look or category in ("Cc", "Cf", "Cs", "Cn", "Me")


def _without_looks(character: str) -> str:
    looks = unicodedata.decomposition(character).startswith(_LOOKS)
    if looks or ord(character) in _LIGATURES or ord(character) in _IN_CIRCLES:
        return unicodedata.normalize("NFKC", character)
    capital = unicodedata.name(character, "").removeprefix(_SMALL_CAPITAL)
    return capital.lower() if len(capital) == 1 else character


def _is_spoken(character: str) -> bool:
    category = unicodedata.category(character)
    return category[0] in "LNS" or category == "Co" or character in _SPOKEN_SIGNS


def time_words(utterance: Utterance, phones: Sequence[TimedPhone]) -> Tier:
    """Return when each word sounds, from its first phone to its last.

    Words that were spoken as one (``of the``) share the phones by their letters; a sign
    that is not spoken is no word.

    Parameters
    ----------
    utterance : Utterance
        What was spoken.
    phones : sequence of TimedPhone
        Without silences, in order.
    """
    words, starts = _with_inner_words(utterance, {phone.position for phone in phones})
    groups: dict[int, list[TimedPhone]] = {}
    latest = 0
    for phone in phones:
        # A position never goes back; where the synthesiser says so it means this word.
        latest = max(latest, bisect_right(starts, phone.position) - 1)
        groups.setdefault(latest, []).append(phone)
    heads = sorted(groups)
    intervals: list[Interval] = []
    for head, following in zip(heads, [*heads[1:], len(words)], strict=True):
        silent = [word for word in words[head + 1 : following] if any(map(str.isalnum, word))]
        intervals += _share([words[head], *silent], groups[head])
    return Tier(tuple(intervals))


def _with_inner_words(
    utterance: Utterance, positions: Iterable[int]
) -> tuple[list[str], list[int]]:
    """Cut the words of scripts without spaces where the synthesiser began a new one."""
    spoken = utterance.spoken
    inner = {
        position
        for position in positions
        if 0 <= position < len(spoken) and script_of(spoken[position]) in _WITHOUT_SPACES
    }
    starts = sorted(inner.union(utterance.starts))
    known = dict(zip(utterance.starts, utterance.words, strict=True))
    words: list[str] = []
    for start, end in zip(starts, [*starts[1:], len(spoken)], strict=True):
        part = spoken[start:end].strip().strip(_AROUND)
        words.append(known.get(start, part) if not inner else part or known.get(start, ""))
    return words, starts


def _share(words: list[str], phones: list[TimedPhone]) -> list[Interval]:
    """Give each word its phones by its number of letters, at least one each."""
    letters = [len(word) for word in words]
    total = sum(letters)
    if len(phones) < len(words):
        start, length = phones[0].start, phones[-1].end - phones[0].start
        edges = [start + length * sum(letters[:n]) / total for n in range(len(words) + 1)]
        return [Interval(word, a, b) for word, (a, b) in zip(words, pairwise(edges), strict=True)]
    cuts = [0]
    for n in range(1, len(words)):
        wanted = round(len(phones) * sum(letters[:n]) / total)
        cuts.append(min(max(wanted, cuts[-1] + 1), len(phones) - (len(words) - n)))
    cuts.append(len(phones))
    return [
        Interval(word, phones[a].start, phones[b - 1].end)
        for word, (a, b) in zip(words, pairwise(cuts), strict=True)
    ]
