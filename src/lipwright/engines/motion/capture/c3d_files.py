"""C3D: labelled markers over time, through ezc3d (extra ``mocap``).

Places are brought to metres. A marker that was not seen is NaN: where the file says so
(NaN, residual -1) and where it lies exactly at the origin. Analog channels are not read.
Frame ``k`` is taken to cover ``k / rate`` to ``(k + 1) / rate`` of the sound, whatever
number the file gives its first frame.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from lipwright.engines.motion.capture.c3d_header import MOST_FRAMES, check_c3d
from lipwright.engines.motion.capture.motion import Floats, Motion
from lipwright.errors import FileFormatError, MissingExtraError
from lipwright.markers import marker_channels

UNITS = {"mm": 1e-3, "cm": 1e-2, "dm": 0.1, "m": 1.0, "in": 0.0254, "inch": 0.0254}
_NO_LABEL = re.compile(r"\s*|\*\d+|(unlabell?ed|uname|unnamed|unknown)?[\s_*:-]*\d*", re.IGNORECASE)
FEWEST = 4


def read_c3d(path: str | Path) -> Motion:
    """Read the markers of a C3D file; clean them with :func:`.cleaning.clean`.

    Raises
    ------
    FileFormatError
        If it is no C3D file, was cut, is at or over 65,535 frames, has no rate, an unknown
        unit, fewer than 4 labelled markers, or two markers of one label seen at once.
    MissingExtraError
        Without the extra ``mocap``.
    InputError
        If it cannot be read.
    """
    where = str(path)
    header = check_c3d(path)
    try:
        import ezc3d  # late: an extra
    except ImportError:
        raise MissingExtraError.of(f"{where}: motion in C3D", "mocap") from None
    try:
        file = ezc3d.c3d(where)
    except Exception as error:  # it raises whatever its C++ part throws
        raise FileFormatError(
            f"cannot be read ({str(error).strip()})", where=where, expected="a C3D file"
        ) from None
    if header.frames < FEWEST:
        raise FileFormatError(f"{header.frames} frames", where=where, expected=f"{FEWEST} or more")
    parameters = file["parameters"]["POINT"]
    _check_frames(file, header.frames, where)
    rate = float(next(iter(_value(parameters, "RATE")), 0.0))
    if not rate > 0 or not np.isfinite(rate):
        raise FileFormatError(f"{rate:g} frames per second", where=where, expected="its frame rate")
    scale, notes = _scale(parameters, where)
    points = _seen(file).transpose(2, 1, 0) * scale
    labels, points, said = _labelled(_labels(parameters), points, where)
    values = points.reshape(len(points), -1).astype(np.float32)
    return Motion(marker_channels(labels), values, rate, 0.0, (*notes, *said), "markers", where)


def _value(parameters: Any, name: str) -> Sequence[Any]:
    return list(parameters[name]["value"]) if name in parameters else []


def _check_frames(file: Any, promised: int, where: str) -> None:
    """Hold what was read against all places in which a file counts its frames."""
    point = file["parameters"]["POINT"]
    found = int(file["data"]["points"].shape[2])
    said = [int(value) % 65536 for value in _value(point, "FRAMES")[:1]]
    longer = [int(value) for value in _value(point, "LONG_FRAMES")[:1]]
    trial = dict(file["parameters"]).get("TRIAL", {})
    first, last = (_long(_value(trial, f"ACTUAL_{end}_FIELD")) for end in ("START", "END"))
    if first is not None and last is not None:
        longer.append(last - first + 1)
    most = max([promised, *said, *longer])
    if most >= MOST_FRAMES:
        raise FileFormatError(
            f"{most} frames",
            where=where,
            expected=f"fewer than {MOST_FRAMES}: longer files lose their end unseen",
            cure="export the take in parts",
        )
    if found != promised:
        raise FileFormatError(
            f"{found} of the {promised} frames that its header names",
            where=where,
            cure="export it again",
        )


def _long(words: Sequence[Any]) -> int | None:
    """Two 16-bit words, low one first, as one number."""
    if len(words) < 2:
        return None
    return (int(words[0]) % 65536) + 65536 * (int(words[1]) % 65536)


def _scale(parameters: Any, where: str) -> tuple[float, list[str]]:
    unit = str(next(iter(_value(parameters, "UNITS")), "")).strip()
    if not unit:
        return UNITS["mm"], ["names no unit: millimetres are assumed"]
    if unit.lower() not in UNITS:
        raise FileFormatError(
            f"the unit {unit!r}", where=where, expected=f"one of {', '.join(UNITS)}"
        )
    return UNITS[unit.lower()], []


def _seen(file: Any) -> Floats:
    """Return the places (3, M, T), NaN where a marker was not seen."""
    points = np.array(file["data"]["points"][:3], dtype=np.float64)
    residuals = np.asarray(file["data"]["meta_points"]["residuals"])[0]
    lost = ~np.isfinite(points).all(axis=0) | (points == 0).all(axis=0)
    if residuals.shape == lost.shape:
        lost |= residuals < 0
    points[:, lost] = np.nan
    return points


def _labels(parameters: Any) -> list[str]:
    """Return all labels: a list holds 255 of them, the others follow in LABELS2, LABELS3."""
    labels = [str(label).strip() for label in _value(parameters, "LABELS")]
    for number in range(2, 10):
        labels += [str(label).strip() for label in _value(parameters, f"LABELS{number}")]
    subjects = {label.partition(":")[0] for label in labels if ":" in label}
    if len(subjects) == 1 and all(":" in label or _NO_LABEL.fullmatch(label) for label in labels):
        labels = [label.partition(":")[2] if ":" in label else label for label in labels]
    return labels


def _labelled(
    labels: list[str], points: Floats, where: str
) -> tuple[tuple[str, ...], Floats, list[str]]:
    """Keep the markers that have a label, pieces of one marker joined."""
    notes = []
    count = points.shape[1]
    labels = (labels + [""] * count)[:count]
    named = [i for i, label in enumerate(labels) if not _NO_LABEL.fullmatch(label)]
    if len(named) < count:
        notes.append(f"{count - len(named)} markers without a label left out")
    kept: dict[str, int] = {}
    for i in named:
        label = labels[i]
        if label not in kept:
            kept[label] = i
            continue
        both = np.isfinite(points[:, [kept[label], i], 0]).all(axis=1)
        if both.any():
            raise FileFormatError(
                f"two markers {label!r}, both seen in frame {int(np.flatnonzero(both)[0]) + 1}",
                where=where,
                expected="one marker of a label",
                cure="name one of them differently",
            )
        piece = np.isfinite(points[:, i, 0])
        points[piece, kept[label]] = points[piece, i]
        notes.append(f"pieces of {label!r} joined")
    if len(kept) < FEWEST:
        raise FileFormatError(
            f"{len(kept)} labelled markers", where=where, expected=f"{FEWEST} or more"
        )
    return tuple(kept), points[:, list(kept.values())], notes
