"""``studio``: the editor of sets and lines, in the browser."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from lipwright.errors import InputError


@click.command()
@click.argument("names", nargs=-1, metavar="[SET OR LINE]...")
@click.option("--say", metavar="TEXT", help="A text to begin with, spoken.")
@click.option("--text", metavar="WORDS", help="What is said in the sound that is named.")
@click.option(
    "--labels",
    type=click.Path(path_type=Path),
    metavar="FILE",
    help="Phone times of the sound that is named.",
)
@click.option(
    "--language", default="en-us", show_default=True, help="What --say and --text are in."
)
@click.option(
    "--character",
    default="",
    metavar="WHO",
    help="head, crab, a character file (.json), or a .glb, .vrm or .gltf file.",
)
@click.option(
    "--preset",
    default="default",
    show_default=True,
    help="The set's settings: default, published, or one of its own.",
)
@click.option(
    "--model",
    type=click.Path(path_type=Path),
    metavar="MODEL",
    help="What the neural engine has learnt, to hold lines beside it.",
)
@click.option("--port", type=click.IntRange(0, 65535), help="Where to listen.  [default: free]")
@click.option("--no-browser", is_flag=True, help="Print the link, and open no page.")
def studio(
    names: tuple[str, ...],
    say: str | None,
    text: str | None,
    labels: Path | None,
    language: str,
    character: str,
    preset: str,
    model: Path | None,
    port: int | None,
    no_browser: bool,
) -> None:
    """Open the editor of bigram sets and lines in the browser.

    Name what is to be open, in any order: a set (english, mandarin, crab, or a .json file),
    overrides, a character, sounds (the words in a .txt or labels beside them are found),
    labels, animations, edits, or a folder of sounds. Without names it is the English set.
    Nothing is written before you save in the page, and have seen what changes.
    """  # fmt: skip
    from lipwright.studio.opening import Given, sort_names
    from lipwright.studio.running import run

    for option, given in (("--text", text), ("--labels", labels)):
        if given and len(sort_names(Given(names)).sounds) != 1:
            raise click.UsageError(f"{option} goes with one sound")
    if labels is not None and text is not None:
        raise click.UsageError("give one of --text and --labels, not both")
    if say is not None and not say.strip():
        raise InputError("no words to say", where="--say", expected="a text")
    run(
        Given(
            names,
            character,
            preset,
            text or "",
            str(labels) if labels else "",
            language,
            say or "",
            str(model) if model else "",
        ),
        port,
        browser=not no_browser,
        told=click.echo,
        note=_note,
    )


def _note(text: str) -> None:
    """Say what is worked on, where somebody looks on."""
    if sys.stderr.isatty():
        click.echo(text, err=True)
