"""The built-in head with markers on it, made once."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from lipwright.character import load_character
from lipwright.marker_faces import (
    Binding,
    FaceMesh,
    MarkerFace,
    MarkerLayout,
    bind,
    drive,
    read_face_mesh,
)
from tests.marker_layouts import layout_of, layout_on, recorded

Floats = NDArray[np.float64]
POSES: list[dict[str, float]] = [
    {},
    {"jawOpen": 0.7},
    {"jawOpen": 0.3},
    {"jawOpen": 0.2, "mouthPucker": 0.8},
    {"mouthSmileLeft": 0.8, "mouthSmileRight": 0.7},
    {"jawLeft": 0.5, "jawOpen": 0.1},
    {"browInnerUp": 0.8},
]


@cache
def head() -> FaceMesh:
    return read_face_mesh(load_character("head"))


@cache
def chosen() -> tuple[int, ...]:
    return tuple(layout_on(head()))


def layout(turn: Floats | None = None, shift: Floats | None = None) -> MarkerLayout:
    """Markers of the head, as they are recorded in turned axes."""
    rest = head().points[list(chosen())]
    moves = recorded(head(), list(chosen()), POSES)
    found = layout_of(rest, moves, turn)
    if shift is None:
        return found
    return MarkerLayout(
        found.labels, found.rest + shift, found.mean, found.basis, found.variance, found.where
    )


@cache
def bound() -> Binding:
    return bind(layout(), head())


@cache
def driven() -> MarkerFace:
    return drive(layout(), head(), bound())
