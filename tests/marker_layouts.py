"""Markers as a capture of speech has them: on the borders of the lips, about them, on the face."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.marker_faces import FaceMesh, MarkerLayout

Floats = NDArray[np.float64]
MARKERS, AROUND = 109, 36
BORDERS = {1.0: 0.12, 0.0: 0.14}
"""Of the mouth's width: from where the lips meet to the red's border, upper and lower lip."""


def layout_on(face: FaceMesh) -> list[int]:
    """Vertices for the markers."""
    points, line = face.points, face.line
    apart = np.linalg.norm(points[:, None] - line[None], axis=2).min(axis=1)
    front = face.outward & (points[:, 2] > np.quantile(points[face.outward, 2], 0.3))
    front &= points[:, 1] > line[:, 1].mean() - 1.6 * face.width
    chosen = list(face.mouth.corners)
    for side, border in BORDERS.items():
        for place in np.linspace(-0.42, 0.42, 9) * face.width:
            narrow = border * face.width * np.sqrt(1 - (place / (0.55 * face.width)) ** 2)
            lip = np.flatnonzero(front & (np.abs(face.sides - side) < 0.01))
            off = np.abs(apart[lip] - narrow) + np.abs(points[lip, 0] - place)
            chosen.append(int(lip[np.argmin(off)]))
    chosen = list(dict.fromkeys(chosen))
    about = front & (np.linalg.norm(points - line.mean(axis=0), axis=1) < face.width)
    chosen = farthest(points, chosen, np.flatnonzero(about), AROUND)
    return farthest(points, chosen, np.flatnonzero(front), MARKERS - len(chosen))


def farthest(points: Floats, chosen: list[int], pool: NDArray[np.intp], count: int) -> list[int]:
    """Add the points of a pool that lie farthest from all that are chosen."""
    chosen = list(chosen)
    near = np.linalg.norm(points[pool][:, None] - points[chosen][None], axis=2).min(axis=1)
    for _ in range(count):
        chosen.append(int(pool[np.argmax(near)]))
        near = np.minimum(near, np.linalg.norm(points[pool] - points[chosen[-1]], axis=1))
    return chosen


def recorded(face: FaceMesh, chosen: list[int], poses: list[dict[str, float]]) -> Floats:
    """Displacements (P, M, 3) of markers in poses of the face's own targets."""
    return np.stack([(face.surfaces.positions(pose) - face.points)[chosen] for pose in poses])


def layout_of(rest: Floats, moves: Floats, turn: Floats | None = None) -> MarkerLayout:
    """Return the layout of markers that were recorded in some axes, all their motion kept."""
    turn = np.eye(3) if turn is None else turn
    mean = moves.mean(axis=0)
    _, sizes, ways = np.linalg.svd((moves - mean).reshape(len(moves), -1), full_matrices=False)
    kept = sizes > 1e-9 * sizes[0]
    basis = ways[kept].reshape(-1, *mean.shape)
    return MarkerLayout(
        tuple(f"m{number:03}" for number in range(len(rest))),
        rest @ turn.T,
        mean @ turn.T,
        basis @ turn.T,
        sizes[kept] ** 2 / len(moves),
    )
