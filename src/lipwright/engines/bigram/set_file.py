"""Bigram sets as files that an animator opens (DESIGN sections 4 and 8).

JSON, one pose's key list per line, in a stable order, so that a version-control diff
shows what was done. Reading refuses what is broken with the place in the file.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path

import msgspec

from lipwright.curves import Keys
from lipwright.engines.bigram.model import (
    Bigram,
    BigramSet,
    Curves,
    Pair,
    Rules,
)
from lipwright.errors import InputError, SetError, did_you_mean
from lipwright.files import (
    convert,
    file_version,
    format_number,
    format_row,
    quote,
    read_bytes,
    read_document,
)
from lipwright.phones import PhoneSet, load_phone_set

DATA = Path(__file__).parent.parent.parent / "data" / "sets"
FORMAT, VERSION = "lipwright/bigram-set", 1

KeyList = list[tuple[float, float]]


class _Struct(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    pass


class BigramEntry(_Struct, frozen=True):
    """A bigram as it stands in a file."""

    pair: tuple[str, str]
    curves: dict[str, KeyList]
    boundary: float | None = None
    word: str = ""


class _Set(_Struct, frozen=True):
    version: int
    name: str
    bigrams: list[BigramEntry]
    rules: Rules | None = None
    base: str = ""
    about: str = ""
    phone_set: str = "common"
    boundary: float = 0.5
    phones: dict[str, dict[str, KeyList]] = {}
    reach: dict[str, str] = {}
    presets: dict[str, Rules] = {}


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


def _read_set(path: Path, above: tuple[Path, ...]) -> BigramSet:
    where, version = str(path), file_version(path)
    read = convert(read_document(path, format=FORMAT, version=VERSION), _Set, where)
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
            digest_of(base.digest.encode() + read_bytes(path)),
            files=(*base.files, *([(phone_set, phones_version)] if own else []), (where, version)),
        )
    except InputError as error:
        raise error.at(where) from None


def _base(read: _Set, path: Path, above: tuple[Path, ...], classes: PhoneSet) -> BigramSet:
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


def set_bytes(of: BigramSet, boundary: float = 0.5, base: BigramSet | None = None) -> bytes:
    """Return the content of a set's file: stable order, one key list per line.

    Parameters
    ----------
    of : BigramSet
    boundary : float
        Of bigrams that do not say their own.
    base : BigramSet, optional
        A set that comes with Lipwright: only pairs and phones that it lacks are written.
    """
    if base is not None:
        return _lines_bytes(
            [
                *_head(of, boundary),
                f'  "base": {quote(base.name)},',
                *_phones_text({n: c for n, c in of.singles.items() if n not in base.singles}),
                *_bigrams_text(
                    [b for p, b in of.bigrams.items() if p not in base.bigrams], boundary
                ),
            ]
        )
    return _lines_bytes(
        [
            *_head(of, boundary),
            f'  "reach": {_flat({k: quote(v) for k, v in of.reach.items()})},',
            f'  "rules": {_rules_text(of.rules, "  ")},',
            '  "presets": {',
            *_joined(f"    {quote(n)}: {_rules_text(r, '    ')}" for n, r in of.presets.items()),
            "  },",
            *_phones_text(of.singles),
            *_bigrams_text(of.bigrams.values(), boundary),
        ]
    )


def _head(of: BigramSet, boundary: float) -> list[str]:
    return [
        f'  "format": {quote(FORMAT)},',
        f'  "version": {VERSION},',
        f'  "name": {quote(of.name)},',
        f'  "about": {quote(of.about)},',
        f'  "phone_set": {quote(of.phone_set)},',
        f'  "boundary": {format_number(boundary)},',
    ]


def _phones_text(singles: Mapping[str, Curves]) -> list[str]:
    rows = _joined(f"    {quote(n)}: {_curves_text(c, '    ')}" for n, c in singles.items())
    return ['  "phones": {', *rows, "  },"]


def _bigrams_text(bigrams: Iterable[Bigram], boundary: float) -> list[str]:
    return ['  "bigrams": [', *_joined(_bigram_text(b, boundary) for b in bigrams), "  ]"]


def _lines_bytes(lines: list[str]) -> bytes:
    return ("\n".join(["{", *lines, "}"]) + "\n").encode()


def _joined(rows: Iterable[str]) -> list[str]:
    listed = list(rows)
    return [row + "," for row in listed[:-1]] + listed[-1:]


def _flat(fields: Mapping[str, str]) -> str:
    return "{" + ", ".join(f"{quote(name)}: {value}" for name, value in fields.items()) + "}"


def _value(value: float | str) -> str:
    return quote(value) if isinstance(value, str) else format_number(value)


def _rules_text(rules: Rules, indent: str) -> str:
    poses = (
        f"{indent}    "
        + _flat({field: _value(value) for field, value in msgspec.structs.asdict(pose).items()})
        for pose in rules.poses
    )
    conflicts = (
        f'{indent}    {{"poses": [{quote(c.poses[0])}, {quote(c.poses[1])}], '
        f'"threshold": {format_number(c.threshold)}}}'
        for c in rules.conflicts
    )
    settings = {n: _value(v) for n, v in msgspec.structs.asdict(rules.settings).items()}
    return "\n".join(
        [
            "{",
            f'{indent}  "poses": [',
            *_joined(poses),
            f"{indent}  ],",
            f'{indent}  "conflicts": [',
            *_joined(conflicts),
            f"{indent}  ],",
            f'{indent}  "settings": {_flat(settings)}',
            f"{indent}}}",
        ]
    )


def _curves_text(curves: Curves, indent: str) -> str:
    if not curves:
        return "{}"
    rows = (
        f"{indent}  {quote(pose)}: [" + ", ".join(format_row(pair) for pair in keys.pairs()) + "]"
        for pose, keys in curves.items()
    )
    return "\n".join(["{", *_joined(rows), f"{indent}}}"])


def _bigram_text(bigram: Bigram, boundary: float) -> str:
    head = f'    {{"pair": [{quote(bigram.pair[0])}, {quote(bigram.pair[1])}], '
    if bigram.word:
        head += f'"word": {quote(bigram.word)}, '
    if bigram.boundary != boundary:
        head += f'"boundary": {format_number(bigram.boundary)}, '
    return head + f'"curves": {_curves_text(bigram.curves, "    ")}}}'
