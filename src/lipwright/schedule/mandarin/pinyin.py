"""Pinyin: how a syllable is spelled, and the initial, final and tone that it stands for.

Spellings are those of ISO 7098 with tone marks (``nǚ``), digits behind the syllable
(``nü3``, ``nv3``, ``nu:3``) or no tone at all (``nü``). What is no syllable of Mandarin
is refused: the table of legal ones is below. Which pinyin a character has is
:mod:`.reading`'s to know.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, replace
from functools import cache, lru_cache

# Finals that may follow each initial; the empty one stands for syllables without any.
_LEGAL = {
    "": "a o e ê ai ei ao ou an en ang eng er i ia io ie iao iu ian in iang ing iong u ua uo uai"
    " ui uan un uang ueng ü üe üan ün m n ng",
    "b": "a o ai ei ao an en ang eng ong i ie iao ian iang in ing u",
    "p": "a o ai ei ao ou an en ang eng i ie iao ian in ing u",
    "m": "a o e ai ei ao ou an en ang eng i ie iao iu ian in ing u",
    "f": "a o ei ou an en ang eng iao u",
    "d": "a e ai ei ao ou an en ang eng ong i ia ie iao iu ian in ing u uo ui uan un",
    "t": "a e ai ei ao ou an ang eng ong i ie iao ian ing u uo ui uan un",
    "n": "a e ai ei ao ou an en ang eng ong i ia ie iao iu ian in iang ing u uo uan un ü üe",
    "l": "a o e ai ei ao ou an en ang eng ong i ia ie iao iu ian in iang ing u uo uan un ü üe üan",
    "g": "a e ai ei ao ou an en ang eng ong u ua uo uai ui uan un uang",
    "k": "a e ai ei ao ou an en ang eng ong u ua uo uai ui uan un uang",
    "h": "a e ai ei ao ou an en ang eng ong u ua uo uai ui uan un uang m ng",
    "j": "i ia ie iao iu ian in iang ing iong ü üe üan ün",
    "q": "i ia ie iao iu ian in iang ing iong ü üe üan ün",
    "x": "i ia ie iao iu ian in iang ing iong ü üe üan ün",
    "zh": "a e ai ei ao ou an en ang eng ong iii u ua uo uai ui uan un uang",
    "ch": "a e ai ao ou an en ang eng ong iii u ua uo uai ui uan un uang",
    "sh": "a e ai ei ao ou an en ang eng iii u ua uo uai ui uan un uang",
    "r": "e ao ou an en ang eng ong iii u ua uo ui uan un",
    "z": "a e ai ei ao ou an en ang eng ong ii u uo ui uan un",
    "c": "a e ai ei ao ou an en ang eng ong ii u uo ui uan un",
    "s": "a e ai ei ao ou an en ang eng ong ii u uo ui uan un",
}
_ALONE = {
    "i": "yi", "in": "yin", "ing": "ying", "iu": "you", "u": "wu", "ui": "wei", "un": "wen",
    "ueng": "weng", "ü": "yu", "üe": "yue", "üan": "yuan", "ün": "yun", "iong": "yong",
}  # fmt: skip
_OTHERS = {"wong": ("", "ueng"), "nue": ("n", "üe"), "lue": ("l", "üe"), "eh": ("", "ê")}
_TONE_MARKS = {"\u0304": 1, "\u0301": 2, "\u030c": 3, "\u0300": 4}
_DIAERESIS, _CIRCUMFLEX = "\u0308", "\u0302"
_LONGEST, _LONGEST_WORD = 6, 120  # letters
_APOSTROPHES = "'’"
_VOWELS = "aeoê"
_HUMMED = ("m", "n", "ng")


@dataclass(frozen=True, slots=True)
class Syllable:
    """A syllable of Mandarin, or a Latin word between such syllables.

    Parameters
    ----------
    text : str
        The character, or the letters, that it was read from.
    initial : str
        ``"zh"``; nothing where the syllable begins with its final.
    final : str
        In full, whatever the spelling leaves out: ``ju`` has ``"ü"``, ``zi`` ``"ii"``,
        ``zhi`` ``"iii"``. Nothing for a Latin word.
    tone : int
        1 to 4, 5 for the neutral tone, 0 where none is given.
    erhua : bool
        Whether it ends in the r of 儿 (``huar``).
    """

    text: str
    initial: str = ""
    final: str = ""
    tone: int = 0
    erhua: bool = False

    @property
    def is_foreign(self) -> bool:
        """Whether it is a Latin word."""
        return not self.final

    @property
    def pinyin(self) -> str:
        """Its spelling with the tone as a digit, ü as ``ü``: ``"lü4"``."""
        tone = str(self.tone) if self.tone else ""
        return _spelling(self.initial, self.final) + ("r" if self.erhua else "") + tone


def legal_syllables() -> tuple[str, ...]:
    """Return the spelling of every syllable of Mandarin, without tones."""
    spelled = (
        _spelling(initial, final) for initial, all_ in _LEGAL.items() for final in all_.split()
    )
    return tuple(sorted(spelled))


def read_syllable(spelled: str, text: str = "") -> Syllable | None:
    """Return the syllable of one spelling, or None if there is none such.

    Examples
    --------
    >>> read_syllable("nǚ")
    Syllable(text='nǚ', initial='n', final='ü', tone=3, erhua=False)
    >>> read_syllable("zhv9") is None
    True
    """
    found = read_pinyin(spelled)
    if not found or len(found) != 1:
        return None
    return replace(found[0], text=text or spelled)


@lru_cache(maxsize=4096)
def read_pinyin(word: str) -> tuple[Syllable, ...]:
    """Return the syllables of a word in pinyin, or none if it is no pinyin.

    A syllable that begins with a vowel inside a word wants an apostrophe (``xi'an``) or
    a tone before it; where that leaves no reading, it may stand without.

    Examples
    --------
    >>> [syllable.pinyin for syllable in read_pinyin("nǐhǎo")]
    ['ni3', 'hao3']
    >>> [syllable.pinyin for syllable in read_pinyin("xi'an")]
    ['xi', 'an']
    """
    letters = _letters(word.lower()) if len(word) <= _LONGEST_WORD else None
    if letters is None:
        return ()
    return _split(letters, strict=True) or _split(letters, strict=False) or ()


def has_tone(word: str) -> bool:
    """Whether a word carries a tone: a mark of pinyin, or a digit at its end."""
    marks = any(c in _TONE_MARKS for c in unicodedata.normalize("NFD", word))
    return marks or re.search(r"[^\W\d_][1-5](?!\d)", word) is not None


Letters = tuple[tuple[str, int], ...]


def _letters(word: str) -> Letters | None:
    """Return each letter with its tone; digits and apostrophes are letters of their own."""
    result: list[tuple[str, int]] = []
    for character in unicodedata.normalize("NFD", word.replace("u:", "ü")):
        if character in _TONE_MARKS and result:
            result[-1] = (result[-1][0], _TONE_MARKS[character])
        elif character in (_DIAERESIS, _CIRCUMFLEX) and result:
            marked = unicodedata.normalize("NFC", result[-1][0] + character)
            result[-1] = (marked, result[-1][1])
        elif character == "v":
            result.append(("ü", 0))
        elif character in "abcdefghijklmnopqrstuwxyz012345" + _APOSTROPHES:
            result.append((character, 0))
        else:
            return None
    return tuple(result)


@lru_cache(maxsize=4096)  # the same ends come again and again
def _split(letters: Letters, *, strict: bool, inside: bool = False) -> tuple[Syllable, ...] | None:
    """Return the syllables of letters, the longest first; None if they are none."""
    if not letters:
        return ()
    for length in range(min(_LONGEST, len(letters)), 0, -1):
        head, rest = letters[:length], letters[length:]
        tones = [tone for _, tone in head if tone]
        found = _table().get("".join(letter for letter, _ in head))
        if found is None or len(tones) > 1 or (inside and found[1] in _HUMMED):
            continue
        tone = tones[0] if tones else 0
        erhua, rest = _erhua(found, rest)
        if rest and rest[0][0] in "012345":
            if tone:
                continue
            tone, rest = int(rest[0][0]) or 5, rest[1:]
        elif strict and rest and rest[0][0] in _VOWELS:
            continue
        if rest and rest[0][0] in _APOSTROPHES:
            rest = rest[1:]
        others = _split(rest, strict=strict, inside=True)
        if others is not None:
            text = "".join(letter for letter, _ in head)
            return (Syllable(text, *found, tone, erhua), *others)
    return None


def _erhua(found: tuple[str, str], rest: Letters) -> tuple[bool, Letters]:
    """Take the r of ``huar`` off what follows, where it begins no syllable of its own."""
    alone = rest[:1] == (("r", 0),) and (len(rest) == 1 or rest[1][0] in "012345" + _APOSTROPHES)
    return (True, rest[1:]) if alone and found[1] != "er" else (False, rest)


@cache
def _table() -> dict[str, tuple[str, str]]:
    """Every legal spelling, without tone, and its initial and final."""
    table = dict(_OTHERS)
    for initial, finals in _LEGAL.items():
        for final in finals.split():
            spelling = _spelling(initial, final)
            table[spelling] = (initial, final)
            if initial in ("j", "q", "x") and final.startswith("ü"):
                table[initial + final] = (initial, final)  # jü, as some type it
    return table


def _spelling(initial: str, final: str) -> str:
    if not initial:
        glide = {"i": "y", "u": "w"}.get(final[0], "") if len(final) > 1 else ""
        return _ALONE.get(final, glide + final[1:] if glide else final)
    if initial in ("j", "q", "x"):
        return initial + final.replace("ü", "u")
    return initial + ("i" if final in ("ii", "iii") else final)
