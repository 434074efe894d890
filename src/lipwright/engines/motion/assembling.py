"""The arrays of a database, worked out from prepared takes (DESIGN section 5).

Every take is worked on alone and in order, so that the same takes give the same numbers
whether they came at once or one after the other.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.clustering import merged
from lipwright.engines.motion.components import Components, components
from lipwright.engines.motion.database import SOUND_PARAMETERS, Settings
from lipwright.engines.motion.label_index import pack, suffix_array
from lipwright.engines.motion.preparing import Prepared
from lipwright.engines.motion.units import at_points, seams, whole_frames
from lipwright.engines.motion.unusual import POINTS, unusual
from lipwright.errors import InputError

MOST_UNITS = 2**31 - 1


def assembled(
    takes: Sequence[Prepared], settings: Settings
) -> tuple[dict[str, Any], dict[str, NDArray[Any]]]:
    """Return the header and the arrays of a database of some takes.

    The takes go together: see :func:`lipwright.engines.motion.building.build`.

    Raises
    ------
    InputError
        If there are more phones than can be numbered.
    """
    basis = components(
        (take.values for take in takes), settings.variance, settings.least_components
    )
    labels = tuple(sorted({label for take in takes for label in take.cut.labels}))
    arrays = {**_take_table(takes), **_unit_table(takes, labels)}
    arrays |= _motion(takes, basis, settings) | _sound(takes, settings)
    label, take = arrays["label"], arrays["take"]
    arrays |= label_table(label, take, len(labels))
    moves = _at_points(takes, basis, POINTS) / (np.sqrt(basis.total) or 1.0)
    arrays["unusual"] = unusual(moves, label, take)
    if settings.clusters:
        # A sharp split of motion that is nearly the same would not help: components suffice.
        points = _at_points(takes, basis, settings.motion_points)
        vectors = points.astype(np.float32).reshape(len(label), -1)
        arrays |= merged(vectors, settings.clusters, label, take, len(labels), settings.seed)
    header = {
        "phone_set": takes[0].phone_set,
        "rate": takes[0].rate,
        "channels": list(takes[0].channels),
        "labels": list(labels),
        "takes": len(takes),
        "frames": int(arrays["take_first"][-1]),
        "units": len(label),
        "components": len(basis.basis),
        "total_variance": basis.total,
        "settings": msgspec.to_builtins(settings),
    }
    return header, arrays


def _at_points(takes: Sequence[Prepared], basis: Components, points: int) -> NDArray[np.float64]:
    """The motion of all units at as many instants each, (U, points, K)."""
    found = [at_points(basis.project(take.values), take.cut.spans, points) for take in takes]
    return np.concatenate(found)


def _take_table(takes: Sequence[Prepared]) -> dict[str, NDArray[Any]]:
    frames = [len(take.values) for take in takes]
    units = [len(take.cut.labels) for take in takes]
    if sum(units) > MOST_UNITS:
        raise InputError(f"{sum(units)} phones", expected=f"{MOST_UNITS} at most")
    return {
        "take_first": np.concatenate(([0], np.cumsum(frames))).astype(np.int64),
        "take_unit": np.concatenate(([0], np.cumsum(units))).astype(np.int64),
        "take_start": np.array([take.start for take in takes], np.float64),
        "take_has_sound": np.array([take.features is not None for take in takes], np.bool_),
        "take_names": np.array([take.name.encode("utf-8") for take in takes]),
        "take": np.repeat(np.arange(len(takes), dtype=np.int32), units),
    }


def _unit_table(takes: Sequence[Prepared], labels: Sequence[str]) -> dict[str, NDArray[Any]]:
    index = {label: number for number, label in enumerate(labels)}
    first, last, spans, offset = [], [], [], 0
    for take in takes:
        begin, end = whole_frames(take.cut.spans, len(take.values))
        first.append(begin + offset)
        last.append(end + offset)
        spans.append(take.cut.spans + offset)
        offset += len(take.values)
    return {
        "label": np.array([index[one] for take in takes for one in take.cut.labels], np.int16),
        "first": np.concatenate(first),
        "last": np.concatenate(last),
        "spans": np.concatenate(spans),
    }


def _motion(
    takes: Sequence[Prepared], basis: Components, settings: Settings
) -> dict[str, NDArray[Any]]:
    # Take by take, so that the same take gives the same numbers in any company.
    frames = [basis.project(take.values) for take in takes]
    step = settings.velocity_time * takes[0].rate
    deviation = np.sqrt(basis.total) or 1.0
    edges = [
        seams(one, take.cut.spans, step) / deviation
        for one, take in zip(frames, takes, strict=True)
    ]
    return {
        "mean": basis.mean.astype(np.float32),
        "basis": basis.basis.astype(np.float32),
        "variance": basis.variance,
        "values": np.concatenate([take.values for take in takes]),
        "frames": np.concatenate(frames),
        "seams": np.concatenate(edges).astype(np.float32),
    }


def _sound(takes: Sequence[Prepared], settings: Settings) -> dict[str, NDArray[Any]]:
    heard = [take.features for take in takes if take.features is not None]
    every = np.concatenate(heard) if heard else np.zeros((1, SOUND_PARAMETERS), np.float32)
    centre = every.mean(axis=0, dtype=np.float64).astype(np.float32)
    scale = every.std(axis=0, dtype=np.float64).astype(np.float32)
    scale[scale < 1e-6] = 1.0
    features, units = [], []
    for take in takes:
        rows = take.features
        silent = rows is None
        features.append(
            np.zeros((len(take.values), SOUND_PARAMETERS), np.float32) if rows is None else rows
        )
        spans = take.cut.spans
        units.append(
            np.zeros((len(spans), settings.sound_points * SOUND_PARAMETERS))
            if silent
            else unit_sound(features[-1], spans, settings.sound_points, centre, scale)
        )
    return {
        "features": np.concatenate(features),
        "unit_sound": np.concatenate(units).astype(np.float32),
        "sound_centre": centre,
        "sound_scale": scale,
    }


def unit_sound(
    features: NDArray[np.float32],
    spans: NDArray[np.float64],
    points: int,
    centre: NDArray[np.float32],
    scale: NDArray[np.float32],
) -> NDArray[np.float32]:
    """Return the sound of spans, scaled, at the same number of points: (U, points * 9)."""
    rows = (at_points(features, spans, points) - centre) / scale
    return rows.reshape(len(spans), -1).astype(np.float32)


def label_table(
    label: NDArray[np.int16], take: NDArray[np.int32], labels: int
) -> dict[str, NDArray[Any]]:
    """Return what finds units by their labels: the suffix array and the units of each label."""
    suffixes = suffix_array(label, take, labels)
    by_label = np.argsort(label, kind="stable")
    return {
        "suffixes": suffixes,
        "keys": pack(label, take, labels)[suffixes],
        "by_label": by_label.astype(np.int32),
        "label_first": np.searchsorted(label[by_label], np.arange(labels + 1)).astype(np.int64),
    }
