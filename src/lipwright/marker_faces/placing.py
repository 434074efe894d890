"""The nearest point of a skin to a marker, on the lip that it was recorded on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.marker_faces.face_mesh import FaceMesh

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

LIKE = 0.4
"""Of the mouth's width: how far apart lie, for a marker, what opens wholly and what stays."""
_NEAREST = 24
_OTHER_LIP = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Placed:
    """A point on a skin.

    Parameters
    ----------
    corners : (3,) int
        The vertices of its triangle.
    shares : (3,) float64
        Of each of them; their sum is 1.
    point : (3,) float64
    """

    corners: Indices
    shares: Floats
    point: Floats


def place(face: FaceMesh, points: Floats, lowered: Floats | None = None) -> list[Placed]:
    """Put points on the skin.

    Parameters
    ----------
    face : FaceMesh
    points : (M, 3) float64
        In the head's axes.
    lowered : (M,) float64, optional
        How much each goes down as the mouth opens, 0..1: which of two lips it is on.
    """
    outer = np.flatnonzero(face.outward)
    inside = np.zeros(len(face.points), np.bool_)
    found = []
    for number, point in enumerate(points):
        far = ((face.points[outer] - point) ** 2).sum(axis=1)
        if lowered is not None:
            like = LIKE * face.width * (face.lowered[outer] - lowered[number])
            side = face.sides[outer[int(np.argmin(far + like**2))]]
            far[np.abs(face.sides[outer] - side) > _OTHER_LIP] = np.inf
        inside[:] = False
        inside[outer[np.argsort(far, kind="stable")[:_NEAREST]]] = True
        near = face.triangles[inside[face.triangles].any(axis=1)]
        if lowered is not None:
            own = near[(np.abs(face.sides[near] - side) <= _OTHER_LIP).all(axis=1)]
            near = own if len(own) else near
        found.append(_nearest(face.points, near, point))
    return found


def _nearest(points: Floats, triangles: Indices, point: Floats) -> Placed:
    """Return the nearest point of some triangles."""
    shares = nearest_shares(points[triangles], point)
    places = (shares[:, :, None] * points[triangles]).sum(axis=1)
    best = int(np.argmin(((places - point) ** 2).sum(axis=1)))
    return Placed(triangles[best], shares[best], places[best])


def nearest_shares(triangles: Floats, point: Floats) -> Floats:
    """Return the nearest point of each triangle (F, 3, 3), as shares (F, 3) of its corners.

    The foot of the plumb line where it lies inside, else the nearest point of the three
    edges.
    """
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    normal = np.cross(b - a, c - a)
    size = (normal**2).sum(axis=1)
    size = np.where(size > 0, size, np.inf)
    inner = np.stack(
        [
            (np.cross(c - b, point - b) * normal).sum(axis=1) / size,
            (np.cross(a - c, point - c) * normal).sum(axis=1) / size,
            (np.cross(b - a, point - a) * normal).sum(axis=1) / size,
        ],
        axis=1,
    )
    best, least = inner, np.where((inner.min(axis=1) >= 0) & np.isfinite(size), 0.0, np.inf)
    for one, other in ((0, 1), (1, 2), (2, 0)):
        start, along = triangles[:, one], triangles[:, other] - triangles[:, one]
        long = (along**2).sum(axis=1)
        part = np.clip(((point - start) * along).sum(axis=1) / np.where(long > 0, long, 1.0), 0, 1)
        far = ((start + part[:, None] * along - point) ** 2).sum(axis=1)
        shares = np.zeros_like(inner)
        shares[:, one], shares[:, other] = 1 - part, part
        nearer = far < least
        best = np.where(nearer[:, None], shares, best)
        least = np.where(nearer, far, least)
    return best
