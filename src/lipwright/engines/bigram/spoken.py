"""When an override spoke: who changed a curve or a number, and what the set alone would do.

Part of :mod:`~lipwright.engines.bigram.why`. The set beneath the overrides is animated
too, with the same phones and edits: that is the value it would have had.
"""

from __future__ import annotations

from functools import lru_cache

from lipwright.engines.bigram.engine import BigramEngine, Solved
from lipwright.engines.bigram.model import Bigram, BigramSet, Pair
from lipwright.engines.bigram.stand_in import STAND_IN, stand_in


def who_drew(of: BigramSet, bigram: Bigram, pose: str) -> str:
    """Return which overrides made a pair's curve of a pose what it is; nothing if none did."""
    said: list[str] = []
    for layer in of.layers:
        if bigram.pair in layer.pairs:
            said = [layer.title]
        elif bigram.source == STAND_IN and layer.phones & set(bigram.pair):
            said.append(layer.title)
        if layer.gains.get(pose, 1.0) != 1:
            times = f"times {layer.gains[pose]:g}"
            said.append(times if said and said[-1] == layer.title else f"{times} by {layer.title}")
    return ", ".join(said)


def who_set(engine: BigramEngine, pose: str, field: str) -> str:
    """Return whose a number of a pose is, and what the set itself says; nothing if its own."""
    own = engine.of.beneath
    if own is None or engine.preset != "default":
        return ""
    named = [layer for layer in engine.of.layers if field in layer.poses.get(pose, {})]
    if not named:
        return ""
    return f" ({named[-1].title}; {own.name} itself says {getattr(own.rules.pose(pose), field):g})"


def who_bound(engine: BigramEngine, one: str, other: str) -> str:
    """Return whose the threshold of two poses is; nothing if it is the set's own."""
    poses = frozenset((one, other))
    named = [layer for layer in engine.of.layers if poses in layer.thresholds]
    return f", {named[-1].title}" if named and engine.preset == "default" else ""


def own_bigram(of: BigramSet, pair: Pair) -> Bigram | None:
    """Return the pair as the set itself has it; None where nothing is overridden."""
    if of.beneath is None:
        return None
    return of.beneath.bigrams.get(pair) or stand_in(of.beneath, pair)


def value_alone(engine: BigramEngine, solved: Solved, control: str, time: float) -> float | None:
    """Return what the set without overrides would show; None where there are none."""
    own = engine.beneath
    if own is None or solved.track is None:
        return None
    column = own.rules.names.index(control)
    return float(own.sample(_alone(own, solved), time, 1, 60.0)[0, column])


@lru_cache(maxsize=2)
def _alone(own: BigramEngine, solved: Solved) -> Solved:
    assert solved.track is not None
    return own.solve(solved.track, solved.words, [one.edit for one in solved.edits])
