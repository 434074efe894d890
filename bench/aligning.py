"""Alignment: speed and memory on synthesised speech, quality on labelled recordings.

The recordings lie beside the project, in ``../shared/data``; without them only speed and
memory are measured.
"""

import csv
import time

import numpy as np

from bench.measure import milliseconds, peak_mb, say
from bench.recordings import DATA, is_damaged, matched, starts
from lipwright import pipeline
from lipwright.errors import LipwrightError
from lipwright.sound_files import read_sound

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


def measure_timit() -> None:
    """Starts of phones beside a hand's, on the labelled sentences.

    In some of the files bytes were lost, and what follows is noise: they must come through,
    but there is nothing in them to compare.
    """
    pairs: list[float] = []
    phones, recordings, failed, seconds, sound_seconds = 0, 0, 0, 0.0, 0.0
    for path in sorted((DATA / "timit").glob("*/*.flac")):
        text = path.with_suffix(".txt").read_text().split(maxsplit=2)[2]
        hand = starts(pipeline.from_labels(path.with_suffix(".phn")).phones)
        sound = read_sound(path)
        before = time.process_time()
        try:
            ours = pipeline.align(sound, text)
        except LipwrightError:
            failed += 1
            continue
        seconds += time.process_time() - before
        sound_seconds += sound.duration
        if not is_damaged(sound.samples):
            recordings += 1
            pairs += matched(starts(ours.phones), hand)
            phones += len(hand)
    off = np.abs(pairs)
    say(
        "align TIMIT: phone starts beside a hand's",
        recordings=recordings,
        failed_of_60=failed,
        within_20_ms=round(float(np.mean(off <= 0.020)), 3),
        within_50_ms=round(float(np.mean(off <= 0.050)), 3),
        median_ms=round(1e3 * float(np.median(off)), 1),
        matched=round(len(off) / phones, 3),
        cpu_per_second_of_sound=round(seconds / sound_seconds, 3),
    )


def measure_grid() -> None:
    """Whether every sentence of the GRID speaker comes through, and how sure we are."""
    with (DATA / "grid" / "text.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    failed, doubtful = 0, 0
    for row in rows:
        try:
            speech = pipeline.align(
                DATA / "grid" / "audio" / f"{row['sentence']}.flac", row["text"]
            )
            pipeline.animate(speech)
        except LipwrightError:
            failed += 1
            continue
        doubtful += speech.confidence is not None and speech.confidence < 0.5
    say("align and animate GRID", sentences=len(rows), failed=failed, doubtful=doubtful)


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
    if (DATA / "timit").is_dir():
        measure_timit()
        measure_grid()
