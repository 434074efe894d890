"""Capture: recorded motion from files, with its sound and words beside it, made clean.

:func:`find_takes` lists a folder, :func:`read_motion` reads blendshapes (CSV) or markers
(C3D), :func:`clean` brings markers to the motion of a still face, :func:`check_length`
holds motion against its sound. Sound, words and labels are read by the caller.
"""

from __future__ import annotations

from pathlib import Path

from lipwright.engines.motion.capture.c3d_files import read_c3d
from lipwright.engines.motion.capture.cleaning import clean
from lipwright.engines.motion.capture.csv_files import TimeIs, read_csv
from lipwright.engines.motion.capture.motion import Motion, check_length
from lipwright.engines.motion.capture.report import CleaningReport, RestFace
from lipwright.engines.motion.capture.takes import MOTION, TakeFiles, find_takes, read_texts
from lipwright.errors import InputError

__all__ = [
    "CleaningReport",
    "Motion",
    "RestFace",
    "TakeFiles",
    "check_length",
    "clean",
    "find_takes",
    "read_motion",
    "read_texts",
]


def read_motion(
    path: str | Path, *, rate: float | None = None, time_is: TimeIs = "start"
) -> Motion:
    """Read recorded motion, whichever its format.

    Parameters
    ----------
    path : path
        ``.csv`` with blendshapes, or ``.c3d`` with markers.
    rate, time_is
        For tables, see :func:`.csv_files.read_csv`.

    Returns
    -------
    Motion
        Blendshapes ready to be learnt from, or markers yet to be cleaned.

    Raises
    ------
    FileFormatError
        If the file is not what it should be.
    MissingExtraError
        For C3D without the extra ``mocap``.
    InputError
        If it cannot be read, or is of no known suffix.
    """
    suffix = Path(path).suffix.lower()
    if suffix == ".c3d":
        return read_c3d(path)
    if suffix == ".csv":
        return read_csv(path, rate=rate, time_is=time_is)
    raise InputError(
        f"the suffix {suffix!r}", where=str(path), expected=f"motion in {' or '.join(MOTION)}"
    )
