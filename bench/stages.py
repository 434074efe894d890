"""The bigram engine: each stage, and the whole, at 22, 38, 500 and 5,000 phones.

DESIGN section 4 asks for 6 ms or less for 500 phones, nine poses, all stages with what
``why`` needs, and 60 samples per second, on one core, and for growth that is linear.
"""

import tracemalloc

import numpy as np

from bench.measure import milliseconds, say
from lipwright.engines.bigram import BigramEngine, load_set, read_set
from lipwright.engines.bigram import stages as stage
from lipwright.engines.bigram.polyline import Axis
from lipwright.engines.bigram.preparation import prepare
from lipwright.engines.bigram.set_file import DATA
from lipwright.phones import PhoneTrack, load_phone_set, load_reduction
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier

SIZES = (22, 38, 500, 5000)


def line(count: int) -> PhoneTrack:
    """Return random phones of natural lengths."""
    rng = np.random.default_rng(count)
    labels = load_phone_set("arpabet").labels
    time = 0.0
    phones = []
    for _ in range(count):
        length = float(rng.uniform(0.04, 0.14))
        phones.append(Interval(str(rng.choice(labels)), time, time + length))
        time += length
    return PhoneTrack(Tier(tuple(phones)))


def measure_whole(engine: BigramEngine, count: int) -> None:
    """All stages and 60 samples per second."""
    speech = Speech(line(count))
    runs = 40 if count <= 500 else 10
    figures = milliseconds(lambda: engine.animate(speech), runs)
    per_phone = round(1e3 * figures["median_ms"] / count, 2)
    tracemalloc.start()
    engine.animate(speech)
    peak = round(tracemalloc.get_traced_memory()[1] / 1e6, 2)
    tracemalloc.stop()
    say(f"engine, {count} phones", **figures, per_phone_us=per_phone, peak_mb=peak)


def measure_stages(engine: BigramEngine, count: int) -> None:
    """Each stage alone."""
    track, rules, plan = line(count), engine.rules, engine.plan
    reduction = load_reduction(track.phone_set)
    rows = reduction.rows(track)[0]
    spans = prepare(rows, 0.2, 0.2)
    placed = engine.table.place(spans, "boundary")
    margin = plan.margin()
    width = float(spans.last[-1] - spans.first[0]) + 2 * margin
    axis = Axis(float(spans.first[0]) - margin, width, len(plan.poses))
    stitched = stage.stitch(placed, axis)
    smoothed = stage.smooth(stitched, axis, plan, rules)
    solved = engine.solve(track)
    frames = int(60 * track.tier.end)
    work = {
        "reduced": lambda: reduction.rows(track),
        "prepared": lambda: prepare(rows, 0.2, 0.2),
        "placed": lambda: engine.table.place(spans, "boundary"),
        "stitched": lambda: stage.stitch(placed, axis),
        "smoothed": lambda: stage.smooth(stitched, axis, plan, rules),
        "constrained and limited": lambda: stage.bound(smoothed, axis, plan, rules),
        "softened and sampled": lambda: engine.sample(solved, 0.0, frames, 60.0),
    }
    for name, one in work.items():
        say(f"stage, {count} phones: {name}", **milliseconds(one, 40 if count <= 500 else 10))


if __name__ == "__main__":
    made = BigramEngine(load_set("english"))
    for size in SIZES:
        measure_whole(made, size)
    for size in (500, 5000):
        measure_stages(made, size)
    path = DATA / "english.json"
    say("read the English set", **milliseconds(lambda: read_set(path), runs=10))
