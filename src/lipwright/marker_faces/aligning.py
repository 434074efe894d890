"""Laying a layout of markers onto a face: the similarity that brings them together.

Iterated closest points (Besl, McKay 1992; the plane at each of them: Chen, Medioni 1992),
from several starts about the first guess of the layout. A marker's like is not only near:
what opens with the mouth is drawn to what opens, so that no lip comes to lie on the other.
The same layout and face give the same answer.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from lipwright.marker_faces.face_mesh import FaceMesh
from lipwright.marker_faces.layout import MarkerLayout
from lipwright.marker_faces.placing import LIKE

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

HUMAN_MOUTH = 0.05
"""Metres from corner to corner: what tells roughly how large a model is."""
_SCALES, _PITCHES, _ROLLS = (0.75, 1.0, 1.3), (-25.0, 0.0, 25.0), (-20.0, 0.0, 20.0)
_LEAST, _MOST = 0.6, 1.7
_COARSE, _ROUNDS, _KEPT, _FINE_ROUNDS = 2500, 10, 4, 40
_LOOSE = 0.12
_ALONG = 0.02
_PINNED = 20.0
_DONE = 1e-7


@dataclass(frozen=True, slots=True, eq=False)
class Alignment:
    """How a layout lies on a face: ``scale * points @ turn.T + shift``.

    Parameters
    ----------
    turn : (3, 3) float64
        From the layout's axes to the head's left, up and front.
    scale : float
        Of the model's units in a metre.
    shift : (3,) float64
    cost : float
        What is left, 0..1: no unit.
    """

    turn: Floats
    scale: float
    shift: Floats
    cost: float = 0.0

    def laid(self, points: Floats) -> Floats:
        """Return places in the layout as places on the face."""
        return np.asarray(self.scale * points @ self.turn.T + self.shift)

    def moved(self, displacements: Floats) -> Floats:
        """Return displacements (…, 3) in the layout as displacements on the face."""
        return np.asarray(self.scale * displacements @ self.turn.T)


@dataclass(frozen=True, slots=True, eq=False)
class _Ground:
    """What the markers are drawn to."""

    points: Floats
    normals: Floats
    lowered: Floats
    width: float

    def nearest(self, points: Floats, lowered: Floats) -> Indices:
        like = LIKE * self.width
        own = np.column_stack([points, like * lowered])
        other = np.column_stack([self.points, like * self.lowered])
        far = (other**2).sum(axis=1) - 2 * own @ other.T
        return np.asarray(far.argmin(axis=1))

    def trust(self, far: Floats) -> Floats:
        return np.asarray(1.0 / (1.0 + (far / (_LOOSE * self.width)) ** 2))


def align(layout: MarkerLayout, face: FaceMesh, pins: dict[int, Floats]) -> Alignment:
    """Lay a layout onto a face.

    Parameters
    ----------
    layout : MarkerLayout
    face : FaceMesh
    pins : dict of int to (3,) float64
        Where single markers lie, in the head's axes.

    Returns
    -------
    Alignment
        The best that was found; whether it is good the caller decides.
    """
    outer = np.flatnonzero(face.outward)
    fine = _Ground(face.points[outer], face.normals[outer], face.lowered[outer], face.width)
    some = outer[:: max(1, len(outer) // _COARSE)]
    coarse = _Ground(face.points[some], face.normals[some], face.lowered[some], face.width)
    found = [_settled(layout, coarse, pins, one) for one in _starts(layout, fine)]
    found.sort(key=lambda each: each.cost)
    polished = [_polished(layout, fine, pins, one) for one in found[:_KEPT]]
    return min(polished, key=lambda each: each.cost)


def _starts(layout: MarkerLayout, ground: _Ground) -> list[Alignment]:
    """Return first guesses: turned, tilted, larger and smaller; what opens over what opens."""
    of_markers = np.average(layout.rest, axis=0, weights=layout.lowered**2 + 1e-6)
    opening = ground.points[ground.lowered > 0.3]
    target = (opening.min(axis=0) + opening.max(axis=0)) / 2
    target[2] = float(opening[:, 2].max())
    found = []
    for size, pitch, roll in product(_SCALES, _PITCHES, _ROLLS):
        turn = _about(2, roll) @ _about(0, pitch) @ layout.axes
        scale = size * ground.width / HUMAN_MOUTH
        found.append(Alignment(turn, scale, target - scale * turn @ of_markers))
    return found


def _about(axis: int, degrees: float) -> Floats:
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    made = np.eye(3)
    one, other = (axis + 1) % 3, (axis + 2) % 3
    made[one, one] = made[other, other] = cosine
    made[one, other], made[other, one] = -sine, sine
    return made


def _settled(
    layout: MarkerLayout, ground: _Ground, pins: dict[int, Floats], start: Alignment
) -> Alignment:
    """Bring markers to the points that are nearest, again and again."""
    found = start
    for _ in range(_ROUNDS):
        laid = found.laid(layout.rest)
        target = ground.points[ground.nearest(laid, layout.lowered)]
        weights = ground.trust(np.linalg.norm(target - laid, axis=1))
        target, weights = _with_pins(target, weights, pins)
        found = similarity(layout.rest, target, weights, _bounds(ground.width))
    return _judged(layout, ground, pins, found)


def _polished(
    layout: MarkerLayout, ground: _Ground, pins: dict[int, Floats], start: Alignment
) -> Alignment:
    """Let markers slide along the planes at the nearest points."""
    found = start
    for _ in range(_FINE_ROUNDS):
        laid = found.laid(layout.rest)
        near = ground.nearest(laid, layout.lowered)
        target, normals = ground.points[near], ground.normals[near]
        across = ((target - laid) * normals).sum(axis=1)
        weights = ground.trust(np.abs(across))
        target, weights = _with_pins(target, weights, pins)
        along = np.full(len(laid), _ALONG)
        along[list(pins)] = 1.0
        pivot = laid.mean(axis=0)
        step = _step(laid - pivot, target - laid, normals, weights, along)
        found = _stepped(found, step, pivot, _bounds(ground.width))
        if np.abs(step[[0, 1, 2, 6]]).max() < _DONE:
            break
    return _judged(layout, ground, pins, found)


def _step(arms: Floats, offsets: Floats, normals: Floats, weights: Floats, along: Floats) -> Floats:
    """Return the small turn, shift and growth, (7,), that meet planes, and points a little."""
    moves = np.zeros((len(arms), 3, 7))
    for axis in range(3):
        moves[:, :, axis] = np.cross(np.eye(3)[axis], arms)
        moves[:, axis, 3 + axis] = 1.0
    moves[:, :, 6] = arms
    parts = np.eye(3) * along[:, None, None] + normals[:, :, None] * normals[:, None, :]
    system = np.einsum("mia,m,mij,mjb->ab", moves, weights, parts, moves)
    right = np.einsum("mia,m,mij,mj->a", moves, weights, parts, offsets)
    scale = np.sqrt(np.maximum(np.diag(system), 1e-30))
    solved = np.linalg.solve(system / np.outer(scale, scale) + 1e-9 * np.eye(7), right / scale)
    return np.asarray(solved / scale)


def _stepped(
    found: Alignment, step: Floats, pivot: Floats, bounds: tuple[float, float]
) -> Alignment:
    angle = float(np.linalg.norm(step[:3]))
    axis = step[:3] / (angle or 1.0)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    scale = float(np.clip(found.scale * (1 + step[6]), *bounds))
    grown = scale / found.scale * turn
    shift = pivot + grown @ (found.shift - pivot) + step[3:6]
    return Alignment(turn @ found.turn, scale, shift)


def _with_pins(target: Floats, weights: Floats, pins: dict[int, Floats]) -> tuple[Floats, Floats]:
    target, weights = target.copy(), weights.copy()
    for marker, point in pins.items():
        target[marker], weights[marker] = point, _PINNED
    return target, weights


def _bounds(width: float) -> tuple[float, float]:
    return _LEAST * width / HUMAN_MOUTH, _MOST * width / HUMAN_MOUTH


def _judged(
    layout: MarkerLayout, ground: _Ground, pins: dict[int, Floats], found: Alignment
) -> Alignment:
    """Return it with what is left: distances of the markers, and likes that were not found.

    Distances are measured in the layout's own size, else the smallest would be the best.
    """
    laid = found.laid(layout.rest)
    near = ground.nearest(laid, layout.lowered)
    target, _ = _with_pins(ground.points[near], near.astype(np.float64), pins)
    far = np.linalg.norm(target - laid, axis=1) / found.scale / HUMAN_MOUTH
    unlike = LIKE * (ground.lowered[near] - layout.lowered)
    left = np.sqrt(far**2 + unlike**2) / _LOOSE
    return Alignment(found.turn, found.scale, found.shift, float(np.mean(left**2 / (1 + left**2))))


def similarity(
    points: Floats, target: Floats, weights: Floats, bounds: tuple[float, float]
) -> Alignment:
    """Return the similarity without mirroring that brings points onto others (Umeyama 1991)."""
    share = weights / weights.sum()
    middle, goal = share @ points, share @ target
    one, other = points - middle, target - goal
    u, sizes, v = np.linalg.svd((other * share[:, None]).T @ one)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(u @ v))])
    turn = (u * signs) @ v
    scale = float((sizes * signs).sum() / (share @ (one**2).sum(axis=1)))
    scale = float(np.clip(scale, *bounds))
    return Alignment(turn, scale, goal - scale * turn @ middle)
