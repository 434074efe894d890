"""Calibration: the gain of each pose, found from the mesh.

At half ``open`` the gap between the lips is the same share of the mouth's width on every
character, that of the built-in head; at ``PBM`` the lips touch and do not cross; ``W``,
``ShCh`` and ``wide`` change the mouth's width by the same shares, as far as the rig can. Where no
mouth is found all gains stay 1, and it is said. A gain or a row of the user's stays as it is.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from lipwright.character.fitting import MISSING, Fitting
from lipwright.character.jaw import front_of, usual_front
from lipwright.character.mouth import Mouth, Stance, find_mouth
from lipwright.character.rig import Rig
from lipwright.character.surfaces import Surfaces, read_surfaces
from lipwright.errors import InputError
from lipwright.gltf import Gltf, structure

Floats = NDArray[np.float64]

OPEN_GAP = 0.23
"""Between the lips at half ``open``, of the mouth's width: as of the built-in head."""
WIDTHS = {"W": 0.56, "ShCh": 0.80, "wide": 1.24}
"""From corner to corner at 1, of the width at rest: as of the built-in head."""
TOUCH, CROSSED = 0.01, -0.02
"""Lips touch when nothing wider is seen between them; flesh gives way by as much as this."""
UP = np.array([0.0, 1.0, 0.0])
_MOST_VERTICES = 300_000
_OPEN_RANGE, _WIDTH_RANGE = (0.25, 3.0), (0.6, 1.5)
_CLOSING = sorted((round(0.05 * step, 2) for step in range(41)), key=lambda gain: abs(gain - 1.0))
_LITTLE = 0.01
_STEPS = 14


@dataclass(frozen=True, slots=True)
class Measured:
    """How one control was calibrated.

    Parameters
    ----------
    measure : str
        ``"gap"`` or ``"width"``, in shares of the mouth's width at rest.
    wanted, before, after : float
        What it should be, is at gain 1, and is at the gain taken.
    gain : float
        The gain.
    note : str
        What could not be reached.
    """

    measure: str
    wanted: float
    before: float
    after: float
    gain: float
    note: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Calibration:
    """What was found on the mesh.

    Parameters
    ----------
    mouth : Mouth, optional
        The mouth, or None where none was found.
    face : Surfaces, optional
        The whole face.
    rest : Stance, optional
        The mouth at rest.
    controls : dict of str to Measured
        What was found for each control.
    reason : str
        Why nothing could be found.
    """

    mouth: Mouth | None = None
    face: Surfaces | None = None
    rest: Stance | None = None
    controls: dict[str, Measured] = field(default_factory=dict)
    reason: str = ""


def calibrate(rig: Rig, fitting: Fitting) -> tuple[Fitting, Calibration]:
    """Return a fitting with the gains that suit the mesh, and how they were found."""
    opening = fitting.values({"open": 1.0}) if "open" in fitting.controls else {}
    if not any(opening.values()) or rig.model is None:
        return fitting, Calibration(reason="nothing opens the mouth")
    try:
        with structure(rig.model.where), np.errstate(all="ignore"):
            return _calibrate(rig.model, fitting, opening)
    except InputError as error:
        return fitting, Calibration(reason=f"its surface cannot be read ({error.found})")


def _calibrate(
    model: Gltf, fitting: Fitting, opening: dict[str, float]
) -> tuple[Fitting, Calibration]:
    face = _face(model, fitting, opening)
    if face is None:
        return fitting, Calibration(reason=f"it has more than {_MOST_VERTICES:,} vertices")
    mouth = find_mouth(face, opening)
    if mouth is None:
        return fitting, Calibration(face=face, reason="nothing on it parts as lips do")
    return _calibrated(fitting, mouth, face)


def _face(model: Gltf, fitting: Fitting, opening: dict[str, float]) -> Surfaces | None:
    """Return the surfaces, in the axes of the head that they form."""
    front = usual_front(model)
    face = read_surfaces(model, fitting.joints, front)
    if face.count > _MOST_VERTICES:
        return None
    rest, moved = face.positions({}) @ face.axes, face.positions(opening) @ face.axes
    far = np.linalg.norm(moved - rest, axis=1)
    if not np.isfinite(far).all():
        raise InputError("places of vertices that are no finite numbers")
    if not far.any():
        return face
    if fitting.joints:
        way = np.sign(next(iter(fitting.joints.values())).degrees)
        return replace(face, axes=_axes(front_of(way * np.cross(face.axis, UP), 0.0, front)))
    # The chin goes farthest; the head's middle is what lies about its height.
    chin = np.average(rest, axis=0, weights=far**2)
    level = np.abs(rest[:, 1] - chin[1]) < 2 * far.max()
    size = float(np.ptp(rest[level], axis=0).max(initial=0.0))
    found = front_of(chin - (rest[level].min(axis=0) + rest[level].max(axis=0)) / 2, size, front)
    return replace(face, axes=_axes(found))


def _axes(front: Floats) -> Floats:
    return np.stack([np.cross(UP, front), UP, front])


def _calibrated(fitting: Fitting, mouth: Mouth, face: Surfaces) -> tuple[Fitting, Calibration]:
    found: dict[str, Measured] = {}
    rest = mouth.stand({})

    def stance(control: str, gain: float, amount: float = 1.0) -> Stance:
        plain = replace(fitting, gains={**fitting.gains, control: gain})
        return mouth.stand(plain.values({control: amount}))

    for control, fitted in fitting.controls.items():
        if fitted.status == MISSING:
            continue
        given = fitting.gains.get(control, 1.0) if control in fitting.given else None
        if control == "open":
            wanted = OPEN_GAP + max(rest.gap, 0.0)
            measured = _to_reach(
                lambda gain: stance("open", gain, 0.5).gap, wanted, "gap", _OPEN_RANGE, given
            )
        elif control == "PBM":
            measured = _to_close(lambda gain: stance("PBM", gain), given)
        elif control in WIDTHS:
            measured = _to_reach(
                lambda gain, c=control: stance(c, gain).width,  # type: ignore[misc]
                WIDTHS[control], "width", _WIDTH_RANGE, given,
            )  # fmt: skip
        else:
            continue
        found[control] = measured
    gains = {control: measured.gain for control, measured in found.items()}
    return (
        replace(fitting, gains={**fitting.gains, **gains}),
        Calibration(mouth, face, rest, found),
    )


def _to_reach(
    measure: Callable[[float], float],
    wanted: float,
    name: str,
    bounds: tuple[float, float],
    given: float | None,
) -> Measured:
    """Return the gain at which a measure, which gain moves one way, is what is wanted."""
    before = measure(1.0)
    if given is not None:
        return Measured(name, wanted, before, measure(given), given, "as the mapping says")
    low, high = bounds
    ends = measure(low) - wanted, measure(high) - wanted
    if abs(ends[1] - ends[0]) < _LITTLE:
        return Measured(name, wanted, before, before, 1.0, f"moves the mouth's {name} too little")
    if ends[0] * ends[1] > 0:
        gain = min(bounds, key=lambda each: abs(measure(each) - wanted))
        gain = _least(measure, gain)
        note = f"this rig reaches {measure(gain):.2f}"
        return Measured(name, wanted, before, measure(gain), gain, note)
    for _ in range(_STEPS):
        middle = (low + high) / 2
        if (measure(middle) - wanted) * ends[0] > 0:
            low = middle
        else:
            high = middle
    gain = round((low + high) / 2, 3)
    return Measured(name, wanted, before, measure(gain), gain)


def _least(measure: Callable[[float], float], gain: float) -> float:
    """Return the gain nearest to 1 that does as much: channels at their limit go no further."""
    reached = measure(gain)
    for share in np.linspace(0.0, 1.0, 21)[:-1]:
        nearer = float(1.0 + share * (gain - 1.0))
        if abs(measure(nearer) - reached) < _LITTLE:
            return round(nearer, 3)
    return gain


def _to_close(stance: Callable[[float], Stance], given: float | None) -> Measured:
    """Return the gain nearest to 1 at which the lips touch and do not cross."""
    before = stance(1.0)

    def made(gain: float, note: str = "") -> Measured:
        return Measured("gap", 0.0, _seen(before), _seen(stance(gain)), gain, note)

    if given is not None:
        return made(given, "as the mapping says")
    stances = []
    for gain in _CLOSING:
        each = stance(gain)
        if each.widest <= TOUCH and each.contact >= CROSSED:
            return made(gain)
        stances.append((gain, each))
    whole = [(gain, each) for gain, each in stances if each.contact >= CROSSED]
    if not whole:
        return made(1.0, "the lips cross at any gain")
    gain, each = min(whole, key=lambda item: item[1].widest)
    return made(gain, f"the lips stay {max(each.widest, 0.0):.0%} of the mouth's width apart")


def _seen(stance: Stance) -> float:
    """Return the gap, or how far the lips crossed."""
    return stance.contact if stance.contact < CROSSED else max(stance.widest, 0.0)
