"""Coverage: which pairs lines need, which of them a set has, and what is missing most."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass

from lipwright.engines.bigram.classes import reduction_for
from lipwright.engines.bigram.model import BigramSet, Pair
from lipwright.engines.bigram.preparation import prepare
from lipwright.phones import PhoneTrack, load_phone_set


@dataclass(frozen=True, slots=True)
class Coverage:
    """How well a set serves some lines, or how complete it is.

    Attributes
    ----------
    needed : dict of pair to int
        How often each pair is needed, most frequent first; once each for a whole set.
    missing : tuple of pair
        Those that the set lacks, most frequent first: each is made from single phones.
    bare : tuple of str
        Classes that have no single-phone curve either.
    """

    needed: dict[Pair, int]
    missing: tuple[Pair, ...]
    bare: tuple[str, ...]

    @property
    def share(self) -> float:
        """Share of the needed pairs, by frequency, that the set has: 0..1."""
        total = sum(self.needed.values())
        if not total:
            return 1.0
        return 1 - sum(self.needed[pair] for pair in self.missing) / total


def coverage(
    of: BigramSet, lines: Iterable[PhoneTrack] | None = None, reduction: str | None = None
) -> Coverage:
    """Return which pairs are needed and which of them a set lacks.

    Parameters
    ----------
    of : BigramSet
    lines : iterable of PhoneTrack, optional
        The lines to be animated; without them every pair of classes counts once.
    reduction : str, optional
        Path of a reduction file of the user's.
    """
    classes = load_phone_set(of.phone_set).labels
    counts: Counter[Pair] = Counter()
    if lines is None:
        counts.update(of.needed(classes))
    else:
        settings = of.rules.settings
        for track in lines:
            rows, _ = reduction_for(of, track.phone_set, reduction).rows(track)
            spans = prepare(rows, settings.padding, settings.silence_reach)
            counts.update(spans.pairs)
    needed = dict(counts.most_common())
    missing = tuple(pair for pair in needed if pair not in of.bigrams)
    labels = {label for pair in missing for label in pair}
    bare = tuple(label for label in classes if label in labels and label not in of.singles)
    return Coverage(needed, missing, bare)
