"""Bigram sets, overrides and edits as text: stable order, one key list per line (DESIGN section 8).

What an animator did is then what a version-control diff shows. Reading is in
:mod:`~lipwright.engines.bigram.set_file`, :mod:`~lipwright.engines.bigram.overrides` and
:mod:`~lipwright.engines.bigram.edits`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import msgspec

from lipwright.engines.bigram.documents import (
    OVERRIDES_FORMAT,
    SET_FORMAT,
    BigramEntry,
    KeyList,
    OverridesDocument,
    SetDocument,
)
from lipwright.engines.bigram.edits import FORMAT as EDITS_FORMAT
from lipwright.engines.bigram.edits import Edit
from lipwright.engines.bigram.model import BigramSet, Conflict, Curves, Rules
from lipwright.files import format_number, format_row, quote

VERSION = 1


def set_bytes(of: BigramSet, boundary: float = 0.5, base: BigramSet | None = None) -> bytes:
    """Return the content of a set's file.

    Parameters
    ----------
    of : BigramSet
    boundary : float
        Of bigrams that do not say their own.
    base : BigramSet, optional
        A set that comes with Lipwright: only pairs and phones that it lacks are written.
    """
    known = base.bigrams if base is not None else {}
    singles = base.singles if base is not None else {}
    return set_document_bytes(
        SetDocument(
            VERSION,
            of.name,
            [
                BigramEntry(pair, _lists(b.curves), b.boundary, b.word)
                for pair, b in of.bigrams.items()
                if pair not in known
            ],
            of.rules if base is None else None,
            base.name if base is not None else "",
            of.about,
            of.phone_set,
            boundary,
            {name: _lists(curves) for name, curves in of.singles.items() if name not in singles},
            dict(of.reach) if base is None else {},
            dict(of.presets) if base is None else {},
        )
    )


def _lists(curves: Curves) -> dict[str, KeyList]:
    return {pose: keys.pairs() for pose, keys in curves.items()}


def set_document_bytes(of: SetDocument) -> bytes:
    """Return the content of a set's file, as it says it itself."""
    lines = _head(SET_FORMAT, of.name, of.about)
    lines += [
        f'  "phone_set": {quote(of.phone_set)},',
        f'  "boundary": {format_number(of.boundary)},',
    ]
    if of.base:
        lines.append(f'  "base": {quote(of.base)},')
    if of.reach or of.rules is not None:
        lines.append(f'  "reach": {_flat({k: quote(v) for k, v in of.reach.items()})},')
    if of.rules is not None:
        lines.append(f'  "rules": {_rules_text(of.rules, "  ")},')
    if of.presets or of.rules is not None:
        presets = (f"    {quote(n)}: {_rules_text(r, '    ')}" for n, r in of.presets.items())
        lines += ['  "presets": {', *_joined(presets), "  },"]
    if of.phones or of.rules is not None:
        lines += _phones_text(of.phones)
    return _whole([*lines, *_bigrams_text(of.bigrams, of.boundary)])


def overrides_bytes(of: OverridesDocument) -> bytes:
    """Return the content of an override file: only what it says."""
    lines = _head(OVERRIDES_FORMAT, of.name, of.about)
    if of.boundary != 0.5:
        lines.append(f'  "boundary": {format_number(of.boundary)},')
    if of.gains:
        lines.append(f'  "gains": {_flat({k: format_number(v) for k, v in of.gains.items()})},')
    if of.poses:
        rows = (f"    {quote(name)}: {_fields(one)}" for name, one in of.poses.items())
        lines += ['  "poses": {', *_joined(rows), "  },"]
    if of.conflicts:
        lines += ['  "conflicts": [', *_joined(_conflicts_text(of.conflicts, "    ")), "  ],"]
    if of.settings:
        lines.append(f'  "settings": {_fields(of.settings)},')
    if of.phones:
        lines += _phones_text(of.phones)
    return _whole([*lines, *_bigrams_text(of.bigrams, of.boundary)])


def edits_bytes(edits: Sequence[Edit], about: str = "") -> bytes:
    """Return the content of a file of edits: one edit per line, only what it says."""
    rows = []
    for edit in edits:
        said = msgspec.to_builtins(edit)
        place = {name: said.pop(name) for name in ("word", "occurrence", "phone", "label", "pose")}
        kept = {name: value for name, value in said.items() if value != _UNSAID[name]}
        rows.append("    " + _fields({**place, **kept}))
    lines = [f'  "format": {quote(EDITS_FORMAT)},', f'  "version": {VERSION},']
    if about:
        lines.append(f'  "about": {quote(about)},')
    return _whole([*lines, '  "edits": [', *_joined(rows), "  ]"])


_UNSAID = {"gain": 1.0, "level": None, "hold": 0.0, "keys": None, "unlocked": False}


def _head(kind: str, name: str, about: str) -> list[str]:
    return [
        f'  "format": {quote(kind)},',
        f'  "version": {VERSION},',
        f'  "name": {quote(name)},',
        f'  "about": {quote(about)},',
    ]


def _whole(lines: list[str]) -> bytes:
    return ("\n".join(["{", *lines, "}"]) + "\n").encode()


def _joined(rows: Iterable[str]) -> list[str]:
    listed = list(rows)
    return [row + "," for row in listed[:-1]] + listed[-1:]


def _flat(fields: Mapping[str, str]) -> str:
    return "{" + ", ".join(f"{quote(name)}: {value}" for name, value in fields.items()) + "}"


def _fields(fields: Mapping[str, Any]) -> str:
    return _flat({name: _value(value) for name, value in fields.items()})


def _value(value: Any) -> str:
    if isinstance(value, str):
        return quote(value)
    if isinstance(value, bool) or value is None:
        return {True: "true", False: "false", None: "null"}[value]
    if isinstance(value, int | float):
        return format_number(value)
    return "[" + ", ".join(format_row(row) for row in value) + "]"


def _phones_text(phones: Mapping[str, Mapping[str, KeyList]]) -> list[str]:
    rows = _joined(f"    {quote(n)}: {_curves_text(c, '    ')}" for n, c in phones.items())
    return ['  "phones": {', *rows, "  },"]


def _bigrams_text(bigrams: Iterable[BigramEntry], boundary: float) -> list[str]:
    return ['  "bigrams": [', *_joined(_bigram_text(b, boundary) for b in bigrams), "  ]"]


def _rules_text(rules: Rules, indent: str) -> str:
    poses = (f"{indent}    " + _fields(msgspec.structs.asdict(pose)) for pose in rules.poses)
    return "\n".join(
        [
            "{",
            f'{indent}  "poses": [',
            *_joined(poses),
            f"{indent}  ],",
            f'{indent}  "conflicts": [',
            *_joined(_conflicts_text(rules.conflicts, indent + "    ")),
            f"{indent}  ],",
            f'{indent}  "settings": {_fields(msgspec.structs.asdict(rules.settings))}',
            f"{indent}}}",
        ]
    )


def _conflicts_text(conflicts: Iterable[Conflict], indent: str) -> Iterable[str]:
    return (
        f'{indent}{{"poses": [{quote(c.poses[0])}, {quote(c.poses[1])}], '
        f'"threshold": {format_number(c.threshold)}}}'
        for c in conflicts
    )


def _curves_text(curves: Mapping[str, KeyList], indent: str) -> str:
    if not curves:
        return "{}"
    rows = (
        f"{indent}  {quote(pose)}: [" + ", ".join(format_row(pair) for pair in keys) + "]"
        for pose, keys in curves.items()
    )
    return "\n".join(["{", *_joined(rows), f"{indent}}}"])


def _bigram_text(entry: BigramEntry, boundary: float) -> str:
    head = f'    {{"pair": [{quote(entry.pair[0])}, {quote(entry.pair[1])}], '
    if entry.word:
        head += f'"word": {quote(entry.word)}, '
    if entry.boundary is not None and entry.boundary != boundary:
        head += f'"boundary": {format_number(entry.boundary)}, '
    return head + f'"curves": {_curves_text(entry.curves, "    ")}}}'
