"""What the sounds of all languages sound like in the phones of the acoustic model.

The model was trained on American English, so a French /y/ has to be looked for as the
English phones nearest to it: nearest to the ear, where the reduction to the Common
Phoneme Set goes by what is seen of the lips (:mod:`lipwright.phones.ipa`). The table is
data (``data/acoustics/ipa.json``); where it is uncertain it names several phones, and
the sound decides among them. A phone set of one language may have a table of its own
beside it (``pinyin.json``).
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import islice, product
from pathlib import Path

import msgspec

from lipwright.errors import LabelError
from lipwright.files import convert, read_document
from lipwright.phones import load_phone_set
from lipwright.schedule.align.lexicon import Pronunciation, Ways
from lipwright.schedule.align.pronouncing import Way

DATA = Path(__file__).parents[2] / "data" / "acoustics"
_STOPS = frozenset("ptkbdg")
_MOST_WAYS = 6  # pronunciations of a word; more cost time and bring nothing
_FEWEST_WAYS = 2  # of each reading of a word


class _Language(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    sounds: dict[str, list[str]] = {}
    optional: list[str] = []


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    about: str
    sounds: dict[str, list[str]]
    languages: dict[str, _Language] = {}


def sounds_like(label: str, language: str = "") -> Ways:
    """Return what an IPA label sounds like: sequences of ARPAbet phones, best first.

    Parameters
    ----------
    label : str
        One phone as a synthesiser writes it, with any marks.
    language : str
        Some voices write sounds in their own way: the table says which.

    Raises
    ------
    LabelError
        If the label is no IPA.

    Examples
    --------
    >>> sounds_like("tsʰ"), sounds_like("mʲ")
    ((('t', 's'),), (('m',),))
    """
    table = _sounds(language)
    options = [table[spelling] for spelling in _spellings(label, table)]
    if not options:
        raise LabelError(
            f"no sound is known for {label!r}",
            expected="a letter of the International Phonetic Alphabet",
            cure="align it from labels",
        )
    ways = (tuple(phone for part in parts for phone in part) for parts in product(*options))
    return tuple(dict.fromkeys(islice(ways, _MOST_WAYS)))


def ways_of(labels: Sequence[str], language: str = "") -> tuple[Way, ...]:
    """Return the ways in which a word of these labels may sound: the likeliest first.

    A sound that a label may be is taken to be the same in the whole word; one label at a
    time departs from its best. Sounds that speakers of the language may leave out are
    there in one half of the ways.

    Raises
    ------
    LabelError
        If a label is no IPA.
    """
    optional = set(_language(language).optional)
    kept = tuple(label for label in labels if label not in optional)
    fewer = [kept] if kept and len(kept) < len(labels) else []
    options = {label: sounds_like(label, language) for label in labels}
    most = _MOST_WAYS // (1 + len(fewer))
    return tuple(
        way for said in (tuple(labels), *fewer) for way in islice(_departures(said, options), most)
    )


def ways_by_table(said: Sequence[Sequence[str]], phone_set: str) -> tuple[Way, ...]:
    """Return the ways in which a word may sound that is said in one or several ways.

    Parameters
    ----------
    said : sequence of sequence of str
        Entries of the phone set's own table.
    phone_set : str
        A set that has one: ``"pinyin"``.

    Raises
    ------
    LabelError
        If the table has no such entry.

    Examples
    --------
    >>> ways_by_table([("sh", "i-")], "pinyin")[:2]
    ((('sh', ('sh',)), ('i-', ('y',))), (('sh', ('f',)), ('i-', ('y',))))
    """
    table = _table(phone_set)
    unknown = {entry for way in said for entry in way} - set(table)
    if unknown:
        raise LabelError(f"no sound is known for {', '.join(map(repr, sorted(unknown)))}")
    most = max(_FEWEST_WAYS, _MOST_WAYS // len(said))
    return tuple(way for each in said for way in islice(_departures(each, table), most))


def _departures(labels: Sequence[str], table: Mapping[str, Ways]) -> Iterator[Way]:
    options = {label: table[label] for label in labels}
    best = {label: ways[0] for label, ways in options.items()}
    yield _way(labels, best, options)
    for rank in range(1, max(map(len, options.values()))):
        for changed, ways in options.items():
            if rank < len(ways):
                yield _way(labels, {**best, changed: ways[rank]}, options)


def _way(labels: Sequence[str], chosen: dict[str, Pronunciation], options: dict[str, Ways]) -> Way:
    """Join what was chosen; no two stops meet where a sound may be something else.

    A trill or tap after a stop would take the stop's burst for its own.
    """
    way: list[tuple[str, Pronunciation]] = []
    for label in labels:
        sounds = chosen[label]
        if way and way[-1][1][-1] in _STOPS and sounds[0] in _STOPS:
            sounds = next((other for other in options[label] if other[0] not in _STOPS), sounds)
        way.append((label, sounds))
    return tuple(way)


def _spellings(label: str, table: dict[str, Ways]) -> list[str]:
    """Cut a label into the longest spellings of the table; a vowel twice is a long one."""
    plain = _apart(label)
    longest = max(map(len, table))
    found: list[str] = []
    at = 0
    while at < len(plain):
        sizes = range(min(longest, len(plain) - at), 0, -1)
        size = next((size for size in sizes if plain[at : at + size] in table), 0)
        spelling = plain[at : at + size]
        if size and spelling != (found[-1] if found else ""):
            found.append(spelling)
        elif not size and unicodedata.category(plain[at]) in ("Ll", "Lo"):
            return []
        at += size or 1
    return found


def _apart(label: str) -> str:
    """Return a label with its marks behind its letters, but ç, a letter; without ties."""
    known = load_phone_set("ipa").aliases  # letters that IPA has given up, such as ʦ
    plain = "".join(known.get(c, c) if c.isalpha() else c for c in label.replace("\u0361", ""))
    composed = unicodedata.normalize("NFC", plain)
    return "".join(c if c == "ç" else unicodedata.normalize("NFD", c) for c in composed)


@cache
def _sounds(language: str) -> dict[str, Ways]:
    rows = {**_document("ipa").sounds, **_language(language).sounds}
    return {_apart(key): _as_ways(ways) for key, ways in rows.items()}


@cache
def _table(phone_set: str) -> dict[str, Ways]:
    return {key: _as_ways(ways) for key, ways in _document(phone_set).sounds.items()}


def _as_ways(written: Sequence[str]) -> Ways:
    return tuple(tuple(way.split()) for way in written)


def _language(name: str) -> _Language:
    languages = _document("ipa").languages
    return languages.get(name) or languages.get(name.split("-")[0]) or _Language()


@cache
def _document(phone_set: str) -> _Document:
    path = DATA / f"{phone_set}.json"
    read = read_document(path, format="lipwright/acoustics", version=1)
    return convert(read, _Document, str(path))
