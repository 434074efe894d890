"""Several good paths at once, whose mean is likelier than any one of them. Ours.

One recording of a phone has a speaker's chance in it: how wide the mouth was that day. The
mean of several that fit has less of it. Here a jump is a cost like any other, beside how a
unit sounds, what its neighbours are, and how long it is; each path is the cheapest
(dynamic programming), and units that a path used cost more for the next. With one path it
is a search by cost alone; the publication's searches put the fewest jumps first.

Phones that were heard without words are often wrong, in the takes as in the line. There a
unit of any phone may stand for another, at a cost, and how it sounds counts twice.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.database import Database

Floats = NDArray[np.float64]
Nodes = NDArray[np.int64]

PATHS = 8
KEPT = 48
"""Units of a phone that a path chooses among."""
LOOKED_AT = 4096
"""Units of a phone that are compared, spread evenly over the database, if it holds more."""
NEIGHBOUR = 1.0
"""What a neighbour of another class costs, in deviations of sound; of the same class, less."""
ALIKE = 0.4
LENGTH = 2.0
"""What a unit costs that is e times as long or short as wanted."""
JUMP = 0.5
USED = 1.2
OTHER, OTHER_ALIKE = 1.0, 0.3
"""What a unit of another phone costs where phones are unsure; of the same class, less."""
UNSURE_SOUND = 2.0
_SHORTEST = 0.02


@dataclass(frozen=True, slots=True, eq=False)
class _Phone:
    """The units that a phone may have, and what each costs by itself."""

    units: Nodes
    cost: Floats


def several(
    database: Database,
    wanted: NDArray[np.integer],
    lengths: Floats,
    classes: NDArray[np.integer],
    sound: NDArray[np.float32] | None = None,
    paths: int = PATHS,
    *,
    unsure: bool = False,
) -> Nodes:
    """Return several paths of units for some phones, the cheapest first.

    Parameters
    ----------
    database : Database
    wanted : (N,) int
        Indices of labels.
    lengths : (N,) float64
        Seconds of the phones.
    classes : (L,) int
        The class of each label: labels of one class look alike.
    sound : (N, D) float32, optional
        Of the wanted phones, as the database keeps that of its units.
    paths : int
        How many.
    unsure : bool
        Whether labels may be wrong, those of the database too; it needs ``sound``.

    Returns
    -------
    (M, N) int64
    """
    asked = [int(label) for label in wanted]
    phones = [
        _phone(database, asked, place, float(lengths[place]), classes, sound, unsure)
        for place in range(len(asked))
    ]
    used = [np.zeros(len(phone.units)) for phone in phones]
    found = np.empty((paths, len(asked)), np.int64)
    for path in range(paths):
        for place, chosen in enumerate(_cheapest(database, phones, used)):
            found[path, place] = phones[place].units[chosen]
            used[place][chosen] += USED
    return found


def _phone(
    database: Database,
    wanted: list[int],
    place: int,
    length: float,
    classes: NDArray[np.integer],
    sound: NDArray[np.float32] | None,
    unsure: bool,
) -> _Phone:
    units = _having(database, wanted[place])
    cost = np.zeros(len(units))
    if sound is not None:
        if unsure:
            units, cost = _any(database, units, wanted[place], classes)
        away = database.unit_sound[units] - sound[place]
        far = np.sqrt(np.einsum("ud,ud->u", away, away) / away.shape[1])
        cost += UNSURE_SOUND * far if unsure else far
    before = wanted[place - 1] if place else -1
    after = wanted[place + 1] if place + 1 < len(wanted) else -1
    cost += _strangeness(database, units, -1, before, classes)
    cost += _strangeness(database, units, 1, after, classes)
    spans = database.spans[units]
    own = np.maximum((spans[:, 1] - spans[:, 0]) / database.rate, _SHORTEST)
    cost += LENGTH * np.abs(np.log(own / max(length, _SHORTEST)))
    return _Phone(units, cost)


def _having(database: Database, label: int) -> Nodes:
    """Return the units of a label that are looked at."""
    first, last = database.label_first[label : label + 2].tolist()
    step = max(1, -(-(last - first) // LOOKED_AT))
    return np.asarray(database.by_label[first:last:step], np.int64)


def _any(
    database: Database, own: Nodes, label: int, classes: NDArray[np.integer]
) -> tuple[Nodes, Floats]:
    """Return units of any label, ``own`` among them, and what it costs that they are others."""
    step = max(1, -(-len(database.label) // LOOKED_AT))
    units = np.union1d(own, np.arange(0, len(database.label), step))
    labels = database.label[units]
    alike = np.where(classes[labels] == classes[label], OTHER_ALIKE, OTHER)
    return units, np.where(labels == label, 0.0, alike)


def _strangeness(
    database: Database, units: Nodes, side: int, label: int, classes: NDArray[np.integer]
) -> Floats:
    """What it costs each unit that its neighbour in its take is not the wanted one."""
    beside = np.clip(units + side, 0, len(database.label) - 1)
    inside = (beside == units + side) & (database.take[beside] == database.take[units])
    own = np.where(inside, database.label[beside], -1)
    if label < 0:
        return np.where(own == label, 0.0, NEIGHBOUR)
    alike = (own >= 0) & (classes[own] == classes[label])
    cost: Floats = NEIGHBOUR * np.where(own == label, 0.0, np.where(alike, ALIKE, 1.0))
    return cost


def _cheapest(database: Database, phones: list[_Phone], used: list[Floats]) -> list[int]:
    """Return, for each phone, the place of its unit on the cheapest path."""
    kept: list[Nodes] = []
    ways: list[Nodes] = []
    units: Nodes = np.empty(0, np.int64)
    so_far: Floats = np.empty(0)
    for phone, before in zip(phones, used, strict=True):
        cost = phone.cost + before
        best = np.argpartition(cost, KEPT)[:KEPT] if len(cost) > KEPT else np.arange(len(cost))
        own = phone.units[best]
        if kept:
            through = so_far[:, None] + _seams(database, units, own)
            way = through.argmin(axis=0)
            ways.append(way)
            so_far = through[way, np.arange(len(own))] + cost[best]
        else:
            so_far = cost[best]
        kept.append(best)
        units = own
    place = int(so_far.argmin())
    places = [place]
    for way in reversed(ways):
        place = int(way[place])
        places.append(place)
    return [int(best[at]) for best, at in zip(kept, reversed(places), strict=True)]


def _seams(database: Database, left: Nodes, right: Nodes) -> Floats:
    """What it costs to go from units to others: (A, B)."""
    end = database.seams[left, 1].astype(np.float64)
    begin = database.seams[right, 0].astype(np.float64)
    squares = np.einsum("ak,ak->a", end, end)[:, None] + np.einsum("bk,bk->b", begin, begin)
    apart = JUMP + np.sqrt(np.maximum(squares - 2.0 * end @ begin.T, 0.0))
    follows = left[:, None] + 1 == right
    follows &= database.take[left][:, None] == database.take[right]
    return np.where(follows, 0.0, apart)
