"""A mesh that follows markers: radial basis functions, the lips apart.

Cao et al. 2004, section 3: the markers are points of the mesh, and the rest of it is
deformed by radial basis functions. Two things are added. Upper and lower lip touch, but do
not move together: each vertex has a *side*, 1 on the upper lip, 0 on the lower, and goes
from one to the other beside the corners of the mouth; what lies wholly on one side follows
no marker that lies wholly on the other. And what is far from all markers does not move.

Markers lie on the borders of the lips, and the kernel would draw what lies inside of them
towards the mean of the face: a mouth would open by a fifth too little. The edge of a lip is a
free one, nothing beyond pulls at it; so the markers beside it are mirrored at it, and their
images move as they do.

The kernel is the distance to the power of 1.5, with a constant: the distance itself (the
biharmonic kernel of three dimensions) leaves a cusp at each marker, which one sees; its cube
overshoots. It meets the markers and levels off behind the last of them. All is linear in the
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
_SIDED = 1e-4
_AT, _BESIDE = 0.02, 0.25
"""Of the mouth's width: markers so far from where the lips meet are mirrored."""
_FULL, _GONE = 1.5, 6.0
"""Skin moves wholly up to so many spacings of the markers from the next one, and not beyond."""


_NO_IMAGES: tuple[Floats, Indices] = (np.zeros((0, 3)), np.zeros(0, np.intp))


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
    line: Floats | None = None,
) -> Skin:
    """Bind a mesh to markers.

    Parameters
    ----------
    points : (V, 3) float64
        The mesh at rest.
    sides : (V,) float64
        Of each vertex, from :func:`mouth_sides`.
    markers : (M, 3) float64
        On the mesh.
    marker_sides : (M,) float64
    line : (P, 3) float64, optional
        Where the lips meet, from corner to corner.

    Returns
    -------
    Skin
    """
    sides, marker_sides = _snapped(sides), _snapped(marker_sides)
    weights = np.zeros((len(points), len(markers)))
    images, owners = mirrored(markers, marker_sides, line) if line is not None else _NO_IMAGES
    for share, away in ((sides, marker_sides <= 0.0), (1.0 - sides, marker_sides >= 1.0)):
        rows, heard = np.flatnonzero(share > 0), np.flatnonzero(~away)
        if not len(rows) or not len(heard):
            continue
        also = ~away[owners]
        part = interpolation(points[rows], markers[heard], images[also])
        own, of_images = part[:, : len(heard)], part[:, len(heard) :]
        for column, owner in zip(of_images.T, np.searchsorted(heard, owners[also]), strict=True):
            own[:, owner] += column
        weights[np.ix_(rows, heard)] += share[rows, None] * own
    return Skin((weights * fading(points, markers)[:, None]).astype(np.float32))


def _snapped(sides: Floats) -> Floats:
    """Return sides that rounding took off 0 and 1 as what they are."""
    sides = np.where(sides < _SIDED, 0.0, sides)
    return np.where(sides > 1.0 - _SIDED, 1.0, sides)


def mirrored(markers: Floats, sides: Floats, line: Floats) -> tuple[Floats, Indices]:
    """Return the images of the markers beside the line of the lips, and whose each is."""
    start, along = line[:-1], np.diff(line, axis=0)
    long = np.maximum((along**2).sum(axis=1), 1e-30)
    share = ((markers[:, None] - start) * along).sum(axis=2) / long
    feet = start + np.clip(share, 0.0, 1.0)[:, :, None] * along
    far = np.linalg.norm(markers[:, None] - feet, axis=2)
    nearest = far.argmin(axis=1)
    rows = np.arange(len(markers))
    width = float(np.linalg.norm(line[-1] - line[0]))
    inside = (nearest + share[rows, nearest] > 0) & (nearest + share[rows, nearest] < len(along))
    near = far[rows, nearest] / width
    owners = np.flatnonzero(inside & (near > _AT) & (near < _BESIDE) & (np.abs(sides - 0.5) >= 0.5))
    return 2.0 * feet[owners, nearest[owners]] - markers[owners], owners


def interpolation(points: Floats, markers: Floats, images: Floats | None = None) -> Floats:
    """Return weights by which points take the values at markers, meeting them.

    Parameters
    ----------
    points : (V, 3) float64
    markers : (M, 3) float64
    images : (I, 3) float64, optional
        Further places with values.

    Returns
    -------
    (V, M + I) float64
    """
    sources = markers if images is None else np.concatenate([markers, images])
    count, size = len(sources), float(np.ptp(sources, axis=0).max()) or 1.0
    system: Floats = np.ones((count + 1, count + 1))
    system[:count, :count] = _RIDGE * np.eye(count) - (_distances(sources, sources) / size) ** 1.5
    system[count, count] = 0.0
    columns: Floats = np.ones((len(points), count + 1))
    columns[:, :count] = -((_distances(points, sources) / size) ** 1.5)
    # The system is symmetric: what it solves for the points are the weights themselves.
    found = np.linalg.solve(system, columns.T)[:count].T
    return np.asarray(found, np.float64)


def _distances(one: Floats, other: Floats) -> Floats:
    squares = np.zeros((len(one), len(other)))
    for axis in range(3):
        squares += np.subtract.outer(one[:, axis], other[:, axis]) ** 2
    return np.asarray(np.sqrt(squares))


def fading(points: Floats, markers: Floats) -> Floats:
    """Return by how much points (V,) move at all, 1 about the markers and 0 far from them."""
    near = _distances(points, markers).min(axis=1)
    apart = _distances(markers, markers) + np.diag(np.full(len(markers), np.inf))
    spacing = float(np.median(apart.min(axis=1))) if len(markers) > 1 else 1.0
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
