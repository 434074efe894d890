"""``python -m tools.english``: writes ``src/lipwright/data/sets/english.json`` anew."""

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
from tools.english.draw import HAND
from tools.english.knowledge import CLOSING, TONGUE, WORDS

TARGET = Path(__file__).parents[2] / "src" / "lipwright" / "data" / "sets" / "english.json"
ABOUT = (
    "English, all 483 pairs of the Common Phoneme Set, drawn from phonetic knowledge by "
    "tools/english. Poses are FaceFX's nine."
)
PRIORITY = ("open", "W", "wide", "ShCh", "FV", "PBM", *TONGUE)
FAST = ("PBM", "FV")
# Lips stay round from one rounded sound to the next; the jaw goes back up between vowels.
WINDOW = {"W": 0.22, "wide": 0.18, "ShCh": 0.18}
SOFTNESS = {"open": 0.07, "W": 0.10, "wide": 0.06, "ShCh": 0.05, "PBM": 0.012, "FV": 0.012}


def rules() -> Rules:
    """Return the rules of the preset ``default``."""
    poses = tuple(
        Pose(
            name,
            priority,
            meets="widen" if name in FAST else "cut",
            limit=25.0 if name in FAST else 15.0,
            window=WINDOW.get(name, 0.10),
            softness=SOFTNESS.get(name, 0.03),
        )
        for priority, name in enumerate(PRIORITY, 1)
    )
    conflicts = (Conflict(("open", "FV"), 0.5), Conflict(("open", "PBM"), 0.5))
    return Rules(poses, conflicts, Settings())


def published(base: Rules) -> Rules:
    """Return the rules of the preset ``published``: sections 3.2.1 to 3.2.3."""
    poses = tuple(
        msgspec.structs.replace(pose, meets="cut", limit=15.0, softness=0.0) for pose in base.poses
    )
    conflicts = tuple(Conflict(("open", name), 0.5) for name in ("FV", "PBM", "ShCh"))
    return Rules(poses, conflicts, PUBLISHED)


def english() -> BigramSet:
    """Return the whole set."""
    classes = load_phone_set("common").labels
    base = rules()
    empty = BigramSet("english", "common", base, {})
    bigrams = {
        pair: Bigram(
            pair,
            {pose: Keys.of(points) for pose, points in HAND.curves(*pair).items()},
            word=WORDS.get(pair, ""),
            source="english",
        )
        for pair in empty.needed(classes)
    }
    singles = {
        label: {pose: Keys.of(points) for pose, points in HAND.single(label).items()}
        for label in classes
    }
    return BigramSet(
        "english",
        "common",
        base,
        bigrams,
        singles,
        dict(CLOSING),
        {"published": published(base)},
        ABOUT,
    )


if __name__ == "__main__":
    write_atomically(TARGET, set_bytes(english()))
    print(f"{TARGET.name}: {len(english().bigrams)} bigrams")
