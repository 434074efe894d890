"""Marker files: where markers lie on a model's skin; text that an artist may edit.

::

    {
      "format": "lipwright/markers",
      "version": 1,
      "model": "head",
      "vertices": 5688,
      "pins": {"chin": [0, -0.115, 0.08]},
      "markers": {
        "chin": [0, -0.1131, 0.0812],
        "lip_upper": [0, -0.0631, 0.0937]
      }
    }

A point is one of the model's scene, in its own axes and unit; it is put on the skin.
``markers`` holds all markers of the database, or is left out: they are found then.
``pins`` go before, and what is found anew is laid with them.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import msgspec

from lipwright.errors import FileFormatError
from lipwright.files import (
    convert,
    format_number,
    format_row,
    quote,
    read_document,
    write_atomically,
)

FORMAT, VERSION = "lipwright/markers", 1
Point = tuple[float, float, float]
_DIGITS = 6


@dataclass(frozen=True, slots=True)
class MarkerFile:
    """Where markers lie on a model.

    Parameters
    ----------
    model : str
        The character's name, for the reader.
    vertices : int
        How many the model has: what tells it from another.
    markers : dict of str to tuple of 3 float
        All markers, or none.
    pins : dict of str to tuple of 3 float
        Those that an artist has put there.
    where : str
        The file, in errors.
    """

    model: str
    vertices: int
    markers: Mapping[str, Point] = field(default_factory=dict)
    pins: Mapping[str, Point] = field(default_factory=dict)
    where: str = "markers"

    def to_bytes(self) -> bytes:
        """Return the content of the file: a marker per line, in a stable order."""
        parts = [
            f'"format": {quote(FORMAT)}',
            f'"version": {VERSION}',
            f'"model": {quote(self.model)}',
            f'"vertices": {format_number(self.vertices, 0)}',
        ]
        if self.pins:
            parts.append(_block("pins", self.pins))
        if self.markers:
            parts.append(_block("markers", self.markers))
        return ("{\n  " + ",\n  ".join(parts) + "\n}\n").encode()

    def write(self, path: str | Path) -> None:
        """Write the file, whole or not at all.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        write_atomically(path, self.to_bytes())


def _block(key: str, points: Mapping[str, Point]) -> str:
    lines = [f"{quote(label)}: {format_row(point, _DIGITS)}" for label, point in points.items()]
    return f"{quote(key)}: {{\n    " + ",\n    ".join(lines) + "\n  }"


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    model: str
    vertices: int
    markers: dict[str, Point] = {}
    pins: dict[str, Point] = {}


def read_marker_file(path: str | Path) -> MarkerFile:
    """Return the marker file at a path.

    Raises
    ------
    InputError
        If it cannot be read.
    FileFormatError
        If it breaks the format: the message names the place.
    """
    where = str(path)
    read = convert(read_document(path, format=FORMAT, version=VERSION), _Document, where)
    if not read.markers and not read.pins:
        raise FileFormatError("holds no marker", where=where, expected="'markers' or 'pins'")
    return MarkerFile(read.model, read.vertices, read.markers, read.pins, where)
