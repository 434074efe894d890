"""``say``, ``animate`` and ``phones``: from text, sound or labels to files."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import click

from lipwright.cli import options
from lipwright.cli.progress import progress
from lipwright.files import STANDARD_STREAM
from lipwright.speech import Speech


@click.command()
@click.argument("text", metavar="TEXT")
@options.outputs("Where to: .json .csv .glb .html .wav, or - for JSON. May be repeated.")
@click.option("--voice", default="en-us", show_default=True, help="Language or voice.")
@click.option(
    "--speed", type=float, default=175.0, show_default=True, metavar="WPM", help="Words per minute."
)
@click.option("--pitch", type=float, metavar="0..99", help="Height of the voice.")
@options.animation
@options.as_json
def say(
    text: str,
    outputs: tuple[str, ...],
    voice: str,
    speed: float,
    pitch: float | None,
    as_json: bool,
    **how: Any,
) -> None:
    """Speak TEXT and animate it. A lone - reads the text from standard input.

    The sound is written beside the first output unless it is asked for by name, or is
    inside the page.
    """
    from lipwright import pipeline

    files = _with_sound(outputs)
    _check(files)
    if text == STANDARD_STREAM:
        text = sys.stdin.read()
    speech = pipeline.say(text, voice=voice, rate=speed, pitch=pitch)
    _animate(speech, files, as_json, how)


def _with_sound(outputs: tuple[str, ...]) -> tuple[str, ...]:
    suffixes = {Path(path).suffix.lower() for path in outputs}
    silent = [p for p in outputs if Path(p).suffix.lower() in (".json", ".csv", ".glb")]
    if not silent or ".wav" in suffixes:
        return outputs
    return (*outputs, str(Path(silent[0]).with_suffix(".wav")))


@click.command()
@options.recording
@options.outputs("Where to: .json .csv .glb .html .wav, or - for JSON. May be repeated.")
@options.animation
@options.as_json
def animate(
    sound: str,
    text: str | None,
    text_file: Path | None,
    labels: Path | None,
    phone_set: str | None,
    lexicon: Path | None,
    outputs: tuple[str, ...],
    as_json: bool,
    **how: Any,
) -> None:
    """Animate the recording SOUND.

    With --text its words are put in time; with --labels phone times are taken as they are;
    with neither the words are recognised (English).
    """
    _check(outputs)
    speech = _speech(sound, text, text_file, labels, phone_set, lexicon)
    _animate(speech, outputs, as_json, how)


@click.command()
@options.recording
@options.outputs("Where to: .TextGrid .lab .ctm .phn .json. May be repeated.")
@options.as_json
def phones(
    sound: str,
    text: str | None,
    text_file: Path | None,
    labels: Path | None,
    phone_set: str | None,
    lexicon: Path | None,
    outputs: tuple[str, ...],
    as_json: bool,
) -> None:
    """Say when each phone and word of the recording SOUND sounds."""
    import json

    from lipwright import pipeline
    from lipwright.cli.report import notes

    pipeline.check_labels(*outputs)
    speech = _speech(sound, text, text_file, labels, phone_set, lexicon)
    pipeline.save_labels(speech, *outputs)
    if as_json:
        facts = {
            "files": [path for path in outputs if path != STANDARD_STREAM],
            "phones": len(speech.phones),
            "words": len(speech.words),
            "confidence": speech.confidence,
            "notes": list(speech.notes),
        }
        click.echo(json.dumps(facts, ensure_ascii=False), err=STANDARD_STREAM in outputs)
        return
    notes(speech)


def _speech(
    sound: str,
    text: str | None,
    text_file: Path | None,
    labels: Path | None,
    phone_set: str | None,
    lexicon: Path | None,
) -> Speech:
    from lipwright import pipeline

    given = [name for name, value in (("--text", text), ("--text-file", text_file),
                                      ("--labels", labels)) if value is not None]  # fmt: skip
    if len(given) > 1:
        raise click.UsageError(f"give one of {' and '.join(given)}, not both")
    if labels is not None:
        return pipeline.from_labels(labels, sound, phone_set=phone_set)
    if text_file is not None:
        text = _read_text(text_file)
    if text is None:
        with progress("recognising") as report:
            return pipeline.recognise(sound, progress=report)
    with progress("aligning") as report:
        return pipeline.align(sound, text, lexicon=lexicon, progress=report)


def _read_text(path: Path) -> str:
    from lipwright.errors import TextError
    from lipwright.files import read_bytes

    try:
        return read_bytes(path).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise TextError(
            f"byte {error.start} is not UTF-8 text", where=str(path), expected="a text in UTF-8"
        ) from None


def _check(outputs: tuple[str, ...]) -> None:
    from lipwright.export import check_outputs

    check_outputs(outputs)


def _animate(speech: Speech, outputs: tuple[str, ...], as_json: bool, how: dict[str, Any]) -> None:
    from lipwright import pipeline
    from lipwright.cli.report import tell

    how["rate"] = how.pop("frame_rate")
    performance = pipeline.animate(speech, **how)
    pipeline.save(performance, *outputs)
    tell(performance, outputs, as_json=as_json)
