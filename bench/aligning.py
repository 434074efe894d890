"""Alignment: speed and memory on synthesised speech, quality on labelled recordings.

The recordings lie beside the project, in ``../shared/data``; without them only speed and
memory are measured.
"""

import csv
import time
from pathlib import Path

import numpy as np

from bench.measure import milliseconds, peak_mb, say
from lipwright import pipeline
from lipwright.errors import LipwrightError
from lipwright.phones import PhoneTrack
from lipwright.sound_files import read_sound

DATA = Path(__file__).parents[1] / ".." / "shared" / "data"
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


def starts(track: PhoneTrack) -> list[tuple[str, float]]:
    """Labels and starts of the phones that are not silence."""
    return [(phone.label, phone.start) for phone in track if phone.label != "sil"]


def matched(one: list[tuple[str, float]], other: list[tuple[str, float]]) -> list[float]:
    """Differences in start of phones that edit distance pairs with their like, seconds."""
    rows, columns = len(one), len(other)
    cost = np.zeros((rows + 1, columns + 1))
    cost[:, 0], cost[0, :] = np.arange(rows + 1), np.arange(columns + 1)
    for i in range(rows):
        for j in range(columns):
            change = cost[i, j] + (one[i][0] != other[j][0])
            cost[i + 1, j + 1] = min(change, cost[i, j + 1] + 1, cost[i + 1, j] + 1)
    pairs = []
    i, j = rows, columns
    while i and j:
        same = one[i - 1][0] == other[j - 1][0]
        if cost[i, j] == cost[i - 1, j - 1] + (not same):
            i, j = i - 1, j - 1
            if same:
                pairs.append(one[i][1] - other[j][1])
        elif cost[i, j] == cost[i - 1, j] + 1:
            i -= 1
        else:
            j -= 1
    return pairs


def measure_timit() -> None:
    """Starts of phones beside a hand's, on the labelled sentences.

    Some of the files hold damaged sound; the second line is of those that the aligner is
    sure of.
    """
    results: list[tuple[float, list[float], int]] = []
    failed, seconds, sound_seconds = 0, 0.0, 0.0
    for path in sorted((DATA / "timit").glob("*/*.flac")):
        text = path.with_suffix(".txt").read_text().split(maxsplit=2)[2]
        hand = pipeline.from_labels(path.with_suffix(".phn")).phones
        sound = read_sound(path)
        before = time.process_time()
        try:
            ours = pipeline.align(sound, text)
        except LipwrightError:
            failed += 1
            continue
        seconds += time.process_time() - before
        sound_seconds += sound.duration
        pairs = matched(starts(ours.phones), starts(hand))
        results.append((ours.confidence or 0.0, pairs, len(starts(hand))))
    share = round(seconds / sound_seconds, 3)
    say("align TIMIT: cost", failed=failed, cpu_per_second_of_sound=share)
    for least in (0.0, 0.5):
        chosen = [result for result in results if result[0] >= least]
        off = np.abs(np.concatenate([pairs for _, pairs, _ in chosen]))
        say(
            f"align TIMIT: phone starts beside a hand's, confidence {least} and above",
            recordings=len(chosen),
            within_20_ms=round(float(np.mean(off <= 0.020)), 3),
            within_50_ms=round(float(np.mean(off <= 0.050)), 3),
            median_ms=round(1e3 * float(np.median(off)), 1),
            matched=round(len(off) / sum(count for _, _, count in chosen), 3),
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
