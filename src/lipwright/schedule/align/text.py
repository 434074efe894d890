"""Text as people write it becomes words as people say them.

A token is what stands between two spaces; its label stays as the user wrote it. It has
one or more spoken forms ("2026": *twenty twenty-six*, *two thousand twenty-six*), among
which the sound decides. Numbers, dates, times and money are in :mod:`.numbers`. English
only; how words sound is :mod:`.lexicon`'s.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass

from lipwright.errors import TextError
from lipwright.schedule.align.numbers import Form, Forms, spoken_number

_ABBREVIATIONS: dict[str, str] = {
    "dr": "doctor|drive", "mr": "mister", "mrs": "missus", "ms": "miz|miss",
    "prof": "professor", "st": "saint|street", "ste": "saint|suite", "sr": "senior",
    "jr": "junior", "vs": "versus", "etc": "etcetera|et cetera", "no": "number|no",
    "mt": "mount", "ft": "fort|feet", "ave": "avenue", "blvd": "boulevard", "rd": "road",
    "hwy": "highway", "apt": "apartment", "capt": "captain", "gen": "general",
    "lt": "lieutenant", "sgt": "sergeant", "col": "colonel", "gov": "governor",
    "sen": "senator", "rep": "representative", "rev": "reverend", "hon": "honorable",
    "inc": "incorporated|ink", "ltd": "limited", "co": "company", "corp": "corporation",
    "dept": "department", "approx": "approximately", "fig": "figure", "vol": "volume",
    "pp": "pages", "ch": "chapter", "jan": "january", "feb": "february", "mar": "march",
    "apr": "april", "jun": "june", "jul": "july", "aug": "august", "sep": "september",
    "sept": "september", "oct": "october", "nov": "november", "dec": "december",
    "mon": "monday", "tue": "tuesday", "tues": "tuesday", "wed": "wednesday",
    "thu": "thursday", "thur": "thursday", "thurs": "thursday", "fri": "friday",
    "sat": "saturday", "sun": "sunday", "lb": "pound|pounds", "lbs": "pounds",
    "oz": "ounces|ounce", "in": "in|inches", "min": "minutes|minimum", "max": "maximum",
    "sec": "seconds|second", "hr": "hour", "hrs": "hours", "e.g": "e g|for example",
    "i.e": "i e|that is", "a.m": "a m", "p.m": "p m", "ph.d": "p h d", "tel": "telephone",
}  # fmt: skip
_WITHOUT_DOT = {
    "dr", "mr", "mrs", "ms", "prof", "st", "jr", "sr", "vs", "etc", "blvd", "ave", "feb",
    "nov", "dec", "jan", "aug", "sept", "oct", "apr", "lbs", "oz", "hrs", "ltd", "dept",
}  # fmt: skip
_SYMBOLS = {"&": "and", "+": "plus", "=": "equals", "@": "at", "%": "percent", "°": "degrees"}
_SAME = str.maketrans(
    {"’": "'", "‘": "'", "ʼ": "'", "`": "'", "´": "'", "＇": "'", "“": '"', "”": '"',
     "–": "-", "‐": "-", "‑": "-", "−": "-", "—": " ", "―": " ", "…": " ", "\u00ad": None}
)  # fmt: skip
_EDGES = re.compile(r"^[^\w'’$£€¥#°&+=@%.-]+|[^\w'’%°$£€&+=@]+$")
_QUOTED = re.compile(r"‘(.+)’|'(..+)'")
_SPELLED = re.compile(r"(?:[A-Za-z]\.){2,}[A-Za-z]?'?s?")
_ACRONYM = re.compile(r"[A-Z]{2,5}(?:'?s)?|PhD|[a-z][A-Z]{1,3}|[A-Z][a-z][A-Z]")


@dataclass(frozen=True, slots=True)
class Token:
    """What stands between two spaces, and how it may be said.

    Parameters
    ----------
    label : str
        As the user wrote it, without punctuation around it.
    forms : tuple of tuple of str
        Spoken words, lower case, for each way to say it.
    """

    label: str
    forms: Forms


def tokens(text: str) -> tuple[Token, ...]:
    """Return what is to be said.

    Parameters
    ----------
    text : str
        As people write it.

    Raises
    ------
    TextError
        If nothing in it can be spoken, or words are in a script that is not Latin.

    Examples
    --------
    >>> [token.label for token in tokens("Dr. Who owes $5, doesn’t he?")]
    ['Dr.', 'Who', 'owes', '$5', 'doesn’t', 'he']
    >>> tokens("$5")[0].forms
    (('five', 'dollars'),)
    """
    written = _clean(text).split()
    shouting = text.upper() == text and len(written) > 1
    foreign = [word for word in written if _is_foreign(word)]
    if foreign:
        raise TextError(
            f"{', '.join(dict.fromkeys(foreign[:8]))}: not in the Latin script",
            expected="English text",
            cure="align it from labels, or write it in Latin letters",
        )
    plain = [_core(word.translate(_SAME)) for word in written]
    result: list[Token] = []
    for index, (word, core) in enumerate(zip(written, plain, strict=True)):
        before = plain[index - 1].lower() if index else ""
        after = plain[index + 1].lower() if index + 1 < len(plain) else ""
        forms = _forms(core, before, after, shouting=shouting)
        if forms:
            result.append(Token(_label(word), forms))
    if not result:
        raise TextError(
            "the text is empty" if not text.strip() else f"no words in {_shown(text)!r}",
            expected="what is said in the sound",
        )
    return tuple(result)


def _clean(text: str) -> str:
    composed = unicodedata.normalize("NFC", text).translate({0x2014: " ", 0x2026: " "})
    composed = re.sub(r"\.{2,}|--+", " ", composed)
    return "".join(
        " " if c.isspace() or unicodedata.category(c) == "Cc" else c
        for c in composed
        if c.isspace() or unicodedata.category(c) not in {"Cf", "Co", "Cs", "Cn"}
    )


def _shown(text: str) -> str:
    return text.strip()[:40]


def _is_foreign(word: str) -> bool:
    return any(
        c.isalpha() and "LATIN" not in unicodedata.name(c, "") for c in word if c not in "ªºµ"
    )


def _core(word: str) -> str:
    core = _EDGES.sub("", word)
    closing = word[len(core) :] if word.startswith(core) else ""
    dotted = core + "." if "." in closing and _keeps_dot(core) else core
    return unicodedata.normalize("NFKC", dotted).replace("⁄", "/")


def _keeps_dot(core: str) -> bool:
    return core.lower() in _ABBREVIATIONS or bool(_SPELLED.fullmatch(core + "."))


def _label(word: str) -> str:
    quoted = _QUOTED.fullmatch(_EDGES.sub("", word))
    if quoted:
        word = quoted[1] or quoted[2]
    core = _EDGES.sub("", word)
    start = word.find(core)
    dotted = word[start + len(core) : start + len(core) + 1] == "." and _keeps_dot(core)
    return core + "." if dotted else core


def _forms(core: str, before: str, after: str, *, shouting: bool) -> Forms:
    number = spoken_number(core, before, after)
    if number:
        return number
    short = core.lower().rstrip(".")
    if short in _ABBREVIATIONS and (core.endswith(".") or short in _WITHOUT_DOT):
        return tuple(tuple(way.split()) for way in _ABBREVIATIONS[short].split("|"))
    if short in ("am", "pm") and before[-1:].isdigit():
        return (tuple(short),)
    if _SPELLED.fullmatch(core):
        return (_spelled(core.replace(".", "")),)
    words = tuple(part for piece in _pieces(core) for part in piece)
    if not words:
        return ()
    if _ACRONYM.fullmatch(core) and not shouting:
        return (words, _spelled(core))
    return (words,)


def _spelled(letters: str) -> Form:
    plural = re.fullmatch(r"([A-Z]+)'?s", letters)
    if plural:
        spelled = plural[1].lower()
        return (*spelled[:-1], f"{spelled[-1]}'s")
    return tuple(c for c in letters.lower() if c.isalpha())


def _pieces(core: str) -> list[Form]:
    """Split what is joined by hyphens, slashes and symbols; drop what is silent."""
    result: list[Form] = []
    for part in re.findall(r"[^\W\d_]+(?:'[^\W\d_]*)*|'[^\W\d_]+'?|\d+|[&+=@%°]", core):
        if part in _SYMBOLS:
            result.append((_SYMBOLS[part],))
        elif part.isdigit():
            result.extend(spoken_number(part, "", "")[:1])
        else:
            result.append((part.lower(),))
    return result
