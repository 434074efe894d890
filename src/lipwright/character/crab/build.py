"""The crab's parts with their materials, colours and morph targets."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.character.between import morph_targets
from lipwright.character.clusters import step
from lipwright.character.crab import paint
from lipwright.character.crab.anatomy import Anatomy, of_body, part_of
from lipwright.character.crab.body import build_body
from lipwright.character.crab.eyes import eye
from lipwright.character.crab.forms import Solid
from lipwright.character.crab.limbs import Claw, claw, legs
from lipwright.character.crab.mouthparts import (
    lower_teeth,
    mandible,
    swinging,
    tongue,
    upper_teeth,
)
from lipwright.character.crab.poses import EXTRAS, SPEECH, Pose
from lipwright.character.crab.spines import feelers, freckles, knobs, spines
from lipwright.character.mesh import Material, Part

Floats = NDArray[np.float64]

_WHITE = (1.0, 1.0, 1.0, 1.0)
SHELL = Material("shell", _WHITE, 0.42)
HORN = Material("horn", _WHITE, 0.30)
FLESH = Material("flesh", _WHITE, 0.35)
EYE = Material("eyes", _WHITE, 0.10)

TARGETS: dict[str, Pose] = {**SPEECH, **EXTRAS}
"""Every morph target: what it speaks with, then the rest."""
MANDIBLE_RIDES, TONGUE_RIDES = 0.35, 0.9  # shares of the plate's way
BETWEEN = {"mandibles_in": (0.33, 0.67), "mandibles_out": (0.5,)}
"""Where a straight line would leave the arc of a turn by over a millimetre in speech."""
_STILL = 1e-6  # metres


@dataclass(frozen=True, slots=True, eq=False)
class _Surface:
    """A part before its targets are made."""

    name: str
    solid: Solid
    material: Material
    colors: Floats
    anatomy: Anatomy | None = None

    def part(self) -> Part:
        return Part(
            self.name,
            (self.solid.points * 1e-3).astype(np.float32),
            self.solid.triangles.astype(np.uint32),
            self.material,
            self._morphs(),
            self.colors.clip(0.0, 1.0).astype(np.float32),
        )

    def _morphs(self) -> dict[str, NDArray[np.float32]]:
        if self.anatomy is None:
            return {}
        moves = {name: pose(self.anatomy) for name, pose in TARGETS.items()}
        made = morph_targets(self.anatomy.points, moves, BETWEEN)
        return {
            name: moved.astype(np.float32)
            for name, moved in made.items()
            if np.abs(moved).max() > _STILL
        }


def build_crab() -> tuple[Part, ...]:
    """Build the crab, the same to the bit every time.

    Returns
    -------
    tuple of Part
        ``shell`` (the whole body, which goes on inside the mouth as a closed bag),
        ``spines``, ``knobs``, ``freckles``, ``feelers``, ``legs``, ``teeth_upper``,
        ``teeth_lower``, ``tongue``, and of each side ``mandible_left``, ``eye_left``,
        ``lids_left``, ``stalk_left``, ``claw_left``, ``finger_left``, ``bite_left`` (a claw's
        small teeth), ``arm_left``. The origin lies in the middle of the body, which is 0.2 m
        broad. Each part has the targets of :data:`TARGETS` that move it, and in-betweens of
        those of :data:`BETWEEN`.
    """
    surfaces = [*_body(), *_mouth()]
    for name, side in (("left", 1), ("right", -1)):
        surfaces += [*_eye(name, side), *_claw(name, side)]
    return tuple(surface.part() for surface in surfaces)


def _metres(solid: Solid) -> Floats:
    return solid.points * 1e-3


def _body() -> list[_Surface]:
    body = build_body()
    turn = Solid(body.points, body.triangles, body.line, body.turn)
    thorns, humps, dots = spines(body), knobs(body), freckles(body)
    horns, walking = feelers(), legs()
    return [
        _Surface("shell", turn, SHELL, paint.paint_body(body), of_body(body)),
        _Surface("spines", thorns, HORN, paint.paint_spines(thorns)),
        _Surface("knobs", humps, SHELL, paint.paint_knobs(humps)),
        _Surface("freckles", dots, SHELL, paint.paint_freckles(dots)),
        _Surface("feelers", horns, SHELL, paint.paint_spines(horns)),
        _Surface("legs", walking, SHELL, paint.paint_legs(walking)),
    ]


def _mouth() -> list[_Surface]:
    upper, lower, tip = upper_teeth(), lower_teeth(), tongue()
    surfaces = [
        _Surface(
            "teeth_upper",
            upper,
            HORN,
            paint.paint_teeth(upper.points),
            part_of(_metres(upper), teeth=1.0),
        ),
        _Surface(
            "teeth_lower",
            lower,
            HORN,
            paint.paint_teeth(lower.points),
            part_of(_metres(lower), plate=1.0, teeth=-1.0),
        ),
        _Surface(
            "tongue",
            tip,
            FLESH,
            paint.paint_tongue(tip.points),
            part_of(_metres(tip), plate=TONGUE_RIDES, tongue=tip.along),
        ),
    ]
    for name, side in (("left", 1), ("right", -1)):
        horn = mandible(side)
        swings = side * swinging(horn)
        anatomy = part_of(_metres(horn), plate=MANDIBLE_RIDES, mandible=swings)
        surfaces.append(
            _Surface(f"mandible_{name}", horn, HORN, paint.paint_mandible(horn), anatomy)
        )
    return surfaces


def _pair(side: int, weight: Floats | float, count: int) -> Floats:
    """Return a field of both sides that is 0 on the other one."""
    both = np.zeros((2, count))
    both[0 if side > 0 else 1] = weight
    return both


def _eye(name: str, side: int) -> list[_Surface]:
    made = eye(side)
    globe, casing, stalk = made.ball, made.casing, made.stalk
    whole = _pair(side, 1.0, len(globe.points))
    lids = {
        "stalk": _pair(side, 1.0, len(casing.points)),
        "lid": _pair(side, made.closing, len(casing.points)),
    }
    held = _pair(side, step(0.0, 1.0, stalk.along), len(stalk.points))
    return [
        _Surface(
            f"eye_{name}",
            globe,
            EYE,
            paint.paint_ball(globe),
            part_of(_metres(globe), ball=side, stalk=whole),
        ),
        _Surface(
            f"lids_{name}",
            casing,
            SHELL,
            paint.paint_casing(casing),
            part_of(_metres(casing), **lids),
        ),
        _Surface(
            f"stalk_{name}",
            stalk,
            SHELL,
            paint.paint_stalk(stalk),
            part_of(_metres(stalk), stalk=held),
        ),
    ]


def _claw(name: str, side: int) -> list[_Surface]:
    made: Claw = claw(side)
    surfaces = []
    parts = (
        ("claw", made.hand, 0.0),
        ("finger", made.finger, 1.0),
        ("bite", made.teeth, made.moving.astype(np.float64)),
    )
    for kind, solid, moving in parts:
        count = len(solid.points)
        anatomy = part_of(
            _metres(solid), arm=_pair(side, 1.0, count), finger=_pair(side, moving, count)
        )
        colors = paint.paint_claw(solid.points, made.wrist)
        if kind == "bite":
            colors = paint.paint_teeth(solid.points * 0.0)
        surfaces.append(_Surface(f"{kind}_{name}", solid, SHELL, colors, anatomy))
    arm = made.arm
    reach = _pair(side, step(0.15, 1.0, arm.along), len(arm.points))
    surfaces.append(
        _Surface(f"arm_{name}", arm, SHELL, paint.paint_arm(arm), part_of(_metres(arm), arm=reach))
    )
    return surfaces
