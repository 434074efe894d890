"""From levels to what an artist draws: keys of pairs, and of single phones."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from lipwright.curves import Keys
from lipwright.engines.bigram.fit.stretches import Floats, places
from lipwright.engines.bigram.model import Bigram, BigramSet, Curves, Pair
from lipwright.engines.bigram.stand_in import stand_in

LEAST = 0.02
"""A curve that stays below this is not drawn."""
STRAIGHT = 0.004
"""A key this close to the line of its neighbours is not drawn."""
PLACES_OF_PHONE = (-0.5, 0.0, 0.5, 1.0, 1.5)


def draw_pair(base: BigramSet, pair: Pair, levels: Mapping[str, Floats], name: str) -> Bigram:
    """Return a pair with new curves of some poses; the others stay the base's.

    Parameters
    ----------
    base : BigramSet
    pair : tuple of two str
    levels : mapping of str to (3,) float64
        For each new pose.
    name : str
        Of the new set.
    """
    old = base.bigrams.get(pair) or stand_in(base, pair)
    drawn: dict[str, Keys] = {}
    for pose in base.rules.names:
        if pose not in levels:
            if pose in old.curves:
                drawn[pose] = old.curves[pose]
        elif levels[pose].max() >= LEAST:
            values = np.concatenate(([0.0], levels[pose], [0.0]))
            drawn[pose] = few_keys(places(old.boundary), values)
    return Bigram(pair, drawn, old.boundary, old.word, name)


def draw_phone(base: BigramSet, label: str, levels: Mapping[str, Floats]) -> Curves:
    """Return a phone's own curves, with new ones of some poses."""
    old = base.singles.get(label, {})
    drawn: dict[str, Keys] = {}
    for pose in base.rules.names:
        if pose not in levels:
            if pose in old:
                drawn[pose] = old[pose]
        elif levels[pose].max() >= LEAST:
            values = np.concatenate(([0.0], levels[pose], [0.0]))
            drawn[pose] = few_keys(np.array(PLACES_OF_PHONE), values)
    return drawn


def few_keys(times: Sequence[float] | Floats, values: Floats) -> Keys:
    """Return keys of three decimals, without those that the line of the others passes."""
    kept = [(float(t), round(float(v), 3)) for t, v in zip(times, values, strict=True)]
    while len(kept) > 2:
        off = [
            abs(v - np.interp(t, (kept[i][0], kept[i + 2][0]), (kept[i][1], kept[i + 2][1])))
            for i, (t, v) in enumerate(kept[1:-1])
        ]
        least = int(np.argmin(off))
        if off[least] > STRAIGHT:
            break
        del kept[least + 1]
    return Keys.of(kept)
