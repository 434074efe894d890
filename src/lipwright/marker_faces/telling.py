"""Markers told in poses: what they do on a face, the face's own poses are asked to do.

Non-negative least squares on the displacements where the markers lie, every frame at once
(DESIGN section 5, *Out*).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipwright.character.unmixing import FIRM, nonnegative
from lipwright.errors import CharacterError
from lipwright.marker_faces.binding import Binding
from lipwright.marker_faces.face_mesh import FaceMesh

if TYPE_CHECKING:
    from lipwright.character import Character

Floats = NDArray[np.float64]

SEEN = 0.02
"""A pose that moves no marker by as much of the mouth's width is not seen."""


@dataclass(frozen=True, slots=True, eq=False)
class ByMarkers:
    """How the places of markers are told in some poses.

    Parameters
    ----------
    poses : tuple of str
        Those that move a marker.
    alike : (P, P) float64
        Products of the poses' displacements, kept apart a little.
    products : (P, 3 M) float64
        What the markers' displacements, in the layout's axes, are multiplied by.
    rest : (3 M,) float64, metres
        Where markers are while nothing is said.
    """

    poses: tuple[str, ...]
    alike: Floats
    products: Floats
    rest: Floats

    def weights(self, values: Floats, given: Floats) -> Floats:
        """Return weights (T, P) for places (T, 3 M); what is given, (T, P), is kept."""
        return nonnegative(self.alike, (values - self.rest) @ self.products.T, given)


def by_markers(
    character: Character, face: FaceMesh, binding: Binding, rest: Floats, poses: Sequence[str]
) -> ByMarkers:
    """Return how markers on a face are told in its poses.

    Parameters
    ----------
    character : Character
    face : FaceMesh
        Of the character.
    binding : Binding
        Of the markers to the face.
    rest : (3 M,) float64, metres
        Where markers are while nothing is said, in the layout's axes.
    poses : sequence of str

    Raises
    ------
    CharacterError
        If no pose moves a marker.
    """
    fitting = character.fit()
    corners = np.stack([each.corners for each in binding.placed])
    shares = np.stack([each.shares for each in binding.placed])
    shown, moves = [], []
    for pose in poses:
        moved = face.surfaces.positions(fitting.values({pose: 1.0})) - face.points
        at_markers = np.einsum("mc,mcd->md", shares, moved[corners])
        if np.linalg.norm(at_markers, axis=1).max() > SEEN * face.width:
            shown.append(pose)
            moves.append(at_markers)
    if not shown:
        raise CharacterError(
            f"none of the poses ({', '.join(list(poses)[:6])}) moves a marker",
            where=face.name,
            expected="poses that the character has",
        )
    here = np.stack(moves)
    flat = here.reshape(len(here), -1)
    scale = float((flat**2).sum(axis=1).mean())
    # A displacement in the layout is turned and scaled onto the face: the same, transposed.
    back = binding.alignment.scale * here @ binding.alignment.turn
    return ByMarkers(
        tuple(shown),
        flat @ flat.T / scale + FIRM * np.eye(len(shown)),
        back.reshape(len(here), -1) / scale,
        rest,
    )
