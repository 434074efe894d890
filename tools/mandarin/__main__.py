"""``python -m tools.mandarin``: writes ``src/lipwright/data/sets/mandarin.json`` anew."""

from __future__ import annotations

from dataclasses import replace

from lipwright.engines.bigram.model import BigramSet
from lipwright.engines.bigram.set_file import set_bytes
from lipwright.files import write_atomically
from lipwright.phones import load_phone_set
from tools.drawn_sets import FOLDER, bigrams, singles
from tools.english.__main__ import english
from tools.english.draw import HAND
from tools.mandarin.knowledge import SOUNDS, WORDS

TARGET = FOLDER / "mandarin.json"
_HAND = replace(HAND, sounds=SOUNDS)
ABOUT = (
    "Mandarin: the English set and the 45 pairs of ü (43 among sounds, 2 with silence), drawn "
    "from phonetic knowledge by tools/mandarin."
)


def mandarin() -> BigramSet:
    """Return the whole set: the pairs of the English one, and those that hold ``yu``."""
    base = english()
    new = [
        pair for pair in base.needed(load_phone_set("mandarin").labels) if pair not in base.bigrams
    ]
    drawn = bigrams(_HAND, new, WORDS, "mandarin")
    return replace(
        base,
        name="mandarin",
        phone_set="mandarin",
        bigrams={**base.bigrams, **drawn},
        singles={**base.singles, **singles(_HAND, ["yu"])},
        about=ABOUT,
    )


if __name__ == "__main__":
    write_atomically(TARGET, set_bytes(mandarin(), base=english()))
    print(f"{TARGET.name}: {len(mandarin().bigrams) - len(english().bigrams)} bigrams")
