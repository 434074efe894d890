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
from lipwright.engines.motion.learnt import learnt_of
from lipwright.engines.motion.rasta_plp import Features, rasta_plp
from lipwright.engines.motion.search import PATHS as MANY
from lipwright.engines.motion.search import (
    Costs,
    Search,
    find_several,
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
from lipwright.phones.reduction import Reduction, Row
from lipwright.phones.through import through_classes
from lipwright.speech import Speech

FASTEST = 10_000.0
SEVERAL, CHEAPEST = "several", "cheapest"
PATHS = {SEVERAL: MANY, CHEAPEST: 1}
"""Searches by cost alone, ours, and how many paths each finds."""
SEARCHES: dict[str, Callable[[], Search]] = {
    "optimal": lambda: optimal,
    "greedy": lambda: greedy,
    "pq": lambda: pq(4, seconds=10.0),
}
"""The publication's searches; ``pq`` takes the best it has after ten seconds."""
ALIKE = {"optimal": 6}
"""How many paths of equal merit a search gives, where it is not one."""
_SHORTEST_GAP = 1e-6


class MotionEngine:
    """Animates speech with the motion of recorded takes.

    Parameters
    ----------
    database : Database
    search : str
        ``"several"``: the mean of several paths; ``"optimal"``: that of those with the fewest
        jumps; or one path: ``"cheapest"``, ``"greedy"``, ``"pq"``.
    name : str
        What reports call the database; its folder where it is not given.

    Raises
    ------
    InputError
        If there is no such search.
    """

    def __init__(self, database: Database, search: str = SEVERAL, name: str = "") -> None:
        if search not in (*PATHS, *SEARCHES):
            raise InputError(f"no search {search!r}", expected=", ".join((*PATHS, *SEARCHES)))
        self.database = database
        self.search = search
        self.name = name or str(database.folder)
        self._graph = graph_of(database)
        self._known = learnt_of(database)
        plain = isinstance(self._graph, UnitGraph)
        self._pairs = self._graph.pairs if plain else PairTable(database)
        self._reduction = load_reduction(database.phone_set)
        self._spellings: dict[str, Reduction] = {}
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
            Of the database's channels: weights 0..1, or markers' places in metres on a
            still head. Frames lie on whole multiples of ``1 / rate`` on the
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
        rows, nearest = self.rows(speech)
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
            learnt=self._known.learnt,
            features=heard,
            opening=self._known.opening,
            phones=labels,
            pairs=self._pairs,
            unsure=unsure,
        )
        return Animation(
            self.database.channels,
            self._whole(joined.motion),
            rate,
            first / rate,
            {},
            speech.phones,
            speech.words,
            "motion",
            {
                **report,
                "nearest_phones": {**nearest, **report["nearest_phones"]},
                **self._told(joined),
            },
        )

    def rows(self, speech: Speech) -> tuple[list[Row], dict[str, str]]:
        """Return the phones of a line in the database's notation, without gaps.

        Also what stands in for sounds that the notation lacks: a sound of their class.

        Raises
        ------
        LabelError
            If phones are unknown.
        """
        found, report = self._spelling(speech.phones.phone_set).rows(speech.phones)
        if not found:
            return [], {}
        end = max(speech.duration, found[-1][2])
        before = min(0.0, found[0][1])
        rows: list[Row] = []
        for label, start, stop in [*found, (SILENCE, end, end)]:
            if start - before > _SHORTEST_GAP:
                rows.append((SILENCE, before, start))
            if stop - start > _SHORTEST_GAP:
                rows.append((label, max(start, before), stop))
            before = max(before, stop)
        return rows, report.stand_ins

    def _spelling(self, phone_set: str) -> Reduction:
        """Return what phones of a notation are in the database's; kept for the next line."""
        if phone_set not in self._spellings:
            counts = np.diff(self.database.label_first)
            frequent = [self.database.labels[one] for one in np.argsort(-counts, kind="stable")]
            self._spellings[phone_set] = through_classes(
                phone_set, self.database.phone_set, frequent
            )
        return self._spellings[phone_set]

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
        if self.search in SEARCHES:
            costs = Costs(self._graph, sound)
            paths = find_several(
                SEARCHES[self.search](),
                self._graph,
                labels,
                costs,
                self._class_of,
                ALIKE.get(self.search, 1),
            )
            told = {"complete": paths[0].complete, "jumps": paths[0].jumps, "paths": len(paths)}
            missing = paths[0].stand_ins
            units = np.stack([path.units for path in paths])
        else:
            wanted, missing = label_indices(self.database, labels, self._class_of)
            lengths = spans[:, 1] - spans[:, 0]
            count = PATHS[self.search]
            units = several(
                self.database, wanted, lengths, self._classes, sound, count, unsure=unsure
            )
            told = {"paths": len(units)}
        return units, {
            "database": self.name,
            **({"about_database": self.database.about} if self.database.about else {}),
            "search": self.search,
            **told,
            "nearest_phones": {one.wanted: one.used for one in missing},
        }

    def _whole(self, motion: NDArray[np.float32]) -> NDArray[np.float32]:
        """Put the face at rest under a motion; markers have places, shapes a range."""
        face = motion + self.database.rest
        return face if self.database.markers else np.clip(face, 0.0, 1.0)

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
