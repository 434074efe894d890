"""The face of a character as markers need it: its skin, its lips, and what lies inside.

All is in the head's left, up and front, in the model's own unit. What its surfaces are is
told by where the mouth was found, how its own opening moves them, and their names.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipwright.character.calibration import calibrate
from lipwright.character.mouth import Mouth
from lipwright.character.plain.surfaces import Surface as PlainSurface
from lipwright.character.shading import Shading
from lipwright.character.surfaces import Surfaces
from lipwright.engines.motion.skin import mouth_sides
from lipwright.errors import CharacterError

if TYPE_CHECKING:
    from lipwright.character import Character
    from lipwright.gltf import Gltf

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
Flags = NDArray[np.bool_]

_INSIDE = re.compile(r"teeth|tooth|tongue|gum|denture", re.I)
_STILL = re.compile(r"hair(?!line)|shirt|cloth|hat$|glass|eye(?!.?(brow|lash|lid|socket))", re.I)
_ON_SKIN = re.compile(r"brow|lash|lid|beard|mous?tache|stubble", re.I)
_OUTWARD = 0.1


@dataclass(frozen=True, eq=False)
class FaceMesh:
    """A character's face.

    Parameters
    ----------
    name : str
        The character's.
    model : Gltf
    surfaces : Surfaces
        All of the model, in the head's axes.
    points, opening : (N, 3) float64
        All vertices at rest, and how they move when the mouth opens.
    skin, inside, still : (N,) bool
        The skin that the lips are of; teeth, gums and tongue; hair, eyes and clothes.
    outward : (N,) bool
        Skin on which a marker may lie: seen from outside.
    triangles : (F, 3) int
        Of the skin.
    normals : (N, 3) float64
    sides : (N,) float64
        1 on the upper lip's side, 0 on the lower's.
    mouth : Mouth
    """

    name: str
    model: Gltf
    surfaces: Surfaces
    points: Floats
    opening: Floats
    skin: Flags
    inside: Flags
    still: Flags
    outward: Flags
    triangles: Indices
    normals: Floats
    sides: Floats
    mouth: Mouth

    @property
    def width(self) -> float:
        """The mouth's width."""
        return self.mouth.width

    @property
    def line(self) -> Floats:
        """Where the lips meet, from right to left, (P, 3)."""
        return np.asarray((self.points[self.mouth.upper] + self.points[self.mouth.lower]) / 2)

    @property
    def lowered(self) -> Floats:
        """How much each vertex goes down as the mouth opens, (N,), 0..1."""
        down = np.where(self.outward, -self.opening[:, 1], 0.0)
        most = float(np.quantile(down[down > 0.1 * down.max()], 0.95))
        return np.clip(-self.opening[:, 1] / most, 0.0, 1.0)


def read_face_mesh(character: Character) -> FaceMesh:
    """Return the face of a character.

    Raises
    ------
    CharacterError
        If no mouth can be found on it.
    """
    fitting, found = character.fit(), character.calibration()
    if found.mouth is None:
        fitting, found = calibrate(character.read_rig(), fitting)
    model = character.model()
    if found.mouth is None or found.face is None:
        raise CharacterError(
            f"markers need a mouth, and {found.reason}",
            where=character.name,
            expected="a face whose lips part when it opens its mouth",
            cure="map 'open' to what opens it (--mapping)",
        )
    face, mouth = found.face, found.mouth
    points = face.positions({})
    opening = face.positions(fitting.values({"open": 1.0})) - points
    named = np.array([each.name for each in face.parts])
    lips = np.unique(face.part_of[np.concatenate([mouth.upper, mouth.lower])])
    of_skin = np.isin(np.arange(len(named)), lips)
    inside = np.array([bool(_INSIDE.search(name)) for name in named]) & ~of_skin
    apart = [bool(_STILL.search(name)) and not _ON_SKIN.search(name) for name in named]
    still = np.array(apart) & ~of_skin & ~inside
    skin = of_skin[face.part_of]
    triangles = face.triangles
    triangles = triangles[skin[triangles].all(axis=1)]
    normals, sides = _on_skin(points, triangles, mouth)
    middle = points[mouth.vertices].mean(axis=0) - (0, 0, 1.5 * mouth.width)
    away = points - middle
    facing = (normals * away).sum(axis=1) > _OUTWARD * np.linalg.norm(away, axis=1)
    return FaceMesh(
        character.name,
        model,
        face,
        points,
        opening,
        skin,
        inside[face.part_of],
        still[face.part_of],
        skin & facing,
        triangles,
        normals,
        sides,
        mouth,
    )


def _on_skin(points: Floats, triangles: Indices, mouth: Mouth) -> tuple[Floats, Floats]:
    """Return normals and sides of all vertices, those that a seam has split taken as one."""
    rows, numbers = np.unique(triangles, return_inverse=True)
    local = numbers.reshape(-1, 3)
    plain = PlainSurface((), points[rows], local, 0, 0, np.eye(3))
    first, place = plain.welded
    welded, whole = points[rows][first], place[local]
    shading = Shading.of(welded.astype(np.float32), whole.astype(np.uint32))
    upper, lower = (place[np.searchsorted(rows, lip)] for lip in (mouth.upper, mouth.lower))
    # A vertex that both lips share is neither's.
    both = np.intersect1d(upper, lower)
    own = [np.setdiff1d(lip, both) for lip in (upper, lower)]
    normals, sides = np.zeros_like(points), np.full(len(points), 0.5)
    normals[rows] = shading.normals[place]
    sides[rows] = mouth_sides(welded, whole, *own)[place]
    return normals, sides
