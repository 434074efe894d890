"""Boundaries after decoding: stages that take phones and return the same phones, moved.

The decoder's clock ticks every 10 ms, and its model has habits: it lets phrases begin
too early and end too late, and leans to one side at some kinds of boundary. Each stage
corrects one of them; a further one is one more function in ``STAGES``. Where between two
phones the sound changes is found in :mod:`.boundaries`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lipwright.schedule.align.boundaries import located
from lipwright.schedule.align.features import RATE
from lipwright.schedule.align.heard import Heard

Phones = tuple[Heard, ...]
Stage = Callable[[Phones, NDArray[np.float32]], Phones]

_STEP = 80  # samples between two levels: 5 ms
_SHORTEST = 0.01  # s that a moved boundary leaves of a phone
_STOPS = frozenset(("p", "t", "k", "b", "d", "g", "ch", "jh"))
_CLOSURE = 0.08  # s; a shorter pause before a stop is its closure
_FIRST_CLOSURE = 0.06  # s, as long as :mod:`lipwright.schedule.say` makes it
_EDGE = 0.35  # of the way from the pause's level to the phrase's, in decibels
_OVERSHOOT = 0.04  # s that a phrase may reach beyond its decoded end

_KINDS = {
    "vowel": "aa ae ah ao aw ax ay eh er ey ih iy ow oy uh uw",
    "stop": "p t k b d g",
    "voiceless": "f th s sh hh",
    "voiced": "v dh z zh",
    "affricate": "ch jh",
    "nasal": "m n ng",
    "glide": "l r w y",
}
_KIND = {phone: kind for kind, phones in _KINDS.items() for phone in phones.split()}
# Seconds from our boundary to the one that hands marked: shrunk medians on TIMIT, of
# kinds that it has five or more of.
_BIAS = {
    ("glide", "glide"): 0.003,
    ("glide", "stop"): 0.002,
    ("glide", "vowel"): -0.010,
    ("nasal", "glide"): -0.005,
    ("nasal", "stop"): 0.004,
    ("nasal", "vowel"): -0.015,
    ("stop", "glide"): 0.011,
    ("stop", "nasal"): 0.014,
    ("stop", "stop"): 0.023,
    ("stop", "voiced"): 0.008,
    ("stop", "vowel"): 0.004,
    ("voiceless", "glide"): 0.012,
    ("voiceless", "stop"): 0.004,
    ("voiceless", "voiceless"): -0.010,
    ("voiceless", "vowel"): 0.005,
    ("vowel", "affricate"): 0.004,
    ("vowel", "glide"): 0.004,
    ("vowel", "stop"): 0.006,
    ("vowel", "voiced"): 0.003,
    ("vowel", "vowel"): -0.021,
}


def refine(
    phones: Phones, samples: NDArray[np.float32], stages: Sequence[Stage] | None = None
) -> Phones:
    """Return the phones with their boundaries corrected.

    Parameters
    ----------
    phones : tuple of Heard
        Without gaps, from 0 on.
    samples : (N,) float32
        The piece they lie in, at 16 kHz.
    stages : sequence of Stage, optional
        ``STAGES`` where they are not given.
    """
    for stage in STAGES if stages is None else stages:
        phones = stage(phones, samples)
    return phones


def closures(phones: Phones, samples: NDArray[np.float32]) -> Phones:
    """Give a short pause before a stop to the stop: it is its closure."""
    result: list[Heard] = []
    for phone in phones:
        if len(result) > 1 and phone.label in _STOPS and _is_closure(result[-1]):
            phone = replace(phone, start=result.pop().start)
        result.append(phone)
    return tuple(result)


def _is_closure(pause: Heard) -> bool:
    return pause.is_pause and pause.end - pause.start < _CLOSURE


def changes_of_sound(phones: Phones, samples: NDArray[np.float32]) -> Phones:
    """Move boundaries to where the sound changes from the one phone to the other."""
    edges = _edges(phones)
    edges[1:-1] = located([p.label for p in phones], np.array(edges[1:-1]), samples).tolist()
    return _with_edges(phones, edges)


def phrase_edges(phones: Phones, samples: NDArray[np.float32]) -> Phones:
    """Begin and end phrases where the sound rises from, and falls to, the pause's level."""
    level = _level(samples)
    edges = _edges(phones)
    for index, (before, phone) in enumerate(pairwise(phones), 1):
        if before.is_pause and not phone.is_pause:
            edges[index] = _rise(level, before, phone, _reach_right(phones, index))
        elif phone.is_pause and not before.is_pause:
            edges[index] = _fall(level, before, phone, _reach_left(phones, index - 1))
    return _with_edges(phones, edges)


def usual_bias(phones: Phones, samples: NDArray[np.float32]) -> Phones:
    """Take out what the model usually errs at a kind of boundary."""
    edges = _edges(phones)
    for index, (before, phone) in enumerate(pairwise(phones), 1):
        kinds = (_KIND.get(before.label, ""), _KIND.get(phone.label, ""))
        edges[index] += _BIAS.get(kinds, 0.0)
    return _with_edges(phones, edges)


def closures_after_pauses(phones: Phones, samples: NDArray[np.float32]) -> Phones:
    """Let a stop that begins a phrase start before its burst: nobody hears it close."""
    edges = _edges(phones)
    for index, (before, phone) in enumerate(pairwise(phones), 1):
        if before.is_pause and phone.label in _STOPS:
            edges[index] -= min(_FIRST_CLOSURE, 0.5 * (edges[index] - edges[index - 1]))
    return _with_edges(phones, edges)


STAGES: tuple[Stage, ...] = (closures, changes_of_sound, phrase_edges, usual_bias)
# Of other languages it is not known what hands mark, but what the synthesiser means.
OTHER_STAGES: tuple[Stage, ...] = (
    closures,
    changes_of_sound,
    phrase_edges,
    closures_after_pauses,
)


def _edges(phones: Sequence[Heard]) -> list[float]:
    return [*(phone.start for phone in phones), phones[-1].end]


def _with_edges(phones: Phones, edges: Sequence[float]) -> Phones:
    """Move the inner edges, each no further than leaves its neighbours a little."""
    result = list(phones)
    for index in range(1, len(result)):
        before, phone = result[index - 1], result[index]
        low, high = before.start + _SHORTEST, phone.end - _SHORTEST
        if low <= high:
            edge = min(max(edges[index], low), high)
            result[index - 1] = replace(before, end=edge)
            result[index] = replace(phone, start=edge)
    return tuple(result)


def _level(samples: NDArray[np.float32]) -> NDArray[np.float64]:
    """Return the level in decibels, every 5 ms over 10 ms."""
    squares = np.pad(np.square(samples.astype(np.float64) * 32767.0), _STEP)
    sums = np.add.reduceat(squares, np.arange(0, len(squares), _STEP))
    return np.asarray(10 * np.log10((sums[:-1] + sums[1:]) / (2 * _STEP) + 1.0))


def _at(time: float) -> int:
    return round(time * RATE / _STEP)


def _pause_level(level: NDArray[np.float64], pause: Heard) -> float:
    first, last = _at(pause.start), _at(pause.end)
    return float(np.median(level[first : max(last, first + 1)]))


def _reach_right(phones: Phones, index: int) -> float:
    following = phones[index + 1] if index + 1 < len(phones) else None
    return following.end if following and not following.is_pause else phones[index].end


def _reach_left(phones: Phones, index: int) -> float:
    before = phones[index - 1] if index else None
    return before.start if before and not before.is_pause else phones[index].start


def _rise(level: NDArray[np.float64], pause: Heard, phone: Heard, reach: float) -> float:
    first, last = _at(phone.start), _at(reach)
    around = level[first : last + 1]
    if len(around) < 3:
        return phone.start
    quiet = _pause_level(level, pause)
    limit = quiet + _EDGE * (float(around.max()) - quiet)
    begin = max(_at(pause.start), first - 4)
    above = np.flatnonzero(level[begin : last + 1] > limit)
    return (begin + int(above[0])) * _STEP / RATE if len(above) else phone.start


def _fall(level: NDArray[np.float64], phone: Heard, pause: Heard, reach: float) -> float:
    first, last = _at(reach), _at(phone.end)
    around = level[first : last + 1]
    if len(around) < 3 or pause.end - pause.start < 3 * _STEP / RATE:
        return phone.end
    quiet = _pause_level(level, pause)
    limit = quiet + _EDGE * (float(around.max()) - quiet)
    stop = min(_at(pause.end), _at(phone.end + _OVERSHOOT))
    above = np.flatnonzero(level[first : stop + 1] > limit)
    return (first + int(above[-1])) * _STEP / RATE if len(above) else phone.end
