"""``python -m tools.neural_page GRID FACEGOOD``: writes ``docs/neural-engine.md`` anew.

GRID is a folder of sentences (``audio``, ``motion``, ``text.csv``), FACEGOOD one of long
takes (``NAME.flac`` beside ``NAME.csv``). It takes some minutes.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path

import numpy as np

from lipwright import pipeline
from lipwright.engines.neural.training import DECAY
from lipwright.errors import LipwrightError
from lipwright.files import write_all
from lipwright.phones import SILENCE
from lipwright.sound import Sound
from lipwright.timeline import Interval, Tier
from tools.neural_page.figures import figure_3, hidden_units
from tools.neural_page.pieces import HEARING, Piece, drawn, grid, takes
from tools.neural_page.sources import Spoken, amounts, animators, lacking, manners, voices
from tools.neural_page.trials import Trial, five_of, mean_of, trial

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "neural-engine.md"
FIGURE = DOCS / "pictures" / "neural-figure-3.svg"
CURVE = DOCS / "pictures" / "neural-hidden-units.svg"
TEMPLATE = Path(__file__).with_name("page.md")
UNITS = (2, 4, 8, 12, 18, 24, 32, 48, 64)
DRAWS, FEW = 10, 4
THRESHOLDS = (0.15, 0.25, 0.35)
SHOWN = 2
Trials = Mapping[str, Sequence[Trial]]


def say(what: str) -> None:
    """Tell what is being measured."""
    print(f"{what} …", file=sys.stderr, flush=True)


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def results(found: Trials) -> str:
    """Return errors and correlations of each output."""
    rows = []
    for name, trials in found.items():
        each = np.mean([one.correlations for one in trials], axis=0)
        rms, left = (mean_of([getattr(t, w) for t in trials]) for w in ("rms", "unexplained"))
        rows.append([name, f"{rms:.3f}", f"{left:.2f}", *(f"{value:.2f}" for value in each)])
    return table(["", "RMS", "left", "a", "i", "o/u", "b/m/p", "open"], rows)


def to_correct(found: Trials) -> str:
    """Return shares of frames and of values that are off, by threshold."""
    rows = []
    for name, trials in found.items():
        for by in THRESHOLDS:
            shares = [
                mean_of([t.wrong(by) for t in trials]),
                mean_of([t.wrong_values(by) for t in trials]),
                mean_of([t.wrong_at_rest(by) for t in trials]),
            ]
            rows.append([name, f"{by:g}", *(f"{100 * share:.0f} %" for share in shares)])
    return table(["", "off by more than", "frames", "values", "frames, mean face held"], rows)


def left_over(found: Trials) -> str:
    """Return what is left of the variance, and frames to correct."""
    rows = [
        [
            name,
            f"{mean_of([t.rms for t in trials]):.3f}",
            f"{mean_of([t.unexplained for t in trials]):.2f}",
            f"{100 * mean_of([t.wrong() for t in trials]):.0f} %",
        ]
        for name, trials in found.items()
    ]
    return table(["", "RMS", "left", "frames to correct"], rows)


def units(pieces: Sequence[Piece], decay: float = DECAY) -> dict[int, float]:
    """Return the error by the number of hidden units."""
    parts = [drawn(pieces, number) for number in range(FEW)]
    return {
        count: mean_of([trial(*part, hidden=count, decay=decay).rms for part in parts])
        for count in UNITS
    }


def curve_table(curves: Mapping[str, Mapping[int, float]]) -> str:
    """Return the curves' figures."""
    rows = [[name, *(f"{value:.3f}" for value in curve.values())] for name, curve in curves.items()]
    return table(["hidden units", *map(str, UNITS)], rows)


def stretch(pieces: Sequence[Piece]) -> str:
    """Return Figure 3 for pieces that were not taught, of recordings that may be shown.

    Nobody has written down what is said in them: phones by ear stand for the text.
    """
    taught, unseen = drawn(pieces, 0)
    shown = unseen[:SHOWN]
    found = trial(taught, shown, targets=five_of(taught))
    samples, labels, times, at = [], list[Interval](), [], 0.0
    for piece in shown:
        whole = piece.samples()
        start = piece.times[0] - 0.5 * HEARING.frame
        length = round(piece.seconds * whole.rate)
        first = max(round(start * whole.rate), 0)
        sound = Sound(whole.samples[first : first + length], whole.rate)
        heard = [phone for phone in pipeline.hear(sound).phones if phone.label != SILENCE]
        labels += [replace(one, start=one.start + at, end=one.end + at) for one in heard]
        times.append(piece.times - start + at)
        samples.append(sound.samples)
        at += sound.duration
    joined = Sound(np.concatenate(samples), whole.rate)
    text = Tier(tuple(labels))
    return figure_3(joined, text, np.concatenate(times), found.given, found.wanted)


def phones_told(found: Mapping[str, tuple[float, float]]) -> dict[str, str]:
    """Return what is said of phones that the sample had or lacked."""
    had, lacked = np.mean(list(found.values()), axis=0) if found else (np.nan, np.nan)
    return {
        "PHONES": f"{len(found)}",
        "LABELS": ", ".join(found),
        "HAD": f"{had:.3f}",
        "LACKED": f"{lacked:.3f}",
    }


def make(one: Sequence[Piece], two: Sequence[Piece]) -> dict[Path, bytes]:
    """Return what each file must hold."""
    spoken = Spoken()
    say("the experiment")
    both = {
        name: [trial(*drawn(pieces, number)) for number in range(DRAWS)]
        for name, pieces in (("GRID", one), ("facegood", two))
    }
    say("hidden units")
    curves = {"GRID": units(one), "facegood": units(two)}
    curves |= {"GRID, no decay": units(one, 0.0), "facegood, no decay": units(two, 0.0)}
    say("how much was taught")
    more = {
        f"{name}, {seconds:g} s": trials
        for name, pieces in (("GRID", one), ("facegood", two))
        for seconds, trials in amounts(pieces, FEW).items()
    }
    say("speakers and manners")
    speakers = {
        "GRID, taught by GRID": both["GRID"],
        "GRID, taught by facegood": voices(two, one, FEW),
        "facegood, taught by facegood": both["facegood"],
        "facegood, taught by GRID": voices(one, two, FEW),
    }
    ways = {f"running speech, taught by {name}": t for name, t in manners(two, DRAWS).items()}
    say("phones and animators")
    taught_by = animators(one, spoken, DRAWS)
    long = amounts(one, 2, spoken.drawn)[300.0]
    values = {
        "DATE": f"{datetime.now():%-d %B %Y}",
        "RESULTS": results({**both, "GRID, drawn by the bigram engine": taught_by["consistent"]}),
        "CORRECT": to_correct(both),
        "UNITS": curve_table(curves),
        "AMOUNTS": left_over(more),
        "SPEAKERS": left_over(speakers),
        "MANNERS": left_over(ways),
        **phones_told(lacking(one, spoken, DRAWS)),
        "ANIMATORS": left_over({**taught_by, "consistent, 5 minutes taught": long}),
        "SHARE": f"{100 * mean_of([t.wrong() for ts in both.values() for t in ts]):.0f}",
    }
    text = TEMPLATE.read_text(encoding="utf-8")
    for name, value in values.items():
        text = text.replace(f"<{name}>", value)
    say("figure 3")
    pictures = {FIGURE: stretch(two), CURVE: hidden_units(curves)}
    return {PAGE: text.encode(), **{path: svg.encode() for path, svg in pictures.items()}}


def main() -> int:
    """Read the command line; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m tools.neural_page", description=__doc__)
    parser.add_argument("grid", type=Path, metavar="GRID")
    parser.add_argument("takes", type=Path, metavar="FACEGOOD")
    given = parser.parse_args()
    try:
        write_all(make(grid(given.grid), takes(given.takes)).items())
    except LipwrightError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
