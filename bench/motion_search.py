"""The motion engine's database and searches: time, memory, jumps and cost.

Two databases. *Open*: 18,000 units of random words of the pronouncing dictionary; what is
searched are words that it lacks, so matches are short, as in the paper's experiments.
*Grid*, where the recordings are there: 497 of their sentences, and 51 words in all; phones
are shared out evenly over the measured words, which is good enough to search. Sound is
made: a mean per phone, with noise. Then 10,000 units of the open database are repeated with
noise, 10 and 100 times (a million units) and, with ``all``, 500 times (5 million). What
``growth`` prints are exponents: time goes with that power of the number of units, or of
phones; with the logarithm it is near 0.

Issue 5 asks: 38 phones on about 18,000 units: greedy 0.3 ms, optimal 5 ms; open in 50 ms at
any size; greedy's time logarithmic in the database; a search process under 300 MB.
"""

import csv
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from bench.measure import milliseconds, say
from bench.recordings import DATA
from lipwright.engines.motion.assembling import label_table
from lipwright.engines.motion.building import build
from lipwright.engines.motion.database import Database, Settings, open_database
from lipwright.engines.motion.graph import Graph, MergedGraph, UnitGraph
from lipwright.engines.motion.info import info
from lipwright.engines.motion.preparing import Prepared, prepare
from lipwright.engines.motion.search import Costs, Search, greedy, optimal, pq, several
from lipwright.engines.motion.storage import write
from lipwright.engines.motion.take import Take
from lipwright.phones import PhoneTrack
from lipwright.schedule.align.lexicon import pronounced
from lipwright.schedule.align.model import model_folder
from lipwright.schedule.align.text import Token
from lipwright.sound import Sound
from lipwright.timeline import Interval, Tier

PAPER = (22, 37, 38)
LONG = (38, 100, 500, 1000, 5000)
GROWN = 260
"""Takes of the database that is repeated: 10,000 units."""
REPEATED = (1, 10, 100)
REPEATED_ALL = 500
CAP = 20.0
"""Seconds for one PQ search; the paper's took up to 650."""
BOTH: dict[str, Search] = {"greedy": greedy, "optimal": optimal}
NOISY = ("unit_sound", "seams", "unusual")
Numbers = NDArray[Any]
Corpus = tuple[list[Prepared], list[Prepared]]


@cache
def mean_of(label: str, width: int) -> Numbers:
    """A phone's mean: the same every time."""
    return np.random.default_rng(list(label.encode())).normal(size=width)


def spoken(labels: Sequence[str], edges: Numbers) -> PhoneTrack:
    return PhoneTrack(Tier(tuple(map(Interval, labels, edges[:-1].tolist(), edges[1:].tolist()))))


def followed(phones: PhoneTrack, frames: int, width: int, noise: float, seed: int) -> Numbers:
    """Numbers per frame that follow the phones' means, with noise: at 25 Hz."""
    rows = np.random.default_rng(seed).normal(scale=noise, size=(frames, width))
    for phone in phones:
        rows[round(25 * phone.start) : round(25 * phone.end)] += mean_of(phone.label, width)
    return rows.astype(np.float32)


def taken(name: str, values: Numbers, phones: PhoneTrack, seed: int) -> Prepared:
    """A take at 25 Hz with made sound."""
    channels = tuple(f"shape{index}" for index in range(values.shape[1]))
    silent = Sound(np.zeros(16, np.float32), 16000)
    take = Take(name, channels, values, 25.0, 0.0, phones, Tier(), silent)
    sound = followed(phones, len(values), 9, 0.6, seed)
    return prepare(take, features=lambda _: sound)


def open_corpus() -> Corpus:
    """Takes of six random words each; the last tenth speaks words that the others do not."""
    rows = (model_folder() / "en-us" / "cmudict-en-us.dict").read_text("utf-8").splitlines()
    words = [row.lower().split()[1:] for row in rows]
    rng = np.random.default_rng(0)
    takes = []
    for number, chosen in enumerate(rng.permutation(len(words))[: 6 * 484].reshape(-1, 6)):
        labels = ["sil", *(label for word in chosen for label in words[word]), "sil"]
        edges = np.cumsum(np.append(0.0, rng.uniform(0.06, 0.2, len(labels))))
        phones = spoken(labels, edges)
        values = followed(phones, int(np.ceil(25 * edges[-1])), 9, 0.2, number)
        takes.append(taken(f"take {number}", values, phones, number))
    return takes[:440], takes[440:]


def grid_corpus() -> Corpus:
    """The sentences of the recordings; each ninth is left out."""
    sentences: dict[str, list[tuple[str, float, float]]] = {}
    with (DATA / "grid" / "words.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            word = row["word"], float(row["start"]), float(row["end"])
            sentences.setdefault(row["sentence"], []).append(word)
    every = sorted({word for said in sentences.values() for word, _, _ in said} - {"sil", "sp"})
    known = pronounced([Token(word, ((word,),)) for word in every])[0]
    ways = {one.label: one.forms[0][0][0] for one in known}
    kept: list[Prepared] = []
    left: list[Prepared] = []
    for number, (name, said) in enumerate(sorted(sentences.items())):
        phones: list[Interval] = []
        for spelled, start, end in said:
            labels = ways.get(spelled, ("sil",))
            edges = np.linspace(start, end, len(labels) + 1)
            phones += spoken(labels, edges)
        table = np.loadtxt(DATA / "grid" / "motion" / f"{name}.csv", delimiter=",", skiprows=1)
        track = PhoneTrack(Tier(tuple(phones)))
        take = taken(name, table[:, 1:].astype(np.float32), track, number)
        (kept if number % 9 else left).append(take)
    return kept, left


def line(left: Sequence[Prepared], held: Database, count: int) -> Numbers:
    """So many phones of takes left out, one after the other, without silence."""
    known = {label: index for index, label in enumerate(held.labels) if label != "sil"}
    said = [known[label] for take in left for label in take.cut.labels if label in known]
    return np.array((said * (1 + count // len(said)))[:count])


def sound_of(held: Database, wanted: Numbers) -> Numbers:
    """A sound for each wanted phone: that of some unit with its label, with noise."""
    rng = np.random.default_rng(3)
    first = held.label_first
    units = [int(held.by_label[rng.integers(first[w], first[w + 1])]) for w in wanted]
    noise = rng.normal(scale=0.5, size=(len(units), held.unit_sound.shape[1]))
    return (held.unit_sound[units] + noise).astype(np.float32)


def measure_search(what: str, search: Search, graph: Graph, wanted: Numbers) -> float:
    """Time, jumps and cost of one search; returns the median, ms."""
    costs = Costs(graph, sound_of(graph.database, wanted))
    start = time.perf_counter()
    path = search(graph, wanted, costs)
    once = time.perf_counter() - start
    runs = max(1, min(100, int(5.0 / max(once, 1e-6))))
    if once < 1:
        timed = milliseconds(lambda: search(graph, wanted, costs), runs)
    else:
        timed = {"median_ms": round(1e3 * once, 1)}
    found = {"jumps": path.jumps, "cost": round(path.cost, 3), "complete": path.complete}
    say(f"search, {what}", **timed, **found)
    return timed["median_ms"]


def measure_several(what: str, held: Database, wanted: Numbers) -> float:
    """Time of the search for several paths, which needs lengths and classes besides."""
    lengths, classes = np.full(len(wanted), 0.1), np.arange(len(held.labels))
    sound = sound_of(held, wanted)
    timed = milliseconds(lambda: several(held, wanted, lengths, classes, sound), 5)
    say(f"search, {what}", **timed)
    return timed["median_ms"]


def exponent(sizes: Sequence[int], times: Sequence[float]) -> float:
    """With which power of the size the time grows."""
    slope = np.polyfit(np.log(sizes), np.log(times), 1)[0]
    return round(float(slope), 3)


def noisy(rows: Numbers, times: int, rng: np.random.Generator) -> Numbers:
    many = rng.standard_normal((times * len(rows), *rows.shape[1:]), np.float32)
    many *= 0.05 * rows.std()
    many.reshape(times, *rows.shape)[...] += rows
    return many


def shifted(rows: Numbers, times: int, by: int) -> Numbers:
    turns = np.arange(times).reshape(-1, *([1] * rows.ndim))
    return (rows[None] + by * turns).reshape(-1, *rows.shape[1:]).astype(rows.dtype)


def repeated(held: Database, times: int, folder: Path) -> None:
    """Write a database so many times over, with noise on motion and sound."""
    rng = np.random.default_rng(5)
    units, takes, frames = len(held.label), len(held.take_start), len(held.frames)
    label, take = np.tile(held.label, times), shifted(held.take, times, takes)
    once = ("mean", "basis", "variance", "rest", "sound_centre", "sound_scale")
    arrays: dict[str, Numbers] = {
        **{name: getattr(held, name) for name in once},
        **{name: noisy(getattr(held, name), times, rng) for name in NOISY},
        **{name: np.tile(getattr(held, name), (times, 1)) for name in ("features", "values")},
        "frames": noisy(held.frames, times, rng),
        "label": label,
        "take": take,
        **{
            name: shifted(getattr(held, name), times, frames) for name in ("first", "last", "spans")
        },
        "take_first": np.append(shifted(held.take_first[:-1], times, frames), frames * times),
        "take_unit": np.append(shifted(held.take_unit[:-1], times, units), units * times),
        **{
            name: np.tile(getattr(held, name), times)
            for name in ("take_start", "take_has_sound", "take_names")
        },
        **label_table(label, take, len(held.labels)),
    }
    header = {
        "phone_set": held.phone_set,
        "rate": held.rate,
        "channels": held.channels,
        "labels": held.labels,
        "takes": takes * times,
        "frames": frames * times,
        "units": units * times,
        "components": len(held.basis),
        "total_variance": held.total_variance,
        "settings": msgspec.to_builtins(held.settings),
    }
    write(folder, header, arrays)


def measure_size(
    folder: Path, left: Sequence[Prepared], searches: dict[str, Search]
) -> tuple[int, dict[str, float]]:
    """Opening and searching one database, and the memory that a process needs for it."""
    held = open_database(folder)
    count = len(held.label)
    size = f"{count:,} units"
    times = {"open": milliseconds(lambda: open_database(folder))["median_ms"]}
    say(f"open, {size}", median_ms=times["open"])
    for phones in PAPER:
        wanted = line(left, held, phones)
        for name, search in searches.items():
            what = f"{phones} phones, {size}: {name}"
            times[name] = measure_search(what, search, UnitGraph(held), wanted)
        if "optimal" in searches:
            times["several"] = measure_several(f"{phones} phones, {size}: several", held, wanted)
    code = (
        "import numpy as np\n"
        "from lipwright.engines.motion.database import open_database\n"
        "from lipwright.engines.motion.graph import UnitGraph\n"
        "from lipwright.engines.motion.search import Costs, greedy, optimal\n"
        f"graph = UnitGraph(open_database({str(folder)!r}))\n"
        f"{list(searches)[-1]}(graph, np.array({wanted.tolist()}), Costs(graph))"
    )
    if Path("/proc/self/status").exists():
        say(f"memory of a search process, {size}", peak_mb=own_peak_mb(code))
    return count, times


def own_peak_mb(code: str) -> float:
    """Greatest memory of a fresh Python in MB, mapped pages that it touched included.

    What ``getrusage`` says would begin with the memory of this process, which has
    just written the database.
    """
    tail = "\nprint(open('/proc/self/status').read().split('VmHWM:')[1].split()[0])"
    run = subprocess.run(
        [sys.executable, "-c", code + tail], check=True, capture_output=True, text=True
    )
    return round(float(run.stdout) / 1024, 1)


def measure_paper(name: str, corpus: Corpus, folder: Path) -> Database:
    """The paper's tables: searches beside each other, plain and merged."""
    kept, left = corpus
    start = time.perf_counter()
    held = build(folder / name, kept)
    took = round(time.perf_counter() - start, 2)
    about = msgspec.to_builtins(replace(info(held), units_per_phone={}))
    say(f"{name}: built", seconds=took, **about)
    windows = {f"PQ({h})": pq(h, seconds=CAP) for h in (3, 4, 5, 6)}
    for count in PAPER:
        wanted = line(left, held, count)
        for what, search in {"greedy": greedy, "optimal": optimal, **windows}.items():
            measure_search(f"{name}, {count} phones: {what}", search, UnitGraph(held), wanted)
    for clusters in (1000, 500, 200):
        start = time.perf_counter()
        merged = build(folder / f"{name} merged", kept, Settings(clusters=clusters))
        say(f"{name}, {clusters} clusters: built", seconds=round(time.perf_counter() - start, 2))
        wanted = line(left, merged, 38)
        for what, search in {
            "greedy": greedy,
            "optimal": optimal,
            "PQ(4)": windows["PQ(4)"],
        }.items():
            text = f"{name}, {clusters} clusters, 38 phones: {what}"
            measure_search(text, search, MergedGraph(merged), wanted)
    return held


def measure_growth(kept: Sequence[Prepared], left: Sequence[Prepared], folder: Path) -> None:
    """Against the utterance's length and against the database's size."""
    held = build(folder / "grown", kept[:GROWN])
    by_length: dict[str, list[float]] = {"greedy": [], "optimal": [], "several": []}
    for count in LONG:
        wanted = line(left, held, count)
        for name, search in BOTH.items():
            found = measure_search(f"{count} phones: {name}", search, UnitGraph(held), wanted)
            by_length[name].append(found)
        by_length["several"].append(measure_several(f"{count} phones: several", held, wanted))
    say("growth with the phones", **{name: exponent(LONG, t) for name, t in by_length.items()})
    sizes: list[tuple[int, dict[str, float]]] = []
    for times in REPEATED:
        repeated(held, times, folder / "repeated")
        sizes.append(measure_size(folder / "repeated", left, BOTH))
    counts = [count for count, _ in sizes]
    names = sizes[0][1]
    powers = {name: exponent(counts, [found[name] for _, found in sizes]) for name in names}
    say("growth with the units", **powers)
    if "all" in sys.argv:
        repeated(held, REPEATED_ALL, folder / "repeated")
        measure_size(folder / "repeated", left, {"greedy": greedy})


def corpora() -> Iterator[tuple[str, Corpus]]:
    if (DATA / "grid").is_dir():
        yield "grid", grid_corpus()
    yield "open", open_corpus()


if __name__ == "__main__":
    place = Path(tempfile.mkdtemp(prefix="lipwright-bench-"))
    try:
        for title, both_parts in corpora():
            if "growth" not in sys.argv:
                measure_paper(title, both_parts, place)
        measure_growth(*both_parts, place)
    finally:
        shutil.rmtree(place, ignore_errors=True)
