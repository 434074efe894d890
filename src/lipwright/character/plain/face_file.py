"""Face files: clusters of a mesh and how expressions move them, as text to edit.

JSON, ``"format": "lipwright/face"``. Lengths are in the model's own unit, ``unit`` says
how many metres that is; angles in degrees; places as the model stands in its scene.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from pathlib import Path

import msgspec

from lipwright.errors import FileFormatError
from lipwright.files import convert, read_document

FORMAT, VERSION = "lipwright/face", 1
Point = tuple[float, float, float]


class _Struct(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    pass


class Sphere(_Struct, frozen=True):
    """All within ``radius`` of ``center``: 1 in the ``core`` (a share), 0 at the edge."""

    center: Point
    radius: float
    core: float = 0.0


class Along(_Struct, frozen=True):
    """As a sphere, but measured along the surface: lips that touch are far apart."""

    point: Point
    radius: float
    core: float = 0.0


class Box(_Struct, frozen=True):
    """All between two corners; it fades out over ``fade`` beyond them."""

    low: Point
    high: Point
    fade: float = 0.0


class Plane(_Struct, frozen=True):
    """All on the side of a plane to which ``normal`` points, rising over ``fade``."""

    point: Point
    normal: Point
    fade: float = 0.0


class Region(_Struct, frozen=True):
    """A weight for each vertex, 0..1: one way of saying where.

    Parameters
    ----------
    sphere, along, box, plane : optional
        A shape in space or on the surface.
    part : str, optional
        All of a mesh, group or material of this name.
    vertices : list of int, optional
        Numbers of vertices of ``part``, from 0.
    weights : list of float, optional
        One for each of ``vertices``; 1 where not given.
    mirror : bool
        Whether its mirror image (x to -x) belongs to it, too.
    invert : bool
        Whether all but it is meant.
    """

    sphere: Sphere | None = None
    along: Along | None = None
    box: Box | None = None
    plane: Plane | None = None
    part: str | None = None
    vertices: list[int] | None = None
    weights: list[float] | None = None
    mirror: bool = False
    invert: bool = False

    @property
    def shapes(self) -> int:
        """How many shapes it has."""
        return sum(s is not None for s in (self.sphere, self.along, self.box, self.plane))


class Turn(_Struct, frozen=True):
    """A rotation by ``degrees`` about ``axis`` through ``pivot``."""

    degrees: float
    axis: Point
    pivot: Point


class Scaling(_Struct, frozen=True):
    """Each vertex goes to ``factors`` times its distance from ``center``."""

    center: Point
    factors: Point


class ClusterMove(_Struct, frozen=True):
    """How a cluster moves at intensity 1; each vertex by its own weight.

    Parameters
    ----------
    cluster : str
    shift : three numbers, optional
        A translation.
    turn : Turn, optional
    scale : Scaling, optional
    shifts : list of three numbers, optional
        For a cluster of one list of vertices: each vertex's own translation.
    degrees : list of float, optional
        The same: each vertex's own share of ``turn``, in degrees.
    """

    cluster: str
    shift: Point | None = None
    turn: Turn | None = None
    scale: Scaling | None = None
    shifts: list[Point] | None = None
    degrees: list[float] | None = None


class FaceFile(_Struct, frozen=True):
    """What a face file says.

    Parameters
    ----------
    name : str
    model : str
        An OBJ, GLB, glTF or VRM file; relative to the face file.
    clusters : dict of str to list of Region
        A cluster's weight is the product of its regions'.
    expressions : dict of str to list of ClusterMove
        Basic expressions: the names that the morph targets will have.
    mixtures : dict of str to dict of str to float
        Further targets, mixed of basic expressions at some intensity.
    between : dict of str to list of float
        Intensities at which an expression gets an in-between target.
    unit : float
        Metres per unit of the model, and of this file.
    about : str
    """

    version: int
    name: str
    model: str
    clusters: dict[str, list[Region]]
    expressions: dict[str, list[ClusterMove]]
    mixtures: dict[str, dict[str, float]] = {}
    between: dict[str, list[float]] = {}
    unit: float = 1.0
    about: str = ""


def read_face(path: str | Path) -> FaceFile:
    """Return the content of a face file.

    Raises
    ------
    InputError
        If the file cannot be read.
    FileFormatError
        If it is no face file, or something in it makes no sense: the message names the place.
    """
    where = str(path)
    read = convert(read_document(path, format=FORMAT, version=VERSION), FaceFile, where)
    if not read.unit > 0:
        raise _wrong(where, "unit", f"{read.unit:g} metres per unit", "more than 0")
    if not read.expressions:
        raise _wrong(where, "expressions", "nothing", "at least one expression, such as open")
    for name, regions in read.clusters.items():
        _check_cluster(regions, f"clusters.{name}", where)
    for name, moves in read.expressions.items():
        for number, move in enumerate(moves):
            _check_move(read, move, f"expressions.{name}[{number}]", where)
    _check_targets(read, where)
    return read


def _check_cluster(regions: list[Region], place: str, where: str) -> None:
    if not regions:
        raise _wrong(where, place, "no region", "at least one")
    for number, region in enumerate(regions):
        here = f"{place}[{number}]"
        if region.shapes > 1:
            raise _wrong(where, here, "several shapes", "one each: list further ones beside it")
        if not region.shapes and region.part is None:
            raise _wrong(where, here, "nothing", "sphere, along, box, plane or part")
        if region.vertices is not None and (region.shapes or region.part is None):
            raise _wrong(where, here, "vertices", "the part that they belong to, and no shape")
        if region.weights is not None and len(region.weights) != len(region.vertices or ()):
            raise _wrong(where, here, f"{len(region.weights)} weights", "one for each vertex")
        for ball in (region.sphere, region.along):
            if ball is not None and not (ball.radius > 0 and 0 <= ball.core < 1):
                found = f"radius {ball.radius:g}, core {ball.core:g}"
                raise _wrong(where, here, found, "a radius above 0 and a core from 0 to below 1")
        if region.plane is not None:
            _check_direction(region.plane.normal, f"{here}.plane.normal", where)


def _check_move(face: FaceFile, move: ClusterMove, place: str, where: str) -> None:
    if move.cluster not in face.clusters:
        known = ", ".join(face.clusters) or "a cluster"
        raise _wrong(where, place, f"no cluster {move.cluster!r}", f"one of {known}")
    if move.turn is not None:
        _check_direction(move.turn.axis, f"{place}.turn.axis", where)
    if not any((move.shift, move.turn, move.scale, move.shifts)):
        raise _wrong(where, place, "no movement", "shift, turn, scale or shifts")
    own = [values for values in (move.shifts, move.degrees) if values is not None]
    if not own:
        return
    if move.degrees is not None and move.turn is None:
        raise _wrong(where, place, "degrees without a turn", "the axis and pivot of a turn")
    regions = face.clusters[move.cluster]
    listed = regions[0].vertices if len(regions) == 1 else None
    if listed is None or any(len(values) != len(listed) for values in own):
        raise _wrong(
            where, place, "values for single vertices", "a cluster of one list of as many vertices"
        )


def _check_targets(face: FaceFile, where: str) -> None:
    for name, mixed in face.mixtures.items():
        if name in face.expressions:
            raise _wrong(where, f"mixtures.{name}", "an expression's name", "another name")
        _check_known(mixed, face, f"mixtures.{name}", where)
    _check_known(face.between, face, "between", where)
    for name, steps in face.between.items():
        if any(not 0 < step < 1 for step in steps) or steps != sorted(set(steps)):
            raise _wrong(where, f"between.{name}", str(steps), "rising numbers between 0 and 1")


def _check_known(names: Iterable[str], face: FaceFile, place: str, where: str) -> None:
    for name in names:
        if name not in face.expressions:
            known = ", ".join(face.expressions)
            raise _wrong(where, place, f"no expression {name!r}", f"one of {known}")


def _check_direction(direction: Point, place: str, where: str) -> None:
    if not math.hypot(*direction) > 1e-9:
        raise _wrong(where, place, "no direction", "three numbers that are not all 0")


def _wrong(where: str, place: str, found: str, expected: str) -> FileFormatError:
    return FileFormatError(found, where=f"{where}, at {place}", expected=expected)
