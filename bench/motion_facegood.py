"""The motion engine on Mandarin takes without words: phones by ear, curves of animators.

Each take beside the project is cut in the middle of pauses into stretches of some seconds.
Left out are: every sixth stretch of the four takes of syllables and words; each stretch of
the running speech in turn; all running speech. What is left out is heard and animated, and
held against the animators' own curves, both on the built-in head. Loudness alone stands
beside. Without recordings nothing is measured.
"""

import shutil
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import soundfile

from bench.mandarin import FOLDER, STEP, bursts, loudness
from bench.measure import say
from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.character.head import measure as measure_mouth
from lipwright.engines.motion.building import build as build_of
from lipwright.engines.motion.building import takes_of
from lipwright.engines.motion.capture import read_motion
from lipwright.engines.motion.database import Database, open_database
from lipwright.engines.motion.engine import MotionEngine
from lipwright.engines.motion.learnt import keep_learnt
from lipwright.evaluate import Curve, MotionReport, Recording
from lipwright.evaluate.motion import correlation
from lipwright.measuring import head_mouth
from lipwright.motion_takes import build_motion
from lipwright.sound_files import read_sound
from lipwright.speech import Speech

LONG, EVERY = 5.0, 6
RUNNING = "1114_3_15"
LAGS = np.arange(-30, 31) * 0.01
SEARCHES = "several", "optimal", "greedy"
Make = Callable[[Speech], Animation]


@dataclass(frozen=True)
class Line:
    """A stretch: what is heard in it, and what the animators made for it."""

    name: str
    speech: Speech
    face: Recording
    jaw: Curve


def cut(folder: Path) -> list[str]:
    """Write the takes, cut in pauses, to a folder; return the names of the stretches."""
    names = []
    for path in sorted(FOLDER.glob("*.csv")):
        sound = read_sound(path.with_suffix(".flac"))
        header, *rows = path.read_text().splitlines()
        spoken = bursts(sound)
        edges = [0]
        for (_, end), (start, _) in pairwise(spoken):
            frame = round(15 * (end + start))
            if start - end > 0.2 and frame - edges[-1] > 30 * LONG:
                edges.append(frame)
        edges.append(min(len(rows), int(30 * sound.duration)))
        for number, (first, last) in enumerate(pairwise(edges)):
            names.append(f"{path.stem}_{number:02d}")
            cells = [row.partition(",")[2] for row in rows[first:last]]
            lines = [f"{k / 30:.4f},{row}" for k, row in enumerate(cells)]
            (folder / f"{names[-1]}.csv").write_text("\n".join([header, *lines]) + "\n")
            samples = sound.samples[first * sound.rate // 30 : last * sound.rate // 30]
            soundfile.write(folder / f"{names[-1]}.wav", samples, sound.rate)
    return names


def read(folder: Path, name: str) -> Line:
    """Hear a stretch and measure the animators' mouth on the built-in head."""
    motion = read_motion(folder / f"{name}.csv")
    skin, marks = head_mouth()
    weights = dict(zip(motion.channels, motion.values.T.astype(np.float64), strict=True))
    mouth = measure_mouth([skin], marks, weights)
    face = Recording(
        Curve(motion.times, mouth.opening),
        Curve(motion.times, mouth.breadth),
        Curve(motion.times, np.maximum(weights["mouthPucker"], weights["mouthFunnel"])),
    )
    speech = pipeline.hear(folder / f"{name}.wav")
    return Line(name, speech, face, Curve(motion.times, weights["jawOpen"]))


def later(opening: Sequence[Curve], faces: Sequence[Curve]) -> tuple[int, float]:
    """How many ms later the faces move, of 300 either way, and the correlation there."""
    means = [
        np.mean(
            [
                correlation(one.later(lag).at(face.times), face.values)
                for one, face in zip(opening, faces, strict=True)
            ]
        )
        for lag in LAGS
    ]
    best = int(np.argmax(means))
    return round(1000 * LAGS[best]), round(float(means[best]), 4)


def told(found: MotionReport) -> dict[str, Any]:
    """The figures of a comparison."""
    closed = found.closures["p b m"]
    return {
        "opening": round(found.opening.correlation, 4),
        "rounding": round(found.rounding.correlation, 4),
        "pucker": found.pucker and round(found.pucker.correlation, 4),
        "opening_rms": round(found.opening.rms, 4),
        "closed": None if closed.met is None else round(closed.met, 3),
        "turns": [round(found.turns.animation, 2), round(found.turns.recording, 2)],
        "lag_ms": found.lag_ms,
    }


def figures(make: Sequence[Make], lines: Sequence[Line]) -> dict[str, Any]:
    """How like the animators' curves ours are."""
    before = time.perf_counter()
    made = [way(line.speech) for way, line in zip(make, lines, strict=True)]
    seconds = time.perf_counter() - before
    found = pipeline.evaluate_motion([(a, b.face) for a, b in zip(made, lines, strict=True)])
    name = "jawOpen" if "jawOpen" in made[0].controls else "open"
    jaws = [Curve(one.times, one.control(name).astype(np.float64)) for one in made]
    lag, best = later(jaws, [line.jaw for line in lines])
    return {
        **told(found),
        "jaw": best,
        "jaw_later_ms": lag,
        "jumps": int(np.sum([one.report.get("jumps", 0) for one in made])),
        "phones": sum(len(line.speech.phones) for line in lines),
        "ms_per_line": round(1e3 * seconds / len(lines), 1),
    }


def by_loudness(lines: Sequence[Line]) -> dict[str, Any]:
    """The same correlation of smoothed loudness."""
    heard = []
    for line in lines:
        assert line.speech.sound is not None
        level = loudness(line.speech.sound)
        level = np.convolve(np.maximum(level, level.max() - 40), np.ones(9) / 9, "same")
        heard.append(Curve(STEP * np.arange(len(level), dtype=np.float64), level))
    lag, best = later(heard, [line.face.opening for line in lines])
    jaw_lag, jaw = later(heard, [line.jaw for line in lines])
    return {"opening": best, "later_ms": lag, "jaw": jaw, "jaw_later_ms": jaw_lag}


def build(takes: Path, out: Sequence[str], place: Path, what: str) -> Database:
    """Build a database by ear from all stretches but some."""
    folder = place / f"takes of {what}"
    folder.mkdir()
    for path in takes.iterdir():
        if path.stem not in out:
            shutil.copy(path, folder)
    before = time.perf_counter()
    built = build_motion(folder, place / what, by_ear=True)
    seconds = time.perf_counter() - before
    before = time.perf_counter()
    database = open_database(place / what)
    opened = time.perf_counter() - before
    length = len(database.frames) / database.rate
    say(
        f"facegood database: {what}",
        takes=built.takes,
        minutes=round(length / 60, 1),
        units=len(database.label),
        seconds=round(seconds, 1),
        share_of_length=round(seconds / length, 4),
        open_ms=round(1e3 * opened, 1),
        components=len(database.basis),
    )
    return database


def without(database: Database, name: str, place: Path) -> Database:
    """The database without one of its takes."""
    kept = [take for take in takes_of(database) if take.name != name]
    made = build_of(place / f"without {name}", kept, database.settings)
    keep_learnt(made)
    return made


def compare(what: str, databases: Sequence[Database], lines: Sequence[Line]) -> None:
    """Print each engine's figures on some lines, each with a database of its own."""
    say(f"facegood, {what}: loudness", lines=len(lines), **by_loudness(lines))
    for search in SEARCHES:
        make = [MotionEngine(database, search).animate for database in databases]
        say(f"facegood, {what}: motion, {search}", **figures(make, lines))
    say(f"facegood, {what}: bigram", **figures([drawn] * len(lines), lines))


def drawn(speech: Speech) -> Animation:
    """What the bigram engine makes of what is heard."""
    return pipeline.animate(speech).animation


def main(place: Path) -> None:
    """Leave out stretches, then the running speech, and print."""
    takes = place / "takes"
    takes.mkdir()
    names = cut(takes)
    running = [name for name in names if RUNNING in name]
    out = [name for name in names if name not in running][3::EVERY]
    database = build(takes, out, place, "every sixth stretch left out")
    compare("syllables and words", [database] * len(out), [read(takes, name) for name in out])
    lines = [read(takes, name) for name in running]
    compare("running speech", [without(database, name, place) for name in running], lines)
    database = build(takes, running, place, "running speech left out")
    compare("running speech, none known", [database] * len(lines), lines)


if __name__ == "__main__":
    if FOLDER.is_dir():
        with tempfile.TemporaryDirectory() as folder:
            main(Path(folder))
