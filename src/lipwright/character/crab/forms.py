"""The solids of which the crab is put together: limbs with round ends, and balls.

Points in millimetres, closed surfaces, triangles counter-clockwise seen from outside.
This module knows no crab.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_FORWARD = (0.0, 0.0, 1.0)


class Solid(NamedTuple):
    """A closed surface.

    Parameters
    ----------
    points : (V, 3) float64, millimetres
    triangles : (F, 3) intp
    along : (V,) float64
        Share of the way from its first to its last end.
    around : (V,) float64, radians
        Where it lies around the way; 0 on the side of the limb's `hint`.
    """

    points: Floats
    triangles: Indices
    along: Floats
    around: Floats


@dataclass(frozen=True, slots=True)
class Limb:
    """A way through stations with a thickness at each, drawn as a smooth round form.

    Parameters
    ----------
    stations : sequence of (x, y, z, radius), millimetres
    flat : float
        Breadth across the hint's direction, as a share of that along it.
    hint : tuple of 3 float
        A direction that the cross-sections' first axis keeps near to.
    rings, sides : int
        How finely it is drawn.
    """

    stations: ArrayLike
    flat: float = 1.0
    hint: tuple[float, float, float] = _FORWARD
    rings: int = 14
    sides: int = 12

    def solid(self) -> Solid:
        """Return its surface."""
        rows = np.asarray(self.stations, np.float64)
        at = np.linspace(0.0, 1.0, self.rings)
        way = smooth(rows, at)
        first, last = _cap(way[0], way[0] - way[1]), _cap(way[-1], way[-1] - way[-2])
        way = np.concatenate([first[::-1], way, last])
        share = np.concatenate([np.zeros(len(first)), at, np.ones(len(last))])
        return tube(way, share, self.flat, self.hint, self.sides)


def smooth(rows: Floats, at: Floats) -> Floats:
    """Return a Catmull-Rom curve through rows, at shares 0..1 of its length: (n, columns)."""
    ends = np.stack([2 * rows[0] - rows[1], 2 * rows[-1] - rows[-2]])
    full = np.concatenate([ends[:1], rows, ends[1:]])
    steps = np.linalg.norm(np.diff(rows[:, :3], axis=0), axis=1)
    run = np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()
    low = np.clip(np.searchsorted(run, at, "right") - 1, 0, len(rows) - 2)
    t = ((at - run[low]) / (run[low + 1] - run[low]))[:, None]
    a, b, c, d = (full[low + k] for k in range(4))
    bend = (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3
    return np.asarray(0.5 * (2 * b + (c - a) * t + bend), np.float64)


def _cap(end: Floats, ahead: Floats) -> Floats:
    """Return the stations of a round end, outward."""
    unit = ahead[:3] / np.linalg.norm(ahead[:3])
    turn = np.radians([35.0, 65.0, 85.0])[:, None]
    middle = end[:3] + unit * end[3] * np.sin(turn) * 0.8
    return np.concatenate([middle, end[3] * np.cos(turn)], axis=1)


def tube(
    way: Floats, share: Floats, flat: float, hint: tuple[float, float, float], sides: int
) -> Solid:
    """Return the surface around a way of (x, y, z, radius), closed at both ends."""
    middle, radius = way[:, :3], way[:, 3:]
    along = np.gradient(middle, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    first = np.asarray(hint) - (along @ np.asarray(hint))[:, None] * along
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    second = np.cross(along, first)
    angle = np.arange(sides) * 2 * np.pi / sides
    rim = np.cos(angle)[:, None] * first[:, None] + (
        flat * np.sin(angle)[:, None] * second[:, None]
    )
    rings = middle[:, None] + radius[:, None] * rim
    points = np.concatenate([rings.reshape(-1, 3), middle[:1], middle[-1:]])
    return Solid(
        points,
        wrap(len(way), sides),
        np.concatenate([np.repeat(share, sides), [0.0, 1.0]]),
        np.concatenate([np.tile(angle, len(way)), [0.0, 0.0]]),
    )


def wrap(rings: int, sides: int) -> Indices:
    """Return the triangles of rings joined to a tube, the last two points closing its ends."""
    grid = np.arange(rings * sides).reshape(rings, sides)
    a, d = grid[:-1], grid[1:]
    b, c = np.roll(a, -1, axis=1), np.roll(d, -1, axis=1)
    faces = [np.stack(corners, -1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))]
    start, end = np.full(sides, rings * sides), np.full(sides, rings * sides + 1)
    faces.append(np.stack([start, np.roll(grid[0], -1), grid[0]], axis=1))
    faces.append(np.stack([grid[-1], np.roll(grid[-1], -1), end], axis=1))
    return np.concatenate(faces)


def ball(center: ArrayLike, radius: float, from_front: ArrayLike, sides: int) -> Solid:
    """Return a ball with rings at angles from its front (degrees), from the back forward."""
    turn = np.radians(np.asarray(from_front, np.float64))[::-1]
    x, y, z = np.asarray(center, np.float64)
    rings = len(turn)
    way = np.stack(
        [np.full(rings, x), np.full(rings, y), z + radius * np.cos(turn), radius * np.sin(turn)], 1
    )
    angle = np.arange(sides) * 2 * np.pi / sides
    rim = np.stack([np.cos(angle), np.sin(angle), np.zeros(sides)], axis=1)
    points = (way[:, None, :3] + way[:, None, 3:] * rim).reshape(-1, 3)
    ends = np.array([[x, y, z - radius], [x, y, z + radius]])
    share = np.concatenate([np.repeat(1.0 - turn / np.pi, sides), [0.0, 1.0]])
    around = np.concatenate([np.tile(angle, rings), [0.0, 0.0]])
    return Solid(np.concatenate([points, ends]), wrap(rings, sides), share, around)


def joined(solids: list[Solid]) -> Solid:
    """Return several surfaces as one."""
    starts = np.cumsum([0, *(len(solid.points) for solid in solids[:-1])])
    return Solid(
        np.concatenate([solid.points for solid in solids]),
        np.concatenate([s.triangles + start for s, start in zip(solids, starts, strict=True)]),
        np.concatenate([solid.along for solid in solids]),
        np.concatenate([solid.around for solid in solids]),
    )


def mirrored(solid: Solid) -> Solid:
    """Return the surface's mirror image, left for right."""
    return Solid(
        solid.points * (-1.0, 1.0, 1.0), solid.triangles[:, ::-1], solid.along, solid.around
    )
