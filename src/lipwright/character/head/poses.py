"""The nine canonical poses (those of FaceFX), as moves of clusters of the face model.

``open`` turns the jaw by OPEN_DEGREES. As a linear target its arc is drawn as a chord: at
half weight no vertex is more than 1.1 mm from the true turn (ARKit's ``jawOpen``, which
turns farther: 1.9 mm); an in-between target at a half brings that to 0.3 mm (0.5 mm). The
poses of the tongue move nothing else; they show in an open mouth. Lips that a pose does
not part stay vertex on vertex where they meet.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from lipwright.character.clusters import shift, step, turn
from lipwright.character.face_model import Move
from lipwright.character.head.anatomy import Anatomy
from lipwright.character.head.moves import corner, gather, jaw, lower, spread, upper

OPEN_DEGREES = 15.0
Pose = Callable[[Anatomy], list[Move]]
_X = (1.0, 0.0, 0.0)


def opened(part: Anatomy) -> list[Move]:
    """`open`: the jaw drops; lips and cheeks follow."""
    return [
        *jaw(part, OPEN_DEGREES, forward=4.0, down=1.5),
        gather(part, part.near, 0.11),
        shift(upper(part), y=0.8),
    ]


def rounded(part: Anatomy) -> list[Move]:
    """`W`: the lips narrow, round and push forward."""
    red = part.red
    body = 1.0 - 0.35 * red
    return [
        gather(part, part.near, 0.44),
        shift(part.near, y=-0.8, z=7.5),
        shift(corner(part, 0.8), z=4.5),
        shift(upper(part) * (1 - red), y=0.8),
        shift(upper(part) * red, y=0.6, z=0.8),
        shift(lower(part) * (1 - red), y=-1.2),
        shift(lower(part) * red, y=-0.8, z=0.5),
        shift(corner(part) * body, y=-0.3),
        shift(part.flap, y=4.0, z=0.5),
    ]


def flared(part: Anatomy) -> list[Move]:
    """`ShCh`: the lips push forward and flare off nearly closed teeth."""
    red = part.red
    return [
        gather(part, part.near, 0.20),
        shift(part.near, z=4.5),
        shift(corner(part), z=2.5),
        shift(upper(part, 0.6), y=1.6, z=0.8),
        shift(upper(part, 0.6) * red, y=0.6, z=0.6),
        shift(lower(part, 0.6), y=-1.8, z=0.8),
        shift(lower(part, 0.6) * red, y=-0.8, z=0.8),
    ]


def pressed(part: Anatomy) -> list[Move]:
    """`PBM`: the lips press together and roll in; no gap is left.

    The inner side of the lower lip rises behind the upper one, so that lips which some
    other pose still holds a little apart look closed, too.
    """
    red = part.red
    outside = 1.0 - red
    seam = np.sin(np.pi * red) * (1.0 - corner(part))
    return [
        shift(upper(part) * outside, y=-1.5, z=-0.6),
        shift(lower(part) * outside, y=1.8, z=-0.4),
        shift((upper(part, 0.5) + lower(part, 0.5)) * red, z=-1.8),
        shift(part.near * seam, z=-1.0),
        shift(part.near * red, y=0.2),
        shift(corner(part), z=-0.6),
        spread(part, part.near, 0.8),
        shift(part.flap, y=5.6, z=2.6),
    ]


def tucked(part: Anatomy) -> list[Move]:
    """`FV`: the lower lip goes under the edge of the upper teeth, which show."""
    red = part.red
    low = lower(part, 0.6)
    return [
        *jaw(part, 1.5),
        shift(low * red, y=1.8, z=-4.2),
        shift(lower(part) * (1 - red), y=2.4, z=-1.8),
        shift(lower(part) * np.sin(np.pi * red), y=1.2, z=-0.4),
        shift(part.flap, y=-2.0),
        shift(upper(part, 0.9), y=1.6),
        shift(upper(part, 0.9) * red, y=1.2, z=0.6),
    ]


def spread_wide(part: Anatomy) -> list[Move]:
    """`wide`: the corners go outward and back, the lips thin and part over the teeth."""
    red = part.red
    sides = part.wide * (1.0 - 0.5 * np.abs(part.side))
    return [
        spread(part, sides, 6.5),
        shift(corner(part, 0.7), y=1.0, z=-4.0),
        shift((upper(part) + lower(part)), z=-1.2),
        shift(upper(part) * (1 - red), y=-0.6),
        shift(lower(part) * (1 - red), y=0.9),
        shift(upper(part, 0.6), y=1.0),
        shift(lower(part, 0.6), y=-1.4),
    ]


def tongue_back(part: Anatomy) -> list[Move]:
    """`tBack`: the body of the tongue rises at the back."""
    body = _along(part, 0.35, 0.27)
    return [shift(body, y=11.0, z=-3.0), shift(_along(part, 1.0, 0.35), y=-1.0, z=-5.0)]


def tongue_roof(part: Anatomy) -> list[Move]:
    """`tRoof`: the tip touches the ridge behind the upper teeth."""
    tip = _tip(part, 0.45)
    return [shift(tip, y=14.5, z=3.0), turn(tip, -14.0, _X, (0.0, -0.074, 0.056))]


def tongue_teeth(part: Anatomy) -> list[Move]:
    """`tTeeth`: the tip comes between the teeth."""
    return [shift(_tip(part, 0.1), z=18.5), shift(_tip(part, 0.3), y=9.5)]


def _tip(part: Anatomy, start: float) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.nan_to_num(step(start, 1.0, part.tongue))


def _along(
    part: Anatomy, middle: float, reach: float
) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    return np.nan_to_num(np.exp(-(((part.tongue - middle) / reach) ** 2)))


POSES: dict[str, Pose] = {
    "open": opened,
    "W": rounded,
    "ShCh": flared,
    "PBM": pressed,
    "FV": tucked,
    "wide": spread_wide,
    "tBack": tongue_back,
    "tRoof": tongue_roof,
    "tTeeth": tongue_teeth,
}
