"""Which markers show the lips, and how far they are apart: found from what is said.

Nobody names markers alike, so names say nothing here. In p, b and m the lips touch, so the
distance between a marker on the upper and one on the lower is the same every time; in open
vowels it is not. The pairs of markers that tell the two apart best, for how near they lie to
one another, are the lips': chin and nose part as widely, but not from so near. Their
distances along their own lines, linear in the markers' places, are the opening.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.closures import KINDS, evenly
from lipwright.engines.motion.recorded import Recorded

Floats = NDArray[np.float64]

OPEN = ("aa", "ae", "ah", "ao", "aw", "ay", "eh", "ey")
"""Phones that open the mouth."""
NOISE = 2e-4
"""Metres by which a distance between touching lips may vary and still be as good as none."""
NEAR = 5e-3
"""Metres below which it matters little how near two markers lie."""
PAIRS = 4
UNITS = 400
_FEWEST = 3


def opening_row(data: Recorded, rest: Floats) -> Floats | None:
    """Return how markers tell that the lips are open.

    Parameters
    ----------
    data : Recorded
        Of displacements of markers, ``(F, 3 * M)``, metres.
    rest : (M, 3) float64
        Where they are at rest.

    Returns
    -------
    (3 * M,) float64 or None
        ``motion @ row`` is how far the lips are apart, in metres from how they are at rest;
        None where too few closures or open vowels were recorded, or no pair of markers
        tells them apart.
    """
    closed, opened = _middles(data, KINDS[0]), _middles(data, OPEN)
    if min(len(closed), len(opened)) < _FEWEST:
        return None
    moves = opened.mean(axis=0) - closed.mean(axis=0)
    one, other = np.triu_indices(len(rest), 1)
    apart = moves[one] - moves[other]
    wide = np.linalg.norm(apart, axis=1)
    lines = apart / np.maximum(wide, 1e-12)[:, None]
    # How much each pair's distance varies along its line while the lips touch.
    spread = np.zeros(len(one))
    for first, last in pairwise(range(0, len(one) + 4096, 4096)):
        some = slice(first, last)
        between = closed[:, one[some]] - closed[:, other[some]]
        spread[some] = np.einsum("fpi,pi->fp", between, lines[some]).std(axis=0)
    near = np.linalg.norm(rest[one] - rest[other], axis=1) + NEAR
    clear = wide / (spread + NOISE) / near
    best = np.argsort(-clear, kind="stable")[:PAIRS]
    if not len(best) or wide[best[0]] < 5 * NOISE:
        return None
    row = np.zeros(rest.shape)
    for pair in best.tolist():
        row[one[pair]] += lines[pair] / len(best)
        row[other[pair]] -= lines[pair] / len(best)
    return row.ravel()


def _middles(data: Recorded, labels: tuple[str, ...]) -> Floats:
    """The middle frame of each unit of some phones: (N, markers, 3)."""
    names = np.array([label.casefold() for label in data.labels])
    units = np.flatnonzero(np.isin(names, labels)[np.asarray(data.label)])
    units = evenly(units, UNITS)
    middle = (np.asarray(data.first)[units] + np.asarray(data.last)[units] - 1) // 2
    frames: Floats = np.asarray(data.values[middle], np.float64)
    return frames.reshape(len(frames), -1, 3)
