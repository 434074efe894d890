"""Which markers do not deform: those whose distances from one another vary least.

A jaw is rigid too, or nearly. Of several groups the one that fills most space is the
skull's: the sum of its squared distances is the greatest.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from lipwright.engines.motion.capture.head import (
    FEWEST,
    STEADY,
    Flags,
    head_motion,
    median,
    sorted_quantile,
    spans,
    still_face,
)
from lipwright.engines.motion.capture.motion import Floats

LOOSEST = 1e-3
"""Metres by which a distance varies that nobody calls steady; skin slides a little."""
_SAMPLES = 150
_SHARE = 0.75
_GROUPS = 4
_ROUNDS, _OFTEN, _STRAYS = 3, 0.84, 1.3


def rigid_markers(points: Floats) -> Flags:
    """Find the markers that keep their distances from one another.

    Parameters
    ----------
    points : (T, M, 3) float64
        NaN where a marker was not seen.

    Returns
    -------
    (M,) bool
        The widest group each of which keeps its distance to three quarters of the others;
        none where there is no such group.
    """
    seen = np.isfinite(points[:, :, 0])
    frames = np.flatnonzero(seen.mean(axis=1) >= 0.5)
    frames = frames[np.linspace(0, len(frames) - 1, min(_SAMPLES, len(frames))).astype(np.intp)]
    none = np.zeros(points.shape[1], dtype=bool)
    if len(none) < FEWEST or len(frames) < FEWEST:
        return none
    some = points[frames]
    apart, varies = _distances(some)
    known = varies[np.triu_indices(len(none), 1)]
    known = known[np.isfinite(known)]
    if not len(known):
        return none
    steady = varies < np.clip(2 * float(np.quantile(known, 0.1)), STEADY, LOOSEST)
    wide = np.where(np.isfinite(apart), apart, 0.0) ** 2
    best = max(_groups(steady, wide), key=lambda group: wide[group][:, group].sum(), default=none)
    if best.sum() < FEWEST:
        return none
    best = _stillest(some, best)
    return best if spans(median(some), best) else none


def _distances(points: Floats) -> tuple[Floats, Floats]:
    """Return the distances of all pairs (M, M): their median, and how far they vary."""
    count = points.shape[1]
    one, other = np.triu_indices(count, 1)
    apart = np.sqrt(((points[:, one] - points[:, other]) ** 2).sum(axis=2))
    low, middle, high = sorted_quantile(apart, (0.16, 0.5, 0.84))
    both = np.zeros((2, count, count))
    for whole, half in zip(both, (middle, (high - low) / 2), strict=True):
        whole[one, other] = whole[other, one] = half
    return both[0], both[1]


def _groups(steady: Flags, wide: Floats) -> Iterator[Flags]:
    """Yield groups that have no marker in common, each around the marker with most reach."""
    left = np.ones(len(steady), dtype=bool)
    for _ in range(_GROUPS):
        reach = np.where(left, (wide * steady)[:, left].sum(axis=1), -1.0)
        group = steady[int(np.argmax(reach))] & left
        while group.sum() >= FEWEST:
            share = np.where(group, steady[:, group].mean(axis=1), np.inf)
            worst = int(np.argmin(share))
            if share[worst] >= _SHARE:
                yield group
                break
            group[worst] = False
        left = left & ~group
        left[int(np.argmax(reach))] = False


def _stillest(points: Floats, group: Flags) -> Flags:
    """Drop the markers of a group that move most against the others, on a still head."""
    for _ in range(_ROUNDS):
        still = head_motion(points, still_face(points, group), group).removed(points)
        off = np.linalg.norm(still - median(still), axis=2)
        strays = sorted_quantile(off, (_OFTEN,))[0]
        limit = _STRAYS * float(np.nanquantile(strays[group], 0.25))
        kept = group & (strays <= max(limit, STEADY))
        if kept.sum() < FEWEST or (kept == group).all():
            break
        group = kept
    return group
