"""The head's parts with their materials, colours and morph targets."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.face_model import displacement
from lipwright.character.head import arkit
from lipwright.character.head.anatomy import Anatomy, of_skin, on_face, rigid
from lipwright.character.head.brows import brows
from lipwright.character.head.ears import ears
from lipwright.character.head.eyes import eyeball
from lipwright.character.head.hair import hair
from lipwright.character.head.lips import CONTACT, RED
from lipwright.character.head.measure import Landmarks
from lipwright.character.head.paint import paint_skin, shade
from lipwright.character.head.poses import POSES
from lipwright.character.head.shirt import shirt
from lipwright.character.head.skin import Skin, build_skin
from lipwright.character.head.teeth import LOWER, UPPER, gums, teeth
from lipwright.character.head.tongue import tongue
from lipwright.character.mesh import Material, Part

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

SKIN = Material("skin", (0.68, 0.41, 0.30, 1.0), 0.55)
TOOTH = Material("teeth", (0.80, 0.75, 0.66, 1.0), 0.25)
GUM = Material("gums", (0.42, 0.12, 0.11, 1.0), 0.35)
TONGUE = Material("tongue", (0.46, 0.14, 0.13, 1.0), 0.4)
HAIR = Material("hair", (0.13, 0.070, 0.038, 1.0), 0.6)
CLOTH = Material("cloth", (0.06, 0.11, 0.16, 1.0), 0.85, double_sided=True)
EYE = Material("eyes", (1.0, 1.0, 1.0, 1.0), 0.12)


def build_head() -> tuple[Part, ...]:
    """Build the head.

    Returns
    -------
    tuple of Part
    """
    skin = build_skin()
    parts = [_part("skin", skin.points, skin.triangles, SKIN, of_skin(skin), paint_skin(skin))]
    points, triangles = brows()
    parts.append(_part("brows", points, triangles, HAIR, on_face(points), None))
    points, triangles = ears()
    parts.append(_part("ears", points, triangles, SKIN, rigid(points), None))
    points, triangles, colors = hair()
    parts.append(_part("hair", points, triangles, HAIR, rigid(points), colors))
    points, triangles = shirt()
    parts.append(_part("shirt", points, triangles, CLOTH, rigid(points), None))
    for name, row, goes in (("upper", UPPER, 0.0), ("lower", LOWER, 1.0)):
        for kind, make, material in (("teeth", teeth, TOOTH), ("gums", gums, GUM)):
            points, triangles = make(row)
            parts.append(
                _part(f"{kind}_{name}", points, triangles, material, rigid(points, goes), None)
            )
    points, triangles, share = tongue()
    parts.append(
        _part(
            "tongue",
            points,
            triangles,
            TONGUE,
            rigid(points, 0.92, tongue=share),
            shade(points, 0.040, 0.078),
        )
    )
    for name, side in (("left", 1.0), ("right", -1.0)):
        points, triangles, colors = eyeball(side)
        parts.append(_part(f"eye_{name}", points, triangles, EYE, rigid(points, ball=side), colors))
    return tuple(parts)


def _part(
    name: str,
    points: Floats,
    triangles: Indices,
    material: Material,
    anatomy: Anatomy,
    colors: Floats | None,
) -> Part:
    morphs = {}
    for target, pose in {**POSES, **arkit.SHAPES}.items():
        moved = displacement(points, pose(anatomy))
        if np.abs(moved).max() > 1e-7:
            morphs[target] = moved.astype(np.float32)
    return Part(
        name,
        points.astype(np.float32),
        triangles.astype(np.uint32),
        material,
        morphs,
        None if colors is None else colors.astype(np.float32),
    )


def landmarks() -> Landmarks:
    """Return the vertices of the part ``skin`` that mark the mouth; the same for every build."""
    return _landmarks(build_skin())


def _landmarks(skin: Skin) -> Landmarks:
    meet = skin.mouth[CONTACT + 1]
    count = len(meet)
    quarter = count // 4
    border, inner = RED + 1, CONTACT + 5
    right_to_left = [*range(3 * quarter, count), *range(quarter + 1)]
    below = [(count // 2 - number) % count for number in right_to_left]
    return Landmarks(
        upper_inner_lip=int(meet[0]),
        lower_inner_lip=int(meet[count // 2]),
        left_corner=int(meet[quarter]),
        right_corner=int(meet[3 * quarter]),
        upper_lip=tuple(skin.mouth[border:inner, 0].tolist()),
        lower_lip=tuple(skin.mouth[border:inner, count // 2].tolist()),
        upper_loop=tuple(meet[right_to_left].tolist()),
        lower_loop=tuple(meet[below].tolist()),
    )
