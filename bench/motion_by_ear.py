"""What it costs the motion engine that phones are heard instead of aligned: one GRID speaker.

Of the sentences beside the project 40 are left out and 260 of the others make two databases,
one from the words and one by ear; the lines are heard both ways too. Closures are those of
the aligned phones. Without recordings nothing is measured.
"""

import csv
import shutil
import tempfile
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from bench.measure import say
from bench.motion_facegood import Line, by_loudness, drawn, told
from bench.quality import GRID
from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.engines.motion.database import open_database
from lipwright.engines.motion.engine import MotionEngine
from lipwright.evaluate import read_recording
from lipwright.motion_takes import build_motion

LEFT_OUT, EVERY_OTHER = slice(4, 360, 9), slice(None, None, 2)


def line(name: str, text: str) -> Line:
    """A sentence with its words in time; with no text, by ear."""
    face = read_recording(GRID / "measured" / f"{name}.csv", GRID / "motion" / f"{name}.csv")
    sound = GRID / "audio" / f"{name}.flac"
    speech = pipeline.align(sound, text) if text else pipeline.hear(sound)
    return Line(name, speech, face, face.opening)


def takes(names: Sequence[str], texts: dict[str, str], folder: Path) -> Path:
    """A folder of sentences, with their words where texts are given."""
    folder.mkdir()
    for name in names:
        shutil.copy(GRID / "motion" / f"{name}.csv", folder)
        shutil.copy(GRID / "audio" / f"{name}.flac", folder)
        if name in texts:
            (folder / f"{name}.txt").write_text(texts[name])
    return folder


def main(place: Path) -> None:
    """Measure and print."""
    with (GRID / "text.csv").open(newline="") as table:
        texts = {row["sentence"]: row["text"] for row in csv.DictReader(table)}
    left_out = list(texts)[LEFT_OUT]
    known = [name for name in texts if name not in left_out][EVERY_OTHER]
    build_motion(takes(known, texts, place / "words"), place / "aligned")
    build_motion(takes(known, {}, place / "sounds"), place / "by ear", by_ear=True)
    lines = {
        "aligned": [line(name, texts[name]) for name in left_out],
        "by ear": [line(name, "") for name in left_out],
    }
    true = [one.speech.phones for one in lines["aligned"]]

    def compare(what: str, made: list[Animation]) -> None:
        said = [replace(one, phones=phones) for one, phones in zip(made, true, strict=True)]
        faces = [one.face for one in lines["aligned"]]
        found = pipeline.evaluate_motion(list(zip(said, faces, strict=True)))
        say(f"motion by ear, GRID: {what}", lines=len(made), takes=len(known), **told(found))

    say("motion by ear, GRID: loudness", **by_loudness(lines["by ear"]))
    for way, some in lines.items():
        compare(f"lines {way}, bigram", [drawn(one.speech) for one in some])
        for kind in ("aligned", "by ear"):
            for search in ("several", "optimal"):
                engine = MotionEngine(open_database(place / kind), search)
                made = [engine.animate(one.speech) for one in some]
                compare(f"takes {kind}, lines {way}, {search}", made)


if __name__ == "__main__":
    if GRID.is_dir():
        with tempfile.TemporaryDirectory() as folder:
            main(Path(folder))
