"""What a syllable of Mandarin sounds like: the phones of the set ``pinyin``, and espeak's names.

A final is written out as its sounds: ``ian`` is i ê n, since its vowel is that of *xie*.
espeak-ng reads most syllables from their pinyin; those that it has no rule for, and all
that end in the r of 儿, are given to it in its own names of phonemes, in ``[[ ]]``.
"""

from __future__ import annotations

from lipwright.schedule.mandarin.pinyin import Syllable

FINALS: dict[str, tuple[str, ...]] = {
    "a": ("a",), "o": ("o",), "e": ("e",), "ê": ("ê",), "er": ("er",),
    "ai": ("ai",), "ei": ("ei",), "ao": ("ao",), "ou": ("ou",),
    "an": ("a", "n"), "en": ("e", "n"), "ang": ("a", "ng"), "eng": ("e", "ng"), "ong": ("u", "ng"),
    "i": ("i",), "ii": ("ii",), "iii": ("iii",), "ia": ("i", "a"), "io": ("i", "o"),
    "ie": ("i", "ê"), "iao": ("i", "ao"), "iu": ("i", "ou"), "ian": ("i", "ê", "n"),
    "in": ("i", "n"), "iang": ("i", "a", "ng"), "ing": ("i", "ng"), "iong": ("ü", "u", "ng"),
    "u": ("u",), "ua": ("u", "a"), "uo": ("u", "o"), "uai": ("u", "ai"), "ui": ("u", "ei"),
    "uan": ("u", "a", "n"), "un": ("u", "e", "n"), "uang": ("u", "a", "ng"),
    "ueng": ("u", "e", "ng"), "ü": ("ü",), "üe": ("ü", "ê"), "üan": ("ü", "ê", "n"),
    "ün": ("ü", "n"), "m": ("m",), "n": ("e", "n"), "ng": ("ng",),
}  # fmt: skip
"""The phones of each final."""

# Before the r of 儿 endings and the second parts of ai, ei are lost: the phones that stay,
# and espeak-ng's name of the vowel.
_BEFORE_R: dict[str, tuple[tuple[str, ...], str]] = {
    **dict.fromkeys(("a", "ai", "an", "ang"), (("a",), "A")),
    **dict.fromkeys(("ia", "ian", "iang"), (("i", "a"), "iA")),
    **dict.fromkeys(("ua", "uai", "uan", "uang"), (("u", "a"), "uA")),
    **dict.fromkeys(("ei", "en", "ii", "iii", "n"), ((), "")),
    **dict.fromkeys(("i", "in", "ing"), (("i",), "i")),
    **dict.fromkeys(("u", "ong", "ui", "un", "ueng"), (("u",), "u")),
    **dict.fromkeys(("ü", "ün", "iong"), (("ü",), "y")),
    "üan": (("ü", "a"), "y&"), "o": (("o",), "o"), "uo": (("u", "o"), "uo"),
    "io": (("i", "o"), "io"),
    "e": (("e",), "o-"), "eng": (("e",), "@"), "ê": (("ê",), "E"), "ie": (("i", "ê"), "iE"),
    "üe": (("ü", "ê"), "yE"), "ao": (("ao",), "Au"), "iao": (("i", "ao"), "iAu"),
    "ou": (("ou",), "ou"), "iu": (("i", "ou"), "iou"), "m": (("m",), "@"), "ng": (("ng",), "@"),
}  # fmt: skip
_ESPEAK_INITIALS = {
    "": "", "b": "p", "p": "ph", "m": "m", "f": "f", "d": "t", "t": "th", "n": "n", "l": "l",
    "g": "k", "k": "kh", "h": "X", "j": "tS;", "q": "tS;h", "x": "S;", "zh": "ts.", "ch": "ts.h",
    "sh": "s.", "r": "z.", "z": "ts", "c": "tsh", "s": "s",
}  # fmt: skip
_ESPEAK_TONES = {0: "55", 1: "55", 2: "35", 3: "214", 4: "51", 5: "11"}
# Of syllables that it takes for English words when it is given their pinyin.
_ESPEAK_FINALS = {"iong": "j'ong{}", "ê": "'E{}", "m": "'@{}m", "ng": "'@{}N", "üan": "'y&{}n"}
_ODD_FINALS = ("ê", "m", "ng")

_GLIDES = ("i", "u", "ü")
_AFTER_GLIDES = ("a", "o", "e", "ê", "ai", "ei", "ao", "ou")
_VOWEL, _REST = 2.0, 1.0


def sounds(syllable: Syllable) -> tuple[str, ...]:
    """Return the phones of a syllable, in the set ``pinyin``.

    Examples
    --------
    >>> sounds(Syllable("中", "zh", "ong", 1))
    ('zh', 'u', 'ng')
    """
    initial = (syllable.initial,) if syllable.initial else ()
    if syllable.erhua:
        return (*initial, *_BEFORE_R[syllable.final][0], "er")
    return (*initial, *FINALS[syllable.final])


def shares(phones: tuple[str, ...]) -> tuple[float, ...]:
    """Return how long each phone of a syllable lasts beside the others.

    A vowel lasts twice as long as a consonant, an ending, or the glide before a vowel.
    """
    result = []
    for phone, following in zip(phones, (*phones[1:], ""), strict=True):
        long = is_vowel(phone) and not is_glide(phone, following)
        result.append(_VOWEL if long else _REST)
    return tuple(result)


def is_glide(phone: str, following: str) -> bool:
    """Whether a vowel is the short beginning of the one that follows in its syllable."""
    return phone in _GLIDES and (following in _AFTER_GLIDES or (phone, following) == ("ü", "u"))


def is_vowel(phone: str) -> bool:
    """Whether a phone of the set ``pinyin`` is a vowel."""
    return phone[0] in "aoeêiuü"


def for_espeak(syllable: Syllable) -> str:
    """Return how espeak-ng is told a syllable: its pinyin, or names of phonemes.

    Examples
    --------
    >>> for_espeak(Syllable("女", "n", "ü", 3)), for_espeak(Syllable("兄", "x", "iong", 1))
    ('nv3', "[[S;j'ong55]]")
    """
    tone = _ESPEAK_TONES[syllable.tone]
    initial = _ESPEAK_INITIALS[syllable.initial]
    if syllable.erhua:
        vowel = _BEFORE_R[syllable.final][1]
        return f"[[{initial}'{vowel}{tone}@r11]]" if vowel else f"[[{initial}'@r{tone}]]"
    if _takes_for_english(syllable):
        return f"[[{initial}{_ESPEAK_FINALS[syllable.final].format(tone)}]]"
    spelled = Syllable("", syllable.initial, "en" if syllable.final == "n" else syllable.final)
    return spelled.pinyin.replace("ü", "v") + str(syllable.tone or 1)


def _takes_for_english(syllable: Syllable) -> bool:
    if syllable.final == "iong":
        return bool(syllable.initial)
    return syllable.final in _ODD_FINALS or (syllable.initial, syllable.final) == ("l", "üan")
