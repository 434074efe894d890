"""Lips that touch and do not cross.

Markers were recorded on other lips, thinner or thicker, closed or a little open at rest: what
closes those may take these through each other. A target of its own parts the lips, the upper
up and the lower down, and its weight in a frame is what is missing there. It is the only one
whose weight is not linear in the markers.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.skin import smooth
from lipwright.marker_faces.face_mesh import FaceMesh

Floats = NDArray[np.float64]

APART = "markers lips apart"
_STEP = 0.02
"""Of the mouth's width: what lips are parted by at weight 1."""
_GIVES = 0.01
"""Of the mouth's width: so far lips press into one another, as flesh does."""
_REACH = 0.3
_MIDDLE = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class Contact:
    """What tells whether lips cross.

    Parameters
    ----------
    rest : (P,) float64
        From the lower to the upper lip at rest, at points along them.
    gaps : (1 + K, P) float64
        What each target of the markers adds to that.
    parted : (P,) float64
        What the target that parts the lips adds.
    least : float
        How far they may cross, below 0.
    """

    rest: Floats
    gaps: Floats
    parted: Floats
    least: float

    def weights(self, weights: Floats) -> Floats:
        """Return the weight (T,) of parting for weights (T, 1 + K) of the others.

        What comes nearest along the lips: parting them where they only touch, to be sure of
        the last corner, would open a closed mouth.
        """
        if not len(self.rest):
            return np.zeros(len(weights))
        gaps = self.rest + weights @ self.gaps
        missing = (np.minimum(self.rest, self.least) - gaps).clip(0.0)
        return np.asarray(missing @ self.parted / (self.parted @ self.parted))


def parting(face: FaceMesh) -> Floats:
    """Return the target that parts the lips, (N, 3), in the head's axes."""
    line = face.line
    near = np.flatnonzero(face.skin & (np.abs(face.points - line.mean(axis=0)) < face.width).all(1))
    apart = np.linalg.norm(face.points[near][:, None] - line, axis=2)
    across = np.clip(2.0 * (face.points[near, 0] - line[:, 0].mean()) / face.width, -1.0, 1.0)
    share = (1.0 - smooth(apart.min(axis=1) / (_REACH * face.width))) * np.sqrt(1.0 - across**2)
    moves = np.zeros_like(face.points)
    moves[near, 1] = _STEP * face.width * share * (face.sides[near] - 0.5)
    return moves


def contact(face: FaceMesh, moves: Floats, parted: Floats) -> Contact:
    """Return what tells whether lips cross.

    Parameters
    ----------
    face : FaceMesh
    moves : (1 + K, N, 3) float64
        The targets of the markers.
    parted : (N, 3) float64
        From :func:`parting`.
    """
    upper, lower = face.mouth.upper, face.mouth.lower

    def gap(points: Floats) -> Floats:
        return np.asarray(points[..., upper, 1] - points[..., lower, 1])

    opens = gap(parted)
    middle = opens > _MIDDLE * opens.max()
    return Contact(
        gap(face.points)[middle],
        gap(moves)[:, middle],
        opens[middle],
        -_GIVES * face.width,
    )
