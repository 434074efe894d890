"""The motion engine beside a real face: sentences left out, and words left out.

A database is built from the GRID recordings beside the project, 60 sentences left out, and
learns only the tracked shapes; its animations are held against the measured lengths. For
words, each group of them is left out in turn: no take with one of them is in the database,
and only frames are compared in which one of them is spoken. Without recordings nothing is
measured.
"""

import csv
import shutil
import tempfile
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from bench.measure import say
from bench.quality import GRID, only
from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.engines.motion.building import build, takes_of
from lipwright.engines.motion.database import Database, open_database
from lipwright.engines.motion.engine import MotionEngine
from lipwright.engines.motion.learnt import keep_learnt
from lipwright.evaluate import Recording, read_recording
from lipwright.motion_takes import build_motion
from lipwright.speech import Speech

EVERY, MOST = 9, 60
SHARED = ("bin", "blue", "a"), ("lay", "green", "b"), ("place", "red", "f"), ("set", "white", "m")
"""Groups of words that are left out together: a command, a colour, a letter."""
SEARCHES = "several", "cheapest", "optimal", "greedy", "pq"
Line = tuple[Speech, Recording]
Make = Callable[[Speech], Animation]


def lines(names: Sequence[str], texts: dict[str, str]) -> list[Line]:
    """Sentences in time, with what was measured of the face."""
    found = []
    for name in names:
        speech = pipeline.align(GRID / "audio" / f"{name}.flac", texts[name])
        shapes = GRID / "motion" / f"{name}.csv"
        found.append((speech, read_recording(GRID / "measured" / f"{name}.csv", shapes)))
    return found


def figures(make: Make, some: Sequence[Line], words: frozenset[str]) -> dict[str, Any]:
    """How like the face some animations are, in all frames or in those of some words."""
    before = time.perf_counter()
    made = [make(speech) for speech, _ in some]
    seconds = (time.perf_counter() - before) / len(some)
    faces = [
        only(face, one, words) if words else face for one, (_, face) in zip(made, some, strict=True)
    ]
    pairs = [pair for pair in zip(made, faces, strict=True) if len(pair[1].opening.times) > 5]
    found = pipeline.evaluate_motion(pairs)
    closed = found.closures["p b m"]
    return {
        "recordings": len(pairs),
        "opening": round(found.opening.correlation, 4),
        "opening_rms": round(found.opening.rms, 4),
        "rounding": round(found.rounding.correlation, 4),
        "closed": None if closed.met is None else round(closed.met, 3),
        "closures_within_40_ms": closed.within_40_ms and round(closed.within_40_ms, 3),
        "own_closures_met": closed.own_met and round(closed.own_met, 3),
        "turns": [round(found.turns.animation, 2), round(found.turns.recording, 2)],
        "lag_ms": found.lag_ms,
        "jumps": round(float(np.mean([one.report.get("jumps", 0) for one in made])), 2),
        "ms_per_line": round(1e3 * seconds, 1),
    }


def animated(speech: Speech, database: Path | None = None) -> Animation:
    """A line by the bigram engine, or by the motion engine, told in poses."""
    if database is None:
        return pipeline.animate(speech).animation
    return pipeline.animate(speech, engine="motion", database=database, controls="poses").animation


def without(database: Database, texts: dict[str, str], words: frozenset[str], to: Path) -> Database:
    """The database without the takes in which one of some words is spoken."""
    kept = [take for take in takes_of(database) if not words & set(texts[take.name].split())]
    made = build(to, kept, database.settings)
    keep_learnt(made)
    return made


def measure(place: Path) -> None:
    """Print the build, the sentences and the words left out."""
    with (GRID / "text.csv").open(newline="") as table:
        texts = {row["sentence"]: row["text"] for row in csv.DictReader(table)}
    names = list(texts)
    left_out = names[4::EVERY][:MOST]
    takes = place / "takes"
    (takes / "motion").mkdir(parents=True)
    (takes / "audio").mkdir()
    for name in set(names) - set(left_out):
        shutil.copy(GRID / "motion" / f"{name}.csv", takes / "motion")
        shutil.copy(GRID / "audio" / f"{name}.flac", takes / "audio")
    shutil.copy(GRID / "text.csv", takes)
    before = time.perf_counter()
    built = build_motion(takes, place / "database")
    seconds = time.perf_counter() - before
    before = time.perf_counter()
    database = open_database(place / "database")
    opened = time.perf_counter() - before
    minutes = len(database.frames) / database.rate / 60
    say(
        "motion database",
        recordings=built.takes,
        minutes=round(minutes, 1),
        seconds=round(seconds, 1),
        share_of_length=round(seconds / minutes / 60, 3),
        open_ms=round(1e3 * opened, 1),
        components=len(database.basis),
    )
    unheard = lines(left_out, texts)
    ways: dict[str, Make] = {one: MotionEngine(database, one).animate for one in SEARCHES}
    ways["several, told in poses"] = partial(animated, database=place / "database")
    ways["the bigram engine"] = animated
    for name, make in ways.items():
        say(f"motion, sentences left out: {name}", **figures(make, unheard, frozenset()))
    for group in SHARED:
        words = frozenset(group)
        own = [name for name in names if words & set(texts[name].split())][::4][:MOST]
        part = without(database, texts, words, place / "-".join(group))
        found = figures(MotionEngine(part).animate, lines(own, texts), words)
        say(f"motion, words left out: {' '.join(group)}", takes=len(part.take_start), **found)


if __name__ == "__main__":
    if GRID.is_dir():
        with tempfile.TemporaryDirectory() as folder:
            measure(Path(folder))
