"""Markers bound to a face: each on a point of its skin, found or as a file says.

What is found is refused where it does not fit; a place that an artist gave is taken, if it
is on the skin of this model.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import CharacterError, FileFormatError, did_you_mean
from lipwright.marker_faces.aligning import Alignment, align, similarity
from lipwright.marker_faces.face_mesh import FaceMesh
from lipwright.marker_faces.layout import MarkerLayout
from lipwright.marker_faces.marker_file import MarkerFile, Point
from lipwright.marker_faces.placing import Placed, place

Floats = NDArray[np.float64]

FITS = 0.006
"""Metres, root mean square, by which markers may miss a face that they are said to fit."""
_OFF = 0.5
_FREE = (1e-9, 1e9)


@dataclass(frozen=True, slots=True, eq=False)
class Binding:
    """Markers on a face.

    Parameters
    ----------
    labels : tuple of str
    placed : tuple of Placed
        Each marker's point on the skin, in the head's axes.
    alignment : Alignment
        How displacements of the layout become displacements of the face.
    misses : (M,) float64, metres
        How far from the skin the layout lies, in its own size.
    """

    labels: tuple[str, ...]
    placed: tuple[Placed, ...]
    alignment: Alignment
    misses: Floats

    @property
    def points(self) -> Floats:
        """The markers' places, (M, 3), in the head's axes."""
        return np.stack([each.point for each in self.placed])

    @property
    def residual(self) -> float:
        """Root mean square of the misses, metres; the worst tenth (a headband) left out."""
        kept = np.sort(self.misses)[: len(self.misses) - len(self.misses) // 10]
        return float(np.sqrt(np.mean(kept**2)))

    def note(self) -> str:
        """Return what to say of it."""
        worst = int(np.argmax(self.misses))
        return (
            f"{len(self.labels)} markers lie {1e3 * self.residual:.1f} mm from the skin "
            f"(root mean square), {self.labels[worst]} {1e3 * self.misses[worst]:.1f} mm"
        )

    def to_file(self, face: FaceMesh, pins: Mapping[str, Point] | None = None) -> MarkerFile:
        """Return it as a file to edit, in the axes of the model's scene."""
        places = self.points @ face.surfaces.axes
        markers = {
            label: (float(x), float(y), float(z))
            for label, (x, y, z) in zip(self.labels, places, strict=True)
        }
        return MarkerFile(face.name, len(face.points), markers, dict(pins or {}))


def bind(layout: MarkerLayout, face: FaceMesh, file: MarkerFile | None = None) -> Binding:
    """Bind a layout of markers to a face.

    Parameters
    ----------
    layout : MarkerLayout
    face : FaceMesh
    file : MarkerFile, optional
        What is known already; it goes before what is found.

    Raises
    ------
    CharacterError
        If the layout does not fit the face.
    FileFormatError
        If the file is another model's, names a marker that the layout has not, lacks one,
        or puts one beside the skin.
    """
    given = _given(file, layout, face) if file is not None else {}
    pins = {layout.labels.index(label): point for label, point in given.items()}
    if len(pins) == len(layout.labels):
        goal = np.stack([pins[number] for number in range(len(pins))])
        found = similarity(layout.rest, goal, np.ones(len(pins)), _FREE)
        placed = place(face, goal)
        return _bound(layout, placed, found)
    found = align(layout, face, pins)
    placed = place(face, found.laid(layout.rest), layout.lowered)
    bound = _bound(layout, placed, found)
    if bound.residual > FITS:
        raise CharacterError(
            f"the markers miss this face by {1e3 * bound.residual:.0f} mm (root mean square)",
            where=face.name,
            expected=f"at most {1e3 * FITS:.0f} mm",
            cure="choose a face of human proportions, or pin some of them in a marker file",
        )
    pinned = place(face, np.array(list(pins.values())).reshape(-1, 3))
    for number, point in zip(pins, pinned, strict=True):
        placed[number] = point
    return _bound(layout, placed, found)


def _bound(layout: MarkerLayout, placed: list[Placed], found: Alignment) -> Binding:
    points = np.stack([each.point for each in placed])
    misses = np.linalg.norm(found.laid(layout.rest) - points, axis=1) / found.scale
    return Binding(layout.labels, tuple(placed), found, misses)


def _given(file: MarkerFile, layout: MarkerLayout, face: FaceMesh) -> dict[str, Floats]:
    """Return the places that a file gives, in the head's axes, pins before markers."""
    if file.vertices != len(face.points):
        raise FileFormatError(
            f"was made for {file.model!r} of {file.vertices:,} vertices",
            where=file.where,
            expected=f"{face.name!r} of {len(face.points):,}",
            cure="make it anew for this model",
        )
    found: dict[str, Floats] = {}
    for key, points in (("markers", file.markers), ("pins", file.pins)):
        for label, point in points.items():
            where = f"{file.where}, at {key}.{label}"
            if label not in layout.labels:
                raise FileFormatError(
                    "no such marker", where=where, cure=did_you_mean(label, layout.labels)
                )
            found[label] = _on_skin(np.array(point) @ face.surfaces.axes.T, face, where)
    missing = [label for label in layout.labels if label not in file.markers]
    if file.markers and missing:
        raise FileFormatError(
            f"lacks {', '.join(missing[:3])}{', …' if len(missing) > 3 else ''}",
            where=f"{file.where}, at markers",
            expected=f"all {len(layout.labels)} markers",
            cure="add what is missing, or take 'markers' out: it is found then",
        )
    return found


def _on_skin(point: Floats, face: FaceMesh, where: str) -> Floats:
    far = float(np.linalg.norm(face.points[face.outward] - point, axis=1).min())
    if far > _OFF * face.width:
        raise FileFormatError(
            f"lies {far / face.width:.1f} times the mouth's width from the skin",
            where=where,
            expected="a point on it, in the axes and the unit of the model's scene",
        )
    return point
