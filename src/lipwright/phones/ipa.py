"""Any IPA label reduced to the Common Phoneme Set by how it is articulated (DESIGN section 3).

A label is read letter by letter. A vowel goes to the class whose example is nearest in
height, backness and rounding; a consonant to the nearest in place, closure, sibilance,
laterality and rounding. The lips weigh most, since they are what is seen: a front
rounded vowel (y, ø) goes with u, whose lips it has, and not with i, whose tongue it
has. Tones, stress, aspiration, nasality and other marks that no face shows are passed
over. The letters' features are data (``data/articulation/ipa.json``); sounds that the set has a
class for stand in ``ipa-to-common.json`` and need none of this.
"""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass
from functools import cache

import msgspec

from lipwright.files import convert, read_document
from lipwright.phones.reduction import Piece, read_table
from lipwright.phones.sets import DATA

_VOWEL_WEIGHTS = (1.5, 0.6, 2.0)  # height, backness, rounding
_CONSONANT_WEIGHTS = (0.4, 3.0, 2.0, 3.0, 2.0)  # place, closure, sibilant, lateral, rounding
_FARTHEST_DIPHTHONG = 0.47  # beyond this the two vowels are two sounds
_LONG, _HALF_LONG, _RHOTIC = "ː", "ˑ", "˞"
_ROUNDING = "ʷᵝ"
_STRESS = str.maketrans("", "", "ˈˌ'. -")
_VOWEL_SHARE, _CONSONANT_SHARE = 2.0, 1.0
_RHOTIC_VOWELS = "ɚɝ"


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    about: str
    vowels: dict[str, tuple[float, float, float]]
    consonants: dict[str, tuple[float, float, float, float, float]]
    classes: dict[str, list[str]]
    diphthongs: dict[str, list[str]]
    spellings: dict[str, str]


@dataclass(frozen=True, slots=True)
class _Segment:
    """One letter of a label with its marks."""

    letter: str
    rounded: bool = False
    rhotic: bool = False
    length: float = 1.0


def nearest_class(label: str) -> tuple[tuple[Piece, ...], bool] | None:
    """Return the classes that an IPA label becomes, and whether they are exact.

    Parameters
    ----------
    label : str
        One phone, with any diacritics; several letters are a diphthong, an affricate,
        or sounds one after the other.

    Returns
    -------
    tuple of (tuple of Piece, bool), or None
        None where a character is no IPA, or nothing sounds.

    Examples
    --------
    >>> nearest_class("t͡ʃ")
    ((Piece(label='sh', share=1.0),), True)
    >>> nearest_class("yː")
    ((Piece(label='w', share=3.0),), False)
    """
    known = read_table(DATA / "ipa-to-common.json").pieces
    spellings = _features().spellings
    unified = "".join(spellings.get(letter, letter) for letter in label.translate(_STRESS))
    plain = unicodedata.normalize("NFC", unified)
    for spelling in (plain, _without_marks(plain), _without_marks(plain).replace(_LONG, "")):
        if spelling in known:
            return known[spelling], True
    segments = _segments(plain)
    return None if not segments else (_pieces(segments), False)


@cache
def _features() -> _Document:
    path = DATA.parent / "articulation" / "ipa.json"
    return convert(
        read_document(path, format="lipwright/articulation", version=1), _Document, str(path)
    )


def _is_mark(character: str) -> bool:
    # Combining marks, modifier letters (ʰ, ʲ, tones) and digits of tones and numbering.
    return unicodedata.category(character) in ("Mn", "Lm", "Sk", "No", "Nd") or character in "↑↓↗↘"


def _without_marks(label: str) -> str:
    apart = unicodedata.normalize("NFD", label.replace("ç", "\0"))
    kept = (c for c in apart if not _is_mark(c) or c in (_LONG, _RHOTIC))
    return "".join(kept).replace("\0", "ç")


def _segments(label: str) -> list[_Segment]:
    """Return the letters of a label, or none if one of them is no IPA."""
    features = _features()
    apart = unicodedata.normalize("NFD", label.replace("ç", "\0")).replace("\0", "ç")
    result: list[_Segment] = []
    for character in apart:
        if result and character == result[-1].letter and character in features.vowels:
            result[-1] = _marked(result[-1], _LONG)  # "aa" is a long a
        elif character in features.vowels or character in features.consonants:
            result.append(_Segment(character, rhotic=character in _RHOTIC_VOWELS))
        elif not _is_mark(character):
            return []
        elif result:
            result[-1] = _marked(result[-1], character)
    return result


def _marked(segment: _Segment, mark: str) -> _Segment:
    length = segment.length * {_LONG: 1.5, _HALF_LONG: 1.25}.get(mark, 1.0)
    return _Segment(
        segment.letter,
        segment.rounded or mark in _ROUNDING,
        segment.rhotic or mark == _RHOTIC,
        length,
    )


def _pieces(segments: list[_Segment]) -> tuple[Piece, ...]:
    found: list[tuple[str, float]] = []
    index = 0
    while index < len(segments):
        here = segments[index]
        share = _share(here)
        name = None
        if index + 1 < len(segments) and _is_vowel(here) and _is_vowel(segments[index + 1]):
            name = _diphthong(here, segments[index + 1])
        if name is not None:
            index += 1
            share += _share(segments[index])
        else:
            name = _class_of(here)
        if found and found[-1][0] == name:
            found[-1] = (name, found[-1][1] + share)
        elif found and (found[-1][0], name) == ("d", "sh"):
            found[-1] = (name, found[-1][1] + share)  # an affricate, as tʃ is
        else:
            found.append((name, share))
        index += 1
    return tuple(Piece(name, share) for name, share in found)


def _is_vowel(segment: _Segment) -> bool:
    return segment.letter in _features().vowels


def _share(segment: _Segment) -> float:
    return segment.length * (_VOWEL_SHARE if _is_vowel(segment) else _CONSONANT_SHARE)


def _class_of(segment: _Segment) -> str:
    features = _features()
    if segment.rhotic:
        return "er"
    known = read_table(DATA / "ipa-to-common.json").pieces.get(segment.letter, ())
    if len(known) == 1 and not _is_vowel(segment):
        return known[0].label
    letters = features.vowels if _is_vowel(segment) else features.consonants
    return min(
        (_distance(segment, _Segment(letter)), name)
        for name, examples in features.classes.items()
        for letter in examples
        if letter in letters
    )[1]


def _diphthong(first: _Segment, second: _Segment) -> str | None:
    if first.rhotic or second.rhotic:
        return None
    distance, name = min(
        (_distance(first, _Segment(pair[0])) + _distance(second, _Segment(pair[1])), name)
        for name, pairs in _features().diphthongs.items()
        for pair in pairs
    )
    return name if distance <= _FARTHEST_DIPHTHONG else None


def _distance(a: _Segment, b: _Segment) -> float:
    """Return how far two vowels, or two consonants, are apart."""
    features = _features()
    vowels = _is_vowel(a)
    letters: dict[str, tuple[float, ...]] = dict(features.vowels if vowels else features.consonants)
    weights = _VOWEL_WEIGHTS if vowels else _CONSONANT_WEIGHTS
    gap = [abs(x - y) for x, y in zip(letters[a.letter], letters[b.letter], strict=True)]
    if vowels:
        gap[-1] = abs(max(letters[a.letter][-1], float(a.rounded)) - letters[b.letter][-1])
    return sum(weight * each for weight, each in zip(weights, gap, strict=True))
