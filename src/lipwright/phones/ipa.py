"""Any IPA label reduced to classes by how it is articulated (DESIGN section 3).

A label is read letter by letter. Sounds that the Common Phoneme Set has a class for
stand in ``ipa-to-common.json``; every other goes to the class with the nearest example
in :mod:`lipwright.phones.articulation`. Tones, stress, aspiration, nasality, voice and
other marks that no face shows are passed over. A class within the chart's
``exact_within`` shows all that is seen of the sound: it is exact. Farther off it is a
stand-in, and how far is told. Other sets than the common one name the segments that
show their own classes in the phone set's file (``"ipa": ["y", "ʏ"]``).
"""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass, replace
from functools import cache

from lipwright.phones.articulation import Segment, chart, distance, is_vowel
from lipwright.phones.reduction import Piece, read_table
from lipwright.phones.sets import DATA, load_phone_set

_LONG, _HALF_LONG, _RHOTIC = "ː", "ˑ", "˞"
_LOWERED = {"\u031e": 1, "\u031d": -1}
_STOPS = "pbtdkɡ"
_ROUNDING = "ʷᵝ"
_STRESS = str.maketrans("", "", "ˈˌ'. -")
_VOWEL_SHARE, _CONSONANT_SHARE, _GLIDE_SHARE = 2.0, 1.0, 0.5
_OPEN_STOP = 0.5  # distance of a stop whose closure is not reached (b̞) from its class
_ARROWS = "↑↓↗↘"


@dataclass(frozen=True, slots=True)
class Nearest:
    """The classes that a label becomes.

    Parameters
    ----------
    pieces : tuple of Piece
        Each with its share of the time.
    distance : float
        Of the sound whose class is farthest off; 0 where the set has a class for it.
    exact : bool
        Whether that is within the chart's ``exact_within``.
    """

    pieces: tuple[Piece, ...]
    distance: float
    exact: bool


def nearest_class(label: str, target: str = "common") -> tuple[tuple[Piece, ...], bool] | None:
    """Return the classes that an IPA label becomes, and whether they are exact.

    Parameters
    ----------
    label : str
        One phone, with any diacritics; several letters are a diphthong, an affricate,
        or sounds one after the other.
    target : str
        The phone set with the classes: a name, or a path ending in ``.json``. Its own
        ``ipa`` segments count before those of the Common Phoneme Set.

    Returns
    -------
    tuple of (tuple of Piece, bool), or None
        None where a character is no IPA, nothing sounds, or the target names no segments.

    Examples
    --------
    >>> nearest_class("t͡ʃ")
    ((Piece(label='sh', share=1.0),), True)
    >>> nearest_class("yː")
    ((Piece(label='w', share=3.0),), False)
    """
    found = nearest(label, target)
    return None if found is None else (found.pieces, found.exact)


def nearest(label: str, target: str = "common") -> Nearest | None:
    """Return what :func:`nearest_class` does, and how far off it is.

    Examples
    --------
    >>> found = nearest("ʁ")
    >>> found.pieces[0].label, round(found.distance, 2), found.exact
    ('kg', 0.3, True)
    """
    known = _known(target)
    spellings = chart().spellings
    unified = "".join(spellings.get(letter, letter) for letter in label.translate(_STRESS))
    plain = unicodedata.normalize("NFC", unified)
    bare = plain if _is_changed(plain) else _without_marks(plain)
    for spelling in (plain, bare, bare.replace(_LONG, "")):
        if spelling in known:
            return Nearest(known[spelling], 0.0, True)
    segments = _segments(plain)
    return _reduced(segments, target) if segments else None


def has_examples(target: str) -> bool:
    """Return whether every class of a phone set but silence has a segment that shows it."""
    examples = _examples(target)
    return all(examples.get(label) for label in load_phone_set(target).labels if label != "sil")


@cache
def _examples(target: str) -> dict[str, tuple[str, ...]]:
    """Segments of each class: the set's own, else those of the class of that name."""
    common = chart().classes
    own = {phone.label: phone.ipa for phone in load_phone_set(target).phones}
    taken = {segment for segments in own.values() for segment in segments}
    return {
        label: segments or tuple(each for each in common.get(label, ()) if each not in taken)
        for label, segments in own.items()
    }


@cache
def _known(target: str) -> dict[str, tuple[Piece, ...]]:
    """Labels that a class is there for, as far as the target set has those classes."""
    of = load_phone_set(target)
    known = {
        label: pieces
        for label, pieces in read_table(DATA / "ipa-to-common.json").pieces.items()
        if all(piece.label in of.labels for piece in pieces)
    }
    return known | {each: (Piece(one.label),) for one in of.phones for each in one.ipa}


def _is_mark(character: str) -> bool:
    # Combining marks, modifier letters (ʰ, ʲ, tones) and digits of tones and numbering.
    return unicodedata.category(character) in ("Mn", "Lm", "Sk", "No", "Nd") or (
        character in _ARROWS
    )


def _is_changed(label: str) -> bool:
    """Whether a mark changes what is seen of a letter: then only its segments tell."""
    return any(mark in label for mark in (*_ROUNDING, *_LOWERED))


def _apart(label: str) -> str:
    return unicodedata.normalize("NFD", label.replace("ç", "\0")).replace("\0", "ç")


def _without_marks(label: str) -> str:
    return "".join(c for c in _apart(label) if not _is_mark(c) or c in (_LONG, _RHOTIC))


def _segments(label: str) -> list[Segment]:
    """Return the letters of a label, or none if one of them is no IPA."""
    known = chart()
    result: list[Segment] = []
    for character in _apart(label):
        if result and character == result[-1].letter and is_vowel(character):
            result[-1] = _marked(result[-1], _LONG)  # "aa" is a long a
        elif character in known.vowels or character in known.consonants:
            result.append(Segment(character))
        elif not _is_mark(character):
            return []
        elif result and result[-1].letter + character in known.consonants:
            result[-1] = replace(result[-1], letter=result[-1].letter + character)  # ř: r̝
        elif result and character == "ʷ" and not is_vowel(result[-1].letter):
            result.append(Segment("w", length=_GLIDE_SHARE))  # the lips round on the way out
        elif result:
            result[-1] = _marked(result[-1], character)
    return result


def _marked(segment: Segment, mark: str) -> Segment:
    if mark in (_LONG, _HALF_LONG):
        return replace(segment, length=segment.length * (1.5 if mark == _LONG else 1.25))
    if mark in _ROUNDING:
        return replace(segment, rounding=mark)
    if mark == _RHOTIC:
        return replace(segment, rhotic=True)
    return replace(segment, lowered=_LOWERED[mark]) if mark in _LOWERED else segment


def _reduced(segments: list[Segment], target: str) -> Nearest | None:
    found: list[Piece] = []
    farthest = 0.0
    index = 0
    while index < len(segments):
        share = _share(segments[index])
        best = _diphthong(segments[index : index + 2], target)
        if best is not None:
            index += 1
            share += _share(segments[index])
        else:
            best = _class_of(segments[index], target)
        if best is None:
            return None
        gap, name = best
        # A stop and ʃ are one affricate, as tʃ is.
        if found and (found[-1].label == name or (found[-1].label, name) == ("d", "sh")):
            share += found.pop().share
        found.append(Piece(name, share))
        farthest = max(farthest, gap)
        index += 1
    return Nearest(tuple(found), farthest, farthest <= chart().exact_within)


def _share(segment: Segment) -> float:
    return segment.length * (_VOWEL_SHARE if is_vowel(segment.letter) else _CONSONANT_SHARE)


def _class_of(segment: Segment, target: str) -> tuple[float, str] | None:
    known = _known(target).get(segment.letter, ())
    # A known vowel that a mark rounds, lowers or gives an r is another vowel.
    other = segment.rounding or segment.rhotic or (segment.lowered and is_vowel(segment.letter))
    if len(known) == 1 and not other:
        open_stop = segment.lowered > 0 and segment.letter in _STOPS
        return (_OPEN_STOP if open_stop else 0.0), known[0].label
    return min(
        (
            (distance(segment, Segment(example)), name)
            for name, examples in _examples(target).items()
            for example in examples
            if len(example) == 1 and is_vowel(example) == is_vowel(segment.letter)
        ),
        default=None,
    )


def _diphthong(pair: list[Segment], target: str) -> tuple[float, str] | None:
    if len(pair) < 2 or any(each.rhotic or not is_vowel(each.letter) for each in pair):
        return None
    first, second = pair
    best = min(
        (
            (distance(first, Segment(example[0])) + distance(second, Segment(example[1])), name)
            for name, examples in _examples(target).items()
            for example in examples
            if len(example) == 2
        ),
        default=None,
    )
    return best if best is not None and best[0] <= chart().diphthong_within else None
