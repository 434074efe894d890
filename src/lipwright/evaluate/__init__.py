"""Measures of animation against recorded faces (DESIGN section 11).

Nothing here knows an engine or a character: how far a character's mouth is open comes in
as curves over time, measured on its own mesh.
"""

from __future__ import annotations

from lipwright.evaluate.closures import Closures
from lipwright.evaluate.curve import Curve
from lipwright.evaluate.motion import Likeness, MotionReport, Pair, compare
from lipwright.evaluate.recording import Recording, read_recording
from lipwright.evaluate.rhubarb import is_rhubarb, read_rhubarb

__all__ = [
    "Closures",
    "Curve",
    "Likeness",
    "MotionReport",
    "Pair",
    "Recording",
    "compare",
    "is_rhubarb",
    "read_recording",
    "read_rhubarb",
]
