"""``python -m tools.crab``: writes ``src/lipwright/data/sets/crab.json`` anew."""

from __future__ import annotations

from lipwright.engines.bigram.model import BigramSet, Conflict
from lipwright.engines.bigram.set_file import set_bytes
from lipwright.files import write_atomically
from lipwright.phones import load_phone_set
from tools.crab.draw import HAND
from tools.crab.knowledge import CLOSING, CONFLICTS, PRIORITY
from tools.drawn_sets import FOLDER, bigrams, published, rules, singles
from tools.english.knowledge import WORDS

TARGET = FOLDER / "crab.json"
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


def crab() -> BigramSet:
    """Return the whole set."""
    classes = load_phone_set("common").labels
    base = rules(
        PRIORITY,
        (Conflict((low, high), threshold) for low, high, threshold in CONFLICTS),
        fast=FAST,
        limit=LIMIT,
        window=WINDOW,
        softness=SOFTNESS,
    )
    # The literal bound caps a pose where the other is absent, too: only closures have one.
    as_printed = [Conflict(("mouth_open", name), 0.5) for name in ("bite", "mandibles_in")]
    empty = BigramSet("crab", "common", base, {})
    return BigramSet(
        "crab",
        "common",
        base,
        bigrams(HAND, empty.needed(classes), WORDS, "crab"),
        singles(HAND, classes),
        dict(CLOSING),
        {"published": published(base, as_printed)},
        ABOUT,
    )


if __name__ == "__main__":
    write_atomically(TARGET, set_bytes(crab()))
    print(f"{TARGET.name}: {len(crab().bigrams)} bigrams")
