"""espeak-ng's labels as IPA.

The library labels most sounds in IPA, some by its own ASCII names, and some by a letter
that stands for another sound in the IPA (ы as ``y``, the German r as ``r``). What each
of them is in its language is data that can be read and corrected
(``data/phones/espeak-to-ipa.json``).
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable
from functools import cache

import msgspec

from lipwright.files import convert, read_document
from lipwright.phones import SILENCE
from lipwright.phones.sets import DATA

_FILE = DATA / "espeak-to-ipa.json"
_ALONE = {"ᵐ": "m", "ⁿ": "n", "ᵑ": "ŋ"}
_STRESS = str.maketrans("", "", "ˈˌ")


class _Row(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    label: str
    ipa: str
    example: str


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    about: str
    letters: dict[str, str]
    dropped: str
    languages: dict[str, list[_Row]]


def plain_label(label: str, language: str = "") -> str:
    """Return a label of espeak-ng as IPA without stress, ``sil``, or nothing.

    Some voices give a mark (``ʲ``, a tone) as a phone of its own, which is nothing.

    Parameters
    ----------
    label : str
        As the library writes it.
    language : str
        Of the voice; without it, only what holds in every language is done.

    Examples
    --------
    >>> plain_label("ˈɑː"), plain_label("tS"), plain_label(""), plain_label("ʲ")
    ('ɑː', 'tʃ', 'sil', '')
    >>> plain_label("tɕh", "cmn"), plain_label("y", "ru"), plain_label("y", "fr-fr")
    ('tɕʰ', 'ɨ', 'y')
    """
    if not label:
        return SILENCE
    unstressed = unicodedata.normalize("NFC", label.translate(_STRESS))
    pattern, meant = _language(language)
    if pattern is not None:
        unstressed = pattern.sub(lambda found: meant[found.group()], unstressed)
    plain = unicodedata.normalize("NFC", unstressed.replace("_h", "ʰ").translate(_letters()))
    plain = _ALONE.get(plain, plain)
    if plain.startswith("(") or not any(unicodedata.category(c) in ("Ll", "Lo") for c in plain):
        return ""
    return plain[:-2] + "ŋ" if len(plain) > 2 and plain.endswith("nɡ") else plain


def plain_labels(labels: Iterable[str], language: str = "") -> list[str]:
    """Return labels that espeak-ng wrote one after another, each as :func:`plain_label`.

    A foreign word is spelled as its own language is: ``(en)`` before it says so.

    Examples
    --------
    >>> plain_labels(["r", "ˈoː", "t", "(en)", "ɹ", "(de)"], "de")
    ['ʁ', 'oː', 't', '', 'ɹ', '']
    """
    plain: list[str] = []
    for label in labels:
        if label.startswith("("):
            language = label.strip("()")
        plain.append(plain_label(label, language))
    return plain


@cache
def _read() -> _Document:
    document = read_document(_FILE, format="lipwright/spellings", version=1)
    return convert(document, _Document, str(_FILE))


@cache
def _letters() -> dict[int, str | None]:
    read = _read()
    return {ord(each): None for each in read.dropped} | {
        ord(letter): ipa for letter, ipa in read.letters.items()
    }


@cache
def _language(language: str) -> tuple[re.Pattern[str] | None, dict[str, str]]:
    known = {name for names in _read().languages for name in names.split()}
    spelled = language if language in known else language.split("-")[0]
    rows = [
        row for names, rows in _read().languages.items() for row in rows if spelled in names.split()
    ]
    meant = {unicodedata.normalize("NFC", row.label): row.ipa for row in rows}
    if not meant:
        return None, {}
    longest_first = sorted(meant, key=len, reverse=True)
    return re.compile("|".join(map(re.escape, longest_first))), meant
