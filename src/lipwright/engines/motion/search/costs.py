"""How badly a unit suits a phone, and how badly two units join (DESIGN section 5).

Distances have no unit: sound is scaled to the database's deviation per parameter, motion to
its deviation from the mean, so that 1 is the difference between a thing and its average. A
unit suits by how it sounds and, ours, by how usual its motion is for its phone: an unusual
one must sound the better. The publication's third criterion alone leaves much to chance.
All are weighted and added.
"""

from __future__ import annotations

from copy import copy
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.database import SOUND_PARAMETERS, Database
from lipwright.engines.motion.graph import Graph, Nodes
from lipwright.engines.motion.units import at_points
from lipwright.errors import InputError

Floats = NDArray[np.float64]

UNUSUAL = 8.0
"""How much dearer a unit is whose motion is as far from the usual as motion is from its mean."""
USED = 3.0
"""What each use of a unit by another path costs, where other paths are looked for."""
_SIDES: tuple[Literal["left"], Literal["right"]] = ("left", "right")


def wanted_sound(
    database: Database,
    features: NDArray[np.float32],
    rate: float,
    start: float,
    spans: NDArray[np.float64],
) -> NDArray[np.float32]:
    """Return the sound of wanted phones as the database keeps that of its units.

    Parameters
    ----------
    database : Database
    features : (T, 9) float32
        Parameters of the wanted sound; row k at ``start + (k + 0.5) / rate``.
    rate, start : float
        Rows per second; seconds.
    spans : (N, 2) float64
        Begin and end of the wanted phones, seconds.
    """
    rows = np.asarray(features)
    if rows.ndim != 2 or rows.shape[1] != SOUND_PARAMETERS or not len(rows):
        raise InputError(
            f"sound parameters of shape {rows.shape}", expected=f"rows of {SOUND_PARAMETERS}"
        )
    points = at_points(rows, (spans - start) * rate, database.settings.sound_points)
    scaled = (points - database.sound_centre) / database.sound_scale
    return scaled.reshape(len(spans), -1).astype(np.float32)


class Costs:
    """Distances between what is wanted and what a graph has.

    Parameters
    ----------
    graph : Graph
    sound : (N, D) float32, optional
        Of the wanted phones, from :func:`wanted_sound`; without it only motion counts.
    sound_weight, joining_weight, unusual_weight : float
        What the kinds of distance are multiplied by.
    """

    def __init__(
        self,
        graph: Graph,
        sound: NDArray[np.float32] | None = None,
        sound_weight: float = 1.0,
        joining_weight: float = 1.0,
        unusual_weight: float = UNUSUAL,
    ) -> None:
        width = graph.database.unit_sound.shape[1]
        if sound is not None and (sound.ndim != 2 or sound.shape[1] != width):
            raise InputError(
                f"sound of shape {sound.shape}", expected=f"{width} numbers for each phone"
            )
        self._graph = graph
        self._sound = sound
        self._heard = graph.database.unit_sound
        self._seams = graph.database.seams
        self._sound_weight = sound_weight / np.sqrt(width)
        self._joining_weight = joining_weight
        self._used = np.zeros(0, np.int64)
        self._unusual = graph.database.unusual
        self._unusual_weight = unusual_weight

    def without(self, units: Nodes) -> Costs:
        """Return costs by which units that others used already cost more, once for each use."""
        other = copy(self)
        other._used = np.sort(np.append(self._used, units))
        return other

    def sound(self, phone: int, nodes: Nodes) -> Floats:
        """Return how badly nodes suit one wanted phone: (M,), by the least of a node's sounds."""
        return self.sounds(np.full(len(nodes), phone), nodes)

    def sounds(self, phones: Nodes, nodes: Nodes) -> Floats:
        """Return how badly each node suits its own wanted phone: (M,)."""
        if not len(nodes):
            return np.zeros(0)
        units, first = self._graph.sounds(nodes)
        if len(units) == len(nodes):
            return self.unit_sounds(phones, units)
        counts = np.diff(np.append(first, len(units)))
        every = self._heard_as(np.repeat(phones, counts), units)
        least: Floats = np.minimum.reduceat(every, first)
        return self._suited(least, self._graph.units(nodes))

    def unit_sounds(self, phones: Nodes, units: Nodes) -> Floats:
        """Return how badly each unit suits its own wanted phone: (M,)."""
        return self._suited(self._heard_as(phones, units), units)

    def _suited(self, heard: Floats, units: Nodes) -> Floats:
        """Make units that move unusually dearer: what sounds just as wanted stays free."""
        odd = self._unusual_weight * self._unusual.take(units).astype(np.float64)
        found: Floats = odd if self._sound is None else heard * (1.0 + odd)
        if len(self._used):
            first, last = (np.searchsorted(self._used, units, side) for side in _SIDES)
            found = found + USED * (last - first)
        return found

    def _heard_as(self, phones: Nodes, units: Nodes) -> Floats:
        if self._sound is None:
            return np.zeros(len(units))
        away = self._heard.take(units, axis=0)
        away -= self._sound.take(phones, axis=0)
        squared = np.einsum("nd,nd->n", away, away)
        distance: Floats = np.sqrt(squared, dtype=np.float64)
        distance *= self._sound_weight
        return distance

    def joining(self, left: Nodes, right: Nodes) -> Floats:
        """Return how badly every left node joins every right one: (A, B).

        The distance of the motions' states at the seam; 0 for neighbours in a take.
        """
        return self.between(self.ends(left), self.begins(right))

    def ends(self, nodes: Nodes) -> Floats:
        """Return the states in which nodes end: (A, S)."""
        states: Floats = self._seams[self._graph.units(nodes), 1].astype(np.float64)
        return states

    def begins(self, nodes: Nodes) -> Floats:
        """Return the states in which nodes begin: (B, S)."""
        states: Floats = self._seams[self._graph.units(nodes), 0].astype(np.float64)
        return states

    def between(self, one: Floats, other: Floats) -> Floats:
        """Return how badly nodes in some states join nodes in others: (A, B)."""
        squared: Floats = one @ (-2.0 * other.T)
        squared += np.einsum("ad,ad->a", one, one)[:, None]
        squared += np.einsum("bd,bd->b", other, other)
        np.maximum(squared, 0.0, out=squared)
        np.sqrt(squared, out=squared)
        if self._joining_weight != 1.0:
            squared *= self._joining_weight
        return squared

    def joinings(self, left: Nodes, right: Nodes) -> Floats:
        """Return how badly each left node joins the right one beside it: (M,)."""
        away = self._seams[self._graph.units(left), 1].astype(np.float64)
        away -= self._seams[self._graph.units(right), 0]
        distance: Floats = np.sqrt(np.einsum("nd,nd->n", away, away))
        return distance * self._joining_weight

    def total(self, nodes: Nodes) -> float:
        """Return the cost of a whole path: how each node suits, and joins the next."""
        suits = float(self.sounds(np.arange(len(nodes)), nodes).sum())
        return suits + float(self.joinings(nodes[:-1], nodes[1:]).sum())
