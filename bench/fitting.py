"""Sets fitted to a real face: what they are worth on sentences, and on words, left out.

The recordings are the 560 sentences of one GRID speaker beside the project; without them
nothing is measured. What is learnt are the shapes in ``motion``, never the lengths in
``measured``, which only judge. Sentences: 60 are left out of one fit. Words: the 51 words
are left out in groups of one place in the sentence, a fit for each group on the sentences
without any of them, and every sentence is put together from sets that never saw the word at
hand. ``quick`` leaves the second out. Nothing that is fitted here is kept.
"""

import csv
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from bench.measure import say
from bench.quality import GRID
from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.engines.bigram import BigramEngine
from lipwright.engines.motion.capture import read_motion
from lipwright.evaluate import MotionReport, Recording, read_recording
from lipwright.recorded import Recorded, fit_set
from lipwright.speech import Speech

EVERY, LEFT_OUT = 9, 60
GROUPS = (4, 4, 4, 5, 5, 4)
"""How many groups the words of each place in the sentence make: 4 or 5 of each place's."""


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """A sentence of the recordings."""

    words: tuple[str, ...]
    speech: Speech
    take: Recorded
    face: Recording


def lines() -> list[Line]:
    """Read all sentences, and align them."""
    with (GRID / "text.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    found = []
    for row in rows:
        name = row["sentence"]
        speech = pipeline.align(GRID / "audio" / f"{name}.flac", row["text"])
        speech = replace(speech, sound=None)
        motion = read_motion(GRID / "motion" / f"{name}.csv")
        take = Recorded(
            name, motion.channels, motion.values, motion.rate, motion.start, speech.phones
        )
        face = read_recording(GRID / "measured" / f"{name}.csv")
        found.append(Line(tuple(row["text"].split()), speech, take, face))
    return found


def judged(found: MotionReport) -> dict[str, float]:
    """The figures that are printed."""
    return {
        "opening": round(found.opening.correlation, 4),
        "rounding": round(found.rounding.correlation, 4),
        "lag_ms": found.lag_ms,
        "turns": round(found.turns.animation, 2),
        "turns_recorded": round(found.turns.recording, 2),
    }


def sentences(every: Sequence[Line]) -> None:
    """Fit without 60 sentences, and hold the set against them."""
    out = every[::EVERY][:LEFT_OUT]
    kept = [line for line in every if line not in out]
    began = time.perf_counter()
    made, report = fit_set([line.take for line in kept])
    seconds = time.perf_counter() - began
    engine = BigramEngine(made)
    figures = pipeline.evaluate_motion([(engine.animate(line.speech), line.face) for line in out])
    say(
        "set fitted to a GRID speaker, sentences left out",
        fitted_on=len(kept),
        recordings=figures.pairs,
        **judged(figures),
        pairs_measured=report.measured,
        fit_seconds=round(seconds, 1),
    )


def words(every: Sequence[Line]) -> None:
    """Fit without each group of words, and put sentences together from such sets."""
    parts: dict[tuple[int, int], Animation] = {}
    counts = []
    for place, count in enumerate(GROUPS):
        known = sorted({line.words[place] for line in every})
        for group in range(count):
            out = set(known[group::count])
            kept = [line.take for line in every if not out.intersection(line.words)]
            counts.append(len(kept))
            engine = BigramEngine(fit_set(kept)[0])
            for number, line in enumerate(every):
                if line.words[place] in out:
                    parts[number, place] = engine.animate(line.speech)
    whole = [
        (put_together(line, [parts[number, place] for place in range(len(GROUPS))]), line.face)
        for number, line in enumerate(every)
    ]
    figures = pipeline.evaluate_motion(whole)
    say(
        "set fitted to a GRID speaker, words left out",
        fits=len(counts),
        fitted_on=[min(counts), max(counts)],
        recordings=figures.pairs,
        **judged(figures),
    )


def put_together(line: Line, parts: Sequence[Animation]) -> Animation:
    """Each word from the set that never saw it; silence from that of the nearest word."""
    first = parts[0]
    spoken = [word for word in line.speech.words if word.label != "sil"]
    away = [
        np.maximum(np.maximum(word.start - first.times, first.times - word.end), 0.0)
        for word in spoken
    ]
    nearest = np.argmin(away, axis=0)
    values = np.zeros_like(first.values)
    for place, part in enumerate(parts):
        mine = nearest == place
        for column in range(len(first.controls)):
            own = np.interp(first.times, part.times, part.values[:, column])
            values[mine, column] = own[mine]
    return replace(first, values=values, keys={})


if __name__ == "__main__":
    if GRID.is_dir():
        recorded = lines()
        sentences(recorded)
        if "quick" not in sys.argv[1:]:
            words(recorded)
