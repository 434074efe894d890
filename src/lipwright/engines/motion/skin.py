"""A mesh that follows markers: radial basis functions, the lips apart.

Cao et al. 2004, section 3: the markers are points of the mesh, and the rest of it is
deformed by radial basis functions. Two things are added. Upper and lower lip touch, but do
not move together: each vertex has a *side*, 1 on the upper lip, 0 on the lower, and goes
from one to the other beside the corners of the mouth; what lies wholly on one side follows
no marker that lies wholly on the other. And what is far from all markers does not move.

The kernel is Hardy's multiquadric (1971), the distance rounded off at its foot, with a
constant: the distance is the biharmonic kernel of three dimensions, which overshoots beyond
the markers of the lips less than its cube, but leaves a cusp at each of them, which one
sees. It meets the markers and levels off behind the last of them. All is linear in the
markers and computed once, into one matrix. Lengths are the mesh's own; nothing is known
here of characters.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_BAND = 0.1
"""Harmonic sides up to this far from the middle belong to both."""
_PULL = 1e-7
_EXACT, _MOST_STEPS = 1e-6, 4000
_RIDGE = 1e-7
_ROUND, _CLOSEST = 0.5, 0.1
"""The kernel's foot is half of the spacing of the closest tenth of the markers."""
_FULL, _GONE = 1.5, 6.0
"""Skin moves wholly up to so many spacings of the markers from the next one, and not beyond."""


@dataclass(frozen=True, slots=True, eq=False)
class Skin:
    """A mesh bound to markers.

    Parameters
    ----------
    weights : (V, M) float32
        How far each vertex follows each marker.
    """

    weights: NDArray[np.float32]

    def moved(self, displacements: NDArray[np.floating]) -> NDArray[np.float32]:
        """Return displacements (V, 3) of the vertices for those (M, 3) of the markers."""
        return np.asarray(self.weights @ np.asarray(displacements, np.float32))

    def targets(self, basis: NDArray[np.floating]) -> NDArray[np.float32]:
        """Return (K, V, 3), what each of K displacements (K, M, 3) of all markers makes."""
        return np.stack([self.moved(one) for one in basis])


def bind_skin(
    points: Floats,
    sides: Floats,
    markers: Floats,
    marker_sides: Floats,
) -> Skin:
    """Bind a mesh to markers.

    Parameters
    ----------
    points : (V, 3) float64
        The mesh at rest.
    sides : (V,) float64
        Of each vertex, from :func:`mouth_sides`.
    markers : (M, 3) float64
        On the mesh, no two at one place.
    marker_sides : (M,) float64

    Returns
    -------
    Skin
    """
    weights = np.zeros((len(points), len(markers)))
    for share, away in ((sides, marker_sides <= 0.0), (1.0 - sides, marker_sides >= 1.0)):
        rows, heard = np.flatnonzero(share > 0), np.flatnonzero(~away)
        if len(rows) and len(heard):
            part = interpolation(points[rows], markers[heard])
            weights[np.ix_(rows, heard)] += share[rows, None] * part
    return Skin((weights * fading(points, markers)[:, None]).astype(np.float32))


def interpolation(points: Floats, markers: Floats) -> Floats:
    """Return weights (V, M) by which points take the values at markers, meeting them."""
    count = len(markers)
    apart = _distances(markers, markers)
    foot = _ROUND * float(np.quantile(_nearest(apart), _CLOSEST)) if count > 1 else 1.0
    kernel = np.asarray(-np.sqrt(apart**2 + foot**2), np.float64)
    size = float(np.abs(kernel).max()) or 1.0
    system: Floats = np.ones((count + 1, count + 1))
    system[:count, :count] = kernel / size + _RIDGE * np.eye(count)
    system[count, count] = 0.0
    columns: Floats = np.ones((len(points), count + 1))
    columns[:, :count] = -np.sqrt(_distances(points, markers) ** 2 + foot**2) / size
    # The system is symmetric: what it solves for the points are the weights themselves.
    found = np.linalg.solve(system, columns.T)[:count].T
    return np.asarray(found, np.float64)


def _distances(one: Floats, other: Floats) -> Floats:
    squares = np.zeros((len(one), len(other)))
    for axis in range(3):
        squares += np.subtract.outer(one[:, axis], other[:, axis]) ** 2
    return np.asarray(np.sqrt(squares))


def _nearest(apart: Floats) -> Floats:
    """Return the distance of each marker (M,) to the next, given all distances (M, M)."""
    return np.asarray((apart + np.diag(np.full(len(apart), np.inf))).min(axis=1))


def fading(points: Floats, markers: Floats) -> Floats:
    """Return by how much points (V,) move at all, 1 about the markers and 0 far from them."""
    near = _distances(points, markers).min(axis=1)
    apart = _nearest(_distances(markers, markers))
    spacing = float(np.median(apart)) if len(markers) > 1 else 1.0
    return 1.0 - smooth((near / (spacing or 1.0) - _FULL) / (_GONE - _FULL))


def smooth(values: Floats) -> Floats:
    """Return values held within 0..1 that leave both ends without a kink."""
    held = np.clip(values, 0.0, 1.0)
    return np.asarray(held * held * (3.0 - 2.0 * held))


def mouth_sides(points: Floats, triangles: Indices, upper: Indices, lower: Indices) -> Floats:
    """Tell the upper lip's side of a face from the lower's, along its surface.

    The harmonic function that is 1 where the upper lip meets the lower and 0 where the
    lower meets the upper: through the air they touch, along the skin they are the way
    round the corner apart.

    Parameters
    ----------
    points : (V, 3) float64
        Points that a seam has split must be one.
    triangles : (F, 3) int
    upper, lower : int arrays
        The line of each lip, from corner to corner, without the corners.

    Returns
    -------
    (V,) float64
        1 on the upper side, 0 on the lower, between them beside the corners and far away.
    """
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    edges = edges[edges[:, 0] != edges[:, 1]]
    long = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    pull = 1.0 / np.maximum(long / long.mean(), 1e-3)
    known = np.full(len(points), np.nan)
    known[upper], known[lower] = 1.0, 0.0
    sides = _harmonic(edges, pull, known)
    return smooth((sides - 0.5 + _BAND) / (2 * _BAND))


def _harmonic(edges: Indices, pull: Floats, known: Floats) -> Floats:
    """Return values that are each the mean of their neighbours' but where they are known.

    By conjugate gradients (Hestenes, Stiefel 1952), scaled by the diagonal. What hangs on
    nothing known is drawn to 0.5.
    """
    count, free = len(known), np.isnan(known)
    one, other, twice = *edges.T, np.concatenate([pull, pull])
    ends, starts = np.concatenate([one, other]), np.concatenate([other, one])
    degree = np.bincount(ends, twice, count) + _PULL

    def system(values: Floats) -> Floats:
        drawn = degree * values - np.bincount(ends, twice * values[starts], count)
        return np.asarray(np.where(free, drawn, 0.0))

    values = np.where(free, 0.5, known)
    left = np.where(free, 0.5 * _PULL, 0.0) - system(values)
    way = left / degree
    energy = float(left @ way)
    for _ in range(_MOST_STEPS):
        ahead = system(way)
        step = energy / (float(way @ ahead) or 1.0)
        values, left = values + step * way, left - step * ahead
        if float(np.abs(left / degree).max()) < _EXACT:
            break
        before, energy = energy, float(left @ (left / degree))
        way = left / degree + energy / (before or 1.0) * way
    return values
