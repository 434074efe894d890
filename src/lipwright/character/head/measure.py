"""How the mouth of a head looks at given weights: opening, breadth, protrusion.

Measured on the mesh at vertices that the head records (:class:`Landmarks`). Targets add,
so a whole animation is measured at once: a weight may be an array over time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lipwright.character.mesh import Part

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Landmarks:
    """Vertex numbers of the part ``skin`` that mark the mouth.

    Parameters
    ----------
    upper_inner_lip, lower_inner_lip : int
        In the middle, where the lips meet.
    left_corner, right_corner : int
        The corners of the mouth.
    upper_lip, lower_lip : tuple of int
        Down the middle of each lip, from the border of its red to its inner side.
    upper_loop, lower_loop : tuple of int
        The line where the lips meet, from the right to the left corner, one number of the
        lower for each of the upper.
    """

    upper_inner_lip: int
    lower_inner_lip: int
    left_corner: int
    right_corner: int
    upper_lip: tuple[int, ...]
    lower_lip: tuple[int, ...]
    upper_loop: tuple[int, ...]
    lower_loop: tuple[int, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Mouth:
    """Measures of the mouth; each an array over time, or of no dimension.

    Parameters
    ----------
    opening : metres
        What can be seen through between the lips from the front, in the middle; 0 when closed.
    contact_gap : metres
        From the lower to the upper lip's contact in the middle; below 0 if they crossed.
    breadth : metres
        From corner to corner.
    protrusion : metres
        How far the lips' middle stands out, beyond neutral.
    """

    opening: Floats
    contact_gap: Floats
    breadth: Floats
    protrusion: Floats


def measure(parts: Sequence[Part], marks: Landmarks, weights: Mapping[str, ArrayLike]) -> Mouth:
    """Measure the mouth at weights of the head's targets.

    Parameters
    ----------
    parts : sequence of Part
        The head, as built.
    marks : Landmarks
    weights : mapping of str to float or array
        Weight of each target; arrays over time must have the same length. Names that the
        skin has no target for are ignored.
    """
    skin = next(part for part in parts if part.name == "skin")
    upper = _moved(skin, marks.upper_lip, weights)
    lower = _moved(skin, marks.lower_lip, weights)
    meet = _moved(skin, (marks.upper_inner_lip, marks.lower_inner_lip), weights)
    corners = _moved(skin, (marks.left_corner, marks.right_corner), weights)
    front = np.maximum(upper[..., 2].max(axis=-1), lower[..., 2].max(axis=-1))
    rest = skin.positions[[*marks.upper_lip, *marks.lower_lip], 2].max()
    return Mouth(
        opening=np.maximum(upper[..., 1].min(axis=-1) - lower[..., 1].max(axis=-1), 0.0),
        contact_gap=meet[..., 0, 1] - meet[..., 1, 1],
        breadth=corners[..., 0, 0] - corners[..., 1, 0],
        protrusion=front - float(rest),
    )


def _moved(skin: Part, vertices: Sequence[int], weights: Mapping[str, ArrayLike]) -> Floats:
    """Return where vertices are: (..., n, 3), metres."""
    ids = list(vertices)
    points = skin.positions[ids].astype(np.float64)
    for name, weight in weights.items():
        target = skin.morphs.get(name)
        if target is not None:
            points = points + np.asarray(weight, np.float64)[..., None, None] * target[ids]
    return points
