"""Time warping: which instant of a recorded phone answers each instant of the wanted one.

Dynamic time warping of the sounds' features (Cao et al. 2004, section 6.3), with both
phones' first and last instants tied together. Both are brought to knots at even shares of
their time first, so that all phones of a line are warped at once and a change of length is
no warp. From one knot to the next the recording moves on by 1 to 4 half knots: a warp runs
at half to twice the even pace. Where features say little, as in a held vowel, the even pace
wins by a small price on leaving it; the warp is rounded off at last, since a corner in it is
a jerk of the face.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.rasta_plp import between

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

KNOTS = 16
"""Instants of the wanted phone; the recorded one has twice as many steps between them."""
STEPS = np.array([4, 3, 2, 1])  # half knots of the recording per knot; 2 is the even pace
PRICE = 0.1
"""Of a step off the even pace, per half knot, in mean distances of the features."""


def linear(count: int) -> Floats:
    """Return even warps, (count, KNOTS)."""
    return np.tile(np.linspace(0.0, 1.0, KNOTS), (count, 1))


def warp(wanted: NDArray[np.floating], recorded: NDArray[np.floating]) -> Floats:
    """Return the warp between two phones given by their frames.

    Parameters
    ----------
    wanted : (M, 9)
        Features of the phone that is wanted.
    recorded : (N, 9)
        Features of the phone that was recorded.

    Returns
    -------
    (KNOTS,) float64
        Share of the recorded phone's time at even shares of the wanted one's: 0 first, 1
        last, never falling.

    Examples
    --------
    >>> frames = np.arange(10.0)[:, None] * np.ones(9)
    >>> bool(np.allclose(warp(frames, frames[::2]), np.linspace(0, 1, KNOTS)))
    True
    """
    pair = (knots(wanted[None], KNOTS), knots(recorded[None], 2 * KNOTS - 1))
    return np.asarray(warps(*pair)[0])


def knots(frames: NDArray[np.floating], count: int) -> Floats:
    """Return ``count`` instants at even shares of phones' time.

    Parameters
    ----------
    frames : (P, N, 9)
        Of phones that all have N frames.
    """
    positions = np.linspace(0.0, 1.0, count) * frames.shape[1] - 0.5
    return np.stack([between(phone, positions) for phone in frames])


def warps(wanted: Floats, recorded: Floats) -> Floats:
    """Return the warps of many phones at once.

    Parameters
    ----------
    wanted : (P, M, 9) float64
        Features at M even shares of each wanted phone's time.
    recorded : (P, 2 M - 1, 9) float64
        Features at twice as many steps of the recorded phone.

    Returns
    -------
    (P, M) float64
        As :func:`warp`; even where one side is all zeros, which stands for no sound.
    """
    cost = _distances(wanted, recorded)
    path = _least_path(cost) / (recorded.shape[1] - 1)
    path[:, 1:-1] = 0.25 * path[:, :-2] + 0.5 * path[:, 1:-1] + 0.25 * path[:, 2:]
    mute = ~(wanted.any(axis=(1, 2)) & recorded.any(axis=(1, 2)))
    path[mute] = np.linspace(0.0, 1.0, wanted.shape[1])
    return np.asarray(path)


def _distances(wanted: Floats, recorded: Floats) -> Floats:
    """Squared distances of the features (P, M, 2 M - 1), their mean 1 in every phone."""
    own, other = (np.einsum("pnd,pnd->pn", side, side) for side in (wanted, recorded))
    apart: Floats = wanted @ recorded.transpose(0, 2, 1)
    apart *= -2.0  # in place, here and below: this is memory that is passed through
    apart += own[:, :, None]
    apart += other[:, None, :]
    mean = apart.mean(axis=(1, 2), keepdims=True)
    # Equal features leave only rounding behind, which must not be blown up to a warp.
    differ = mean > 1e-9 * (own.mean() + other.mean())
    apart *= np.where(differ, 1.0 / np.where(differ, mean, 1.0), 0.0)
    return apart


def _least_path(cost: Floats) -> Ints:
    """Half knot of the recording at each knot, (P, M), by dynamic programming."""
    phones, count, halves = cost.shape
    most = len(STEPS)
    total = np.full((phones, most + halves), np.inf)
    total[:, most] = cost[:, 0, 0]
    reached = total[:, most:]
    # The totals that lie 4, 3, 2 and 1 before each half knot.
    before = np.lib.stride_tricks.sliding_window_view(total, most, axis=1)[:, :halves]
    price = PRICE * np.abs(STEPS - 2)[:, None, None]
    tried = np.empty((most, phones, halves))
    chosen = np.zeros((count, phones, halves), np.int64)
    for knot in range(1, count):
        np.add(before.transpose(2, 0, 1), price, out=tried)
        tried.argmin(axis=0, out=chosen[knot])
        np.minimum.reduce(tried, axis=0, out=reached)
        reached += cost[:, knot]
    path = np.zeros((phones, count), np.int64)
    path[:, -1] = halves - 1
    each = np.arange(phones)
    for knot in range(count - 1, 0, -1):
        path[:, knot - 1] = path[:, knot] - STEPS[chosen[knot, each, path[:, knot]]]
    return path
