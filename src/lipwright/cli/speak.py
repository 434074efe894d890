"""``say``, ``animate`` and ``phones``: from text, sound or labels to files."""

from __future__ import annotations

import os
import re
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from lipwright.cli import options
from lipwright.cli.options import Recording
from lipwright.cli.progress import progress
from lipwright.errors import InputError, LipwrightError
from lipwright.files import STANDARD_STREAM, decode_text, read_bytes, read_standard_input
from lipwright.sound import is_own_wav
from lipwright.speech import Speech


def _list_voices(ctx: click.Context, param: click.Parameter, value: bool) -> None:
    if not value:
        return
    from lipwright.schedule.say import voices

    for voice in voices():
        click.echo(f"{voice.language:<16}{voice.name}")
    ctx.exit()


@click.command()
@click.argument("text", metavar="TEXT")
@options.outputs(
    "Where to: .json .csv .c3d .glb .html .wav .tsv .xml .rhubarb.json .dat, or -. May be repeated."
)
@click.option("--voice", default="en-us", show_default=True, help="Language or voice.")
@click.option(
    "--speed", type=float, default=175.0, show_default=True, metavar="WPM", help="Words per minute."
)
@click.option(
    "--voices",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_list_voices,
    help="List the voices, and leave.",
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
    from lipwright.casting import engine_for

    files = _with_sound(outputs)
    _check(files, how)
    if text == STANDARD_STREAM:
        text = decode_text(read_standard_input(), "standard input")
    of = [how[name] for name in ("bigram_set", "preset", "overrides", "reduction", "character")]
    with _meanwhile(engine_for, *of, voice):
        speech = pipeline.say(
            text, voice=voice, rate=speed, pitch=pitch, character=how["character"]
        )
    _animate(speech, files, as_json, how)


@contextmanager
def _meanwhile(work: Callable[..., object], *arguments: object) -> Iterator[None]:
    """Do what will be needed while a child process speaks; its errors come up when it is used."""

    def quietly() -> None:
        with suppress(LipwrightError):
            work(*arguments)

    thread = threading.Thread(target=quietly, daemon=True)
    thread.start()
    yield
    thread.join()


def _with_sound(outputs: tuple[str, ...]) -> tuple[str, ...]:
    """Add the sound beside the first output, unless someone else's sound lies there."""
    suffixes = {Path(path).suffix.lower() for path in outputs}
    from lipwright.export import sound_beside

    without = (".json", ".csv", ".c3d", ".glb", ".tsv", ".xml", ".dat")
    silent = [p for p in outputs if Path(p).suffix.lower() in without]
    if not silent or ".wav" in suffixes:
        return outputs
    sound = sound_beside(silent[0])
    if sound.exists() and not is_own_wav(read_bytes(sound)):
        raise InputError(
            "exists, and is not a sound that Lipwright made",
            where=str(sound),
            cure="name another file for the sound with -o, or move this one",
        )
    return (*outputs, str(sound))


@click.command()
@options.recording
@options.outputs(
    "Where to: .json .csv .c3d .glb .html .wav .tsv .xml .rhubarb.json .dat, or -. May be repeated."
)
@options.animation
@options.as_json
def animate(
    recording: Recording,
    outputs: tuple[str, ...],
    as_json: bool,
    **how: Any,
) -> None:
    """Animate the recording SOUND.

    With --text its words are put in time, in any --language; with --labels phone times are
    taken as they are; with neither the words are recognised (English), or with --by-ear
    phones are heard without words, in any language. The neural engine needs neither, nor
    does auto.
    """
    _check(outputs, how, *recording.files)
    speech = _speech(recording, by_sound=how["engine"] in ("neural", "auto"))
    _animate(speech, outputs, as_json, how, Path(recording.sound).name)


@click.command()
@options.recording
@options.outputs("Where to: .TextGrid .lab .ctm .phn .json. May be repeated.")
@options.as_json
def phones(
    recording: Recording,
    outputs: tuple[str, ...],
    as_json: bool,
) -> None:
    """Say when each phone and word of the recording SOUND sounds."""
    from lipwright import pipeline
    from lipwright.cli.report import tell_labels

    pipeline.check_labels(*outputs)
    keep_inputs(outputs, recording.files)
    speech = _speech(recording)
    pipeline.save_labels(speech, *outputs)
    tell_labels(speech, outputs, as_json=as_json)


def _speech(given: Recording, *, by_sound: bool = False) -> Speech:
    from lipwright import pipeline

    ways = {"--text": given.text, "--text-file": given.text_file, "--labels": given.labels}
    named = [name for name, value in ways.items() if value is not None]
    if len(named) > 1:
        raise click.UsageError(f"give one of {' and '.join(named)}, not both")
    if given.by_ear:
        return _by_ear(given, named)
    if given.language is not None and (given.labels is not None or not named):
        raise click.UsageError(
            "--language goes with --text or --text-file: what is said is recognised in English only"
        )
    if given.labels is not None:
        return pipeline.from_labels(given.labels, given.sound, phone_set=given.phone_set)
    text = read_text(given.text_file) if given.text_file is not None else given.text
    if text is None and by_sound:
        return pipeline.sound_alone(given.sound)
    if text is None:
        with progress("recognising") as report:
            return pipeline.recognise(given.sound, progress=report)
    with progress("aligning") as report:
        return pipeline.align(
            given.sound,
            text,
            language=given.language or "en-us",
            lexicon=given.lexicon,
            progress=report,
        )


def _by_ear(given: Recording, named: list[str]) -> Speech:
    from lipwright import pipeline

    others = {"--language": given.language, "--lexicon": given.lexicon}
    others["--phone-set"] = given.phone_set
    if strange := [*named, *(name for name, value in others.items() if value is not None)]:
        raise click.UsageError(f"--by-ear needs no words: it does not go with {strange[0]}")
    with progress("listening") as report:
        return pipeline.hear(given.sound, progress=report)


def read_text(path: Path) -> str:
    """Return the text in a file."""
    return decode_text(read_bytes(path), str(path))


def _check(outputs: tuple[str, ...], how: dict[str, Any], *inputs: object) -> None:
    from lipwright.casting import files_read
    from lipwright.export import check_outputs, suffix_of

    check_outputs(outputs)
    if ".glb" in map(suffix_of, outputs):
        from lipwright.character.pictures import is_pictures, load_pictures

        if is_pictures(how["character"]):
            load_pictures(how["character"]).no_model()
    names = ("overrides", "reduction", "edits", "mapping", "markers", "pictures", "model")
    read = files_read(how["character"], how["bigram_set"])
    keep_inputs(outputs, (*inputs, *read, *(how[name] for name in names)))


def keep_inputs(outputs: Iterable[str], inputs: Iterable[object]) -> None:
    """Refuse to write over what the command reads."""
    read = {os.path.realpath(str(path)) for path in inputs if path and Path(str(path)).is_file()}
    for path in outputs:
        if path != STANDARD_STREAM and os.path.realpath(path) in read:
            raise InputError("would be written over its own input", where=path, cure="rename one")


def _animate(
    speech: Speech,
    outputs: tuple[str, ...],
    as_json: bool,
    how: dict[str, Any],
    sound_file: str = "",
) -> None:
    from lipwright import pipeline
    from lipwright.cli.report import tell

    how["rate"] = how.pop("frame_rate")
    how["without"] = tuple(filter(None, re.split(r"[,\s]+", how["without"] or "")))
    performance = pipeline.animate(speech, **how)
    performance = replace(performance, sound_file=sound_file)
    pipeline.save(performance, *outputs)
    tell(performance, outputs, as_json=as_json)
