"""A face in one set of shapes, told in another: recorded ARKit scores as poses of a set.

What the scores do to the lips of the built-in head, poses are asked to do: non-negative
least squares on the displacements along the line where they meet, every frame at once. The map from
scores to the poses' normal equations is made once; what poses of the tongue do cannot be
seen on the lips and is left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head import build_head, landmarks
from lipwright.character.mesh import Part
from lipwright.errors import CharacterError

Floats = NDArray[np.float64]

ACROSS = 2.0
"""How much what moves sideways counts. Lips go up and down by far more than from corner to
corner, and the eye sees both: else how round a mouth is would be drowned by how open it is."""
SEEN = 1e-3
"""A shape that moves nothing there by as much is not seen, metres."""
FIRM = 5e-5
"""Keeps poses that look alike apart: a share of the poses' mean square."""
CLOSE = 3e-5
EVEN, MOST = 0.3, 4.0
"""What weak scores are brought up to, and how many times at most; see :func:`evening`."""
SWEEPS = 5000


@dataclass(frozen=True, slots=True, eq=False)
class Unmixing:
    """The linear map from shapes to poses.

    Parameters
    ----------
    channels : tuple of str
        Shapes that the head knows and that move the lips; their order is that of the columns.
    poses : tuple of str
        Poses that can be seen on the lips.
    alike : (P, P) float64
        Products of the poses' displacements, kept apart a little.
    products : (P, C) float64
        Of the poses' and the channels' displacements.
    """

    channels: tuple[str, ...]
    poses: tuple[str, ...]
    alike: Floats
    products: Floats

    def weights(self, values: NDArray[np.floating], given: Floats | None = None) -> Floats:
        """Return the weights of the poses.

        Parameters
        ----------
        values : (T, C) float
            Of the channels; differences from a face at rest may be below 0.
        given : (T, P) float64, optional
            What poses have, whatever the values say, where it is no NaN; the others
            make it good.

        Returns
        -------
        (T, P) float64
            In 0..1.
        """
        return nonnegative(self.alike, np.asarray(values, np.float64) @ self.products.T, given)


def unmixing(channels: Sequence[str], poses: Sequence[str]) -> Unmixing:
    """Return the map from recorded shapes to poses, on the built-in head.

    Parameters
    ----------
    channels : sequence of str
        ARKit's names; others are left out.
    poses : sequence of str

    Raises
    ------
    CharacterError
        If no channel, or no pose, moves the lips of the head.
    """
    skin, line = _skin()
    known, shown = _seen(skin, line, channels), _seen(skin, line, poses)
    for what, found, asked, such in (
        ("channels", known, channels, "jawOpen and mouthPucker"),
        ("poses", shown, poses, "open and W"),
    ):
        if not found:
            raise CharacterError(
                f"none of the {what} ({', '.join(list(asked)[:6])}) moves the head's lips",
                expected=f"names such as {such}",
            )
    here, there = _moves(skin, line, shown), _moves(skin, line, known)
    scale = float((here**2).sum(axis=1).mean())
    alike = here @ here.T / scale + FIRM * np.eye(len(shown))
    return Unmixing(known, shown, alike, here @ there.T / scale)


def nonnegative(squares: Floats, products: Floats, given: Floats | None = None) -> Floats:
    """Minimise ``x' A x / 2 - b' x`` with x in 0..1, for many b at once.

    Cyclic coordinate descent, which finds the minimum of any positive definite A.

    Parameters
    ----------
    squares : (P, P) float64
        A.
    products : (T, P) float64
        A row for each b.
    given : (T, P) float64, optional
        What x is, where it is no NaN.

    Returns
    -------
    (T, P) float64
    """
    low, high = np.zeros_like(products), np.ones_like(products)
    if given is not None:
        low, high = np.where(np.isnan(given), low, given), np.where(np.isnan(given), high, given)
    # Where no bound is met, that is the minimum already.
    found: Floats = np.clip(np.linalg.solve(squares, products.T).T, low, high)
    for _ in range(SWEEPS):
        moved = 0.0
        for pose in range(len(squares)):
            column = found[:, pose]
            rest = products[:, pose] - found @ squares[:, pose]
            better = np.clip(column + rest / squares[pose, pose], low[:, pose], high[:, pose])
            moved = max(moved, float(np.abs(better - column).max(initial=0.0)))
            found[:, pose] = better
        if moved < CLOSE:
            break
    return found


def evening(scores: Floats) -> Floats:
    """Return the gains (C,) that bring up shapes which a tracker scores too low.

    Trackers from video score some shapes (mouthStretch, mouthFunnel) in hundredths where
    the eye sees them clearly. A shape whose 99th percentile is below 0.3 is multiplied to
    reach it, four times at most.

    Parameters
    ----------
    scores : (T, C) float64
        From rest.
    """
    high = np.percentile(scores, 99, axis=0)
    return np.asarray(np.clip(EVEN / np.maximum(high, 1e-9), 1.0, MOST))


@lru_cache(maxsize=1)
def _skin() -> tuple[Part, NDArray[np.intp]]:
    """The head's skin, and the vertices where its lips meet."""
    marks = landmarks()
    skin = next(part for part in build_head() if part.name == "skin")
    return skin, np.unique((*marks.upper_loop, *marks.lower_loop)).astype(np.intp)


def _seen(skin: Part, line: NDArray[np.intp], names: Sequence[str]) -> tuple[str, ...]:
    return tuple(
        name
        for name in dict.fromkeys(names)
        if name in skin.morphs and np.abs(skin.morphs[name][line]).max() > SEEN
    )


def _moves(skin: Part, vertices: NDArray[np.intp], names: Sequence[str]) -> Floats:
    moves = np.stack([skin.morphs[name][vertices] for name in names]).astype(np.float64)
    moves[:, :, 0] *= ACROSS
    return moves.reshape(len(names), -1)
