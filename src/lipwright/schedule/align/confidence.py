"""How sure an alignment is: goodness of pronunciation, and what it means.

Per phone the mean, over its frames, of how much better or worse its own states fit the
sound than the best of all phones without context (Witt & Young 2000). Right words lie
near 0 (-3 for synthetic voices), wrong ones below -4. In words and lines each phone
counts once, however long: wrong words fit worst in their short phones. The mapping to 0..1
is a logistic function for phones, words and lines each; its constants were set where right
texts, on synthetic voices too, and exchanged ones meet.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from lipwright.schedule.align.heard import Heard
from lipwright.schedule.align.model import STATES
from lipwright.schedule.align.viterbi import Stretch

# (margin at which right and wrong are as likely, steepness), nats per frame
_PHONE = (-3.5, 0.8)
_WORD = (-3.9, 1.2)
_LINE = (-3.9, 2.5)
DOUBTFUL = 0.5
# A pause as long, and as unlike silence, is sound that the words do not account for.
_UNACCOUNTED = (0.3, -5.0)
_USUAL = 0.1  # s of such sound that count as much as a phone


def margins(
    path: Iterable[Stretch],
    scores: NDArray[np.float32],
    columns: NDArray[np.int64],
    best: NDArray[np.float32],
) -> tuple[float, ...]:
    """Return, for each phone of a path, its mean margin in nats per frame.

    Parameters
    ----------
    path : iterable of Stretch
    scores : (T, U) float32
        Log likelihoods of the states.
    columns : (S,) int
        Column of each state of the network.
    best : (T,) float32
        Log likelihood of the best phone of all.
    """
    result = []
    for stretch in path:
        frames = slice(stretch.start, stretch.end)
        states = columns[STATES * stretch.node : STATES * stretch.node + STATES]
        own = scores[frames][:, states].max(axis=1)
        result.append(float((own - best[frames]).mean()))
    return tuple(result)


def phone_confidence(phone: Heard) -> float:
    """Return how sure a phone is, 0..1."""
    return _logistic(phone.margin, _PHONE)


def word_confidence(phones: Iterable[Heard]) -> float:
    """Return how sure a word of these phones is, 0..1."""
    return _logistic(mean_margin(phones), _WORD)


def line_confidence(phones: Iterable[Heard]) -> float:
    """Return how sure a line of these phones is, 0..1."""
    return _logistic(mean_margin(phones), _LINE)


def mean_margin(phones: Iterable[Heard]) -> float:
    """Return the mean margin of the phones; minus infinity if there are none.

    Sound that the words do not account for belongs to it, by its length.
    """
    speech = [
        (p.margin, (p.end - p.start) / _USUAL if p.is_pause else 1.0)
        for p in phones
        if not p.is_pause or is_unaccounted(p)
    ]
    total = sum(weight for _, weight in speech)
    return sum(m * weight for m, weight in speech) / total if total else -math.inf


def is_unaccounted(phone: Heard) -> bool:
    """Whether a pause is rather sound that the words do not account for."""
    seconds, margin = _UNACCOUNTED
    return phone.is_pause and phone.end - phone.start > seconds and phone.margin < margin


def _logistic(margin: float, constants: tuple[float, float]) -> float:
    middle, steepness = constants
    return round(1 / (1 + math.exp(min(60.0, -steepness * (margin - middle)))), 3)
