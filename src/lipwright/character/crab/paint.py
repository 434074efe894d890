"""The crab's colours per vertex, linear red, green, blue: what is painted on which part."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.character.clusters import step
from lipwright.character.crab.body import Body
from lipwright.character.crab.eyes import IRIS, PUPIL
from lipwright.character.crab.forms import Solid

Floats = NDArray[np.float64]

RED = np.array([0.70, 0.085, 0.030])
DEEP = np.array([0.30, 0.020, 0.035])
ORANGE = np.array([0.86, 0.27, 0.05])
CREAM = np.array([0.90, 0.66, 0.40])
PALE = np.array([0.93, 0.80, 0.60])
PLUM = np.array([0.080, 0.018, 0.040])
MOUTH = np.array([0.11, 0.010, 0.014])
TEAL = np.array([0.02, 0.30, 0.32])
FRECKLE = np.array([0.95, 0.62, 0.30])


def blend(base: Floats, other: Floats, share: Floats) -> Floats:
    """Return colours that go over into another by a share per vertex."""
    return np.asarray(base * (1.0 - share[:, None]) + other * share[:, None], np.float64)


def paint_body(body: Body) -> Floats:
    """Return the body's colours: red shell, pale face, dark mouth."""
    line, sine = body.line, np.sin(body.turn)
    x, y, z = body.points.T
    face = blend(np.broadcast_to(CREAM, body.points.shape), PALE, step(40.0, -20.0, y))
    cheeks = np.exp(-(((np.abs(x) - 68.0) / 13.0) ** 2) - ((y + 6.0) / 12.0) ** 2)
    face = blend(face, ORANGE, 0.75 * cheeks * (z > 0))
    face = blend(
        face, ORANGE, 0.8 * np.exp(-(((line - 2.0) / 0.16) ** 2)) * (0.45 + 0.55 * (sine < 0))
    )
    face = blend(face, DEEP * 0.6, step(1.3, 0.95, line))
    face = blend(face, PLUM, step(0.5, 0.0, line))
    shell = _shell(body.points)
    colors = blend(face, shell, step(2.86, 3.0, line))
    colors = blend(colors, DEEP, 0.6 * np.exp(-(((line - 3.05) / 0.2) ** 2)) * (line > 3.0))
    inside = np.clip(-line, 0.0, 3.0)
    return blend(colors, MOUTH * (1.0 - 0.25 * inside)[:, None], (line < 0).astype(np.float64))


def _shell(points: Floats) -> Floats:
    """Return the shell's red, deeper behind and above."""
    _, y, z = points.T
    colors = blend(np.broadcast_to(RED, points.shape), ORANGE, 0.75 * step(25.0, -25.0, y))
    return blend(colors, DEEP, 0.75 * step(25.0, -75.0, z) * step(-20, 30.0, y))


def paint_claw(points: Floats, wrist: Floats) -> Floats:
    """Return a claw's colours: red, orange below, its fingers' ends dark."""
    high = points[:, 1] - wrist[1]
    size = high.max()
    colors = blend(np.broadcast_to(RED, points.shape), ORANGE, step(0.45, 0.05, high / size))
    colors = blend(colors, PALE, 0.55 * step(0.0, 1.0, -(points[:, 2] - wrist[2]) / 14.0))
    return blend(colors, PLUM, step(0.74, 0.86, high / size))


def paint_legs(solid: Solid) -> Floats:
    """Return the legs' colours: orange with red bands, dark feet."""
    colors = np.broadcast_to(ORANGE, solid.points.shape)
    band = 0.5 + 0.5 * np.cos(solid.along * 2 * np.pi * 4.0)
    colors = blend(colors, RED * 0.8, step(0.35, 0.75, band))
    return blend(colors, PLUM, step(0.84, 0.95, solid.along))


def paint_arm(solid: Solid) -> Floats:
    """Return an arm's colours: orange, paler at its joints."""
    joints = np.exp(-(((solid.along - 0.62) / 0.10) ** 2)) + step(0.9, 1.0, solid.along)
    return blend(np.broadcast_to(ORANGE, solid.points.shape), RED, 1.0 - np.clip(joints, 0, 1))


def paint_spines(solid: Solid) -> Floats:
    """Return the spines' colours: the shell's red, pale tips."""
    return blend(np.broadcast_to(RED, solid.points.shape), PALE, step(0.45, 0.85, solid.along))


def paint_freckles(solid: Solid) -> Floats:
    """Return the freckles' colours: one pale orange."""
    return np.array(np.broadcast_to(FRECKLE, solid.points.shape))


def paint_knobs(solid: Solid) -> Floats:
    """Return the knobs' colours: a lighter red towards their tops."""
    return blend(np.broadcast_to(RED, solid.points.shape), ORANGE, step(0.3, 0.9, solid.along))


def paint_mandible(solid: Solid) -> Floats:
    """Return a mandible's colours: plum with an orange root and a pale tip."""
    colors = blend(
        np.broadcast_to(RED, solid.points.shape), DEEP * 0.6, step(0.12, 0.45, solid.along)
    )
    return blend(colors, PALE, step(0.82, 0.97, solid.along))


def paint_tongue(points: Floats) -> Floats:
    """Return the tongue's colours: pink, darker towards its root."""
    tip = step(-14.0, 28.0, points[:, 2])
    dark, pink = np.array([0.16, 0.015, 0.03]), np.array([0.95, 0.27, 0.32])
    return blend(np.broadcast_to(dark, points.shape), pink, tip)


def paint_teeth(points: Floats) -> Floats:
    """Return the teeth's colours: ivory, darker towards the corners of the mouth."""
    shade = 1.0 - 0.35 * np.clip(np.abs(points[:, 0]) / 45.0, 0.0, 1.0) ** 2
    return np.array([0.95, 0.88, 0.70]) * shade[:, None]


def paint_ball(solid: Solid) -> Floats:
    """Return an eyeball's colours, with a light in the pupil."""
    degrees = (1.0 - solid.along) * 180.0
    white, black = np.array([0.97, 0.95, 0.90]), np.array([0.005, 0.005, 0.008])
    colors = np.broadcast_to(white, solid.points.shape)
    iris = blend(
        np.broadcast_to(TEAL, solid.points.shape),
        TEAL * [6, 1.9, 1.2],
        step(IRIS, PUPIL, degrees) ** 2,
    )
    colors = blend(colors, iris, step(IRIS + 1.0, IRIS - 1.0, degrees))
    edge = np.exp(-(((degrees - IRIS + 1.0) / 2.0) ** 2))
    colors = blend(colors, black, 0.7 * edge)
    colors = blend(colors, black, step(PUPIL + 0.4, PUPIL - 0.4, degrees))
    x, y = degrees * np.cos(solid.around), degrees * np.sin(solid.around)
    light = np.hypot(x - 7.5, y - 9.0)
    return blend(colors, np.ones(3), step(6.0, 4.0, light))


def paint_casing(solid: Solid) -> Floats:
    """Return the lids' colours: the shell's red, darker at their rims."""
    degrees = solid.along * 360.0
    colors = blend(np.broadcast_to(ORANGE, solid.points.shape), RED, step(50.0, 100.0, degrees))
    rim = np.clip(step(49.0, 43.0, degrees) + step(300.0, 304.0, degrees), 0.0, 1.0)
    return blend(colors, DEEP, rim)


def paint_stalk(solid: Solid) -> Floats:
    """Return a stalk's colours: orange with a pale ring."""
    ring = np.exp(-(((solid.along - 0.55) / 0.13) ** 2))
    return blend(np.broadcast_to(ORANGE, solid.points.shape), PALE, ring)
