"""Where the mouth of a face is, found from how it opens; and how it stands at any pose.

The lips are what lies close together at rest and parts when the mouth opens: of the pairs
of vertices that are each other's nearest across this parting, the frontmost of each column
are the line where the lips meet. The corners are where it ends. Nothing is taken from
names, but that teeth, tongue and eyes are left out where something else is there. Lengths
are the model's own; ``front`` is what is seen from the front.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.character.surfaces import Surfaces

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

_INSIDE = re.compile(
    r"teeth|tooth|tongue|gum|eye|lash|brow|hair|oral|cavity|socket|bag|beard", re.I
)
_CLOSE = 0.45
"""Lips lie closer at rest than this share of what they part at most."""
_TORN = 0.35
"""Skin stretches by less than this: what parts by more, for how close it lay, was not one."""
_SOME = 0.12
"""Where they part by less than this share of it, the mouth ends."""
_MOST = 2500
"""Of more vertices about the lips, every second, third, … is looked at."""
_MOST_BEYOND = 800
_COLUMNS = 5


@dataclass(frozen=True, slots=True, eq=False)
class Mouth:
    """The mouth of a face: which vertices are its inner lips and its corners.

    Parameters
    ----------
    upper, lower : (P,) int
        The line where the lips meet, from the head's right to its left: pairs of vertices.
    corners : tuple of 2 int
        The right and the left corner.
    columns : list of (upper, lower) int arrays
        For columns about the middle, the vertices of each lip.
    surfaces : Surfaces
        The vertices named above alone, numbered in rising order.
    vertices : (M,) int
        Their numbers in the whole face.
    width : float
        From corner to corner, at rest.
    """

    upper: Indices
    lower: Indices
    corners: tuple[int, int]
    columns: list[tuple[Indices, Indices]]
    surfaces: Surfaces
    vertices: Indices
    width: float

    def stand(self, values: Mapping[str, float]) -> Stance:
        """Return how the mouth stands at values of the rig's channels."""
        points = self.surfaces.positions(values)

        def at(vertices: Indices) -> Floats:
            return np.asarray(points[np.searchsorted(self.vertices, vertices)])

        gaps = [at(up)[:, 1].min() - at(low)[:, 1].max() for up, low in self.columns]
        middle = slice(len(self.upper) // 4, len(self.upper) - len(self.upper) // 4)
        pairs = at(self.upper[middle])[:, 1] - at(self.lower[middle])[:, 1]
        right, left = at(np.array(self.corners))
        return Stance(
            float(np.median(gaps)) / self.width,
            float(np.max(gaps)) / self.width,
            float(np.median(pairs)) / self.width,
            float(np.linalg.norm(left - right)) / self.width,
        )


@dataclass(frozen=True, slots=True)
class Stance:
    """How a mouth stands; all in shares of its width at rest.

    Parameters
    ----------
    gap : float
        What can be seen through between the lips from the front, about the middle.
    widest : float
        The same where it is widest.
    contact : float
        From the lower to the upper lip where they meet at rest; below 0 if they crossed.
    width : float
        From corner to corner.
    """

    gap: float
    widest: float
    contact: float
    width: float


def find_mouth(face: Surfaces, opened: Mapping[str, float]) -> Mouth | None:
    """Return the mouth of a face, or None where nothing parts as lips do.

    Parameters
    ----------
    face : Surfaces
        The whole face.
    opened : mapping of str to float
        Values of the rig's channels that open the mouth.
    """
    rest = face.positions({})
    moves = face.positions(opened) - rest
    usable = _usable(face, moves)
    drop = np.where(usable, moves[:, 1], 0.0)
    most = -float(drop.min(initial=0.0))
    if most <= 1e-9 or not np.isfinite(rest).all() or not np.isfinite(moves).all():
        return None
    low = np.flatnonzero(usable & (drop <= -0.4 * most))
    high = np.flatnonzero(usable & (drop >= -0.3 * most))
    reach = _CLOSE * most
    low, high = _near(rest, low, high, reach)
    if not len(low) or not len(high):
        return None
    lower, upper = _mutual(rest, low, high)
    apart = np.linalg.norm(rest[upper] - rest[lower], axis=1)
    torn = apart <= np.minimum(reach, _TORN * (drop[upper] - drop[lower]))
    lower, upper = lower[torn], upper[torn]
    lower, upper = _line(rest, drop, lower, upper, most)
    if len(lower) < 2:
        return None
    corners = _corners(face, rest, drop, lower, upper, most)
    width = float(np.linalg.norm(rest[corners[1]] - rest[corners[0]]))
    if not width > 0:
        return None
    columns = _columns(rest, drop, usable, lower, upper, width)
    named = np.concatenate([upper, lower, corners, *(v for pair in columns for v in pair)])
    vertices = np.unique(named).astype(np.intp)
    return Mouth(upper, lower, corners, columns, face.taken(vertices), vertices, width)


def _usable(face: Surfaces, moves: Floats) -> NDArray[np.bool_]:
    """Leave out teeth, tongue and eyes, if what remains moves, too."""
    skin = np.array([not _INSIDE.search(part.name) for part in face.parts], bool)
    kept = skin[face.part_of] if len(face.parts) else np.zeros(0, bool)
    moving = np.abs(moves[:, 1])
    enough = moving[kept].max(initial=0.0) > 0.3 * moving.max(initial=0.0)
    return kept if enough else np.ones(len(moves), bool)


def _near(rest: Floats, low: Indices, high: Indices, reach: float) -> tuple[Indices, Indices]:
    """Keep the vertices that have some of the other kind in a neighbouring cell."""
    cells = np.floor((rest - rest.min(axis=0)) / reach).astype(np.int64) + 1
    size = cells.max(axis=0) + 2
    keys = (cells[:, 0] * size[1] + cells[:, 1]) * size[2] + cells[:, 2]
    steps = np.array([-1, 0, 1])
    around = ((steps[:, None, None] * size[1] + steps[:, None]) * size[2] + steps).ravel()
    kept_low = low[np.isin(keys[low], (np.unique(keys[high])[:, None] + around).ravel())]
    kept_high = high[np.isin(keys[high], (np.unique(keys[kept_low])[:, None] + around).ravel())]
    return _thinned(kept_low, _MOST), _thinned(kept_high, _MOST)


def _thinned(vertices: Indices, most: int) -> Indices:
    return vertices[:: max(1, -(-len(vertices) // most))]


def _mutual(rest: Floats, low: Indices, high: Indices) -> tuple[Indices, Indices]:
    """Return the pairs that are each other's nearest."""
    squares = _squares(rest[low], rest[high])
    to_high, to_low = squares.argmin(axis=1), squares.argmin(axis=0)
    kept = to_low[to_high] == np.arange(len(low))
    return low[kept], high[to_high[kept]]


def _squares(a: Floats, b: Floats) -> NDArray[np.float32]:
    middle = a.mean(axis=0)
    a, b = (a - middle).astype(np.float32), (b - middle).astype(np.float32)
    total = np.add.outer((a * a).sum(axis=1), (b * b).sum(axis=1)) - 2 * (a @ b.T)
    return np.asarray(total, np.float32)


def _line(
    rest: Floats, drop: Floats, lower: Indices, upper: Indices, most: float
) -> tuple[Indices, Indices]:
    """Return the frontmost pair of each column, from right to left, that follows its neighbour."""
    if not len(lower):
        return lower, upper
    middle = (rest[lower] + rest[upper]) / 2
    order = np.argsort(middle[:, 0], kind="stable")
    lower, upper, middle = lower[order], upper[order], middle[order]
    step = max(0.08 * most, 1e-12)
    columns = np.floor(middle[:, 0] / step).astype(np.int64)
    picked = []
    for column in np.unique(columns):
        inside = np.flatnonzero(columns == column)
        picked.append(int(inside[np.argmax(middle[inside, 2])]))
    parting = drop[upper] - drop[lower]
    start = int(np.argmax([parting[p] + middle[p, 2] for p in picked]))
    chain = [picked[start]]
    for way in (picked[start + 1 :], picked[:start][::-1]):
        last = picked[start]
        for each in way:
            aside = abs(middle[each, 0] - middle[last, 0])
            if np.abs(middle[each, 1:] - middle[last, 1:]).max() > 1.5 * aside + 0.1 * most:
                continue
            chain.append(each)
            last = each
    chain.sort(key=lambda each: float(middle[each, 0]))
    return lower[chain], upper[chain]


def _corners(
    face: Surfaces, rest: Floats, drop: Floats, lower: Indices, upper: Indices, most: float
) -> tuple[int, int]:
    """Follow the parting outwards from the ends of the line until it is small."""
    triangles = face.triangles
    found = []
    for end, way in ((0, -1.0), (-1, 1.0)):
        low, high = int(lower[end]), int(upper[end])
        for _ in range(40):
            around = _beyond(rest, low, high, way, 0.5 * most)
            if not len(around):
                break
            gaps = _squares(rest[around], rest[around])
            parts = np.subtract.outer(drop[around], drop[around])
            near = parts > np.maximum(_SOME * most, np.sqrt(np.maximum(gaps, 0.0)) / _TORN)
            if not near.any():
                break
            rows, columns = np.nonzero(near)
            best = int(np.argmax(way * (rest[around[rows], 0] + rest[around[columns], 0])))
            high, low = int(around[rows[best]]), int(around[columns[best]])
        found.append(_closing(rest, triangles, low, high, way, 1e-5 * most))
    return found[0], found[1]


def _beyond(rest: Floats, low: int, high: int, way: float, reach: float) -> Indices:
    """Return the vertices a little farther out than a pair, about its height and depth."""
    middle = (rest[low] + rest[high]) / 2
    offset = (rest - middle) * (way, 1.0, 1.0)
    inside = (offset[:, 0] > 1e-6 * reach) & (offset[:, 0] < reach)
    inside &= (np.abs(offset[:, 1]) < 0.25 * reach) & (np.abs(offset[:, 2]) < 0.5 * reach)
    return _thinned(np.flatnonzero(inside), _MOST_BEYOND)


def _closing(rest: Floats, triangles: Indices, low: int, high: int, way: float, near: float) -> int:
    """Return the vertex that joins both lips outside a pair, if there is one."""

    def beside(vertex: int) -> set[int]:
        level = np.flatnonzero(np.abs(rest[:, 1] - rest[vertex, 1]) < near)
        same = level[(np.abs(rest[level] - rest[vertex]) < near).all(axis=1)]
        touching = np.zeros(len(triangles), bool)
        for each in same.tolist():
            touching |= (triangles == each).any(axis=1)
        return set(triangles[touching].ravel().tolist())

    middle = (rest[low] + rest[high]) / 2
    offset = (rest - middle) * (way, 1.0, 1.0)
    outside = [v for v in beside(low) & beside(high) if offset[v, 0] > offset[[low, high], 0].max()]
    return max(outside, key=lambda v: float(offset[v, 0] - abs(offset[v, 1])), default=high)


def _columns(
    rest: Floats,
    drop: Floats,
    usable: NDArray[np.bool_],
    lower: Indices,
    upper: Indices,
    width: float,
) -> list[tuple[Indices, Indices]]:
    """Return both lips' vertices in columns about the middle."""
    line = (rest[lower] + rest[upper]) / 2
    centre = (line[0, 0] + line[-1, 0]) / 2
    places = centre + width * np.linspace(-0.2, 0.2, _COLUMNS)
    columns = []
    for place in places:
        nearest = int(np.argmin(np.abs(line[:, 0] - place)))
        at = line[nearest]
        offset = np.abs(rest - (place, at[1], at[2]))
        inside = usable & (offset[:, 0] <= 0.05 * width) & (offset[:, 1] <= 0.22 * width)
        inside &= rest[:, 2] >= at[2] - 0.05 * width
        between = (drop[upper[nearest]] + drop[lower[nearest]]) / 2
        high = np.append(np.flatnonzero(inside & (drop >= between)), upper[nearest])
        low = np.append(np.flatnonzero(inside & (drop < between)), lower[nearest])
        columns.append((np.unique(high), np.unique(low)))
    return columns
