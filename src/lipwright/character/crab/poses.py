"""The crab's own poses, as moves of clusters of the face model.

It speaks with a plate that drops, an upper edge, and two mandibles that go sideways: where
a human's lips press together, the mandibles swing in and pinch the mouth shut. A linear
target draws an arc as its chord: at half weight no vertex of the body is farther than
0.9 mm from the true turn of the plate, and none of a mandible that swings in than 5.3 mm.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import NDArray

from lipwright.character.clusters import shift, step, turn
from lipwright.character.crab.anatomy import Anatomy
from lipwright.character.crab.body import MOUTH
from lipwright.character.crab.eyes import CENTERS
from lipwright.character.crab.limbs import knuckle
from lipwright.character.crab.mouthparts import MANDIBLE_ROOT
from lipwright.character.face_model import Move

Floats = NDArray[np.float64]
Pose = Callable[[Anatomy], list[Move]]

_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_HINGE = (0.0, -0.006, -0.012)
OPEN_DEGREES = 17.0


def plate(part: Anatomy, degrees: float, down: float = 0.0, ahead: float = 0.0) -> list[Move]:
    """Drop the lower plate about its hinge."""
    slide = shift(part.plate, 0.0, -down, ahead).translation
    return [Move(slide, part.plate * np.radians(degrees), _X, _HINGE)]


def mandibles(
    part: Anatomy, inward: float, x: float = 0.0, y: float = 0.0, z: float = 0.0
) -> list[Move]:
    """Swing both mandibles in about their roots (degrees), and move them inward, up, ahead."""
    moves = []
    for side in (1, -1):
        own = np.clip(side * part.mandible, 0.0, 1.0)
        root = tuple((MANDIBLE_ROOT * (side, 1.0, 1.0) * 1e-3).tolist())
        moves.append(turn(own, side * inward, _Z, (root[0], root[1], root[2])))
        moves.append(shift(own, -side * x, y, z))
    return moves


def spread(part: Anatomy, weight: Floats, x: float) -> Move:
    """Move a cluster outward on both sides, most at the corners (mm)."""
    translation = np.zeros_like(part.points)
    translation[:, 0] = weight * x * 1e-3 * np.clip(part.points[:, 0] * 1e3 / MOUTH[0], -1.0, 1.0)
    return Move(translation)


def gather(part: Anatomy, weight: Floats, share: float) -> Move:
    """Bring a cluster nearer to the middle by a share of each vertex's distance."""
    translation = np.zeros_like(part.points)
    translation[:, 0] = -share * weight * part.points[:, 0]
    return Move(translation)


def mouth_open(part: Anatomy) -> list[Move]:
    """The plate drops, the upper edge lifts a little, the corners come in."""
    return [
        *plate(part, OPEN_DEGREES, down=6.0),
        shift(part.above, y=3.5),
        gather(part, part.near, 0.07),
        *mandibles(part, -4.0, x=2.0),
    ]


def mouth_round(part: Anatomy) -> list[Move]:
    """`mouth_OO`: the mouth gathers to a small round funnel; the mandibles frame it."""
    return [
        gather(part, part.near, 0.66),
        shift(part.near, y=-1.0, z=9.0),
        shift(part.corner, y=-5.5, z=2.0),
        shift(part.above, y=9.0, z=3.0),
        shift(part.below, y=-8.0, z=2.0),
        # The teeth draw back, as behind a funnel no one would see them.
        shift(part.teeth, y=12.0),
        shift(np.abs(part.teeth), z=-14.0),
        *plate(part, 2.0),
        *mandibles(part, 18.0, x=15.0, y=-2.0, z=6.0),
    ]


def smile(part: Anatomy) -> list[Move]:
    """The corners go out and up; the rims part over the teeth."""
    return [
        spread(part, part.near, 11.0),
        shift(part.corner, y=11.0, z=-5.0),
        shift(part.above, y=1.5),
        shift(part.below, y=-4.5),
        *mandibles(part, -14.0, x=-7.0, y=2.0),
    ]


def frown(part: Anatomy) -> list[Move]:
    """The corners sink, the middle of the upper edge rises."""
    return [
        shift(part.corner, y=-24.0, z=-1.0),
        gather(part, part.near, 0.12),
        shift(part.above, y=4.2),
        shift(part.below, y=4.2, z=1.5),
        shift(part.flap, y=1.0),
        *mandibles(part, -6.0, y=-8.0),
    ]


def bare_teeth(part: Anatomy) -> list[Move]:
    """Upper edge and plate part over closed teeth."""
    return [
        shift(part.above, y=8.5, z=0.5),
        shift(part.below, y=-9.0, z=0.5),
        spread(part, part.near, 3.0),
        *mandibles(part, -5.0, x=-4.0),
    ]


def bite(part: Anatomy) -> list[Move]:
    """The plate's edge goes in behind the upper teeth, which show."""
    return [
        shift(part.above, y=9.0, z=1.0),
        shift(part.below, y=3.0, z=-5.0),
        shift(part.below * part.rim, y=1.0, z=-6.0),
        *mandibles(part, 4.0, x=5.0, y=-5.0),
    ]


def mandibles_in(part: Anatomy) -> list[Move]:
    """The mandibles meet before the mouth, which the plate presses shut."""
    pressed = part.rim * (1.0 - part.corner)
    return [
        shift(part.above * (1 - part.rim), y=-2.5),
        shift(part.below * (1 - part.rim), y=3.5),
        shift(part.near * pressed, z=-2.0),
        gather(part, part.near, 0.14),
        shift(part.flap, y=6.0, z=1.0),
        *mandibles(part, 50.0, x=7.2, y=-1.0, z=8.0),
    ]


def mandibles_out(part: Anatomy) -> list[Move]:
    """The mandibles swing out to the sides, and draw the corners a little with them."""
    return [*mandibles(part, -26.0, x=-4.0, y=-1.0), spread(part, part.near, 3.0)]


def tongue_up(part: Anatomy) -> list[Move]:
    """The tip rises to the upper teeth."""
    return [shift(_tip(part, 0.25), y=17.0, z=5.0), shift(_tip(part, 0.7), y=4.0)]


def tongue_out(part: Anatomy) -> list[Move]:
    """The tongue comes out between the teeth."""
    tip = _tip(part, 0.15)
    return [shift(tip, y=7.0, z=42.0), shift(_tip(part, 0.75), y=-3.0)]


def tongue_back(part: Anatomy) -> list[Move]:
    """The body of the tongue rises at the back, the tip draws in."""
    body = np.nan_to_num(np.exp(-(((part.tongue - 0.45) / 0.28) ** 2)))
    return [shift(body, y=16.0), shift(_tip(part, 0.4), z=-12.0)]


def _tip(part: Anatomy, start: float) -> Floats:
    return np.nan_to_num(step(start, 1.0, part.tongue))


def blink(side: int, part: Anatomy) -> list[Move]:
    """Both lids of an eye meet."""
    x, y, z = (CENTERS[side] * 1e-3).tolist()
    lid = part.lid[0 if side > 0 else 1]
    return [Move(np.zeros_like(part.points), np.radians(lid), _X, (x, y, z))]


def stalks(part: Anatomy, y: float, apart: float, lean: float) -> list[Move]:
    """Lift the eyes, bring them apart and let them lean outward (degrees)."""
    moves = []
    for number, side in enumerate((1, -1)):
        own = part.stalk[number]
        moves.append(shift(own, side * apart, y))
        moves.append(turn(own, -side * lean, _Z, (side * 0.029, 0.050, 0.022)))
    return moves


def look(part: Anatomy, degrees: float, axis: tuple[float, float, float]) -> list[Move]:
    """Turn both eyeballs about their middles."""
    moves = []
    for side in (1, -1):
        x, y, z = (CENTERS[side] * 1e-3).tolist()
        moves.append(turn(np.clip(side * part.ball, 0.0, 1.0), degrees, axis, (x, y, z)))
    return moves


def snap(side: int, part: Anatomy) -> list[Move]:
    """The moving finger of a claw closes."""
    x, y, z = (knuckle(side) * 1e-3).tolist()
    return [turn(part.finger[0 if side > 0 else 1], -side * 25.0, _Z, (x, y, z))]


def lift(side: int, part: Anatomy) -> list[Move]:
    """A claw rises and leans out, as in a greeting."""
    own = part.arm[0 if side > 0 else 1]
    return [shift(own, y=16.0, z=4.0), turn(own, -side * 14.0, _Z, (side * 0.09, -0.03, 0.04))]


SPEECH: dict[str, Pose] = {
    "mouth_open": mouth_open,
    "mouth_OO": mouth_round,
    "smile": smile,
    "frown": frown,
    "bare_teeth": bare_teeth,
    "bite": bite,
    "mandibles_in": mandibles_in,
    "mandibles_out": mandibles_out,
    "tongue_up": tongue_up,
    "tongue_out": tongue_out,
    "tongue_back": tongue_back,
    "stalks_up": lambda part: stalks(part, 15.0, 0.0, -4.0),
}
"""What its bigram set is drawn in."""

EXTRAS: dict[str, Pose] = {
    "eyeBlinkLeft": partial(blink, 1),
    "eyeBlinkRight": partial(blink, -1),
    "eyes_up": lambda part: look(part, -22.0, _X),
    "eyes_down": lambda part: look(part, 20.0, _X),
    "eyes_left": lambda part: look(part, 25.0, _Y),
    "eyes_right": lambda part: look(part, -25.0, _Y),
    "stalks_down": lambda part: stalks(part, -20.0, 4.0, 6.0),
    "stalks_apart": lambda part: stalks(part, -2.0, 4.0, 16.0),
    "claw_snap_left": partial(snap, 1),
    "claw_snap_right": partial(snap, -1),
    "claw_lift_left": partial(lift, 1),
    "claw_lift_right": partial(lift, -1),
}
"""What else an animator may want of it."""
