"""How badly a unit sounds for a phone, and how badly two units join (DESIGN section 5).

Both distances have no unit: sound is scaled to the database's deviation per parameter,
motion to its deviation from the mean, so that 1 is the difference between a thing and
its average. Both are weighted and added.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.database import SOUND_PARAMETERS, Database
from lipwright.engines.motion.graph import Graph, Nodes
from lipwright.engines.motion.units import at_points
from lipwright.errors import InputError

Floats = NDArray[np.float64]


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
    sound_weight, joining_weight : float
        What the two kinds of distance are multiplied by.
    """

    def __init__(
        self,
        graph: Graph,
        sound: NDArray[np.float32] | None = None,
        sound_weight: float = 1.0,
        joining_weight: float = 1.0,
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

    def sound(self, phone: int, nodes: Nodes) -> Floats:
        """Return how far nodes sound from one wanted phone: (M,), the least of a node's sounds."""
        return self.sounds(np.full(len(nodes), phone), nodes)

    def sounds(self, phones: Nodes, nodes: Nodes) -> Floats:
        """Return how far each node sounds from its own wanted phone: (M,)."""
        if self._sound is None or not len(nodes):
            return np.zeros(len(nodes))
        units, first = self._graph.sounds(nodes)
        if len(units) == len(nodes):
            return self.unit_sounds(phones, units)
        counts = np.diff(np.append(first, len(units)))
        every = self.unit_sounds(np.repeat(phones, counts), units)
        least: Floats = np.minimum.reduceat(every, first)
        return least

    def unit_sounds(self, phones: Nodes, units: Nodes) -> Floats:
        """Return how far each unit sounds from its own wanted phone: (M,)."""
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
        ends = self._seams[self._graph.units(left), 1].astype(np.float64)
        begins = self._seams[self._graph.units(right), 0].astype(np.float64)
        squared = ends @ begins.T
        squared *= -2.0
        squared += np.einsum("ad,ad->a", ends, ends)[:, None]
        squared += np.einsum("bd,bd->b", begins, begins)
        np.maximum(squared, 0.0, out=squared)
        np.sqrt(squared, out=squared)
        squared *= self._joining_weight
        distance: Floats = squared
        return distance

    def joinings(self, left: Nodes, right: Nodes) -> Floats:
        """Return how badly each left node joins the right one beside it: (M,)."""
        away = self._seams[self._graph.units(left), 1].astype(np.float64)
        away -= self._seams[self._graph.units(right), 0]
        distance: Floats = np.sqrt(np.einsum("nd,nd->n", away, away))
        return distance * self._joining_weight

    def total(self, nodes: Nodes) -> float:
        """Return the cost of a whole path: sound of each node, joining of each pair."""
        heard = float(self.sounds(np.arange(len(nodes)), nodes).sum())
        return heard + float(self.joinings(nodes[:-1], nodes[1:]).sum())
