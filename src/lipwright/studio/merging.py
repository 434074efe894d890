"""Two hands on one file: what each changed since it was opened, and ours laid over theirs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from lipwright.engines.bigram.edits import Edit
from lipwright.engines.bigram.model import Rules
from lipwright.engines.bigram.overrides import Overrides
from lipwright.studio.state import OwnSet

K = TypeVar("K")
V = TypeVar("V")


def changed_names(known: Any, now: Any) -> dict[str, object]:
    """Return what differs between two states of a document, by name, with its new value."""
    before, after = _named(known), _named(now)
    names = dict.fromkeys((*before, *after))
    return {name: after.get(name) for name in names if not _same(before.get(name), after.get(name))}


def _same(one: object, other: object) -> bool:
    return one is other or one == other


def same(one: Any, other: Any) -> bool:
    """Whether two states of a document say the same, in the same order."""
    if isinstance(one, tuple):
        return _same(one, other)
    return one is other or (
        list(_named(one)) == list(_named(other)) and not changed_names(one, other)
    )


def _named(of: Any) -> dict[str, object]:
    """Everything that a document says, by a name that a person understands."""
    if isinstance(of, OwnSet):
        return {**_drawn(of.bigrams, of.phones), **_rules(of.of.rules)}
    if isinstance(of, Overrides):
        said: dict[str, object] = dict(_drawn(of.bigrams, of.singles))
        said |= {f"gain of {pose}": gain for pose, gain in of.gains.items()}
        said |= {f"{field} of {p}": v for p, one in of.poses.items() for field, v in one.items()}
        said |= {f"threshold of {' and '.join(c.poses)}": c.threshold for c in of.conflicts}
        return said | dict(of.settings)
    if isinstance(of, tuple):
        return {getattr(one, "name", None) or f"{n}": one for n, one in enumerate(of)}
    return {}


def _drawn(bigrams: Mapping[Any, Any], phones: Mapping[str, Any]) -> dict[str, object]:
    drawn: dict[str, object] = {
        "-".join(pair): (one.curves, one.boundary, one.word) for pair, one in bigrams.items()
    }
    return drawn | {f"phone {label}": curves for label, curves in phones.items()}


def _rules(rules: Rules) -> dict[str, object]:
    said: dict[str, object] = {f"pose {pose.name}": pose for pose in rules.poses}
    said |= {f"threshold of {' and '.join(c.poses)}": c.threshold for c in rules.conflicts}
    return said | {"settings": rules.settings}


def laid_over(known: Any, ours: Any, theirs: Any) -> Any:
    """Return their state of a document with our changes since the known one over it."""
    if isinstance(theirs, OwnSet):
        return _sets(known, ours, theirs)
    if isinstance(theirs, Overrides):
        return _overrides(known, ours, theirs)
    return _edits(known, ours, theirs)


def _sets(known: OwnSet, ours: OwnSet, theirs: OwnSet) -> OwnSet:
    bigrams = _merged(known.bigrams, ours.bigrams, theirs.bigrams)
    phones = _merged(known.phones, ours.phones, theirs.phones)
    base = theirs.base
    rules = theirs.of.rules if ours.of.rules == known.of.rules else ours.of.rules
    of = replace(
        theirs.of,
        bigrams={**(base.bigrams if base else {}), **bigrams},
        singles={**(base.singles if base else {}), **phones},
        rules=rules,
    )
    return replace(theirs, of=of, bigrams=bigrams, phones=phones)


def _overrides(known: Overrides, ours: Overrides, theirs: Overrides) -> Overrides:
    merged: dict[str, Any] = {
        name: _merged(getattr(known, name), getattr(ours, name), getattr(theirs, name))
        for name in ("bigrams", "singles", "gains", "poses", "settings")
    }
    conflicts = _merged(
        *({frozenset(c.poses): c for c in o.conflicts} for o in (known, ours, theirs))
    )
    return replace(theirs, **merged, conflicts=tuple(conflicts.values()))


def _merged(known: Mapping[K, V], ours: Mapping[K, V], theirs: Mapping[K, V]) -> dict[K, V]:
    result = dict(theirs)
    for name, value in ours.items():
        if name not in known or not _same(value, known[name]):
            result[name] = value
    for name in known:
        if name not in ours:
            result.pop(name, None)
    return result


def _edits(known: Sequence[Edit], ours: Sequence[Edit], theirs: Sequence[Edit]) -> tuple[Edit, ...]:
    named = ({edit.name: edit for edit in edits} for edits in (known, ours, theirs))
    return tuple(_merged(*named).values())
