"""The models that come with Lipwright: speakers never heard, ten minutes of one, rest, streams.

On all 560 sentences of the GRID speaker, whom the models never heard: likeness of the mouth,
and closures one by one. A closure of the face beside a p, b or m is met if the animation is
closed within 40 ms of it; one of the animation inside the sentence is true if the face is
closed within 40 ms. Beside them stand loudness, phones by ear, and the aligned text. Then
what ten minutes of the speaker teach, on sentences and on words left out; Mandarin by
animators; noises without speech; and the cost of a stream. Without recordings only the last
two are measured.
"""

import csv
import tempfile
import time
import tracemalloc
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from tools.neural_model import spoil

from bench.mandarin import loudness
from bench.measure import say
from bench.motion import SHARED
from bench.motion_facegood import cut, figures, read
from bench.quality import only
from bench.recordings import DATA
from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.character.between import with_betweens
from lipwright.character.head import measure
from lipwright.engines.neural import Stream
from lipwright.engines.neural.built_in import live_model
from lipwright.engines.neural.engine import NeuralEngine
from lipwright.engines.neural.lessons import Lesson
from lipwright.engines.neural.live_model import LiveModel
from lipwright.engines.neural.stream import hear_all
from lipwright.engines.neural.teaching import teach
from lipwright.evaluate import Curve, Recording, read_recording
from lipwright.evaluate.closures import SHARES
from lipwright.evaluate.curve import span
from lipwright.measuring import head_mouth
from lipwright.neural_takes import read_animation
from lipwright.speech import Speech

GRID, FACEGOOD = DATA / "grid", DATA / "facegood"
WITHIN, STEP = 0.04, 0.005  # s
BESIDE = 0.06  # s
MINUTES, EVERY = 10.0, 9
RATE = 16000
Make = Callable[[Speech], Animation]
Bools = NDArray[np.bool_]


@dataclass(frozen=True)
class Line:
    """A sentence: its sound alone, its words and phones, and the face."""

    name: str
    text: str
    alone: Speech
    aligned: Speech
    face: Recording


def sentences() -> list[Line]:
    """All of GRID."""
    with (GRID / "text.csv").open(newline="") as table:
        rows = [(row["sentence"], row["text"]) for row in csv.DictReader(table)]
    return [
        Line(
            name,
            text,
            pipeline.sound_alone(GRID / "audio" / f"{name}.flac"),
            pipeline.align(GRID / "audio" / f"{name}.flac", text),
            read_recording(GRID / "measured" / f"{name}.csv", GRID / "motion" / f"{name}.csv"),
        )
        for name, text in rows
    ]


def opening(made: Animation) -> Curve:
    """How far an animation opens the built-in head's lips."""
    skin, marks = head_mouth()
    moved = with_betweens(made, skin.morphs)
    weights = dict(zip(moved.controls, moved.values.T, strict=True))
    return Curve(made.times, measure([skin], marks, weights).opening)


def closures(mouths: Sequence[Curve], lines: Sequence[Line], lag: float) -> dict[str, Any]:
    """How many closures of the face are met, and how many of ours are true."""
    faces = [line.face.opening for line in lines]
    limits = [span(np.concatenate([curve.values for curve in side])) for side in (mouths, faces)]
    met: list[bool] = []
    true: list[bool] = []
    for mouth, face, line in zip(mouths, faces, lines, strict=True):
        times = np.arange(face.times[0], face.times[-1], STEP)
        ours, theirs = (
            curve.at(times) <= low + SHARES["p b m"] * (high - low)
            for curve, (low, high) in zip((mouth.later(lag), face), limits, strict=True)
        )
        spoken = [phone for phone in line.aligned.phones if phone.label != "sil"]
        for phone in spoken:
            beside = (times >= phone.start - BESIDE) & (times <= phone.end + BESIDE)
            if phone.label in ("p", "b", "m") and (theirs & beside).any():
                met.append(bool((near(ours) & theirs & beside).any()))
        for start, end in spells(ours):
            inside = times[start] > spoken[0].start + STEP * 4
            if inside and times[end - 1] < spoken[-1].end - STEP * 4:
                true.append(bool(near(theirs)[start:end].any()))
    return {
        "closures_of_the_face": len(met),
        "recall": round(float(np.mean(met)), 3),
        "closures_of_ours": len(true),
        "precision": round(float(np.mean(true)), 3) if true else None,
    }


def near(closed: Bools) -> Bools:
    """Where something is closed within 40 ms."""
    reach = round(WITHIN / STEP)
    return np.convolve(closed, np.ones(2 * reach + 1), "same") > 0.5


def spells(closed: Bools) -> list[tuple[int, int]]:
    """First and last, without, of each spell."""
    edges = np.flatnonzero(np.diff(np.r_[False, closed, False]))
    return [(int(a), int(b)) for a, b in edges.reshape(-1, 2)]


def told(
    made: Sequence[Animation],
    lines: Sequence[Line],
    words: frozenset[str] = frozenset(),
    *,
    with_closures: bool = True,
) -> dict[str, Any]:
    """Figures of animations of lines; of some words only, where they are named."""
    known = [
        Animation(
            one.controls, one.values, one.rate, one.start,
            phones=line.aligned.phones, words=line.aligned.words,
        )
        for one, line in zip(made, lines, strict=True)
    ]  # fmt: skip
    faces = [
        only(line.face, one, words) if words else line.face
        for one, line in zip(known, lines, strict=True)
    ]
    found = pipeline.evaluate_motion(list(zip(known, faces, strict=True)))
    figures = {
        "lines": len(lines),
        "opening": round(found.opening.correlation, 4),
        "rounding": round(found.rounding.correlation, 4),
        "later_ms": found.lag_ms,
    }
    if not with_closures:
        return figures
    return {**figures, **closures([opening(one) for one in known], lines, found.lag_ms / 1000)}


def unheard(lines: Sequence[Line]) -> None:
    """Print the models, and what stands beside them, on a speaker they never heard."""
    ways: dict[str, Callable[[Line], Animation]] = {
        "whole": lambda line: pipeline.animate(line.alone, engine="neural").animation,
        "live": lambda line: pipeline.animate(line.alone, engine="neural", model="live").animation,
        "phones by ear": lambda line: by_ear(line.alone),
        "the aligned text": lambda line: pipeline.animate(line.aligned).animation,
    }
    for name, way in ways.items():
        before = time.perf_counter()
        made = [way(line) for line in lines]
        seconds = time.perf_counter() - before
        figures = told(made, lines)
        say(
            f"GRID, never heard: {name}",
            **figures,
            ms_per_line=round(1e3 * seconds / len(lines), 1),
        )
    for name in ("whole", "live"):
        say(f"GRID, confidence of {name}", **confidence(name, lines))


def by_ear(speech: Speech) -> Animation:
    """What the bigram engine makes of phones by ear."""
    assert speech.sound is not None
    return pipeline.animate(pipeline.hear(speech.sound)).animation


def confidence(name: str, lines: Sequence[Line]) -> dict[str, Any]:
    """Is the opening farther off where the net says so? Thirds of all frames by doubt."""
    model = live_model(name)
    doubts, off = [], []
    made = [pipeline.animate(line.alone, engine="neural", model=name).animation for line in lines]
    mouths = [opening(one) for one in made]
    faces = [line.face.opening for line in lines]
    spans = [span(np.concatenate([curve.values for curve in side])) for side in (mouths, faces)]
    for line, mouth, face in zip(lines, mouths, faces, strict=True):
        assert line.alone.sound is not None
        frames = hear_all(line.alone.sound.samples, line.alone.sound.rate, model)
        one, other = (
            (curve.at(face.times) - low) / (high - low)
            for curve, (low, high) in zip((mouth.later(0.025), face), spans, strict=True)
        )
        doubts.append(np.interp(face.times - 0.025, frames.times, frames.doubt))
        off.append(np.abs(one - other))
    doubt, wrong = np.concatenate(doubts), np.concatenate(off)
    thirds = np.array_split(np.argsort(doubt), 3)
    return {
        "off_where_sure": round(float(wrong[thirds[0]].mean()), 3),
        "between": round(float(wrong[thirds[1]].mean()), 3),
        "off_where_unsure": round(float(wrong[thirds[2]].mean()), 3),
        "doubt": [round(float(np.quantile(doubt, q)), 3) for q in (0.1, 0.5, 0.9)],
    }


def taught(lines: Sequence[Line]) -> None:
    """Print what ten minutes of the speaker teach."""
    out = lines[4::EVERY]
    rest = [line for line in lines if line not in out]
    for hears in ("whole", "live"):
        model, seconds = learnt(rest, hears)
        made = [NeuralEngine(model).animate(line.alone) for line in out]
        say(
            f"GRID, {MINUTES:g} minutes taught, sentences left out: {hears}",
            **told(made, out),
            seconds=seconds,
        )
    for group in SHARED:
        words = frozenset(group)
        own = [line for line in lines if words & set(line.text.split())]
        model, _ = learnt([line for line in lines if line not in own], "whole")
        made = [NeuralEngine(model).animate(line.alone) for line in own[::4]]
        say(
            f"GRID, {MINUTES:g} minutes taught, words left out: {' '.join(group)}",
            **told(made, own[::4], words, with_closures=False),
        )


def learnt(lines: Sequence[Line], hears: str) -> tuple[LiveModel, float]:
    """A model of the speaker's shapes, from ten minutes of some lines."""
    order = np.random.default_rng(0).permutation(len(lines))
    lessons, length = [], 0.0
    for place in order:
        line = lines[place]
        assert line.alone.sound is not None
        if length < 60 * MINUTES:
            shapes, _ = read_animation(GRID / "motion" / f"{line.name}.csv")
            lessons.append(Lesson(line.alone.sound, shapes, line.name))
            length += line.alone.sound.duration
    before = time.perf_counter()
    model = teach(lessons, live_model(hears))
    return model, round(time.perf_counter() - before, 1)


def mandarin() -> None:
    """Print likeness to animators' curves for a language that no voice here recorded."""
    with tempfile.TemporaryDirectory() as folder:
        takes = Path(folder)
        stretches = [read(takes, name) for name in cut(takes)]
    for name in ("whole", "live"):
        engine = NeuralEngine(live_model(name))
        for what, some in (
            ("syllables and words", [one for one in stretches if "_3_" not in one.name]),
            ("running speech", [one for one in stretches if "_3_" in one.name]),
        ):
            found = figures([engine.animate] * len(some), some)
            say(f"facegood, {what}: {name}", lines=len(some), **found)


def at_rest() -> None:
    """Print how much the mouth moves without speech, at -20 dB of full scale."""
    noises: dict[str, Callable[[int, np.random.Generator], NDArray[np.float64]]] = {
        "silence": lambda count, rng: np.zeros(count),
        "hiss": lambda count, rng: spoil.coloured(count, rng, 0.0),
        "fan": spoil.fan,
        "music": spoil.music,
    }
    for name in ("whole", "live"):
        model, found = live_model(name), {}
        for noise, make in noises.items():
            moved = []
            for seed in range(12):
                made = make(20 * RATE, np.random.default_rng([99, seed]))
                level = 0.1 / max(float(np.sqrt(np.square(made).mean())), 1e-9)
                sound = np.clip(made * level, -1, 1).astype(np.float32)
                moved.append(float(np.abs(hear_all(sound, RATE, model).values).mean()))
            found[noise] = [round(float(np.mean(moved)), 4), round(max(moved), 4)]
        say(f"mean activity without speech, mean and worst of 12: {name}", **found)


def speed() -> None:
    """Print latency, time per frame, share of real time, and memory over an hour."""
    rng = np.random.default_rng(0)
    minute = rng.normal(0, 0.05, 60 * RATE).astype(np.float32)
    for name in ("whole", "live"):
        model, times = live_model(name), []
        for _ in range(7):
            before = time.perf_counter()
            hear_all(minute, RATE, model)
            times.append(time.perf_counter() - before)
        median = float(np.median(times))
        say(
            f"a minute at once: {name}",
            ms=round(1e3 * median, 1),
            times_real_time=round(60 / median),
            kilobytes=round(len(model.to_bytes()) / 1e3),
        )
    for rate in (RATE, 48000):
        stream, piece = Stream(rate=rate), rate // 50
        sound = rng.normal(0, 0.05, 60 * rate).astype(np.float32)
        times = []
        for start in range(0, len(sound), piece):
            before = time.perf_counter()
            stream.push(sound[start : start + piece])
            times.append(time.perf_counter() - before)
        say(
            f"a stream, pieces of 20 ms at {rate} Hz",
            ms_per_frame=round(1e3 * float(np.median(times)), 3),
            ms_worst_hundredth=round(1e3 * float(np.quantile(times, 0.99)), 3),
            latency_ms=round(1e3 * stream.latency, 1),
        )
    stream = Stream()
    tracemalloc.start()
    for start in range(0, 60 * RATE, RATE):
        stream.push(minute[start : start + RATE])
    before_kb = tracemalloc.get_traced_memory()[0] / 1e3
    for _ in range(59):
        for start in range(0, 60 * RATE, RATE):
            stream.push(minute[start : start + RATE])
    after_kb = tracemalloc.get_traced_memory()[0] / 1e3
    tracemalloc.stop()
    say(
        "an hour streamed", kilobytes_after_a_minute=round(before_kb), after_an_hour=round(after_kb)
    )


def by_loudness(lines: Sequence[Line]) -> None:
    """Print how far loudness alone follows the lips."""
    found = []
    for line in lines:
        assert line.alone.sound is not None
        level = loudness(line.alone.sound)
        level = np.convolve(np.maximum(level, level.max() - 40), np.ones(9) / 9, "same")
        at = np.interp(line.face.opening.times, 0.01 * np.arange(len(level)), level)
        found.append(np.corrcoef(at, line.face.opening.values)[0, 1])
    say("GRID, loudness alone", opening=round(float(np.mean(found)), 4))


if __name__ == "__main__":
    speed()
    at_rest()
    if DATA.is_dir():
        everything = sentences()
        by_loudness(everything)
        unheard(everything)
        taught(everything)
        mandarin()
