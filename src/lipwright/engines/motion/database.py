"""The database of takes, as it lies in a folder and is opened by memory map (DESIGN section 5).

Opening reads one small JSON file and maps the arrays: milliseconds, at any size. What is
not touched is never read. :mod:`lipwright.engines.motion.building` writes it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.storage import HEADER, open_array, read_header
from lipwright.errors import FileFormatError
from lipwright.files import convert
from lipwright.markers import marker_labels

SOUND_PARAMETERS = 9
"""Parameters of sound per frame: the first nine of RASTA-PLP."""

Offsets = NDArray[np.int64]


class Settings(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a database is built with.

    Parameters
    ----------
    variance : float
        Share of the motion's variance that its components keep, 0..1.
    least_components : int
        Fewest components.
    sound_points : int
        At how many points of a unit its sound is compared.
    motion_points : int
        At how many points of a unit its motion is compared when units are clustered.
    velocity_time : float
        Seconds; at a seam, velocity times this counts like a distance in place.
    clusters : int
        Into how many nodes units of like motion are merged; 0: they are not.
    seed : int
        Of the clustering.
    """

    variance: float = 0.99
    least_components: int = 5
    sound_points: int = 3
    motion_points: int = 16
    velocity_time: float = 0.04
    clusters: int = 0
    seed: int = 0


class Header(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What ``database.json`` says: how much there is, and what it is made of."""

    version: int
    arrays: str
    phone_set: str
    rate: float
    channels: tuple[str, ...]
    labels: tuple[str, ...]
    takes: int
    frames: int
    units: int
    components: int
    total_variance: float
    settings: Settings
    rigid: tuple[str, ...] = ()
    about: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class Merged:
    """The graph's merged nodes; see :func:`lipwright.engines.motion.clustering.merged`."""

    cluster: NDArray[np.int32]
    representative: NDArray[np.int32]
    member: NDArray[np.int32]
    member_first: Offsets
    node: NDArray[np.int32]
    node_first: Offsets
    after: NDArray[np.int32]
    after_first: Offsets
    before: NDArray[np.int32]
    before_first: Offsets


@dataclass(frozen=True, slots=True, eq=False)
class Database:
    """Recorded takes, one after the other, cut into units.

    The motion of frames is ``mean + frames @ basis``; the unit that follows unit ``u`` in
    its take is ``u + 1``, where ``take[u + 1] == take[u]``.

    Parameters
    ----------
    folder : Path
    channels : tuple of str
        What was learnt.
    labels : tuple of str
        The phones that occur, in alphabetical order.
    phone_set : str
        The notation of the labels.
    rate : float
        Frames per second.
    settings : Settings
    total_variance : float
        Variance of all channels.
    mean : (C,) float32
    basis : (K, C) float32
        Orthonormal rows.
    variance : (K,) float64
        Variance along each row.
    rest : (C,) float32
        The face at rest, that was subtracted from the channels before.
    frames : (F, K) float32
        Coefficients.
    features : (F, 9) float32
        Sound; zeros where a take has none.
    values : (F, C) float32
        The channels themselves: what appending and fitting start from.
    label : (U,) int16
        Index into ``labels``.
    first, last : (U,) int64
        Frames, ``last`` exclusive; at least one, so that very short neighbours may share it.
    take : (U,) int32
    spans : (U, 2) float64
        Exact begin and end, as positions in frames: frame k shows position k + 0.5.
    unit_sound : (U, 9 * sound_points) float32
        Sound at the same number of points each, scaled to deviation 1.
    seams : (U, 2, 2K) float32
        Value and velocity at begin and end, over the motion's deviation.
    unusual : (U,) float32
        How far its motion is from the usual, over the motion's deviation; see
        :mod:`lipwright.engines.motion.unusual`.
    by_label, label_first : (U,) int32, (L + 1,) int64
        Units of each label, ascending: the paper's anime array.
    suffixes, keys : (U,) int32, (U,) int64
        See :mod:`lipwright.engines.motion.label_index`.
    take_first, take_unit : (N + 1,) int64
        First frame and first unit of each take.
    take_start : (N,) float64
        Seconds on the sound's clock.
    take_has_sound : (N,) bool
    take_names : (N,) bytes
        UTF-8.
    sound_centre, sound_scale : (9,) float32
        What sound is scaled with.
    merged : Merged or None
        Where units were clustered.
    rigid : tuple of str
        Of markers, those that do not deform: takes that are added are laid on them.
    about : str
        What whoever animates with it is told.
    """

    folder: Path
    channels: tuple[str, ...]
    labels: tuple[str, ...]
    phone_set: str
    rate: float
    settings: Settings
    total_variance: float
    mean: NDArray[np.float32]
    basis: NDArray[np.float32]
    variance: NDArray[np.float64]
    rest: NDArray[np.float32]
    frames: NDArray[np.float32]
    features: NDArray[np.float32]
    values: NDArray[np.float32]
    label: NDArray[np.int16]
    first: NDArray[np.int64]
    last: NDArray[np.int64]
    take: NDArray[np.int32]
    spans: NDArray[np.float64]
    unit_sound: NDArray[np.float32]
    seams: NDArray[np.float32]
    unusual: NDArray[np.float32]
    by_label: NDArray[np.int32]
    label_first: Offsets
    suffixes: NDArray[np.int32]
    keys: NDArray[np.int64]
    take_first: Offsets
    take_unit: Offsets
    take_start: NDArray[np.float64]
    take_has_sound: NDArray[np.bool_]
    take_names: NDArray[np.bytes_]
    sound_centre: NDArray[np.float32]
    sound_scale: NDArray[np.float32]
    merged: Merged | None
    rigid: tuple[str, ...] = ()
    about: str = ""

    @property
    def markers(self) -> tuple[str, ...]:
        """The markers whose coordinates the channels are, metres; none for blendshapes."""
        return marker_labels(self.channels)

    def motion(self, first: int, last: int) -> NDArray[np.float32]:
        """Return the channels of some frames, ``last`` exclusive: (T, C) float32."""
        motion: NDArray[np.float32] = self.mean + self.frames[first:last] @ self.basis
        return motion

    def take_name(self, take: int) -> str:
        """Return a take's name."""
        name: bytes = self.take_names[take]
        return name.decode("utf-8")

    @property
    def deviation(self) -> float:
        """Root of the total variance, in the channels' unit; 1 where nothing moves."""
        return float(np.sqrt(self.total_variance)) or 1.0


def open_database(folder: str | Path) -> Database:
    """Open a database.

    Raises
    ------
    InputError, FileFormatError
        If it is none, is damaged, or is of a newer version.
    """
    place = Path(folder)
    where = str(place / HEADER)
    header = convert(read_header(place), Header, where)
    _check(header, where)
    arrays = place / header.arrays
    shapes = _shapes(header)
    opened = {name: open_array(arrays / f"{name}.npy", *shape) for name, shape in shapes.items()}
    opened["take_names"] = _names(arrays / "take_names.npy", header.takes)
    if header.settings.clusters:
        opened |= _merged(arrays, header)
    return database_of(place, header, opened)


def database_of(folder: Path, header: Header, arrays: Mapping[str, NDArray[Any]]) -> Database:
    """Return a database of arrays, wherever they lie."""
    own = dict(arrays)
    merged = None
    if header.settings.clusters:
        merged = Merged(**{field.name: own.pop(field.name) for field in fields(Merged)})
    return Database(
        folder=folder,
        channels=header.channels,
        labels=header.labels,
        phone_set=header.phone_set,
        rate=header.rate,
        settings=header.settings,
        total_variance=header.total_variance,
        merged=merged,
        rigid=header.rigid,
        about=header.about,
        **own,
    )


def _check(header: Header, where: str) -> None:
    """Refuse numbers that no build has written."""
    least = min(header.takes, header.frames, header.units, header.components)
    if least < 1:
        raise FileFormatError("a count below 1", where=where, expected="a database with takes")
    if not header.rate > 0:
        raise FileFormatError(f"{header.rate} frames per second", where=where, expected="above 0")
    if not header.arrays.replace("-", "").isalnum():
        raise FileFormatError(
            f"arrays in {header.arrays!r}", where=where, expected="the name of a folder beside it"
        )


def _shapes(header: Header) -> dict[str, tuple[str, tuple[int | None, ...]]]:
    takes, frames, units = header.takes, header.frames, header.units
    rows, channels, labels = header.components, len(header.channels), len(header.labels)
    return {
        "mean": ("<f4", (channels,)),
        "basis": ("<f4", (rows, channels)),
        "variance": ("<f8", (rows,)),
        "rest": ("<f4", (channels,)),
        "frames": ("<f4", (frames, rows)),
        "features": ("<f4", (frames, SOUND_PARAMETERS)),
        "values": ("<f4", (frames, channels)),
        "label": ("<i2", (units,)),
        "first": ("<i8", (units,)),
        "last": ("<i8", (units,)),
        "take": ("<i4", (units,)),
        "spans": ("<f8", (units, 2)),
        "unit_sound": ("<f4", (units, SOUND_PARAMETERS * header.settings.sound_points)),
        "seams": ("<f4", (units, 2, 2 * rows)),
        "unusual": ("<f4", (units,)),
        "by_label": ("<i4", (units,)),
        "label_first": ("<i8", (labels + 1,)),
        "suffixes": ("<i4", (units,)),
        "keys": ("<i8", (units,)),
        "take_first": ("<i8", (takes + 1,)),
        "take_unit": ("<i8", (takes + 1,)),
        "take_start": ("<f8", (takes,)),
        "take_has_sound": ("|b1", (takes,)),
        "sound_centre": ("<f4", (SOUND_PARAMETERS,)),
        "sound_scale": ("<f4", (SOUND_PARAMETERS,)),
    }


def _names(path: Path, takes: int) -> NDArray[Any]:
    """The names of takes, whose width is known only to the file."""
    try:
        width = np.load(path, mmap_mode="r").dtype.str
    except (OSError, ValueError, EOFError):
        width = "|S1"
    return open_array(path, width if width.startswith("|S") else "|S1", (takes,))


def _merged(arrays: Path, header: Header) -> dict[str, NDArray[Any]]:
    units, labels = header.units, len(header.labels)
    representative = open_array(arrays / "representative.npy", "<i4", (None,))
    offsets = ("<i8", (len(representative) + 1,))
    shapes: dict[str, tuple[str, tuple[int | None, ...]]] = {
        "cluster": ("<i4", (units,)),
        "representative": ("<i4", (None,)),
        "member": ("<i4", (units,)),
        "member_first": offsets,
        "node": ("<i4", (None,)),
        "node_first": ("<i8", (labels + 1,)),
        "after": ("<i4", (None,)),
        "after_first": offsets,
        "before": ("<i4", (None,)),
        "before_first": offsets,
    }
    return {name: open_array(arrays / f"{name}.npy", *shape) for name, shape in shapes.items()}
