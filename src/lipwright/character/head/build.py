"""The head's parts with their materials, colours and morph targets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.character.between import morph_targets
from lipwright.character.head.anatomy import Anatomy, of_skin, on_face, rigid
from lipwright.character.head.arkit import SHAPES
from lipwright.character.head.brows import brows
from lipwright.character.head.ears import ears
from lipwright.character.head.eyes import eyeball
from lipwright.character.head.hair import hair
from lipwright.character.head.lips import CONTACT, RED
from lipwright.character.head.measure import Landmarks
from lipwright.character.head.paint import paint_skin, shade
from lipwright.character.head.poses import POSES, Pose
from lipwright.character.head.shirt import shirt
from lipwright.character.head.skin import build_skin
from lipwright.character.head.teeth import LOWER, UPPER, gums, teeth
from lipwright.character.head.tongue import tongue
from lipwright.character.mesh import Material, Part

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

SKIN = Material("skin", (0.68, 0.41, 0.30, 1.0), 0.55)
TOOTH = Material("teeth", (0.93, 0.89, 0.80, 1.0), 0.25)
GUM = Material("gums", (0.42, 0.12, 0.11, 1.0), 0.35)
TONGUE = Material("tongue", (0.60, 0.20, 0.18, 1.0), 0.4)
HAIR = Material("hair", (0.13, 0.070, 0.038, 1.0), 0.6)
CLOTH = Material("cloth", (0.06, 0.11, 0.16, 1.0), 0.85, double_sided=True)
EYE = Material("eyes", (1.0, 1.0, 1.0, 1.0), 0.12)

TARGETS: dict[str, Pose] = {**POSES, **SHAPES}
"""Every morph target: the nine poses, then ARKit's shapes."""
BETWEEN = {"open": (0.5,), "jawOpen": (0.5,)}
"""Where a straight line would leave the arc of a turn by over a millimetre."""
_STILL = 1e-7  # metres


@dataclass(frozen=True, slots=True, eq=False)
class _Surface:
    """A part before its targets are made; without an anatomy it never moves."""

    name: str
    points: Floats
    triangles: Indices
    material: Material
    anatomy: Anatomy | None = None
    colors: Floats | None = None

    def part(self) -> Part:
        """Return the part with every target that moves it."""
        colors = None if self.colors is None else self.colors.astype(np.float32)
        points, triangles = self.points.astype(np.float32), self.triangles.astype(np.uint32)
        return Part(self.name, points, triangles, self.material, self._morphs(), colors)

    def _morphs(self) -> dict[str, NDArray[np.float32]]:
        if self.anatomy is None:
            return {}
        moves = {name: pose(self.anatomy) for name, pose in TARGETS.items()}
        made = morph_targets(self.points, moves, BETWEEN)
        return {
            name: moved.astype(np.float32)
            for name, moved in made.items()
            if np.abs(moved).max() > _STILL
        }


def build_head() -> tuple[Part, ...]:
    """Build the head, the same to the bit every time.

    Returns
    -------
    tuple of Part
        ``skin`` (which goes on inside the mouth as a closed bag), ``brows``, ``ears``,
        ``hair``, ``shirt``, ``teeth_upper``, ``gums_upper``, ``teeth_lower``, ``gums_lower``,
        ``tongue``, ``eye_left``, ``eye_right``. The origin lies between the eyes; chin to
        crown is 0.225 m. Each part has the targets of :data:`TARGETS` that move it, and
        in-betweens of those of :data:`BETWEEN`.
    """
    return tuple(surface.part() for surface in (*_outside(), *_inside()))


def _outside() -> list[_Surface]:
    skin = build_skin()
    brow_points, brow_triangles = brows()
    hair_points, hair_triangles, hair_colors = hair()
    surfaces = [
        _Surface("skin", skin.points, skin.triangles, SKIN, of_skin(skin), paint_skin(skin)),
        _Surface("brows", brow_points, brow_triangles, HAIR, on_face(brow_points)),
        _Surface("ears", *ears(), SKIN),
        _Surface("hair", hair_points, hair_triangles, HAIR, colors=hair_colors),
        _Surface("shirt", *shirt(), CLOTH),
    ]
    for name, side in (("left", 1.0), ("right", -1.0)):
        points, triangles, colors = eyeball(side)
        surfaces.append(
            _Surface(f"eye_{name}", points, triangles, EYE, rigid(points, ball=side), colors)
        )
    return surfaces


def _inside() -> list[_Surface]:
    surfaces = []
    rows = (("upper", UPPER, None, 0.045, 0.082), ("lower", LOWER, 1.0, 0.060, 0.086))
    for name, row, goes, back, ahead in rows:
        for kind, make, material in (("teeth", teeth, TOOTH), ("gums", gums, GUM)):
            points, triangles = make(row)
            anatomy = None if goes is None else rigid(points, goes)
            colors = shade(points, back, ahead)
            surfaces.append(
                _Surface(f"{kind}_{name}", points, triangles, material, anatomy, colors)
            )
    points, triangles, share = tongue()
    anatomy = rigid(points, 0.92, tongue=share)
    colors = shade(points, 0.036, 0.072)
    surfaces.append(_Surface("tongue", points, triangles, TONGUE, anatomy, colors))
    return surfaces


def landmarks() -> Landmarks:
    """Return the vertices of the part ``skin`` that mark the mouth; the same for every build."""
    skin = build_skin()
    meet = skin.mouth[CONTACT + 1]
    count = len(meet)
    quarter = count // 4
    border, inner = RED + 1, CONTACT + 4  # down to the lips' inner side
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
