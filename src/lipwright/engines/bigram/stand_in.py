"""Bigrams that a set lacks, built from the single-phone curves of their two phones.

DESIGN section 4: never silence, never a crash, and always named in the report. A
single-phone curve lies over its phone's own time 0..1; what reaches beyond 0..1 reaches
into the neighbour. Within a bigram the first phone keeps its middle and what follows,
the second phone what leads to its middle; the neighbouring bigrams hold the rest.
"""

from __future__ import annotations

import numpy as np

from lipwright.curves import Keys
from lipwright.engines.bigram.model import Bigram, BigramSet, Curves, Pair
from lipwright.engines.bigram.polyline import Line, combine, prune

STAND_IN = "stand-in"
FEWEST = 0.01


def stand_in(of: BigramSet, pair: Pair, boundary: float = 0.5) -> Bigram:
    """Return the bigram of a pair that the set lacks.

    Parameters
    ----------
    of : BigramSet
        The set, with its single-phone curves; a phone that has none adds nothing.
    pair : tuple of two str
        The classes.
    boundary : float
        Where the boundary of the two phones falls in the bigram's 0..1.
    """
    before = _placed(of.singles.get(pair[0], {}), boundary, 0.0)
    after = _placed(of.singles.get(pair[1], {}), 1.0 - boundary, boundary)
    curves = {}
    for pose in of.rules.names:
        lines = [lines[pose] for lines in (before, after) if pose in lines]
        if lines:
            line = lines[0] if len(lines) == 1 else prune(combine(lines[0], lines[1]))
            curves[pose] = Keys(*line)
    return Bigram(pair, curves, boundary, source=STAND_IN)


def _placed(curves: Curves, width: float, offset: float) -> dict[str, Line]:
    """Single-phone curves in a bigram's 0..1: the own time of the phone has ``width``."""
    placed = {}
    for pose, keys in curves.items():
        times = np.where(
            keys.times <= 0,
            offset * (1 + keys.times) if offset else keys.times,
            offset + keys.times * width,
        )
        if not offset:
            beyond = keys.times > 1
            times = np.where(beyond, width + (keys.times - 1) * (1 - width), times)
        line = _within(times, keys.values)
        if line is not None:
            placed[pose] = line
    return placed


def _within(times: np.ndarray, values: np.ndarray) -> Line | None:
    """Cut a line to 0..1, with zeros at both ends."""
    edges = np.interp([0.0, 1.0], times, values, left=0.0, right=0.0)
    inside = (times > FEWEST) & (times < 1 - FEWEST)
    times, values = times[inside], values[inside]
    # The value at a cut end goes to zero within the bigram; the neighbour holds it.
    if edges[0] > 0 or (len(values) and values[0] > 0):
        times, values = np.concatenate(([0.0], times)), np.concatenate(([0.0], values))
    if edges[1] > 0 or (len(values) and values[-1] > 0):
        times, values = np.concatenate((times, [1.0])), np.concatenate((values, [0.0]))
    if len(times) < 2 or not values.max() > 0:
        return None
    return times, values
