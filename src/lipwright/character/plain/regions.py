"""From the regions of a face file to a weight for each vertex, 0..1.

Weights rise and fall smoothly, so that skin does not crease at a cluster's edge. Distances
*along* a surface follow its edges: they part lips that lie on each other, and end where
the surface ends.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence

import numpy as np

from lipwright.character.plain.face_file import Along, Region
from lipwright.character.plain.surfaces import Floats, Surface
from lipwright.errors import CharacterError

_MIRROR = np.array([-1.0, 1.0, 1.0])


def weights(regions: Sequence[Region], surface: Surface, model: Sequence[Surface]) -> Floats:
    """Return the weight of each vertex of a surface in a cluster, (V,).

    Parameters
    ----------
    regions : sequence of Region
        Their weights are multiplied.
    surface : Surface
    model : sequence of Surface
        All surfaces: a distance along begins on the one that is nearest to its point.

    Raises
    ------
    CharacterError
        If a list of vertices names one that the surface has not.
    """
    total = np.ones(len(surface.points))
    for region in regions:
        weight = _weight(region, surface, model, mirrored=False)
        if region.mirror:
            weight = np.maximum(weight, _weight(region, surface, model, mirrored=True))
        total *= 1.0 - weight if region.invert else weight
    return total


def _weight(
    region: Region, surface: Surface, model: Sequence[Surface], *, mirrored: bool
) -> Floats:
    points = surface.points * _MIRROR if mirrored else surface.points
    if region.part is not None and region.part not in surface.names:
        return np.zeros(len(points))
    if region.vertices is not None:
        return _listed(region, surface)
    if region.sphere is not None:
        ball = region.sphere
        away = np.linalg.norm(points - np.array(ball.center), axis=1)
        return _falling(away / ball.radius, ball.core)
    if region.along is not None:
        start = np.array(region.along.point) * (_MIRROR if mirrored else 1.0)
        asked = [one for one in model if region.part is None or region.part in one.names]
        nearest = min(asked, key=lambda one: _away(one, start))
        return _along(region.along, surface, start) if surface is nearest else np.zeros(len(points))
    if region.box is not None:
        low, high = np.array(region.box.low), np.array(region.box.high)
        outside = np.maximum(np.maximum(low - points, points - high), 0.0)
        return _falling(np.linalg.norm(outside, axis=1) / max(region.box.fade, 1e-12), 0.0)
    if region.plane is not None:
        normal = np.array(region.plane.normal) / np.linalg.norm(region.plane.normal)
        height = (points - np.array(region.plane.point)) @ normal
        return _smooth(height / max(region.plane.fade, 1e-12))
    return np.ones(len(points))


def _listed(region: Region, surface: Surface) -> Floats:
    numbers = np.array(region.vertices, np.intp)
    count = len(surface.points)
    if len(numbers) and not (numbers.min() >= 0 and numbers.max() < count):
        raise CharacterError(
            f"no vertex {int(numbers.max())} in {region.part!r}", expected=f"0 to {count - 1}"
        )
    weight = np.zeros(count)
    weight[numbers] = 1.0 if region.weights is None else np.clip(region.weights, 0.0, 1.0)
    return weight


def _smooth(share: Floats) -> Floats:
    """Return a smooth rise from 0 to 1 over shares of 0 to 1."""
    share = np.clip(share, 0.0, 1.0)
    return np.asarray(share * share * (3.0 - 2.0 * share))


def _falling(away: Floats, core: float) -> Floats:
    return _smooth((1.0 - away) / (1.0 - core))


def _away(surface: Surface, start: Floats) -> float:
    return float(np.linalg.norm(surface.points - start, axis=1).min())


def _along(ball: Along, surface: Surface, start: Floats) -> Floats:
    first, place = surface.welded
    points = surface.points[first]
    seed = int(np.linalg.norm(points - start, axis=1).argmin())
    away = np.full(len(points), np.inf)
    if np.linalg.norm(points[seed] - start) <= ball.radius:
        away = _distances(points, place[surface.triangles], seed, ball.radius)
    return _falling(away / ball.radius, ball.core)[place]


def _distances(points: Floats, triangles: np.ndarray, seed: int, farthest: float) -> Floats:
    """Return how far each point is from one of them, along edges (Dijkstra)."""
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    edges = np.concatenate((edges, edges[:, ::-1]))
    edges = edges[np.argsort(edges[:, 0], kind="stable")]
    begin = np.searchsorted(edges[:, 0], np.arange(len(points) + 1))
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    away = np.full(len(points), np.inf)
    away[seed] = 0.0
    queue = [(0.0, seed)]
    while queue:
        distance, point = heapq.heappop(queue)
        if distance > away[point]:
            continue
        for edge in range(begin[point], begin[point + 1]):
            other, reached = int(edges[edge, 1]), distance + float(lengths[edge])
            if reached < away[other] and reached <= farthest:
                away[other] = reached
                heapq.heappush(queue, (reached, other))
    return away
