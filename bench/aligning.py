"""Alignment: speed and memory on synthesised speech; whether all recordings come through.

The recordings lie beside the project, in ``../shared/data``; without them only speed and
memory are measured. How exact the times are is measured in :mod:`bench.robustness`.
"""

import csv
import time
from collections.abc import Iterator
from pathlib import Path

from bench.measure import milliseconds, peak_mb, say
from bench.recordings import DATA
from lipwright import pipeline
from lipwright.errors import LipwrightError

LINE = "She had your dark suit in greasy wash water all year."
LONG = """
import numpy as np
from lipwright import pipeline
from lipwright.sound import Sound
line = {line!r}
one = pipeline.say(line).sound
count = int({minutes} * 60 / one.duration)
sound = Sound(np.tile(one.samples, count), one.rate)
speech = pipeline.align(sound, ' '.join([line] * count))
assert len(speech.words) == 11 * count
"""


def sentences(name: str) -> Iterator[tuple[Path, str]]:
    """Give each recording of a folder with its words."""
    if name == "timit":
        for path in sorted((DATA / name).glob("*/*.flac")):
            yield path, path.with_suffix(".txt").read_text().split(maxsplit=2)[2]
        return
    with (DATA / name / "text.csv").open(newline="") as table:
        for row in csv.DictReader(table):
            yield DATA / name / "audio" / f"{row['sentence']}.flac", row["text"]


def come_through(name: str) -> None:
    """Whether every recording of a folder comes through, damaged ones included."""
    count, failed, doubtful = 0, 0, 0
    for path, text in sentences(name):
        count += 1
        try:
            speech = pipeline.align(path, text)
            pipeline.animate(speech)
        except LipwrightError:
            failed += 1
            continue
        doubtful += speech.confidence is not None and speech.confidence < 0.5
    say(f"align and animate {name}", recordings=count, failed=failed, doubtful=doubtful)


if __name__ == "__main__":
    speech = pipeline.say(LINE)
    assert speech.sound is not None
    sound = speech.sound
    before = time.perf_counter()
    pipeline.align(sound, LINE)
    first = round(1e3 * (time.perf_counter() - before), 1)
    figures = milliseconds(lambda: pipeline.align(sound, LINE), runs=7, warm=0)
    share = round(figures["median_ms"] / 1e3 / sound.duration, 4)
    say("align a sentence", **figures, first_ms=first, per_second_of_sound=share)
    for minutes in (3, 30):
        before = time.perf_counter()
        peak = peak_mb(LONG.format(line=LINE, minutes=minutes))
        seconds = round(time.perf_counter() - before, 1)
        say(f"align {minutes} minutes", seconds=seconds, peak_mb=peak)
    for folder in ("timit", "grid"):
        if (DATA / folder).is_dir():
            come_through(folder)
