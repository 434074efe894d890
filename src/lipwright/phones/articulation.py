"""What the face shows of the sounds of the IPA chart, and how far two sounds are apart.

The features are data that a phonetician can read and correct
(``data/articulation/ipa.json``): height, backness and rounding of a vowel; place, manner,
lips, sibilance and laterality of a consonant. Each name stands for a number on its scale;
a weight says how much the eye makes of a step on it. The lips weigh most, then whatever
parts the jaws; what happens behind the teeth weighs little, voice and nasality nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import msgspec

from lipwright.errors import FileFormatError
from lipwright.files import convert, read_document
from lipwright.phones.sets import DATA

_FILE = DATA.parent / "articulation" / "ipa.json"
_RHOTIC_VOWELS = "ɚɝ"
_RHOTIC_WEIGHT = 1.0  # a vowel with r in it is no plain vowel


class Vowel(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A vowel of the chart: names on the scales of height, backness and rounding."""

    ipa: str
    height: str
    backness: str
    rounding: str
    example: str = ""


class Consonant(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A consonant of the chart: names on the scales of place and manner, shape of the lips."""

    ipa: str
    place: str
    manner: str
    lips: str
    sibilant: bool = False
    lateral: bool = False
    example: str = ""


class Lips(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A shape of the lips: how far they are closed and rounded, 0..1."""

    closing: float
    rounding: float


class Weights(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """How much the eye makes of a whole step of each feature."""

    height: float
    backness: float
    vowel_rounding: float
    place: float
    manner: float
    closing: float
    rounding: float
    sibilant: float
    lateral: float


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    about: str
    scales: dict[str, dict[str, float]]
    lips: dict[str, Lips]
    weights: Weights
    exact_within: float
    diphthong_within: float
    vowels: list[Vowel]
    consonants: list[Consonant]
    classes: dict[str, tuple[str, ...]]
    spellings: dict[str, str]


@dataclass(frozen=True, slots=True)
class Chart:
    """The chart with its numbers.

    Parameters
    ----------
    vowels, consonants : dict of str to tuple of float
        The weighted place of each letter; the distance of two is the sum of differences.
    classes : dict of str to tuple of str
        Segments that show each class of the Common Phoneme Set as it is; two letters are
        a diphthong.
    exact_within : float
        The farthest distance at which a class still shows all that is seen of a sound.
    diphthong_within : float
        The farthest distance at which two vowels are one diphthong.
    spellings : dict of str to str
        Other ways to write a letter.
    rounding : dict of str to float
        What a mark makes of a vowel's rounding, weighted.
    step : float
        What a mark of lowering adds to a vowel's height, weighted.
    """

    vowels: dict[str, tuple[float, ...]]
    consonants: dict[str, tuple[float, ...]]
    classes: dict[str, tuple[str, ...]]
    exact_within: float
    diphthong_within: float
    spellings: dict[str, str]
    rounding: dict[str, float]
    step: float


@dataclass(frozen=True, slots=True)
class Segment:
    """One letter of a label with what its marks say.

    Parameters
    ----------
    letter : str
    rounding : str
        Mark of rounding on a vowel: ``"ʷ"`` full, ``"ᵝ"`` compressed lips.
    rhotic : bool
        Whether an r is heard in the vowel.
    lowered : int
        1 for a lowered vowel (``o̞``) and a stop whose closure is not reached (``b̞``),
        -1 for a raised one.
    length : float
        1 for a short sound.
    """

    letter: str
    rounding: str = ""
    rhotic: bool = False
    lowered: int = 0
    length: float = 1.0


@cache
def chart() -> Chart:
    """Return the chart in ``data/articulation/ipa.json``."""
    where = str(_FILE)
    read = convert(read_document(_FILE, format="lipwright/segments", version=1), _Document, where)
    try:
        return _numbered(read)
    except KeyError as error:
        raise FileFormatError(
            f"{error.args[0]!r} is on no scale", where=where, cure="give it a number there"
        ) from None


def _numbered(read: _Document) -> Chart:
    weights, scales = read.weights, read.scales
    full = weights.vowel_rounding
    vowels: dict[str, tuple[float, ...]] = {
        each.ipa: (
            weights.height * scales["height"][each.height],
            weights.backness * scales["backness"][each.backness],
            full * scales["rounding"][each.rounding],
        )
        for each in read.vowels
    }
    consonants: dict[str, tuple[float, ...]] = {
        each.ipa: (
            weights.place * scales["place"][each.place],
            weights.manner * scales["manner"][each.manner],
            weights.closing * read.lips[each.lips].closing,
            weights.rounding * read.lips[each.lips].rounding,
            weights.sibilant * each.sibilant,
            weights.lateral * each.lateral,
        )
        for each in read.consonants
    }
    rounding = {
        "ʷ": full * scales["rounding"]["rounded"],
        "ᵝ": full * scales["rounding"]["compressed"],
    }
    return Chart(
        vowels,
        consonants,
        read.classes,
        read.exact_within,
        read.diphthong_within,
        read.spellings,
        rounding,
        weights.height * (scales["height"]["mid"] - scales["height"]["close-mid"]),
    )


def is_vowel(letter: str) -> bool:
    """Return whether the chart lists a letter among the vowels."""
    return letter in chart().vowels


def distance(a: Segment, b: Segment) -> float:
    """Return how far apart two vowels, or two consonants, are to the eye.

    Examples
    --------
    >>> round(distance(Segment("k"), Segment("x")), 2)
    0.2
    """
    known = chart()
    place = known.vowels if is_vowel(a.letter) else known.consonants
    gap = sum(abs(x - y) for x, y in zip(_place(a, place), _place(b, place), strict=True))
    return gap + _RHOTIC_WEIGHT * (_is_rhotic(a) != _is_rhotic(b))


def _place(segment: Segment, letters: dict[str, tuple[float, ...]]) -> tuple[float, ...]:
    place = letters[segment.letter]
    if not is_vowel(segment.letter):
        return place
    height, backness, rounding = place
    lips = chart().rounding[segment.rounding] if segment.rounding else 0.0
    return height + segment.lowered * chart().step, backness, max(rounding, lips)


def _is_rhotic(segment: Segment) -> bool:
    return segment.rhotic or segment.letter in _RHOTIC_VOWELS
