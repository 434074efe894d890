"""``python -m tools.english``: writes ``src/lipwright/data/sets/english.json`` anew."""

from __future__ import annotations

from lipwright.engines.bigram.model import BigramSet, Conflict
from lipwright.engines.bigram.set_file import set_bytes
from lipwright.files import write_atomically
from lipwright.phones import load_phone_set
from tools.drawn_sets import FOLDER, bigrams, published, rules, singles
from tools.english.draw import HAND
from tools.english.knowledge import CLOSING, TONGUE, WORDS

TARGET = FOLDER / "english.json"
ABOUT = (
    "English, all 483 pairs of the Common Phoneme Set, drawn from phonetic knowledge by "
    "tools/english. Poses are FaceFX's nine."
)
PRIORITY = ("open", "W", "wide", "ShCh", "FV", "PBM", *TONGUE)
FAST = ("PBM", "FV")
LIMIT = dict.fromkeys(FAST, 25.0)
# Lips stay round from one rounded sound to the next; the jaw goes back up between vowels.
WINDOW = {"W": 0.22, "wide": 0.18, "ShCh": 0.18}
SOFTNESS = {"open": 0.07, "W": 0.10, "wide": 0.06, "ShCh": 0.05, "PBM": 0.012, "FV": 0.012}


def english() -> BigramSet:
    """Return the whole set."""
    classes = load_phone_set("common").labels
    base = rules(
        PRIORITY,
        (Conflict(("open", "FV"), 0.5), Conflict(("open", "PBM"), 0.5)),
        fast=FAST,
        limit=LIMIT,
        window=WINDOW,
        softness=SOFTNESS,
    )
    as_printed = [Conflict(("open", name), 0.5) for name in ("FV", "PBM", "ShCh")]
    empty = BigramSet("english", "common", base, {})
    return BigramSet(
        "english",
        "common",
        base,
        bigrams(HAND, empty.needed(classes), WORDS, "english"),
        singles(HAND, classes),
        dict(CLOSING),
        {"published": published(base, as_printed)},
        ABOUT,
    )


if __name__ == "__main__":
    write_atomically(TARGET, set_bytes(english()))
    print(f"{TARGET.name}: {len(english().bigrams)} bigrams")
