"""The head's rigid motion, removed.

Each frame is laid onto a reference face by the markers that do not deform: orthogonal
Procrustes without scale or mirroring (Schönemann 1966; Kabsch 1976), for all frames at
once, over the markers that were seen; a spike hardly counts.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.capture.motion import Floats
from lipwright.errors import InputError

Flags = NDArray[np.bool_]

FEWEST = 4
SPREAD = 0.005
"""Metres that the holding markers must span across their longest line."""
STEADY = 1e-4
"""Metres by which a distance may vary and be steady, whatever the noise."""
_SAMPLES = 450
_ROUNDS = 3
_AT_ONCE = 4096
_SLIGHT = 1e-4
_FAR = 3.0


def sorted_quantile(values: Floats, shares: tuple[float, ...]) -> list[Floats]:
    """Return quantiles over the first axis, NaN passed over; NaN where nothing was seen."""
    ordered = np.sort(values, axis=0)
    last = np.maximum(np.isfinite(values).sum(axis=0) - 1, 0)
    return [
        np.take_along_axis(ordered, np.round(share * last).astype(np.intp)[None], 0)[0]
        for share in shares
    ]


def median(values: Floats) -> Floats:
    """Return the median over the first axis, NaN passed over."""
    return sorted_quantile(values, (0.5,))[0]


def spans(face: Floats, group: Flags) -> bool:
    """Whether markers lie wide enough apart to tell every turn of the head."""
    places = face[group] - face[group].mean(axis=0)
    return bool(np.linalg.svd(places, compute_uv=False)[1] / np.sqrt(len(places)) > SPREAD / 2)


@dataclass(frozen=True, slots=True, eq=False)
class HeadMotion:
    """How each frame is laid onto the reference: ``point @ turn + shift``.

    Parameters
    ----------
    turns : (T, 3, 3) float64
    shifts : (T, 3) float64
        Metres.
    """

    turns: Floats
    shifts: Floats

    def removed(self, points: Floats) -> Floats:
        """Return points (T, M, 3) as the still head has them."""
        return np.asarray(points @ self.turns + self.shifts[:, None])

    def degrees(self) -> float:
        """Return the largest angle from the mean direction."""
        u, _, v = np.linalg.svd(self.turns.mean(axis=0))
        cosine = (np.einsum("tij,ij->t", self.turns, u @ v) - 1) / 2
        return float(np.degrees(np.arccos(np.clip(cosine, -1, 1))).max())

    def travel(self, centre: Floats) -> float:
        """Return how far a point of the reference strays from its mean place, in metres."""
        places = np.einsum("ti,tji->tj", centre - self.shifts, self.turns)
        return float(np.linalg.norm(places - places.mean(axis=0), axis=1).max())


def head_motion(points: Floats, reference: Floats, group: Flags) -> HeadMotion:
    """Return the rigid motion that lays each frame onto a reference.

    Parameters
    ----------
    points : (T, M, 3) float64
        NaN where a marker was not seen.
    reference : (M, 3) float64
        A face, NaN where a marker is not known.
    group : (M,) bool
        The markers that hold it. The others count next to nothing: they decide only in
        frames where too few of these were seen. A frame with fewer than three markers
        takes the motion of the one before.
    """
    weights = np.where(group, 1.0, _SLIGHT) * np.isfinite(reference[:, 0])
    place = np.where(np.isfinite(reference), reference, 0.0)
    turns, shifts = np.empty((len(points), 3, 3)), np.empty((len(points), 3))
    for at in range(0, len(points), _AT_ONCE):
        part = slice(at, at + _AT_ONCE)
        share = weights * np.isfinite(points[part, :, 0])
        for _ in range(_ROUNDS):
            turns[part], shifts[part] = _laid(points[part], place, share)
            off = HeadMotion(turns[part], shifts[part]).removed(points[part]) - place
            share = weights * _trust(np.linalg.norm(off, axis=2), group)
    known = np.isfinite(shifts[:, 0])
    if not known.any():
        raise InputError("no frame with three markers in it")
    nearest = np.maximum.accumulate(np.where(known, np.arange(len(known)), -1))
    nearest[nearest < 0] = int(np.argmax(known))
    return HeadMotion(turns[nearest], shifts[nearest])


def _trust(off: Floats, group: Flags) -> Floats:
    """Return weights (T, M) by which a spike does not turn the head (Geman, McClure 1987)."""
    held = off[:, group]
    usual = float(np.median(held[np.isfinite(held)])) if np.isfinite(held).any() else 0.0
    return np.where(np.isfinite(off), (1 + (off / (_FAR * max(usual, STEADY))) ** 2) ** -2.0, 0.0)


def _laid(points: Floats, place: Floats, share: Floats) -> tuple[Floats, Floats]:
    """Return turns and shifts of frames whose markers weigh ``share`` (T, M)."""
    enough = (share > 0).sum(axis=1) >= 3
    share = np.where(enough[:, None], share, 1.0)
    share = share / share.sum(axis=1, keepdims=True)
    found = np.where(np.isfinite(points), points, 0.0)
    middle, target = np.einsum("tm,tmi->ti", share, found), share @ place
    spread = (found * share[:, :, None]).transpose(0, 2, 1) @ place
    spread -= middle[:, :, None] * target[:, None]
    u, _, v = np.linalg.svd(spread)
    mirrored = np.linalg.det(u @ v) < 0
    u[mirrored, :, 2] *= -1
    turns = u @ v
    shifts = target - np.einsum("ti,tij->tj", middle, turns)
    shifts[~enough] = np.nan
    return turns, shifts


def still_face(points: Floats, group: Flags, rounds: int = 2) -> Floats:
    """Return the median face (M, 3) of a take with its head held still."""
    seen = np.isfinite(points[:, :, 0])
    face: Floats = points[int(np.argmax(seen[:, group].sum(axis=1) + 1e-3 * seen.sum(axis=1)))]
    some = points[np.linspace(0, len(points) - 1, min(_SAMPLES, len(points))).astype(np.intp)]
    for _ in range(rounds):
        face = median(head_motion(some, face, group).removed(some))
    return face
