"""What every tool that draws a bigram set does alike: rules, pairs, single curves."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path

import msgspec

from lipwright.curves import Keys
from lipwright.engines.bigram.model import (
    PUBLISHED,
    Bigram,
    Conflict,
    Curves,
    Pair,
    Pose,
    Rules,
    Settings,
)
from tools.drawing import Hand, Points

FOLDER = Path(__file__).parents[1] / "src" / "lipwright" / "data" / "sets"


def rules(
    priority: Sequence[str],
    conflicts: Iterable[Conflict],
    *,
    fast: Collection[str],
    limit: Mapping[str, float],
    window: Mapping[str, float],
    softness: Mapping[str, float],
) -> Rules:
    """Return the rules of the preset ``default``; ``fast`` poses are widened, others cut."""
    poses = tuple(
        Pose(
            name,
            place,
            meets="widen" if name in fast else "cut",
            limit=limit.get(name, 15.0),
            window=window.get(name, 0.10),
            softness=softness.get(name, 0.03),
        )
        for place, name in enumerate(priority, 1)
    )
    return Rules(poses, tuple(conflicts), Settings())


def published(base: Rules, conflicts: Iterable[Conflict]) -> Rules:
    """Return the rules of the preset ``published``: sections 3.2.1 to 3.2.3."""
    poses = tuple(
        msgspec.structs.replace(pose, meets="cut", limit=15.0, softness=0.0) for pose in base.poses
    )
    return Rules(poses, tuple(conflicts), PUBLISHED)


def bigrams(
    hand: Hand, pairs: Iterable[Pair], words: Mapping[Pair, str], source: str
) -> dict[Pair, Bigram]:
    """Draw pairs."""
    return {
        pair: Bigram(pair, _keys(hand.curves(*pair)), word=words.get(pair, ""), source=source)
        for pair in pairs
    }


def singles(hand: Hand, labels: Iterable[str]) -> dict[str, Curves]:
    """Draw the single-phone curves of classes."""
    return {label: _keys(hand.single(label)) for label in labels}


def _keys(drawn: Mapping[str, Points]) -> Curves:
    return {pose: Keys.of(points) for pose, points in drawn.items()}
