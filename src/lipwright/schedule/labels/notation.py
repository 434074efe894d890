"""Which phone set the labels of a file belong to, and their spelling in it.

Silence is spelled in many ways; TIMIT writes the closure of a stop as a label of its
own (Garofolo et al. 1993, section "Phonemic and phonetic symbol codes"), which engines
must see as one stop. What stays unknown is an error that names all of it at once.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from dataclasses import replace

from lipwright.errors import LabelError
from lipwright.phones import (
    SILENCE,
    PhoneTrack,
    load_phone_set,
    load_reduction,
    phone_set_names,
)
from lipwright.schedule.labels.rows import Row

GUESSED = ("arpabet", "ipa", "sampa", "pinyin")
"""The phone sets that are tried, in this order, where neither user nor file names one."""

SILENCES = frozenset(
    {"", "_", "#", "sil", "sp", "ssil", "pau", "h#", "silence", "<sil>", "[sil]", "[silence]"}
    | {"<eps>", "<p:>", "<usb>", "<nib>", "<s>", "</s>", "!sil", "sent-start", "sent-end"}
    | {"spn", "nsn", "noise", "[noise]", "++noise++", "brth", "breath", "[breath]", "++breath++"}
)
"""What others write for silence, in lower case; the empty label too."""

CLOSURES = {"bcl": "b", "dcl": "d", "gcl": "g", "pcl": "p", "tcl": "t", "kcl": "k"}
_AFFRICATES = {"dcl": "jh", "tcl": "ch"}
_VOWEL_LETTERS = "aeiou"
# Pinyin whose letters IPA has too, though no language has a phone of that name.
_NO_IPA = frozenset(("zh", "ch", "sh", "ng", "ii", "iii", "ê", "ü"))
_MOST_NAMED = 12
_LONGEST = 3


def is_silence(label: str) -> bool:
    """Tell whether a label stands for silence or noise, in anyone's spelling."""
    return label.strip().casefold() in SILENCES


def fits_a_phone_set(labels: Sequence[str]) -> bool:
    """Tell whether all labels belong to one of the known phone sets."""
    sounding = [label for label in labels if not is_silence(label)]
    return bool(sounding) and not _strangeness(sounding, guess(sounding))


def guess(labels: Sequence[str]) -> str:
    """Return the phone set that knows most of the labels; the first of equals.

    Examples
    --------
    >>> guess(["HH", "AH0", "L", "OW1"])
    'arpabet'
    """
    return min(GUESSED, key=lambda name: _strangeness(labels, name))


def has_to_be_named(track: PhoneTrack) -> bool:
    """Tell whether these labels would be taken for those of another phone set.

    Examples
    --------
    >>> from lipwright.timeline import Tier
    >>> has_to_be_named(PhoneTrack(Tier.of(("sh", 0, 1), ("ao", 1, 2)), "pinyin"))
    True
    """
    sounding = [label for label in track.tier.labels if not is_silence(label)]
    return track.phone_set in phone_set_names() and guess(sounding) != track.phone_set


def _strangeness(labels: Sequence[str], name: str) -> int:
    strange = set(_unknown(labels, name))
    if name == "ipa":
        strange.update(filter(_is_wordlike, labels))
        strange.update(_NO_IPA.intersection(labels))
    return len(strange)


def _is_wordlike(label: str) -> bool:
    # IPA's letters spell words and typing errors too: only pairs such as ts, au are phones.
    letters = [c for c in label.strip() if unicodedata.category(c) in ("Ll", "Lo")]
    if not label.isascii():
        return len(letters) > _LONGEST
    return len(letters) > 2 or len(set(letters)) < len(letters)


def normalised(rows: Sequence[Row], phone_set: str, where: str) -> tuple[list[Row], str]:
    """Return the rows in their phone set's own spelling, and the set's name.

    Parameters
    ----------
    rows : sequence of Row
        Phones as a file spells them.
    phone_set : str
        The set's name, or nothing: it is guessed.
    where : str
        The file, for errors.

    Raises
    ------
    LabelError
        If labels are unknown: all are named, each once.
    """
    labels = [row.label for row in rows if not is_silence(row.label)]
    name = phone_set or guess(labels)
    if name not in ("ipa", "timit"):
        load_phone_set(name)  # a set that does not exist is not a matter of labels
    if name in ("arpabet", "timit"):
        name, rows = "arpabet", folded(rows)
        labels = [row.label for row in rows if not is_silence(row.label)]
    unknown = _unknown(labels, name)
    if name == "ipa" and not phone_set:
        unknown = [
            label for label in dict.fromkeys(labels) if label in unknown or _is_wordlike(label)
        ]
    if unknown:
        raise _stranger(unknown, len(set(labels)), name, where)
    spelled = {label: _spelled(label, name) for label in set(labels)}
    return [replace(row, label=spelled.get(row.label, SILENCE)) for row in rows], name


def _unknown(labels: Sequence[str], name: str) -> list[str]:
    extra = {*CLOSURES, "q", "epi"} if name == "arpabet" else set()
    return [
        label
        for label in dict.fromkeys(labels)
        if not _knows(name, label) and label.casefold() not in extra
    ]


def _knows(name: str, label: str) -> bool:
    try:
        _spelled(label, name)
    except LabelError:
        return False
    return True


def _spelled(label: str, name: str) -> str:
    if name != "ipa":
        return load_phone_set(name).normalise(label)
    # IPA has no list of labels: it knows what its letters can be reduced from.
    spelled = unicodedata.normalize("NFC", label.strip())
    load_reduction("ipa").of(spelled)
    return spelled


def _stranger(unknown: list[str], of: int, name: str, where: str) -> LabelError:
    named = ", ".join(map(repr, unknown[:_MOST_NAMED]))
    if len(unknown) > _MOST_NAMED:
        named += f" and {len(unknown) - _MOST_NAMED} more"
    are_words = 2 * len(unknown) > of and sum(map(len, unknown)) > 3 * len(unknown)
    return LabelError(
        f"{named}: not phones of {name!r}",
        where=where,
        cure="these look like words: give the words as text, and they are aligned"
        if are_words
        else "check their spelling, or name the phone set that they belong to",
    )


def folded(rows: Sequence[Row]) -> list[Row]:
    """Return TIMIT's rows with each closure and its release as one stop.

    A closure without a release is that stop. A glottal stop ``q`` belongs to the vowel
    after it, else to the phone before; the epenthetic silence ``epi``, a few hundredths
    of a second inside a word, to the phone before.
    """
    result: list[Row] = []
    opened: Row | None = None  # a closure or glottal stop that waits for what follows
    for row in rows:
        label = row.label.casefold()
        if opened is not None and _belongs(opened.label.casefold(), label):
            row = replace(row, start=opened.start)
        elif opened is not None:
            _close(result, opened)
        opened = None
        if label in CLOSURES or label == "q":
            opened = row
        elif label == "epi":
            _close(result, row)
        else:
            result.append(row)
    if opened is not None:
        _close(result, opened)
    return result


def _belongs(opened: str, label: str) -> bool:
    if opened == "q":
        return label[:1] in _VOWEL_LETTERS and label != "epi"
    return label in (CLOSURES[opened], _AFFRICATES.get(opened))


def _close(result: list[Row], row: Row) -> None:
    stop = CLOSURES.get(row.label.casefold())
    if stop is not None:
        result.append(replace(row, label=stop))
    elif result and not is_silence(result[-1].label):
        result[-1] = replace(result[-1], end=row.end)
    else:
        result.append(replace(row, label=SILENCE))
