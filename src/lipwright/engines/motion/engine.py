"""The motion engine: phones and sound in, recorded motion out (Cao et al. 2004).

Reads as a recipe: phones in the database's notation, paths of units, their motion warped
and joined, closures. An engine is made once for a database and then takes any number of
lines.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.engines.motion.database import Database
from lipwright.engines.motion.graph import UnitGraph, graph_of
from lipwright.engines.motion.joining import Joined, join
from lipwright.engines.motion.learnt import learnt_of, opening_in
from lipwright.engines.motion.rasta_plp import Features, rasta_plp
from lipwright.engines.motion.search import (
    Costs,
    Search,
    find,
    greedy,
    label_indices,
    optimal,
    pq,
    several,
    wanted_sound,
)
from lipwright.engines.motion.splicing import PairTable
from lipwright.errors import InputError
from lipwright.phones import SILENCE, load_reduction
from lipwright.phones.reduction import Row
from lipwright.speech import Speech

FASTEST = 10_000.0
SEVERAL = "several"
SEARCHES: dict[str, Callable[[], Search]] = {
    "optimal": lambda: optimal,
    "greedy": lambda: greedy,
    "pq": lambda: pq(4, seconds=10.0),
}
"""The publication's searches, for one path; ``pq`` takes the best it has after ten seconds."""
_SHORTEST_GAP = 1e-6


class MotionEngine:
    """Animates speech with the motion of recorded takes.

    Parameters
    ----------
    database : Database
    search : str
        ``"several"``: the mean of several paths; or one path: ``"optimal"``, ``"greedy"``,
        ``"pq"``.

    Raises
    ------
    InputError
        If there is no such search.
    """

    def __init__(self, database: Database, search: str = SEVERAL) -> None:
        if search not in (SEVERAL, *SEARCHES):
            raise InputError(f"no search {search!r}", expected=", ".join((SEVERAL, *SEARCHES)))
        self.database = database
        self.search = search
        self._graph = graph_of(database)
        self._opening = opening_in(database)
        self._learnt = learnt_of(database)
        plain = isinstance(self._graph, UnitGraph)
        self._pairs = self._graph.pairs if plain else PairTable(database)
        self._reduction = load_reduction(database.phone_set)
        names = [self._class_of(label) for label in database.labels]
        self._classes = np.array([names.index(name) for name in names], np.int64)

    def animate(self, speech: Speech, rate: float = 60.0) -> Animation:
        """Return the animation of a line.

        Parameters
        ----------
        speech : Speech
            Its phones choose the motion; its sound, if there is one, chooses among what
            fits and says how the motion is warped.
        rate : float
            Frames per second.

        Returns
        -------
        Animation
            Of the database's channels. Frames lie on whole multiples of ``1 / rate`` on the
            sound's clock. The report names the units, jumps and stand-ins.

        Raises
        ------
        LabelError
            If phones are unknown.
        InputError
            If the rate is out of range, or nothing is said.
        """
        if not 1 <= rate <= FASTEST:
            raise InputError(f"{rate:g} frames per second", expected=f"1 to {FASTEST:g}")
        rows = self.rows(speech)
        if not rows:
            raise InputError("no phones", expected="a line in which something is said")
        labels = [row[0] for row in rows]
        spans = np.array([row[1:] for row in rows], np.float64)
        first = math.floor(spans[0, 0] * rate + 1e-6)
        # Joining looks at the middles of frames: the first of them is to be at `first`.
        spans[0, 0] = (first - 0.5) / rate
        heard = self._heard(speech)
        # Nobody vouches for phones of a confidence of 0: they were heard without words.
        unsure = speech.confidence == 0.0
        units, report = self._units(labels, spans, heard, unsure=unsure)
        joined = join(
            self.database,
            units,
            spans,
            rate,
            learnt=self._learnt,
            features=heard,
            opening=self._opening,
            phones=labels,
            pairs=self._pairs,
            unsure=unsure,
        )
        return Animation(
            self.database.channels,
            np.clip(joined.motion + self.database.rest, 0.0, 1.0),
            rate,
            first / rate,
            {},
            speech.phones,
            speech.words,
            "motion",
            {**report, **self._told(joined)},
        )

    def rows(self, speech: Speech) -> list[Row]:
        """Return the phones of a line in the database's notation, without gaps.

        Raises
        ------
        LabelError
            If phones are unknown.
        """
        track = speech.phones.normalised()
        reduction = load_reduction(track.phone_set, self.database.phone_set)
        found, _ = reduction.rows(track)
        if not found:
            return []
        end = max(speech.duration, found[-1][2])
        before = min(0.0, found[0][1])
        rows: list[Row] = []
        for label, start, stop in [*found, (SILENCE, end, end)]:
            if start - before > _SHORTEST_GAP:
                rows.append((SILENCE, before, start))
            if stop - start > _SHORTEST_GAP:
                rows.append((label, max(start, before), stop))
            before = max(before, stop)
        return rows

    def _heard(self, speech: Speech) -> Features | None:
        if speech.sound is None or not self.database.take_has_sound.any():
            return None
        return rasta_plp(speech.sound, self.database.rate)

    def _units(
        self,
        labels: Sequence[str],
        spans: NDArray[np.float64],
        heard: Features | None,
        *,
        unsure: bool,
    ) -> tuple[NDArray[np.int64], dict[str, Any]]:
        """Return the paths of units, and what is to be said of them."""
        sound = None
        if heard is not None:
            sound = wanted_sound(self.database, heard.values, heard.rate, heard.start, spans)
        if self.search != SEVERAL:
            costs = Costs(self._graph, sound)
            path = find(SEARCHES[self.search](), self._graph, labels, costs, self._class_of)
            told = {"complete": path.complete, "jumps": path.jumps}
            missing = path.stand_ins
            units = path.units
        else:
            wanted, missing = label_indices(self.database, labels, self._class_of)
            lengths = spans[:, 1] - spans[:, 0]
            units = several(self.database, wanted, lengths, self._classes, sound, unsure=unsure)
            told = {"paths": len(units)}
        return units, {
            "database": str(self.database.folder),
            "search": self.search,
            **told,
            "nearest_phones": {one.wanted: one.used for one in missing},
        }

    def _class_of(self, label: str) -> str:
        pieces, _ = self._reduction.of(label)
        return pieces[0].label

    def _told(self, joined: Joined) -> dict[str, Any]:
        """Where the motion comes from: stretches of takes, and how many phones were closed."""
        data = self.database
        starts = np.flatnonzero(np.diff(joined.unit, prepend=-1))
        stretches: list[list[Any]] = []
        last = -2
        for frame in starts.tolist():
            unit = int(joined.unit[frame])
            take = data.take_name(int(data.take[unit]))
            if unit != last + 1 or stretches[-1][0] != take:
                stretches.append([take, round(joined.start + frame / joined.rate, 3), []])
            stretches[-1][2].append(data.labels[data.label[unit]])
            last = unit
        return {
            "stretches": [[take, time, " ".join(said)] for take, time, said in stretches],
            "closed": joined.pulled,
        }
