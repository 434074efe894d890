"""Bigram sets as files that an animator opens (DESIGN sections 4 and 8).

JSON, one pose's key list per line, in a stable order, so that a version-control diff
shows what was done. Reading refuses what is broken with the place in the file.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from lipwright.curves import Keys
from lipwright.engines.bigram.documents import SET_FORMAT, BigramEntry, KeyList, SetDocument
from lipwright.engines.bigram.model import Bigram, BigramSet, Curves, Pair
from lipwright.engines.bigram.set_text import set_bytes as set_bytes
from lipwright.errors import InputError, SetError, did_you_mean
from lipwright.files import (
    Version,
    check_document,
    convert,
    file_version,
    parse_json,
    read_bytes,
)
from lipwright.phones import PhoneSet, load_phone_set

DATA = Path(__file__).parent.parent.parent / "data" / "sets"
FORMAT, VERSION = SET_FORMAT, 1


def load_set(name: str) -> BigramSet:
    """Return a set that comes with Lipwright by name, or the one in a ``.json`` file.

    Raises
    ------
    SetError, FileFormatError
        If it is unknown or broken; the message names the place in the file.
    """
    return read_set(name) if name.endswith(".json") else _built_in(name)


def built_in_sets() -> tuple[str, ...]:
    """Return the names of the sets that come with Lipwright."""
    return tuple(sorted(path.stem for path in DATA.glob("*.json")))


@cache
def _built_in(name: str) -> BigramSet:
    path = DATA / f"{name}.json"
    if not path.exists():
        known = ", ".join(built_in_sets())
        raise SetError(f"no bigram set {name!r}", expected=f"one of {known}, or a .json file")
    return read_set(path)


def read_set(path: str | Path) -> BigramSet:
    """Return the set in a file, with what it takes from the set that it builds on."""
    return _read_set(Path(path), ())


def set_document(data: bytes, where: str) -> SetDocument:
    """Return what the content of a set's file says, without the set that it builds on.

    Raises
    ------
    FileFormatError
        If it is broken; the message names the place in the file.
    """
    document = check_document(parse_json(data, where), where, format=FORMAT, version=VERSION)
    return convert(document, SetDocument, where)


def set_of(document: SetDocument, path: str | Path, data: bytes = b"") -> BigramSet:
    """Return the set of a document that lies, or is to lie, at a path."""
    return _made(document, Path(path), (), None, data)


def base_of(document: SetDocument, path: str | Path) -> BigramSet | None:
    """Return the set that a file builds on; None where it builds on none."""
    if not document.base:
        return None
    own = document.phone_set.endswith(".json")
    phone_set = str(Path(path).parent / document.phone_set) if own else document.phone_set
    return _base(document, Path(path), (), load_phone_set(phone_set))


def _read_set(path: Path, above: tuple[Path, ...]) -> BigramSet:
    version, data = file_version(path), read_bytes(path)
    return _made(set_document(data, str(path)), path, above, version, data)


def _made(
    read: SetDocument,
    path: Path,
    above: tuple[Path, ...],
    version: Version | None,
    data: bytes,
) -> BigramSet:
    where = str(path)
    try:
        # A user's own phone set is a file beside the set.
        own = read.phone_set.endswith(".json")
        phone_set = str(path.parent / read.phone_set) if own else read.phone_set
        phones_version = file_version(phone_set)
        classes = load_phone_set(phone_set)
        for label in (*read.phones, *read.reach):
            check_label(label, classes)
        base = _base(read, path, above, classes)
        return BigramSet(
            read.name,
            phone_set,
            base.rules if read.rules is None else read.rules,
            {**base.bigrams, **read_bigrams(read.bigrams, read.boundary, read.name, classes)},
            {
                **base.singles,
                **{label: read_curves(c, f"phone {label!r}") for label, c in read.phones.items()},
            },
            {**base.reach, **read.reach},
            {**base.presets, **read.presets},
            read.about,
            digest_of(base.digest.encode() + data),
            files=(*base.files, *([(phone_set, phones_version)] if own else []), (where, version)),
        )
    except InputError as error:
        raise error.at(where) from None


def _base(read: SetDocument, path: Path, above: tuple[Path, ...], classes: PhoneSet) -> BigramSet:
    """Return the set that a file builds on: the file names only what it adds or changes."""
    if not read.base:
        if read.rules is None:
            raise SetError("no rules", expected="'rules', or a 'base' that has them")
        return BigramSet(read.name, read.phone_set, read.rules, {})
    above = (*above, path.resolve())
    if not read.base.endswith(".json"):
        base = load_set(read.base)
    elif (beside := (path.parent / read.base).resolve()) in above:
        raise SetError(f"the base {read.base!r} builds on this set", cure="name another base")
    else:
        base = _read_set(beside, above)
    strange = [
        label for label in load_phone_set(base.phone_set).labels if label not in classes.labels
    ]
    if strange:
        raise SetError(
            f"{classes.name!r} lacks {' '.join(strange)}, which the base {read.base!r} has",
            cure="name a phone set that holds all classes of the base",
        )
    return base


def digest_of(data: bytes) -> str:
    """Return what tells a file's content from any other, whatever its line ends."""
    return hashlib.sha256(data.replace(b"\r\n", b"\n")).hexdigest()[:12]


def check_label(label: str, classes: PhoneSet) -> None:
    """Refuse what is no class of the set.

    Raises
    ------
    SetError
    """
    if label not in classes.labels:
        raise SetError(
            f"{label!r} is not a phone of {classes.name!r}",
            expected=f"one of {' '.join(classes.labels)}",
            cure=did_you_mean(label, classes.labels),
        )


def read_curves(read: dict[str, KeyList], where: str) -> Curves:
    """Return key lists as curves; an error names the pose."""
    curves = {}
    for pose, keys in read.items():
        try:
            curves[pose] = Keys.of(keys)
        except InputError as error:
            raise error.at(f"{where}, pose {pose!r}") from None
    return curves


def read_bigrams(
    read: Iterable[BigramEntry], boundary: float, source: str, classes: PhoneSet
) -> dict[Pair, Bigram]:
    """Return bigrams by pair; ``source`` is who drew them.

    Raises
    ------
    SetError
        If a class is unknown, a pair stands twice, or a curve breaks the rules.
    """
    bigrams: dict[Pair, Bigram] = {}
    for entry in read:
        for label in entry.pair:
            check_label(label, classes)
        where = f"bigram {entry.pair[0]}-{entry.pair[1]}"
        if entry.pair in bigrams:
            raise SetError(f"{where} stands twice", cure="remove one of the two")
        curves = read_curves(entry.curves, where)
        at = boundary if entry.boundary is None else entry.boundary
        bigrams[entry.pair] = Bigram(entry.pair, curves, at, entry.word, source)
    return bigrams
