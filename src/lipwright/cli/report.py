"""What a command says when it is done: short, on standard output; notes on standard error."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click

from lipwright.files import STANDARD_STREAM
from lipwright.performance import Performance
from lipwright.speech import Speech

ABOUT = {
    ".json": "lossless, to load again",
    ".csv": "a row per frame",
    ".glb": "model and animation",
    ".html": "speaking head: open it in a browser",
    ".wav": "sound",
}


def tell(performance: Performance, written: Sequence[str], *, as_json: bool) -> None:
    """Report a finished line."""
    # Standard output may be the animation itself: then people read standard error.
    stream = sys.stderr if STANDARD_STREAM in written else sys.stdout
    if as_json:
        print(json.dumps(_facts(performance, written), ensure_ascii=False), file=stream)
        return
    animation = performance.animation
    line = (
        f"{animation.duration:.2f} s, {len(animation)} frames at {animation.rate:g} per second, "
        f"{len(animation.phones)} phones"
    )
    confidence = performance.speech.confidence
    if confidence is not None:
        line += f", confidence {confidence:.2f}"
    print(line, file=stream)
    for path in written:
        if path != STANDARD_STREAM:
            print(f"  {path}  ({ABOUT.get(Path(path).suffix.lower(), 'written')})", file=stream)
    notes(performance.speech)
    stand_ins = animation.report.get("stand_ins", [])
    if stand_ins:
        note(f"the set lacks {', '.join(stand_ins)}: made from single phones")
    nearest = animation.report.get("nearest_classes", {})
    if nearest:
        pairs = ", ".join(f"{label} as {name}" for label, name in nearest.items())
        note(f"sounds without a class of their own: {pairs}")


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
