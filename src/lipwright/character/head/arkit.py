"""ARKit's mouth, jaw and tongue shapes, and a few of its eyes and brows, by their names.

A shape that ends in Left is the character's left (x > 0) and its twin is the mirror image.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np

from lipwright.character.clusters import shift, step, turn
from lipwright.character.face_model import Move, displacement
from lipwright.character.head.anatomy import Anatomy, Floats
from lipwright.character.head.lids import EYE_CENTER
from lipwright.character.head.moves import (
    corner,
    gather,
    half,
    jaw,
    lower,
    upper,
)

JAW_OPEN_DEGREES = 20.0
Shape = Callable[[Anatomy], list[Move]]


def _jaw_open(part: Anatomy) -> list[Move]:
    return [
        *jaw(part, JAW_OPEN_DEGREES, forward=5.0, down=2.0),
        gather(part, part.near, 0.107),
        shift(upper(part), y=0.8),
    ]


def _jaw_shift(part: Anatomy, x: float = 0.0, z: float = 0.0) -> list[Move]:
    return [shift(part.jaw, x=x, z=z)]


def _mouth_close(part: Anatomy) -> list[Move]:
    """Bring the lips together where `jawOpen` has parted them: no gap with both at 1."""
    meeting = part.jaw + part.near * (0.40 + 0.10 * np.abs(part.side) - part.jaw)
    closed = displacement(part.points, jaw(part.with_jaw(meeting), JAW_OPEN_DEGREES, 5.0, 2.0))
    opened = displacement(part.points, jaw(part, JAW_OPEN_DEGREES, 5.0, 2.0))
    return [Move(closed - opened), shift(upper(part), y=-0.8)]


def _funnel(part: Anatomy) -> list[Move]:
    red = part.red
    return [
        gather(part, part.near, 0.28),
        shift(part.near, z=5.0),
        shift(corner(part), z=3.0),
        shift(upper(part, 0.6), y=2.2),
        shift(upper(part, 0.6) * red, y=0.6, z=1.2),
        shift(lower(part, 0.6), y=-3.2),
        shift(lower(part, 0.6) * red, y=-0.6, z=1.2),
    ]


def _pucker(part: Anatomy) -> list[Move]:
    red = part.red
    return [
        gather(part, part.near, 0.50),
        shift(part.near, z=7.0),
        shift(corner(part, 0.8), z=5.0),
        shift(upper(part) * (1 - red), y=1.0),
        shift(lower(part) * (1 - red), y=-1.2),
    ]


def _sideways(part: Anatomy, side: int) -> list[Move]:
    reach = 0.65 * part.near + 0.35 * part.wide
    ahead = half(part, side)
    return [shift(reach, x=7.0 * side), shift(reach * ahead, y=1.0, z=-3.0)]


def _at_corner(
    part: Anatomy, side: int, x: float, y: float, z: float, cheek: float = 0.0
) -> list[Move]:
    """Pull one corner of the mouth by (x outward, y, z) mm, and the cheek above it up."""
    one = half(part, side)
    pulled = (0.6 * part.wide + 0.4 * part.near) * one * (1.0 - 0.82 * np.abs(part.side))
    raised = _hill(part, side, 42.0, -36.0, 20.0, 15.0)
    return [shift(pulled, x * side, y, z), shift(raised, cheek * 0.4 * side, cheek, cheek * 0.8)]


def _smile(part: Anatomy, side: int) -> list[Move]:
    one = half(part, side)
    thin = part.near * one * (1 - part.red)
    return [
        *_at_corner(part, side, 9.0, 6.0, -4.5, cheek=2.4),
        shift(thin * np.clip(-part.side, 0, 1), y=0.8),
        shift(part.near * one * np.abs(part.side), z=-1.0),
    ]


def _roll(part: Anatomy, above: bool) -> list[Move]:
    lip = upper(part, 0.5) if above else lower(part, 0.5)
    sign = -1.0 if above else 1.0
    red = part.red
    return [
        shift(lip * (1 - red), y=1.6 * sign, z=-1.2),
        shift(lip * np.sin(np.pi * red), z=-2.2),
        shift(lip * red, z=-3.6),
    ]


def _shrug_lower(part: Anatomy) -> list[Move]:
    """Push the lower lip and the chin up; the upper lip goes along, so that nothing crosses."""
    chin = _hill(part, 0, 0.0, -97.0, 20.0, 12.0)
    lips = upper(part, 0.6) + lower(part, 0.6)
    return [shift(lips, y=2.4, z=1.4), shift(chin, y=2.5, z=0.6)]


def _shrug_upper(part: Anatomy) -> list[Move]:
    """Push the upper lip up and out; the lower lip's edge stays with it."""
    above, below = upper(part, 0.6), lower(part, 0.6) * part.red
    return [shift(above, y=2.2, z=1.8), shift(below, y=2.2, z=1.8)]


def _press(part: Anatomy, side: int) -> list[Move]:
    one = half(part, side)
    red = part.red
    both = (upper(part, 0.5) + lower(part, 0.5)) * one
    return [
        shift(upper(part, 0.5) * one * (1 - red), y=-1.1),
        shift(lower(part, 0.5) * one * (1 - red), y=1.3),
        shift(both * red, z=-1.8),
        shift(corner(part) * one, x=1.5 * side, z=-1.5),
    ]


def _lower_down(part: Anatomy, side: int) -> list[Move]:
    lip = part.near * half(part, side) * np.clip(-part.side * 1.5, 0, 1) ** 0.8
    return [shift(lip, x=1.0 * side, y=-5.0, z=-0.6)]


def _upper_up(part: Anatomy, side: int) -> list[Move]:
    lip = part.near * half(part, side) * np.clip(part.side * 1.5, 0, 1) ** 0.8
    fold = _hill(part, side, 21.0, -46.0, 10.0, 10.0) * (1 - part.red)
    return [shift(lip, x=0.5 * side, y=4.2, z=0.6), shift(fold, x=0.8 * side, y=1.6, z=0.8)]


def _tongue_out(part: Anatomy) -> list[Move]:
    ahead = np.nan_to_num(step(0.0, 1.0, part.tongue))
    tip = np.nan_to_num(step(0.45, 1.0, part.tongue))
    return [shift(ahead, z=40.0), shift(tip, y=-4.0), shift(ahead * (1 - tip), y=2.0)]


def _cheek_puff(part: Anatomy) -> list[Move]:
    puffed = [_hill(part, side, 43.0, -63.0, 20.0, 19.0) * (1 - part.near) for side in (1, -1)]
    return [
        *(shift(hill, x=9.0 * side, z=6.5) for hill, side in zip(puffed, (1, -1), strict=True)),
        shift(part.near, z=1.5),
    ]


def _hill(part: Anatomy, side: int, x: float, y: float, radius_x: float, radius_y: float) -> Floats:
    """Return a smooth cluster around (x, y) mm on one side of the face (0: in the middle)."""
    across = (part.points[:, 0] * 1e3 * (side or 1) - x) / radius_x
    along = (part.points[:, 1] * 1e3 - y) / radius_y
    ahead = step(-0.01, 0.03, part.points[:, 2])
    return np.asarray(np.exp(-(across**2) - along**2) * ahead * part.skin, np.float64)


def _blink(part: Anatomy, side: int) -> list[Move]:
    """Close one eye. The ball goes back a little, as it does, out of the lid's chord."""
    eye = 0 if side > 0 else 1
    pivot = (side * float(EYE_CENTER[0]), float(EYE_CENTER[1]), float(EYE_CENTER[2]))
    closing = part.lid[eye]
    ball = (part.ball == side).astype(np.float64)
    return [
        turn(closing, 1.0, (1.0, 0.0, 0.0), pivot),
        shift(np.clip(closing / 60.0, 0, 1), z=1.2),
        shift(ball, z=-2.2),
    ]


def _brow(
    part: Anatomy, side: int, x: float, radius: float, y: float, inward: float = 0.0
) -> list[Move]:
    """Move the brow around `x` mm on one side up by `y` mm and inward."""
    across = (part.points[:, 0] * 1e3 * side - x) / radius
    height, depth = part.points[:, 1], part.points[:, 2]
    along = step(0.006, 0.020, height) * step(0.062, 0.028, height) * step(0.0, 0.03, depth)
    weight = np.exp(-(across**2)) * along * part.skin
    return [shift(weight, x=-inward * side, y=y, z=0.15 * y)]


def _inner_brows(part: Anatomy) -> list[Move]:
    return [move for side in (1, -1) for move in _brow(part, side, x=13.0, radius=15.0, y=5.5)]


def _both(name: str, shape: Callable[[Anatomy, int], list[Move]]) -> dict[str, Shape]:
    """Return a shape of each side under its name with Left and Right."""
    return {
        f"{name}Left": lambda part: shape(part, 1),
        f"{name}Right": lambda part: shape(part, -1),
    }


SHAPES: dict[str, Shape] = {
    "jawOpen": _jaw_open,
    "jawForward": partial(_jaw_shift, z=5.0),
    "jawLeft": partial(_jaw_shift, x=6.0),
    "jawRight": partial(_jaw_shift, x=-6.0),
    "mouthClose": _mouth_close,
    "mouthFunnel": _funnel,
    "mouthPucker": _pucker,
    **_both("mouth", _sideways),
    **_both("mouthSmile", _smile),
    **_both("mouthFrown", partial(_at_corner, x=1.5, y=-6.0, z=-2.0)),
    **_both("mouthDimple", partial(_at_corner, x=4.5, y=1.0, z=-5.5)),
    **_both("mouthStretch", partial(_at_corner, x=7.8, y=-3.0, z=-4.5)),
    "mouthRollLower": partial(_roll, above=False),
    "mouthRollUpper": partial(_roll, above=True),
    "mouthShrugLower": _shrug_lower,
    "mouthShrugUpper": _shrug_upper,
    **_both("mouthPress", _press),
    **_both("mouthLowerDown", _lower_down),
    **_both("mouthUpperUp", _upper_up),
    "tongueOut": _tongue_out,
    "cheekPuff": _cheek_puff,
    **_both("eyeBlink", _blink),
    "browInnerUp": _inner_brows,
    **_both("browOuterUp", partial(_brow, x=44.0, radius=18.0, y=5.5)),
    **_both("browDown", partial(_brow, x=22.0, radius=22.0, y=-4.5, inward=1.2)),
}
"""The shapes by ARKit's names."""
