"""The default English set beside a real face: 560 sentences of one GRID speaker.

The recordings lie beside the project, in ``../shared/data``; without them nothing is
measured. Phone times are our own aligner's. Besides the whole sentences, likeness is taken
on each half of the 51 words, the frames of the other half's words left out; a figure on
words on which nothing was chosen needs a set that was drawn without them.
"""

import csv
import sys
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from bench.measure import say
from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.evaluate import Curve, Recording, read_recording

GRID = Path(__file__).parents[1] / ".." / "shared" / "data" / "grid"
HALF = "by with green white place set four one seven three zero now please d e f h l m o p r v x z"


def rounded(value: Any) -> Any:
    """Figures as people read them."""
    if isinstance(value, dict):
        return {key: rounded(one) for key, one in value.items()}
    return round(value, 4) if isinstance(value, float) else value


def only(recording: Recording, animation: Animation, words: frozenset[str]) -> Recording:
    """The frames of a recording in which none but these words is spoken."""
    times = recording.opening.times
    keep = np.ones(len(times), dtype=bool)
    for word in animation.words:
        if word.label not in words:
            keep &= (times < word.start) | (times >= word.end)
    return Recording(
        Curve(times[keep], recording.opening.values[keep]),
        Curve(times[keep], recording.breadth.values[keep]),
    )


def measure(bigram_set: str) -> dict[str, Any]:
    """All figures of one set."""
    with (GRID / "text.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    vocabulary = frozenset(word for row in rows for word in row["text"].split())
    animate = partial(pipeline.animate, bigram_set=bigram_set)
    pairs = []
    for row in rows:
        name = row["sentence"]
        speech = pipeline.align(GRID / "audio" / f"{name}.flac", row["text"])
        recording = read_recording(
            GRID / "measured" / f"{name}.csv", GRID / "motion" / f"{name}.csv"
        )
        pairs.append((animate(speech).animation, recording))
    found: dict[str, Any] = {"set": bigram_set, **asdict(pipeline.evaluate_motion(pairs))}
    first = frozenset(HALF.split())
    for half, words in (("first_half", first), ("second_half", vocabulary - first)):
        own = pipeline.evaluate_motion([(made, only(face, made, words)) for made, face in pairs])
        found[half] = {
            "words": len(words & vocabulary),
            "opening": own.opening.correlation,
            "rounding": own.rounding.correlation,
        }
    return found


if __name__ == "__main__":
    if GRID.is_dir():
        chosen = sys.argv[1] if len(sys.argv) > 1 else "english"
        say("English set beside a GRID speaker", **rounded(measure(chosen)))
