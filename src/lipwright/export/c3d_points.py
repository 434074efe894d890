"""C3D: markers over time, as motion capture programs read them (extra ``mocap``).

Places are in millimetres, residuals 0. It loses phones and words, keys, the report, and
what is beyond a 32-bit float; frames start with the first, whatever its time.
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from lipwright.errors import CharacterError, InputError, MissingExtraError
from lipwright.markers import marker_labels
from lipwright.performance import Performance

MOST_FRAMES = 65535
"""The format counts frames in 16 bits."""
_MM = 1e3


def encode(performance: Performance) -> bytes:
    """Return the markers as a C3D file.

    Raises
    ------
    CharacterError
        If the animation is not one of markers.
    InputError
        If it has more frames than the format can count.
    MissingExtraError
        Without the extra ``mocap``.
    """
    animation = performance.animation
    labels = marker_labels(animation.controls)
    if not labels:
        raise CharacterError(
            f"no markers to write as C3D, but controls such as {animation.controls[0]!r}",
            expected="the motion engine with a database of markers",
        )
    if len(animation) >= MOST_FRAMES:
        raise InputError(
            f"{len(animation)} frames",
            expected=f"fewer than {MOST_FRAMES} in a C3D file",
            cure="choose a lower --rate, or cut the sound",
        )
    try:
        import ezc3d  # late: an extra
    except ImportError:
        raise MissingExtraError.of("writing C3D", "mocap") from None
    file = ezc3d.c3d()
    point = file["parameters"]["POINT"]
    point["RATE"]["value"] = [animation.rate]
    point["UNITS"]["value"] = ["mm"]
    point["LABELS"]["value"] = list(labels)
    points = np.ones((4, len(labels), len(animation)))
    places = animation.values.reshape(len(animation), -1, 3)
    points[:3] = _MM * places.transpose(2, 1, 0).astype(np.float64)
    file["data"]["points"] = points
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "markers.c3d"
        file.write(str(path))
        return path.read_bytes()
