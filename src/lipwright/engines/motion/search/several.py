"""Several good paths at once, whose mean is likelier than any one of them. Ours.

One recording of a phone has a speaker's chance in it: how wide the mouth was that day. The
mean of several that fit has less of it. Here a jump is a cost like any other, beside how a
unit sounds, what its neighbours are, and how long it is; each path is the cheapest
(dynamic programming), and units that a path used cost more for the next. With one path it
is a search by cost alone, in which a unit that moves unusually costs more: there is no mean
that would make up for it. The publication's searches put the fewest jumps first.

Phones that were heard without words are often wrong, in the takes as in the line. There a
unit of any phone may stand for another, at a cost, and how it sounds counts twice.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.database import Database
from lipwright.phones import SILENCE

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Nodes = NDArray[np.int64]

PATHS = 12
KEPT = 96
"""Units of a phone that paths choose among."""
LOOKED_AT = 4096
STRETCHES = 64
"""Of a phone with more units than ``LOOKED_AT``, as many are compared: those that follow
each of so many places, which lie evenly over the database and are the same for all phones.
What lies between is never read, so that a search needs little memory.
"""
NEIGHBOUR = 1.0
"""What a neighbour of another class costs, in deviations of sound; of the same class, less."""
ALIKE = 0.4
EDGE = 3.0
"""What it costs that a line starts or ends with what had speech beside it: no face rests there."""
LENGTH = 2.0
"""What a unit costs that is e times as long or short as wanted."""
JUMP = 0.2
USED = 1.5
UNUSUAL = 1.0
"""What a unit's motion costs, of a lone path, that is as far from the usual as motion is from
its mean."""
OTHER, OTHER_ALIKE = 1.0, 0.3
"""What a unit of another phone costs where phones are unsure; of the same class, less."""
UNSURE_SOUND = 2.0
LONG, LONGEST = 200, 400
"""Phones after which a line is cut at the next silence, and at the latest."""
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
        How many; of more than one the mean is taken, so that unusual units do not matter.
    unsure : bool
        Whether labels may be wrong, those of the database too; it needs ``sound``.

    Returns
    -------
    (M, N) int64
    """
    asked = [int(label) for label in wanted]
    found = np.empty((paths, len(asked)), np.int64)
    for stretch in _stretches(database, asked):
        phones = [
            _phone(
                database,
                asked,
                place,
                float(lengths[place]),
                classes,
                sound,
                unusual=UNUSUAL if paths == 1 else 0.0,
                unsure=unsure,
            )
            for place in stretch
        ]
        seams = [_seams(database, one.units, other.units) for one, other in pairwise(phones)]
        costs = [phone.cost.astype(np.float32) for phone in phones]
        for path in range(paths):
            for place, chosen in enumerate(_cheapest(costs, seams)):
                found[path, stretch.start + place] = phones[place].units[chosen]
                costs[place][chosen] += USED
    return found


def _stretches(database: Database, wanted: list[int]) -> list[range]:
    """Cut a long line, in silences where it has any, so that memory does not grow with it."""
    silence = database.labels.index(SILENCE) if SILENCE in database.labels else -1
    found, start = [], 0
    for place, label in enumerate(wanted):
        held = place + 1 - start
        if held >= LONGEST or (held >= LONG and label == silence):
            found.append(range(start, place + 1))
            start = place + 1
    return [*found, range(start, len(wanted))] if start < len(wanted) else found


def _phone(
    database: Database,
    wanted: list[int],
    place: int,
    length: float,
    classes: NDArray[np.integer],
    sound: NDArray[np.float32] | None,
    *,
    unusual: float,
    unsure: bool,
) -> _Phone:
    units = _having(database, wanted[place])
    cost = np.zeros(len(units))
    if sound is not None and unsure:
        units, cost = _any(database, units, wanted[place], classes)
    before = wanted[place - 1] if place else -1
    after = wanted[place + 1] if place + 1 < len(wanted) else -1
    cost += _strangeness(database, units, -1, before, classes)
    cost += _strangeness(database, units, 1, after, classes)
    spans = database.spans[units]
    own = np.maximum((spans[:, 1] - spans[:, 0]) / database.rate, _SHORTEST)
    cost += LENGTH * np.abs(np.log(own / max(length, _SHORTEST)))
    cost += unusual * database.unusual[units]
    if sound is not None:
        weight = UNSURE_SOUND if unsure else 1.0
        units, cost = _heard(database, units, cost, sound[place], weight)
    best = _least(cost, KEPT)
    return _Phone(units[best], cost[best])


def _heard(
    database: Database, units: Nodes, cost: Floats, sound: Singles, weight: float
) -> tuple[Nodes, Floats]:
    """Add what sound costs, and leave out units that are none of the cheapest without it."""

    def away(of: Nodes) -> Floats:
        apart = database.unit_sound[of] - sound
        distance: Floats = np.sqrt(np.einsum("ud,ud->u", apart, apart) / apart.shape[1])
        return weight * distance

    if len(units) > 16 * KEPT:
        some = _least(cost, 4 * KEPT)
        bound = np.partition(cost[some] + away(units[some]), KEPT)[KEPT]
        within = cost <= bound
        units, cost = units[within], cost[within]
    return units, cost + away(units)


def _least(cost: Floats, count: int) -> Nodes:
    """Return the places of the least, at most so many, in order of places."""
    if len(cost) <= count:
        return np.arange(len(cost))
    return np.sort(np.argpartition(cost, count)[:count])


def _having(database: Database, label: int) -> Nodes:
    """Return the units of a label that are looked at."""
    first, last = database.label_first[label : label + 2].tolist()
    having = database.by_label[first:last]
    if len(having) > LOOKED_AT:
        every = np.arange(STRETCHES) * len(database.label) // STRETCHES
        starts = np.searchsorted(having, every.astype(having.dtype))
        places = starts[:, None] + np.arange(LOOKED_AT // STRETCHES)
        having = having[places[places < np.append(starts[1:], len(having))[:, None]]]
    return having.astype(np.int64)


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
        return np.where(own == label, 0.0, EDGE)
    alike = (own >= 0) & (classes[own] == classes[label])
    cost: Floats = NEIGHBOUR * np.where(own == label, 0.0, np.where(alike, ALIKE, 1.0))
    return cost


def _cheapest(costs: list[Singles], seams: list[Singles]) -> list[int]:
    """Return, for each phone, the place of its unit on the cheapest path."""
    so_far, ways = costs[0], []
    for seam, cost in zip(seams, costs[1:], strict=True):
        through = seam + so_far
        way = through.argmin(axis=1)
        ways.append(way)
        so_far = through[np.arange(len(cost)), way] + cost
    places = [int(so_far.argmin())]
    for way in reversed(ways):
        places.append(int(way[places[-1]]))
    return places[::-1]


def _seams(database: Database, left: Nodes, right: Nodes) -> Singles:
    """What it costs to go from units to others: (B, A), single precision is enough."""
    end, begin = database.seams[left, 1], database.seams[right, 0]
    squares = np.einsum("bk,bk->b", begin, begin)[:, None] + np.einsum("ak,ak->a", end, end)
    squares -= 2.0 * begin @ end.T
    apart: Singles = np.sqrt(np.maximum(squares, 0.0, out=squares), out=squares)
    apart += JUMP
    follows = right[:, None] == left + 1
    follows &= database.take[right][:, None] == database.take[left]
    apart[follows] = 0.0
    return apart
