"""The pairs of the 200 utterances: as a synthesiser speaks them, and as a dictionary says.

Both count as Table 2 of Xu et al. 2013 does: across words, silence left out, phones
reduced by its Table 1. Where the synthesiser pauses, neighbours are none; the dictionary
knows no pauses, so its phrases end at punctuation.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

from lipwright import corpus
from lipwright.corpus import Corpus
from lipwright.engines.bigram import load_set
from lipwright.engines.bigram.coverage import Coverage, coverage
from lipwright.phones import PhoneTrack
from lipwright.schedule.align.lexicon import pronounced
from lipwright.schedule.align.text import tokens
from lipwright.speech import Speech
from lipwright.timeline import Tier

UTTERANCES = Path(__file__).parents[2] / "docs" / "corpus" / "utterances.txt"
PHRASE_END = re.compile(r"[.,;:?!\"]+(?:\s|$)|\s\"")
PHONE = 0.1  # seconds: a dictionary knows no times, and only the order is counted


def utterances() -> list[str]:
    """Return the corpus, an utterance each."""
    return UTTERANCES.read_text(encoding="utf-8").splitlines()


def by_synthesiser() -> Coverage:
    """Count the phones that espeak-ng's American voice speaks."""
    spoken = Corpus(text_files=[UTTERANCES], voice="en-us", each_line=True)
    return corpus.coverage(corpus=spoken, silence=False)


def by_dictionary() -> Coverage:
    """Count the first pronunciations of the CMU dictionary."""
    return coverage(load_set("english"), _phrases(), silence=False)


def _phrases() -> Iterator[Speech]:
    for phrase in chain.from_iterable(PHRASE_END.split(text) for text in utterances()):
        if any(map(str.isalnum, phrase)):
            yield _as_written(phrase)


def _as_written(phrase: str) -> Speech:
    spoken, _ = pronounced(tokens(phrase))
    phones: list[tuple[str, float, float]] = []
    words: list[tuple[str, float, float]] = []
    for token in spoken:
        start = PHONE * len(phones)
        for ways in token.forms[0]:
            for label in ways[0]:
                phones.append((label, PHONE * len(phones), PHONE * (len(phones) + 1)))
        words.append((token.label, start, PHONE * len(phones)))
    return Speech(PhoneTrack(Tier.of(*phones)), Tier.of(*words))
