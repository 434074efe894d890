"""Voices: their names, and the scripts that their languages are written in.

A name may be a language (``en-gb``), a voice's own name, or a file of espeak-ng
(``gmw/en``), each with a variant behind ``+`` (``en-us+f3``).
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from lipwright.errors import TextError
from lipwright.schedule.say.words import script_of

# Languages that the library lists but refuses by this name, and names people type.
_FILES = {
    "en-gb": "gmw/en",
    "en-uk": "gmw/en",
    "fr": "roa/fr",
    "fr-fr": "roa/fr",
    "pt-pt": "roa/pt",
    "zh": "sit/cmn",
    "zh-cn": "sit/cmn",
    "zh-tw": "sit/cmn",
    "zh-hans": "sit/cmn",
    "zh-hant": "sit/cmn",
    "zh-hk": "sit/yue",
    "cmn": "sit/cmn",
    "no": "gmq/nb",
    "nn": "gmq/nb",
    "jp": "jpx/ja",
    "chr": "iro/chr",
}

# Which languages are written in which script, by the first word of its letters' names.
_WRITTEN_IN = {
    "CYRILLIC": "ru uk be bg mk sr kk ky tt ba cv nog",
    "GREEK": "el grc",
    "ARABIC": "ar fa ur sd ug",
    "HEBREW": "he",
    "DEVANAGARI": "hi mr ne kok",
    "BENGALI": "bn as bpy",
    "GURMUKHI": "pa",
    "GUJARATI": "gu",
    "ORIYA": "or",
    "TAMIL": "ta",
    "TELUGU": "te",
    "KANNADA": "kn",
    "MALAYALAM": "ml",
    "SINHALA": "si",
    "THAI": "th",
    "MYANMAR": "my shn",
    "GEORGIAN": "ka",
    "ARMENIAN": "hy hyw",
    "ETHIOPIC": "am ti",
    "CHEROKEE": "chr",
    "HANGUL": "ko",
    "HIRAGANA": "ja",
    "KATAKANA": "ja",
    "CJK": "cmn yue",
    "SHAVIAN": "en-shaw",
    "PRIVATE": "piqd",
    "": "af an az bs ca cs cy da de en eo es et eu fi fr ga gd gn hak haw hr ht hu ia id io is it"
    " jbo kl ku la lb lfn lt ltg lv mi ms mt mto nb nci nl no om pap pl pt py qdb qu quc qya ro"
    " sjn sk sl smj sq sv sw tk tn tr uz vi",
}

_LETTERS = re.compile(r"[^\W\d_]+")
_GREEK_LIKE_LATIN = "ΑΒΕΖΗΙΚΜΝΟΡΤΥΧανορυ"
# Voices of espeak-ng that speak, but not what is written.
_LIMITS = {
    "he": "the Hebrew voice leaves out most vowels: the mouth opens less than it should",
    "th": "the Thai voice reads some vowels as consonants: look at the result",
}


@dataclass(frozen=True, slots=True)
class Voice:
    """A voice that is installed.

    Parameters
    ----------
    name : str
        As its maker calls it.
    language : str
        What to give to :func:`lipwright.schedule.say.say` as ``voice``.
    engine : str
        ``"espeak"`` or ``"festival"``.
    languages : tuple of str
        Every language that it answers to.
    file : str
        Where espeak-ng keeps it, which is a name for it as well.
    """

    name: str
    language: str
    engine: str = "espeak"
    languages: tuple[str, ...] = ()
    file: str = ""


def as_voices(listed: Sequence[dict[str, Any]]) -> list[Voice]:
    """Return espeak-ng's own list as voices."""
    return [
        Voice(
            name=each["name"].strip(),
            language=each["languages"][0],
            languages=tuple(each["languages"]),
            file=each["file"],
        )
        for each in listed
    ]


def library_name(voice: str) -> str:
    """Return what to ask the library for first.

    Examples
    --------
    >>> library_name("en_US"), library_name("en-gb+f3")
    ('en-us', 'gmw/en+f3')
    """
    base, plus, variant = voice.strip().partition("+")
    spelled = base.lower().replace("_", "-")
    if "/" in base or " " in base:
        spelled = base
    return _FILES.get(spelled, spelled) + plus + variant


def is_mandarin(voice: str) -> bool:
    """Whether a voice's name means espeak-ng's for Mandarin.

    Examples
    --------
    >>> is_mandarin("cmn"), is_mandarin("zh-CN+f3"), is_mandarin("zh-hk"), is_mandarin("yue")
    (True, True, False, False)
    """
    name = library_name(voice).partition("+")[0].lower()
    language = name.split("-")[0]
    spoken = name.startswith(("sit/cmn", "chinese (mandarin")) or language in ("cmn", "zh")
    return spoken and "yue" not in name


def resolve(voice: str, installed: Sequence[Voice]) -> tuple[str, bool]:
    """Return the file of the voice that a name means, and whether it is exactly that one.

    A region that has no voice (``de-at``) is spoken by its language's (``de``). Without
    any, the name comes back as it was.
    """
    base, plus, variant = voice.strip().partition("+")
    wanted = base.lower().replace("_", "-")
    for candidate in installed:
        known = (*candidate.languages, candidate.name, candidate.file)
        if wanted in (other.lower() for other in known):
            return candidate.file + plus + variant, True
    language = wanted.split("-")[0]
    if any(language in candidate.languages for candidate in installed):
        return library_name(language) + plus + variant, False
    return voice, False


def unknown_voice(voice: str, installed: Sequence[Voice], variants: Sequence[str]) -> TextError:
    """Return the error for a voice that is not there, with those most like it."""
    import difflib  # only for this message

    base, plus, variant = voice.partition("+")
    if plus and resolve(base, installed)[0] != base:
        near = difflib.get_close_matches(variant, variants, 5, 0.3) or list(variants[-5:])
        return TextError(
            f"the voice {base!r} has no variant {variant!r}", expected=f"such as {', '.join(near)}"
        )
    names = {name.lower(): v.language for v in installed for name in (v.name, *v.languages)}
    near = difflib.get_close_matches(base.lower(), names, 5, 0.5)
    near += [name for name in names if base and name.startswith(base.lower()[:2])]
    shown = list(dict.fromkeys(names[name] for name in near))[:6]
    return TextError(
        f"no voice {voice!r}",
        expected=f"a voice such as {', '.join(shown or ['en-us', 'de', 'fr', 'es', 'cmn'])}",
    )


def check_script(text: str, language: str) -> None:
    """Refuse letters that a voice of this language would spell out or leave out.

    A single letter of another script passes: it is spoken by its name, as in "π".

    Raises
    ------
    TextError
        Naming the letters, and a voice that reads them.
    """
    known = {script for script, names in _WRITTEN_IN.items() if _is_one_of(language, names)}
    if not known:
        return  # a voice that this table does not know yet
    run = ""
    for word in mixed_words(text):
        if not {script_of(letter) for letter in word} - {""} <= known | {"LATIN"}:
            raise TextError(
                _mixed(word),
                where="the text",
                expected="words in one script each",
                cure="type this word again",
            )
    for character in text + " ":
        script = script_of(character)
        if script and script != "LATIN" and script not in known:
            run += character
            continue
        if len(run) > 1 or (run and script_of(run) != "GREEK"):
            raise _foreign(run, language)
        run = ""


def mixed_words(text: str) -> list[str]:
    """Return the words in which letters of two scripts stand that look alike.

    Examples
    --------
    >>> mixed_words("Hello H\u0435llo 5 \u03bcm")  # a Cyrillic е, and a Greek μ as a unit
    ['Hеllo']
    """
    return [word for word in _LETTERS.findall(text) if _looks_mixed(word)]


def script_notes(text: str, language: str) -> tuple[str, ...]:
    """Return what may be wrong with a text that the voice does read."""
    mixed = tuple(f"{_mixed(word)}: check its spelling" for word in mixed_words(text))
    limit = _LIMITS.get(language.split("-")[0])
    return mixed if limit is None else (*mixed, limit)


def _looks_mixed(word: str) -> bool:
    scripts = {
        script_of(letter)
        for letter in word
        if script_of(letter) != "GREEK" or letter in _GREEK_LIKE_LATIN
    }
    return len(scripts & {"LATIN", "CYRILLIC", "GREEK"}) > 1


def _mixed(word: str) -> str:
    scripts = [script_of(letter) for letter in word]
    rare = min(set(scripts) - {""}, key=scripts.count)
    letter = next(each for each in word if script_of(each) == rare)
    shown = word if len(word) <= 24 else word[:24] + "…"
    return f"{shown!r} is written in two scripts: its {letter!r} is {rare.capitalize()}"


def _is_one_of(language: str, names: str) -> bool:
    spelled = language.lower()
    return spelled in names.split() or spelled.split("-")[0] in names.split()


def _foreign(letters: str, language: str) -> TextError:
    script = script_of(letters[0])
    readers = _WRITTEN_IN.get(script, "").split()
    shown = letters if len(letters) <= 12 else letters[:12] + "…"
    name = {"CJK": "Chinese characters", "PRIVATE": "private characters"}.get(
        script, f"{script.capitalize()} letters"
    )
    if language.split("-")[0] == "ja" and script == "CJK":
        return TextError(
            f"{shown!r}: the Japanese voice does not know how kanji are read",
            where="the text",
            expected="hiragana or katakana",
            cure="write these words in kana",
        )
    if language.split("-")[0] == "ko" and script == "CJK":
        return TextError(
            f"{shown!r}: the Korean voice does not read hanja",
            where="the text",
            expected="hangul",
            cure="write these words in hangul",
        )
    return TextError(
        f"{shown!r}: the voice {language!r} does not read {name}",
        where="the text",
        cure=f"choose one that does: --voice {readers[0]}" if readers else "leave them out",
    )
