"""Coverage: which pairs lines need, which of them a set has, and what to draw next.

Section 3.1.1 of Xu et al. 2013: running speech uses pairs very unequally, so a set that
is drawn in the order of their frequency serves most of it early. Nothing here reads
text or sound: lines come as phones (:mod:`lipwright.pipeline` brings them). The picture
is in :mod:`~lipwright.engines.bigram.coverage_picture`.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from itertools import accumulate
from typing import Literal

from lipwright.engines.bigram.model import BigramSet, Pair
from lipwright.engines.bigram.tally import Nearest, Tally, Unit, has_curve
from lipwright.phones import SILENCE, PhoneTrack, load_phone_set
from lipwright.speech import Speech

State = Literal["drawn", "stand-in", "no curve"]


@dataclass(frozen=True, slots=True)
class Need:
    """A pair that lines need.

    Attributes
    ----------
    pair : tuple of two str
    amount : float
        How often it occurs, or how many seconds.
    share : float
        The same as a share of all pairs, 0..1.
    cumulative : float
        Share of this pair and all that are needed more.
    state : {"drawn", "stand-in", "no curve"}
        Whether the set has it; or it is made from its two phones' single curves; or one
        of them has none, and the mouth does not move for it.
    word : str
        A word, or two neighbours, of the lines in which it occurs.
    nearest : float
        Share of its occurrences in which a phone's class is only the nearest one, 0..1.
    """

    pair: Pair
    amount: float
    share: float
    cumulative: float
    state: State
    word: str = ""
    nearest: float = 0.0


@dataclass(frozen=True, slots=True)
class Step:
    """A pair to draw, and the share of the lines that is drawn when it is, 0..1."""

    need: Need
    covered: float


@dataclass(frozen=True, slots=True)
class Coverage:
    """How well a set serves some lines, or how complete it is.

    Attributes
    ----------
    needed : dict of pair to float
        How often each pair is needed (int), or for how many seconds, most first; once
        each for a whole set.
    missing : tuple of pair
        Those that the set lacks, most needed first: each is made from single phones.
    bare : tuple of str
        Classes of those that have no single-phone curve either, silence left out.
    classes : tuple of str
        Of the set, in the order of its phone set.
    undrawn : frozenset of pair
        Pairs that the set lacks, needed or not.
    silence : bool
        Whether pairs with silence count.
    within_words : bool
        Whether only pairs inside one word count.
    by : {"count", "time"}
        What ``needed`` holds.
    lines, phones : int
        How many were read, silences left out.
    words : dict of pair to str
        Where each pair occurs: in a word, or else in two neighbours.
    nearest : dict of pair to float
        How much of a pair's amount has a phone whose class is only the nearest one.
    nearest_phones : dict of str to Nearest
        Those phones, most frequent first.
    notes : tuple of str
        What was left out of the lines, and why.
    """

    needed: dict[Pair, float]
    missing: tuple[Pair, ...]
    bare: tuple[str, ...]
    classes: tuple[str, ...] = ()
    undrawn: frozenset[Pair] = frozenset()
    silence: bool = True
    within_words: bool = False
    by: Unit = "count"
    lines: int = 0
    phones: int = 0
    words: dict[Pair, str] = field(default_factory=dict)
    nearest: dict[Pair, float] = field(default_factory=dict)
    nearest_phones: dict[str, Nearest] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def total(self) -> float:
        """How many pairs there are in all, or for how many seconds they last."""
        return sum(self.needed.values())

    @property
    def share(self) -> float:
        """Share of the needed pairs, by frequency, that the set has: 0..1."""
        total = self.total
        return 1 - sum(self.needed[pair] for pair in self.missing) / total if total else 1.0

    @property
    def possible(self) -> tuple[Pair, ...]:
        """All pairs that could be needed, in the order of the phone set."""
        classes = [label for label in self.classes if self.silence or label != SILENCE]
        return tuple((a, b) for a in classes for b in classes if not a == b == SILENCE)

    def state(self, pair: Pair) -> State:
        """Return how the set serves a pair."""
        if pair not in self.undrawn:
            return "drawn"
        return "no curve" if set(pair) & set(self.bare) else "stand-in"

    def needs(self) -> tuple[Need, ...]:
        """Return the needed pairs, most needed first."""
        return tuple(self._needs())

    def _needs(self) -> Iterator[Need]:
        total, so_far = self.total, 0.0
        for pair, amount in self.needed.items():
            so_far += amount
            yield Need(
                pair,
                amount,
                amount / total,
                min(so_far / total, 1.0),
                self.state(pair),
                self.words.get(pair, ""),
                self.nearest.get(pair, 0.0) / amount,
            )

    def order(self) -> tuple[Step, ...]:
        """Return the missing pairs in the order in which to draw them.

        Each step gains the most that a single pair can: pairs do not depend on each
        other, so no other order covers more after any number of steps.
        """
        left = [need for need in self._needs() if need.state != "drawn"]
        covered = accumulate((need.share for need in left), initial=self.share)
        next(covered)
        return tuple(Step(need, min(done, 1.0)) for need, done in zip(left, covered, strict=True))

    def share_of_first(self, count: int) -> float:
        """Return the share of the ``count`` most needed pairs, 0..1."""
        first = list(self.needed.values())[:count]
        return sum(first) / self.total if first else 0.0

    def pairs_for(self, share: float) -> int:
        """Return how many of the most needed pairs make up a share, 0..1, of all."""
        needs = self._needs()
        return sum(1 for need in needs if need.cumulative - need.share < share - 1e-12)


def coverage(
    of: BigramSet,
    lines: Iterable[PhoneTrack | Speech] | None = None,
    reduction: str | None = None,
    *,
    within_words: bool = False,
    silence: bool = True,
    by: Unit = "count",
) -> Coverage:
    """Return which pairs are needed and which of them a set lacks.

    Parameters
    ----------
    of : BigramSet
    lines : iterable of PhoneTrack or Speech, optional
        The lines to be animated, read one after the other; without them every pair of
        classes counts once.
    reduction : str, optional
        Path of a reduction file of the user's.
    within_words : bool
        Count only pairs of one word; else across words as well, as in Table 2.
    silence : bool
        Count pairs into and out of silence. Table 2 leaves them out. Phones on both
        sides of a pause are no neighbours either way.
    by : {"count", "time"}
        Count occurrences, or the seconds of speech that are a pair's: half of its two
        phones' time, so that no instant counts twice.

    Raises
    ------
    LabelError
        If a phone has no class in the set, or words are asked for where there are none.
    """
    phone_set = load_phone_set(of.phone_set)
    tally = Tally(of, reduction, within_words=within_words, silence=silence, by=by)
    if lines is None:
        every = of.needed(phone_set.labels)
        tally.amounts = {pair: 1 for pair in every if silence or SILENCE not in pair}
    else:
        for line in lines:
            tally.add(line)
    needed = tally.most_needed(phone_set.labels)
    missing = tuple(pair for pair in needed if pair not in of.bigrams)
    labels = {label for pair in missing for label in pair}
    return Coverage(
        needed,
        missing,
        tuple(c for c in phone_set.labels if c in labels and not has_curve(of, c)),
        phone_set.labels,
        frozenset(p for p in of.needed(phone_set.labels) if p not in of.bigrams),
        silence,
        within_words,
        by,
        tally.lines,
        tally.phones,
        tally.words,
        tally.nearest,
        tally.nearest_phones(),
    )
