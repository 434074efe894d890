"""Phones of Mandarin syllables laid on the times at which espeak-ng spoke them.

espeak-ng's own labels for Mandarin are uneven (``th`` is an aspirated t, ``iɛ`` one
label, ``ɑ ŋ`` two, ``onɡ`` one): its times are kept, and the labels come from the
syllable's initial and final. Latin words keep the English sounds that were spoken, in
capitals.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import accumulate

from lipwright.phones import Piece, load_reduction
from lipwright.schedule.mandarin.pinyin import Syllable
from lipwright.schedule.mandarin.sounds import is_vowel, shares, sounds
from lipwright.timeline import Interval

_ENDINGS = {"n": ("n",), "ng": ("ŋ", "n"), "er": ("ər", "ɚ")}

Heard = tuple[str, float, float]


def lay(syllable: Syllable, heard: Sequence[Heard]) -> list[Interval]:
    """Return the phones of a syllable in time.

    Parameters
    ----------
    syllable : Syllable
    heard : sequence of (str, float, float)
        What was spoken for it: espeak-ng's labels as IPA, start and end, in seconds.

    Returns
    -------
    list of Interval
        Without gaps, from the first start to the last end. Where espeak-ng times as many
        sounds as the syllable has, they are its own; where it joins some, they share.
    """
    if syllable.is_foreign:
        return _english(heard)
    phones = sounds(syllable)
    first, last, before, after = 0, len(phones), list(heard), []
    placed: list[Interval] = []
    if len(phones) > 1 and len(before) > 1 and not is_vowel(phones[0]):
        _, start, end = before.pop(0)
        placed.append(Interval(phones[0], start, end))
        first = 1
    if last - first > 1 and len(before) > 1 and _ends(phones[-1], before[-1][0]):
        _, start, end = before.pop()
        after = [Interval(phones[-1], start, end)]
        last -= 1
    return [*placed, *_middle(phones[first:last], before), *after]


def _ends(phone: str, label: str) -> bool:
    return label.startswith(_ENDINGS.get(phone, ())) if phone in _ENDINGS else False


def _middle(phones: tuple[str, ...], heard: Sequence[Heard]) -> list[Interval]:
    if len(phones) == len(heard):
        return [Interval(p, start, end) for p, (_, start, end) in zip(phones, heard, strict=True)]
    return _shared(phones, shares(phones), heard[0][1], heard[-1][2])


def _shared(
    labels: Sequence[str], parts: Sequence[float], start: float, end: float
) -> list[Interval]:
    total = sum(parts)
    edges = [start + (end - start) * passed / total for passed in accumulate(parts, initial=0.0)]
    edges[-1] = end
    return [
        Interval(label, a, b) for label, a, b in zip(labels, edges[:-1], edges[1:], strict=True)
    ]


def _english(heard: Sequence[Heard]) -> list[Interval]:
    reduction = load_reduction("ipa", "arpabet")
    result: list[Interval] = []
    for label, start, end in heard:
        pieces: tuple[Piece, ...] = reduction.of(label)[0]
        result += _shared(
            [piece.label.upper() for piece in pieces], [p.share for p in pieces], start, end
        )
    return result
