"""Gaps filled: short ones by a spline, long ones from the other markers.

A short gap is bridged by a cubic Hermite spline whose slopes come from the frames around
it. In a long one the marker goes where the markers that are seen have it: the Gaussian
conditional mean under the take's principal components (DESIGN section 5), shifted so that
it meets the frames on both sides.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.capture.motion import Floats

Flags = NDArray[np.bool_]

SHORT = 0.05
"""Seconds that a spline bridges."""
_SLOPE = 4
_EDGE = 3
_FRAMES = 4000
_WHOLE = 0.5
_ROUNDS = 2
_LEARNT = 1500
_TRUST = 0.1
_MOST = 40


@dataclass(frozen=True, slots=True)
class Gap:
    """Frames in which a marker was not seen; the last is exclusive."""

    marker: int
    first: int
    last: int


def find_gaps(lost: Flags) -> list[Gap]:
    """Return all gaps of (T, M) flags, marker by marker."""
    padded = np.zeros((lost.shape[0] + 2, lost.shape[1]), dtype=np.int8)
    padded[1:-1] = lost
    change = np.diff(padded, axis=0).T
    markers, firsts = np.nonzero(change == 1)
    lasts = np.nonzero(change == -1)[1]
    return [Gap(int(m), int(a), int(b)) for m, a, b in zip(markers, firsts, lasts, strict=True)]


def fill(points: Floats, rate: float) -> tuple[Floats, int, int]:
    """Fill all gaps.

    Parameters
    ----------
    points : (T, M, 3) float64
        On a still head; NaN in gaps. Each marker is seen in some frame.
    rate : float
        Frames per second.

    Returns
    -------
    filled : (T, M, 3) float64
    by_spline, from_others : int
        Gaps filled each way.
    """
    filled = points.copy()
    lost = ~np.isfinite(points[:, :, 0])
    gaps = find_gaps(lost)
    longest = max(1, round(SHORT * rate))
    short = [gap for gap in gaps if gap.last - gap.first <= longest]
    long = [gap for gap in gaps if gap.last - gap.first > longest]
    for gap in short:
        filled[gap.first : gap.last, gap.marker] = _spline(points[:, gap.marker], gap)
    seen = filled.copy()
    known = np.isfinite(seen[:, :, 0])
    for _ in range(_ROUNDS if long else 0):  # what was filled teaches the next model
        model = _Model(filled)
        for gap in long:
            filled[gap.first : gap.last, gap.marker] = model.predict(seen, known, gap)
    return filled, len(short), len(long)


def _spline(path: Floats, gap: Gap) -> Floats:
    """Return the places of one marker (T, 3) in a gap; held where the take begins or ends."""
    before = _slope(path, np.arange(gap.first - 1, max(gap.first - 1 - _SLOPE, -1), -1))
    after = _slope(path, np.arange(gap.last, min(gap.last + _SLOPE, len(path))))
    at = np.arange(gap.first, gap.last)
    if before is None or after is None:
        edge = before or after
        return np.tile(edge[0] if edge else np.full(3, np.nan), (len(at), 1))
    span = gap.last - gap.first + 1.0
    u = ((at - gap.first + 1.0) / span)[:, None]
    return np.asarray(
        (1 + 2 * u) * (1 - u) ** 2 * before[0]
        + u * (1 - u) ** 2 * span * before[1]
        + u**2 * (3 - 2 * u) * after[0]
        - u**2 * (1 - u) * span * after[1]
    )


def _slope(path: Floats, frames: NDArray[np.intp]) -> tuple[Floats, Floats] | None:
    """Return place and slope (per frame) at the first of some frames, as far as seen."""
    seen = np.isfinite(path[frames, 0])
    count = len(frames) if seen.all() else int(np.argmin(seen))
    if not count:
        return None
    place, other = path[frames[0]], path[frames[count - 1]]
    if count == 1:
        return place, np.zeros(3)
    return place, (other - place) / float(frames[count - 1] - frames[0])


class _Model:
    """The take's principal components, and what they leave open."""

    def __init__(self, points: Floats) -> None:
        flat = points.reshape(len(points), -1)
        whole = np.flatnonzero(np.isfinite(flat).all(axis=1))
        if len(whole) < _WHOLE * len(flat):
            flat, whole = _bridged(flat), np.arange(len(flat))
        self.frames = _some(whole, _FRAMES)
        self.flat = flat[self.frames]
        self.mean = self.flat.mean(axis=0)
        values, vectors = np.linalg.eigh(np.cov(self.flat - self.mean, rowvar=False, ddof=0))
        floor = max(float(np.median(values)), 1e-12)
        count = int(np.clip((values > 3 * floor).sum(), 1, _MOST))
        self.basis = vectors[:, -count:]
        self.spread = np.maximum(values[-count:], floor)
        self.noise = max(float(values[:-count].mean()) if count < len(values) else floor, 1e-12)

    def predict(self, points: Floats, known: Flags, gap: Gap) -> Floats:
        """Return one marker's places (frames, 3) in a gap, meeting what is on both sides."""
        low, high = max(gap.first - _EDGE, 0), min(gap.last + _EDGE, len(points))
        others = np.asarray(known[low:high].all(axis=0))
        others[gap.marker] = False
        places, own = np.repeat(others, 3), slice(3 * gap.marker, 3 * gap.marker + 3)
        basis = self.basis[places]
        inner = basis.T @ basis / self.noise + np.diag(1 / self.spread)
        share = np.linalg.solve(inner, basis.T / self.noise).T
        learnt = _some(np.flatnonzero(known[self.frames, gap.marker]), _LEARNT)
        rows = self.flat[learnt] - self.mean
        scores = rows[:, places] @ share
        # What was filled here before must not teach: its own frames correct the model.
        wrong = rows[:, own] - scores @ self.basis[own].T
        steady = scores.T @ scores + np.eye(scores.shape[1]) * self.noise / _TRUST**2
        loadings = self.basis[own].T + np.linalg.solve(steady, scores.T @ wrong)
        seen = points[low:high].reshape(high - low, -1)[:, places] - self.mean[places]
        guess = self.mean[own] + seen @ share @ loadings
        off = points[low:high, gap.marker] - guess
        return np.asarray(guess + _carried(off))[gap.first - low : gap.last - low]


def _some(indices: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """Return at most so many of some indices, evenly."""
    if len(indices) <= count:
        return indices
    return indices[np.linspace(0, len(indices) - 1, count).astype(np.intp)]


def _carried(off: Floats) -> Floats:
    """Bridge the difference on both sides of a gap along a straight line."""
    seen = np.isfinite(off[:, 0])
    at = np.arange(len(off))
    if not seen.any():
        return np.zeros_like(off)
    left = at[seen & (np.cumsum(~seen) == 0)]
    right = at[seen & (np.cumsum(~seen) > 0)]
    sides = [side for side in (left, right) if len(side)]
    centres = [float(side.mean()) for side in sides]
    means = np.array([off[side].mean(axis=0) for side in sides])
    return np.stack([np.interp(at, centres, column) for column in means.T], axis=1)


def _bridged(flat: Floats) -> Floats:
    """Return paths (T, C) with gaps as straight lines, for want of whole frames."""
    at = np.arange(len(flat))
    columns = []
    for column in flat.T:
        seen = np.isfinite(column)
        columns.append(np.interp(at, at[seen], column[seen]) if seen.any() else np.zeros(len(at)))
    return np.stack(columns, axis=1)
