"""The skin: net, lips and lids joined to one closed surface, with what moves it by name.

Both sides are mirror images; vertices in the middle are shared. The surface goes on
inside the mouth as a closed bag, so nothing can be seen through the lips.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.character.head.grid import half_net
from lipwright.character.head.lids import left_lids
from lipwright.character.head.lips import half_lips

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Skin:
    """The skin and its loops.

    Parameters
    ----------
    points : (V, 3) float64, metres
    triangles : (F, 3) intp
    mouth : (L, n) intp
        Loops around the mouth, from the window's edge inward; each starts above the middle
        and runs over the left corner, below the middle and the right corner.
    back : int
        The vertex at the end of the mouth's bag.
    eyes : (2, M, m) intp
        Loops around the left and the right eye, from the window's edge inward.
    """

    points: Floats
    triangles: Indices
    mouth: Indices
    back: int
    eyes: Indices


def build_skin() -> Skin:
    """Build the neutral skin."""
    net = half_net()
    lips = half_lips(net.points[net.mouth])
    lids = left_lids(net.points[net.eye])
    lip_ids = len(net.points) + np.arange(lips.loops[..., 0].size).reshape(lips.loops.shape[:2])
    back = int(lip_ids[-1, -1]) + 1
    lid_ids = back + 1 + np.arange(lids[..., 0].size).reshape(lids.shape[:2])
    points = np.concatenate(
        [net.points, lips.loops.reshape(-1, 3), lips.back[None], lids.reshape(-1, 3)]
    )
    mouth = np.concatenate([net.mouth[None], lip_ids])
    eye = np.concatenate([net.eye[None], lid_ids])
    closed = np.concatenate([eye, eye[:, :1]], axis=1)
    quads = np.concatenate([net.quads, _between(mouth), _between(closed)])
    end = np.stack([mouth[-1, :-1], np.full(mouth.shape[1] - 1, back), mouth[-1, 1:]], axis=1)
    half = np.concatenate([_split(points, quads), net.cap, end])
    half = half[_has_area(points, half)]
    used = np.unique(half)
    place = np.zeros(len(points), dtype=np.intp)
    place[used] = np.arange(len(used))
    return _mirrored(points[used], place[half], place[mouth], int(place[back]), place[eye])


def _between(loops: Indices) -> Indices:
    """Return the quads between each loop and the next one inside it."""
    corners = [loops[:-1, :-1], loops[1:, :-1], loops[1:, 1:], loops[:-1, 1:]]
    return np.stack(corners, axis=-1).reshape(-1, 4)


def _split(points: Floats, quads: Indices) -> Indices:
    """Cut quads along their shorter diagonal."""
    a, b, c, d = quads.T
    first = np.linalg.norm(points[a] - points[c], axis=1)
    second = np.linalg.norm(points[b] - points[d], axis=1)
    along = first <= second
    return np.concatenate(
        [
            np.stack([a, b, np.where(along, c, d)], axis=1),
            np.stack([np.where(along, a, b), c, d], axis=1),
        ]
    )


def _has_area(points: Floats, triangles: Indices) -> NDArray[np.bool_]:
    a, b, c = points[triangles.T]
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1) > 1e-12)


def _mirrored(points: Floats, triangles: Indices, mouth: Indices, back: int, eye: Indices) -> Skin:
    """Add the other side; vertices with x = 0 are shared."""
    count = len(points)
    own = points[:, 0] > 0.0
    other = np.arange(count)
    other[own] = count + np.arange(np.count_nonzero(own))
    flipped = points[own] * (-1.0, 1.0, 1.0)
    return Skin(
        np.concatenate([points, flipped]),
        np.concatenate([triangles, other[triangles][:, ::-1]]),
        np.concatenate([mouth, other[mouth][:, -2:0:-1]], axis=1),
        back,
        np.stack([eye, other[eye]]),
    )
