"""``python -m tools.crab``: writes ``src/lipwright/data/sets/crab.json`` anew."""

from __future__ import annotations

from pathlib import Path

import msgspec

from lipwright.curves import Keys
from lipwright.engines.bigram.model import (
    PUBLISHED,
    Bigram,
    BigramSet,
    Conflict,
    Pose,
    Rules,
    Settings,
)
from lipwright.engines.bigram.set_file import set_bytes
from lipwright.files import write_atomically
from lipwright.phones import load_phone_set
from tools.crab.draw import HAND
from tools.crab.knowledge import CLOSING, CONFLICTS, PRIORITY
from tools.english.knowledge import WORDS

TARGET = Path(__file__).parents[2] / "src" / "lipwright" / "data" / "sets" / "crab.json"
ABOUT = (
    "A crab speaks English: all 483 pairs of the Common Phoneme Set in the poses of the built-in "
    "crab, drawn by tools/crab."
)
FAST = tuple(CLOSING.values())
# What is light may go faster: mandibles and tongue before the plate.
LIMIT = {"stalks_up": 6.0, "mandibles_in": 30.0, "bite": 25.0, "mandibles_out": 20.0}
WINDOW = {"stalks_up": 0.25, "mouth_OO": 0.20, "smile": 0.16, "frown": 0.18, "mandibles_out": 0.14}
SOFTNESS = {
    "stalks_up": 0.12,
    "mouth_open": 0.05, "mouth_OO": 0.08, "smile": 0.06, "frown": 0.07, "bare_teeth": 0.04,
    "mandibles_out": 0.05, "bite": 0.012, "mandibles_in": 0.012,
}  # fmt: skip


def rules() -> Rules:
    """Return the rules of the preset ``default``."""
    poses = tuple(
        Pose(
            name,
            priority,
            meets="widen" if name in FAST else "cut",
            limit=LIMIT.get(name, 15.0),
            window=WINDOW.get(name, 0.10),
            softness=SOFTNESS.get(name, 0.03),
        )
        for priority, name in enumerate(PRIORITY, 1)
    )
    conflicts = tuple(Conflict((low, high), threshold) for low, high, threshold in CONFLICTS)
    return Rules(poses, conflicts, Settings())


def published(base: Rules) -> Rules:
    """Return the rules of the preset ``published``: sections 3.2.1 to 3.2.3.

    Its literal bound caps a pose where the other is absent, too: only closures have one.
    """
    poses = tuple(
        msgspec.structs.replace(pose, meets="cut", limit=15.0, softness=0.0) for pose in base.poses
    )
    conflicts = tuple(Conflict(("mouth_open", name), 0.5) for name in ("bite", "mandibles_in"))
    return Rules(poses, conflicts, PUBLISHED)


def crab() -> BigramSet:
    """Return the whole set."""
    classes = load_phone_set("common").labels
    base = rules()
    empty = BigramSet("crab", "common", base, {})
    bigrams = {
        pair: Bigram(
            pair,
            {pose: Keys.of(points) for pose, points in HAND.curves(*pair).items()},
            word=WORDS.get(pair, ""),
            source="crab",
        )
        for pair in empty.needed(classes)
    }
    singles = {
        label: {pose: Keys.of(points) for pose, points in HAND.single(label).items()}
        for label in classes
    }
    presets = {"published": published(base)}
    return BigramSet("crab", "common", base, bigrams, singles, dict(CLOSING), presets, ABOUT)


if __name__ == "__main__":
    write_atomically(TARGET, set_bytes(crab()))
    print(f"{TARGET.name}: {len(crab().bigrams)} bigrams")
