"""Do levels chosen on some words hold on words that were left out?

The levels of opening, rounding and spreading of every class are chosen anew by a search,
from a coarse table of what any phonetics book says, on frames in which only one half of
the 51 words of the GRID recordings is spoken. What they reach on the other half's words,
in other sentences, is an estimate of what the way of choosing is worth on words that
nobody looked at. When things happen and how they are smoothed stays as in the set.
"""

import csv
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace

from tools.english.__main__ import english
from tools.english.knowledge import SOUNDS

from bench.measure import say
from bench.quality import GRID, HALF, only
from lipwright import pipeline
from lipwright.engines.bigram import BigramEngine
from lipwright.evaluate import Recording, read_recording
from lipwright.speech import Speech

Levels = dict[tuple[str, str, str], float]
"""Class, target (first or second) and pose: the level."""
Line = tuple[Speech, Recording]

STEPS = (0.12, 0.06)
PULL = 0.02
"""What a level costs that is far from the table, per square."""
POSES = ("open", "W", "wide")
COARSE: dict[str, tuple[dict[str, float], dict[str, float]]] = {
    "ah": ({"open": 0.45}, {}),
    "aa": ({"open": 0.7}, {}),
    "ao": ({"open": 0.45, "W": 0.6}, {}),
    "eh": ({"open": 0.5, "wide": 0.3}, {}),
    "er": ({"open": 0.3, "W": 0.3}, {}),
    "ih": ({"open": 0.3, "wide": 0.4}, {}),
    "w": ({"open": 0.15, "W": 0.9}, {}),
    "ow": ({"open": 0.4, "W": 0.5}, {"open": 0.2, "W": 0.8}),
    "aw": ({"open": 0.6}, {"open": 0.25, "W": 0.7}),
    "oy": ({"open": 0.4, "W": 0.6}, {"open": 0.3, "wide": 0.4}),
    "ay": ({"open": 0.65}, {"open": 0.35, "wide": 0.4}),
    "r": ({"open": 0.15, "W": 0.4}, {}),
    "sh": ({"open": 0.15, "W": 0.3}, {}),
    "f": ({}, {}),
    "bmp": ({}, {}),
    **{label: ({"open": 0.15}, {}) for label in ("h", "l", "z", "th", "d", "kg")},
}


def coarse() -> Levels:
    """The table that the search begins with."""
    levels = {}
    for label, targets in COARSE.items():
        closed = SOUNDS[label].kind == "closure"
        for name, target in zip(("first", "second"), targets, strict=True):
            if name == "second" and SOUNDS[label].second is None:
                continue
            for pose in POSES[closed:]:
                levels[label, name, pose] = target.get(pose, 0.0)
    return levels


@contextmanager
def drawn_with(levels: Mapping[tuple[str, str, str], float]) -> Iterator[None]:
    """Let the set's tool draw with other levels."""
    before = dict(SOUNDS)
    for (label, target, pose), level in levels.items():
        sound = SOUNDS[label]
        if target == "first":
            SOUNDS[label] = replace(sound, first={**sound.first, pose: level})
        else:
            SOUNDS[label] = replace(sound, second={**sound.last, pose: level})
    try:
        yield
    finally:
        SOUNDS.update(before)


def reached(levels: Levels, lines: list[Line], words: frozenset[str]) -> tuple[float, float]:
    """Correlation of opening and of rounding where only these words are spoken."""
    with drawn_with(levels):
        engine = BigramEngine(english())
    pairs = []
    for speech, face in lines:
        made = engine.animate(speech)
        pairs.append((made, only(face, made, words)))
    found = pipeline.evaluate_motion(pairs)
    return found.opening.correlation, found.rounding.correlation


def choose(lines: list[Line], words: frozenset[str]) -> Levels:
    """Search level by level for what is best on these words."""
    start = coarse()

    def worth(levels: Levels) -> float:
        far = sum((levels[key] - start[key]) ** 2 for key in levels)
        return sum(reached(levels, lines, words)) - PULL * far

    chosen = dict(start)
    best = worth(chosen)
    for step in STEPS:
        for key in start:
            for change in (step, -step):
                level = min(max(chosen[key] + change, 0.0), 1.0)
                value = worth({**chosen, key: level})
                if value > best + 1e-4:
                    chosen, best = {**chosen, key: level}, value
                    break
    return chosen


def measure(every: int = 5) -> None:
    """Print one line for each half of the words."""
    with (GRID / "text.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    lines: list[Line] = []
    for row in rows:
        name = row["sentence"]
        speech = replace(pipeline.align(GRID / "audio" / f"{name}.flac", row["text"]), sound=None)
        lines.append((speech, read_recording(GRID / "measured" / f"{name}.csv")))
    first = frozenset(HALF.split())
    second = frozenset(word for row in rows for word in row["text"].split()) - first
    looked_at = lines[::every]
    others = [line for number, line in enumerate(lines) if number % every]
    for name, own, left_out in (("first", first, second), ("second", second, first)):
        chosen = choose(looked_at, own)
        say(
            f"levels chosen on the {name} half of the words",
            sentences=len(looked_at),
            other_sentences=len(others),
            **{
                f"{what}_{when}": dict(
                    zip(
                        ("opening", "rounding"),
                        (round(value, 4) for value in reached(levels, others, words)),
                        strict=True,
                    )
                )
                for what, words in (("own_words", own), ("words_left_out", left_out))
                for when, levels in (("before", coarse()), ("after", chosen))
            },
        )


if __name__ == "__main__":
    if GRID.is_dir():
        measure()
