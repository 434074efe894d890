"""Two rows of teeth in their gums: strips along the dental arch, tooth by tooth.

Widths and heights of crowns follow adult averages; the lower row stands a little behind
the upper one and is hidden by it and by the lower lip when the jaw is closed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]


@dataclass(frozen=True, slots=True)
class Row:
    """One row of teeth, in millimetres.

    Parameters
    ----------
    widths : tuple of float
        Breadth of the teeth of one side, from the middle outward.
    lengths : tuple of float
        How far each tooth reaches beyond the shortest.
    edge, neck : float
        Heights of the cutting edge and of the gum's margin.
    root : float
        Height where the gum ends.
    half_breadth, depth, middle : float
        The arch, an ellipse: half its breadth, its depth, and where its middle lies.
    """

    widths: tuple[float, ...]
    lengths: tuple[float, ...]
    edge: float
    neck: float
    root: float
    half_breadth: float
    depth: float
    middle: float


UPPER = Row(
    (8.4, 6.7, 7.6, 7.0, 6.8, 9.5),
    (0.9, 0.45, 0.75, 0.35, 0.1, 0.0),
    -70.2,
    -61.2,
    -53.0,
    28.5,
    40.0,
    48.0,
)
LOWER = Row(
    (5.3, 5.9, 6.8, 7.0, 7.0, 10.5),
    (0.2, 0.2, 0.4, 0.2, 0.0, 0.0),
    -72.0,
    -80.8,
    -84.5,
    26.0,
    38.0,
    45.6,
)

_ACROSS = np.array([0.0, 0.09, 0.5, 0.91])  # stations on one tooth
_HOLLOW = np.array([-0.9, -0.3, 0.0, -0.3])  # how far each lies behind the tooth's front
_ROUND = np.array([1.0, 0.12, 0.0, 0.12])  # how much the edge is rounded there
_SCALLOP = np.array([1.0, 0.3, 0.0, 0.3])  # the gum's margin: longest between two teeth
# Down the tooth: share of the way from neck to edge, and how far outward (mm).
_PROFILE = np.array(
    [[-0.12, -0.5], [0.12, 0.35], [0.55, 0.5], [0.93, 0.0], [1.0, -0.7], [0.85, -1.9], [0.0, -3.2]]
)
# Down the gum: share of the way from root to margin, and how far outward.
_GUM = np.array([[0.0, -3.0], [0.5, 0.9], [0.88, 1.1], [1.06, 0.2]])


def _stations(row: Row) -> tuple[Floats, Floats, Floats, Floats, Floats]:
    """Return arc length, hollow, rounding, scallop and tooth length along the arch."""
    ends = np.concatenate([[0.0], np.cumsum(row.widths)])
    arc = (ends[:-1, None] + np.diff(ends)[:, None] * _ACROSS).ravel()
    count = len(row.widths)
    columns = [np.tile(part, count) for part in (_HOLLOW, _ROUND, _SCALLOP)]
    long = np.repeat(np.array(row.lengths), len(_ACROSS))
    sides = [arc, *columns, long]
    closing = (ends[-1], _HOLLOW[0], _ROUND[0], _SCALLOP[0], row.lengths[-1])
    left = [np.append(side, end) for side, end in zip(sides, closing, strict=True)]
    left[4][:: len(_ACROSS)][1:] = np.minimum(
        left[4][:: len(_ACROSS)][1:], left[4][: -1 : len(_ACROSS)]
    )
    both = [np.concatenate([side[:0:-1], side]) for side in left]
    both[0][: len(arc)] *= -1.0
    return both[0], both[1], both[2], both[3], both[4]


def _arch(row: Row, arc: Floats) -> tuple[Floats, Floats]:
    """Return points (x, z) on the arch and the outward directions there."""
    turn = np.linspace(-np.pi / 2, np.pi / 2, 721)
    line = np.stack([row.half_breadth * np.sin(turn), row.middle + row.depth * np.cos(turn)], 1)
    run = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    at = np.interp(arc, run - run[-1] / 2, turn)
    point = np.stack([row.half_breadth * np.sin(at), row.middle + row.depth * np.cos(at)], 1)
    outward = np.stack([np.sin(at) / row.half_breadth, np.cos(at) / row.depth], 1)
    return point, outward / np.linalg.norm(outward, axis=1, keepdims=True)


def _sheet(points: Floats, row: Row) -> tuple[Floats, Indices]:
    """Return vertices and triangles of a sheet (rows, columns, 3) that faces outward."""
    grid = np.arange(points[..., 0].size, dtype=np.intp).reshape(points.shape[:2])
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    if row.edge > row.neck:  # the rows run upward
        b, d = d, b
    triangles = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    return points.reshape(-1, 3) * 1e-3, triangles


def teeth(row: Row) -> tuple[Floats, Indices]:
    """Return the teeth of a row: vertices (V, 3) in metres and triangles (F, 3)."""
    arc, hollow, rounding, _, long = _stations(row)
    point, outward = _arch(row, arc)
    down = np.sign(row.edge - row.neck)
    layers = []
    for share, out in _PROFILE:
        near_edge = np.clip(share, 0.0, 1.0) ** 3
        y = row.neck + (row.edge - row.neck) * share + down * near_edge * (long - 0.45 * rounding)
        at = point + outward * (out + hollow * (0.55 + 0.45 * share) * (share > -0.1))[:, None]
        layers.append(np.stack([at[:, 0], y, at[:, 1]], axis=1))
    return _sheet(np.stack(layers), row)


def gums(row: Row) -> tuple[Floats, Indices]:
    """Return the gum of a row: vertices (V, 3) in metres and triangles (F, 3)."""
    arc, hollow, _, scallop, _ = _stations(row)
    point, outward = _arch(row, arc)
    layers = []
    for share, out in _GUM:
        margin = row.neck + (row.edge - row.neck) * 0.16 * scallop
        at = point + outward * (out + 0.5 * hollow * share)[:, None]
        layers.append(np.stack([at[:, 0], row.root + (margin - row.root) * share, at[:, 1]], 1))
    return _sheet(np.stack(layers), row)
