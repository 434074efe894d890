"""Wavefront OBJ: positions, faces and their groups, with the colours of materials.

What is not read: texture coordinates, textures, normals (they are made anew), curves.
Faces of more than three corners are cut into fans. Indices may count from the end.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright.character.mesh import Material, Part
from lipwright.errors import FileFormatError, InputError
from lipwright.files import decode_text, read_bytes

LARGEST = 500_000_000
"""Bytes: a text of more is no face."""
_GREY = (0.6, 0.6, 0.6, 1.0)


@dataclass(slots=True)
class _Reader:
    """The state of reading: what stands so far, and into which part faces go."""

    where: str
    points: list[tuple[float, float, float]] = field(default_factory=list)
    parts: dict[tuple[str, str], list[tuple[int, int, int]]] = field(default_factory=dict)
    libraries: list[str] = field(default_factory=list)
    name: str = ""
    material: str = ""

    def take(self, number: int, line: str) -> None:
        kind, *words = line.split()
        try:
            if kind == "v":
                x, y, z = map(float, words[:3])
                self.points.append((x, y, z))
            elif kind == "f":
                self._face(words)
            elif kind in ("o", "g"):
                self.name = " ".join(words)
            elif kind == "usemtl":
                self.material = " ".join(words)
            elif kind == "mtllib":
                self.libraries.append(" ".join(words))
        except ValueError:
            raise FileFormatError(
                f"{line.strip()[:60]!r}",
                where=f"{self.where}, line {number}",
                expected=_FORMS[kind],
            ) from None

    def _face(self, words: list[str]) -> None:
        corners = [self._index(word.split("/")[0]) for word in words]
        if len(corners) < 3:
            raise ValueError
        triangles = self.parts.setdefault((self.name, self.material), [])
        triangles += [(corners[0], b, c) for b, c in pairwise(corners[1:])]

    def _index(self, word: str) -> int:
        index = int(word)
        place = index - 1 if index > 0 else len(self.points) + index
        if index == 0 or not 0 <= place < len(self.points):
            raise ValueError
        return place


_FORMS = {"v": "v and three numbers", "f": "f and three or more vertices that exist"}


def read_obj(path: str | Path) -> tuple[Part, ...]:
    """Return the parts of an OBJ file, one for each group and material, in its own unit.

    Raises
    ------
    InputError
        If the file cannot be read, or is too large.
    FileFormatError
        If a line of it cannot be used, or it holds no face.
    """
    where = str(path)
    if Path(path).is_file() and Path(path).stat().st_size > LARGEST:
        raise InputError("is too large", where=where, expected=f"at most {LARGEST // 1000**2} MB")
    reader = _Reader(where)
    for number, line in _lines(path):
        reader.take(number, line)
    if not reader.parts:
        raise FileFormatError("holds no face", where=where, expected="a mesh as Wavefront OBJ")
    points = np.array(reader.points, np.float32)
    if not np.isfinite(points).all():
        raise FileFormatError("a position is not finite", where=where)
    colors = _colors(reader.libraries, Path(path).parent)
    return tuple(
        _part(name or material or Path(path).stem, triangles, points, material, colors)
        for (name, material), triangles in reader.parts.items()
    )


def _lines(path: str | Path) -> Iterator[tuple[int, str]]:
    for number, line in enumerate(decode_text(read_bytes(path), str(path)).splitlines(), 1):
        content = line.split("#")[0]
        if content.strip():
            yield number, content


def _part(
    name: str,
    triangles: list[tuple[int, int, int]],
    points: NDArray[np.float32],
    material: str,
    colors: dict[str, tuple[float, float, float, float]],
) -> Part:
    """Keep the vertices that a part uses."""
    corners = np.array(triangles, np.uint32)
    used, numbers = np.unique(corners, return_inverse=True)
    look = Material(material or name, colors.get(material, _GREY), double_sided=True)
    faces = numbers.reshape(corners.shape).astype(np.uint32)
    return Part(name, points[used], faces, look, {}, None)


def _colors(libraries: list[str], folder: Path) -> dict[str, tuple[float, float, float, float]]:
    """Return the diffuse colours of the material files that lie beside the mesh."""
    found: dict[str, tuple[float, float, float, float]] = {}
    for library in libraries:
        if not (folder / library).is_file():
            continue
        name = ""
        for _, line in _lines(folder / library):
            kind, *words = line.split()
            if kind == "newmtl":
                name = " ".join(words)
            elif kind == "Kd" and len(words) == 3:
                red, green, blue = (_linear(word) for word in words)
                found[name] = (red, green, blue, 1.0)
    return found


def _linear(word: str) -> float:
    try:
        value = min(max(float(word), 0.0), 1.0)
    except ValueError:
        return _GREY[0]
    return float(value**2.2)
