"""The engine for what is open, kept up to date change by change.

Laying a character's gains over a whole set takes longer than a hand notices; of a change
only the pairs that became different are laid anew, and the engine keeps what it knows of
the others. What comes of it equals what
:func:`~lipwright.engines.bigram.overrides.lay_over` makes of the whole: a test holds this.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from lipwright.engines.bigram import BigramEngine
from lipwright.engines.bigram.model import BigramSet, Pair
from lipwright.engines.bigram.overrides import Overrides, lay_over, layer_of
from lipwright.studio.state import State


@dataclass(frozen=True, slots=True, eq=False)
class Parts:
    """What a character changes of the set: before the overrides that are open, and after them.

    A character's settings go last, over an override file of its own that is open.
    """

    before: tuple[Overrides, ...] = ()
    after: tuple[Overrides, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Cast:
    """A state made ready to animate.

    Parameters
    ----------
    state : State
    parts : Parts
    under : BigramSet
        The set with what lies beneath the overrides.
    of : BigramSet
        And with them, and what lies over them.
    engine : BigramEngine
    """

    state: State
    parts: Parts
    under: BigramSet
    of: BigramSet
    engine: BigramEngine


def cast(state: State, parts: Parts, preset: str, before: Cast | None = None) -> Cast:
    """Return a state made ready; ``before`` is one that it nearly equals.

    Raises
    ------
    SetError
        If layers name what the set has not, or rules cannot work.
    """
    own = state.own.of
    if before is not None and before.parts is not parts:
        before = None
    was = before.state if before is not None else None
    under = _laid(
        own,
        parts.before,
        (before.under, before.state.own.of) if before else None,
        parts.before,
    )
    of = _laid(
        under,
        (state.overrides, *parts.after),
        (before.of, before.under) if before else None,
        (was.overrides, *parts.after) if was else (),
    )
    if before is not None and of is before.of and before.engine.preset == preset:
        return replace(before, state=state)
    return Cast(
        state, parts, under, of, BigramEngine(of, preset, like=before.engine if before else None)
    )


def _laid(
    base: BigramSet,
    parts: Sequence[Overrides],
    before: tuple[BigramSet, BigramSet] | None,
    parts_before: Sequence[Overrides],
) -> BigramSet:
    """Lay parts over a base; ``before`` is what came of the last base, and that base."""
    saying = [part for part in parts if not part.says_nothing]
    if not saying:
        return base
    if before is None or not _alike(base, before[1], parts, parts_before):
        for part in saying:
            base = lay_over(base, part)
        return base
    changed = _different(base.bigrams, before[1].bigrams)
    for part, was in zip(parts, parts_before, strict=True):
        changed |= _different(part.bigrams, was.bigrams)
    if not changed and base is before[1] and all(map(_is, parts, parts_before)):
        return before[0]
    return _relaid(base, saying, before[0], changed)


def _is(one: object, other: object) -> bool:
    return one is other


def _alike(
    base: BigramSet, was: BigramSet, parts: Sequence[Overrides], before: Sequence[Overrides]
) -> bool:
    """Whether nothing but pairs and rules differs, so that others need not be laid anew."""
    if len(parts) != len(before) or base.singles is not was.singles:
        return False
    return all(
        part.gains == old.gains and part.singles is old.singles and not old.says_nothing
        for part, old in zip(parts, before, strict=True)
    )


def _different(one: Mapping[Pair, Any], other: Mapping[Pair, Any]) -> set[Pair]:
    if one is other:
        return set()
    changed = {pair for pair, bigram in one.items() if other.get(pair) is not bigram}
    return changed | {pair for pair in other if pair not in one}


def _relaid(
    base: BigramSet, parts: Sequence[Overrides], before: BigramSet, changed: set[Pair]
) -> BigramSet:
    small = replace(base, bigrams=_only(base.bigrams, changed), singles={})
    for part in parts:
        small = lay_over(small, replace(part, bigrams=_only(part.bigrams, changed), singles={}))
    bigrams = {p: b for p, b in before.bigrams.items() if p not in changed or p in small.bigrams}
    return replace(
        small,
        bigrams={**bigrams, **small.bigrams},
        singles=before.singles,
        layers=(*base.layers, *map(layer_of, parts)),
        beneath=base.beneath or base,
    )


def _only(bigrams: Mapping[Pair, Any], chosen: set[Pair]) -> dict[Pair, Any]:
    return {pair: bigrams[pair] for pair in chosen if pair in bigrams}
