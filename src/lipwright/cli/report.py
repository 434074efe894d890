"""What a command says when it is done: short, on standard output; notes on standard error."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from typing import Any

import click

from lipwright.export import suffix_of
from lipwright.files import STANDARD_STREAM
from lipwright.performance import Performance
from lipwright.speech import Speech

ABOUT = {
    ".json": "lossless, to load again",
    ".csv": "a row per frame",
    ".c3d": "markers",
    ".glb": "model and animation",
    ".html": "speaking head: open it in a browser",
    ".wav": "sound",
    ".tsv": "held mouth shapes, as Rhubarb's",
    ".xml": "held mouth shapes, as Rhubarb's",
    ".rhubarb.json": "held mouth shapes, as Rhubarb's",
    ".dat": "switch data for Moho",
}


def tell(performance: Performance, written: Sequence[str], *, as_json: bool) -> None:
    """Report a finished line."""
    # Standard output may be the animation itself: then people read standard error.
    stream = sys.stderr if STANDARD_STREAM in written else sys.stdout
    if as_json:
        print(json.dumps(_facts(performance, written)), file=stream)
        return
    animation = performance.animation
    frames = f"{len(animation)} frames at {animation.rate:g} per second"
    print(f"{_sentence(performance.speech)}; {frames}", file=stream)
    for path in written:
        if path != STANDARD_STREAM:
            print(f"  {path}  ({_about(path, performance)})", file=stream)
    notes(performance.speech)
    for text in performance.cues().notes if performance.flat else ():
        note(text)
    stand_ins = animation.report.get("stand_ins", [])
    if stand_ins:
        note(f"the set lacks {', '.join(stand_ins)}: made from single phones")
    if about := animation.report.get("about_database"):
        note(about)
    lacking = animation.report.get("nearest_phones", {})
    if lacking:
        pairs = ", ".join(f"{phone} as {used}" for phone, used in lacking.items())
        note(f"phones that the database lacks: {pairs}")
    bare = animation.report.get("without_curves", [])
    if bare:
        note(f"the set has no curve at all for {' '.join(bare)}: the mouth rests there")
    if animation.report.get("settings_unused"):
        note("this preset has settings of its own: those of the overrides are not used")
    lost = animation.report.get("edits_lost", [])
    if lost:
        note(f"edits that find no phone in this line: {', '.join(lost)}")
    nearest = animation.report.get("nearest_classes", {})
    if nearest:
        pairs = ", ".join(f"{label} as {name}" for label, name in nearest.items())
        note(f"sounds without a class of their own: {pairs}")


def _about(path: str, performance: Performance) -> str:
    suffix = suffix_of(path)
    if suffix == ".html" and performance.flat:
        return "speaking mouth: open it in a browser"
    return ABOUT.get(suffix, "written")


def tell_labels(speech: Speech, written: Sequence[str], *, as_json: bool) -> None:
    """Report written phone times."""
    stream = sys.stderr if STANDARD_STREAM in written else sys.stdout
    files = [path for path in written if path != STANDARD_STREAM]
    if as_json:
        facts = {
            "files": files,
            "seconds": round(speech.duration, 6),
            "phones": len(speech.phones),
            "words": len(speech.words),
            "source": speech.source,
            "confidence": speech.confidence,
            "notes": list(speech.notes),
        }
        print(json.dumps(facts), file=stream)
        return
    print(_sentence(speech), file=stream)
    for path in files:
        print(f"  {path}", file=stream)
    notes(speech)


def _sentence(speech: Speech) -> str:
    counted = f"{speech.duration:.2f} s, {len(speech.words)} words, {len(speech.phones)} phones"
    if speech.confidence is None:
        return counted
    return f"{counted}, confidence {speech.confidence:.2f}"


def notes(speech: Speech) -> None:
    """Say what the schedule has to say."""
    for text in speech.notes:
        note(text)


def note(text: str) -> None:
    """Say something on standard error."""
    click.echo(f"note: {text}", err=True)


def _facts(performance: Performance, written: Sequence[str]) -> dict[str, Any]:
    animation, speech = performance.animation, performance.speech
    return {
        "files": [path for path in written if path != STANDARD_STREAM],
        "seconds": round(animation.duration, 6),
        "frames": len(animation),
        "rate": animation.rate,
        "phones": len(animation.phones),
        "source": speech.source,
        "confidence": speech.confidence,
        "notes": list(speech.notes),
        **animation.report,
    }
