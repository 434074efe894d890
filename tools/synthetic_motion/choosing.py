"""Which sentences: those that show the most pairs of phones in the least time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

from lipwright.phones import SILENCE
from tools.synthetic_motion.speaking import Spoken

WORTH = (1.0, 0.5, 0.25)
"""Of a pair's first occurrence, of its second, of its third."""
REST = 2.0
"""How much more a pair with silence is worth: each line is seen to open and to close."""
FEWEST = 10
"""Of a phone; until there are so many, each more is worth as much as a new pair."""


def cover(lines: Sequence[Spoken], seconds: float) -> list[Spoken]:
    """Choose lines greedily by what each adds per second said, while they fit; in their order."""
    pairs: Counter[tuple[str, str]] = Counter()
    phones: Counter[str] = Counter()
    left, chosen, time = list(lines), list[Spoken](), 0.0
    while fitting := [line for line in left if time + line.seconds <= seconds]:
        best = max(fitting, key=lambda line: _worth(line, pairs, phones) / line.said)
        labels = _labels(best)
        pairs.update(pairwise(labels))
        phones.update(labels)
        left.remove(best)
        chosen.append(best)
        time += best.seconds
    return [line for line in lines if line in chosen]


def _labels(line: Spoken) -> list[str]:
    return [phone.label for phone in line.phones]


def _worth(line: Spoken, pairs: Counter[tuple[str, str]], phones: Counter[str]) -> float:
    """What a line adds to pairs and phones that are there."""
    labels = _labels(line)
    new_pairs, new_phones = Counter(pairwise(labels)), Counter(labels)
    worth = 0.0
    for pair, count in new_pairs.items():
        times = REST if SILENCE in pair else 1.0
        worth += times * sum(WORTH[pairs[pair] : pairs[pair] + count])
    for phone, count in new_phones.items():
        worth += min(count, max(0, FEWEST - phones[phone]))
    return worth
