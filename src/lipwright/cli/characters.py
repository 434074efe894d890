"""``character``: what a rig has and how it is mapped; a character file to start from."""

from __future__ import annotations

import json
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING

import click

from lipwright.cli import options
from lipwright.cli.faces import build

if TYPE_CHECKING:
    from lipwright.engines.bigram import BigramSet

WIDTH = 80


@click.group()
def character() -> None:
    """Look into characters and their rigs; start a character file."""


character.add_command(build)


@character.command()
@click.argument("model", metavar="MODEL")
@click.option(
    "--mapping", type=click.Path(path_type=Path), metavar="FILE",
    help="Use this mapping instead of the one that fits best.",
)  # fmt: skip
@click.option(
    "--write", type=click.Path(path_type=Path), metavar="FILE",
    help="Write the mapping to a file, to be edited and given with --mapping.",
)  # fmt: skip
@click.option(
    "--picture", type=click.Path(path_type=Path), metavar="FILE.svg",
    help="Draw the mouth with the vertices that were taken for lips and corners.",
)  # fmt: skip
@options.as_json
def inspect(
    model: str, mapping: Path | None, write: Path | None, picture: Path | None, as_json: bool
) -> None:
    """Say what the rig of MODEL has and how each pose is made from it.

    MODEL is head, crab, a character file (.json), or a .glb, .vrm or .gltf file. Of a
    character file it says which of its layers each thing comes from. Of a character of
    pictures, such as rhubarb, it lists the mouth shapes and what each is for.
    """
    from lipwright.casting import engine_for, files_read
    from lipwright.character import load_character
    from lipwright.character.inspect import describe_character, inspect_character
    from lipwright.character.pictures import is_pictures
    from lipwright.cli.speak import keep_inputs
    from lipwright.files import write_atomically

    written = [str(path) for path in (write, picture) if path is not None]
    if is_pictures(model):
        _inspect_pictures(model, mapping, written, as_json=as_json)
        return
    keep_inputs(written, (mapping, *files_read(model)))
    loaded = load_character(model, mapping=mapping)
    drawn = loaded.picture() if picture is not None else ""
    drawn_for = loaded.file is not None or loaded.bigram_set
    of = engine_for(character=model).of if drawn_for else None
    if write is not None:
        loaded.write_mapping(write)
    if picture is not None:
        write_atomically(picture, drawn.encode())
    if as_json:
        facts = inspect_character(loaded)
        click.echo(json.dumps({**facts, **(_set_facts(of) if of else {})}, indent=1))
    else:
        click.echo(describe_character(loaded))
        if of is not None:
            click.echo(_set_text(of))
        if written:
            click.echo(f"\nwritten: {', '.join(written)}")


def _inspect_pictures(
    model: str, mapping: Path | None, written: list[str], *, as_json: bool
) -> None:
    from lipwright.character.pictures import describe_pictures, inspect_pictures, load_pictures
    from lipwright.errors import CharacterError

    if mapping is not None or written:
        raise CharacterError(
            "a character of pictures has neither a mapping nor a mesh",
            where=model,
            cure="leave --mapping, --write and --picture out",
        )
    shapes = load_pictures(model)
    if as_json:
        click.echo(json.dumps(inspect_pictures(shapes), indent=1, ensure_ascii=False))
    else:
        click.echo(describe_pictures(shapes))


def _set_facts(of: BigramSet) -> dict[str, object]:
    changes = [
        {"name": layer.name, "character": layer.character, "where": layer.where}
        | {"changes": layer.summary(), "pairs": sorted("-".join(pair) for pair in layer.pairs)}
        for layer in of.layers
    ]
    return {"set": of.name, "overrides": changes}


def _set_text(of: BigramSet) -> str:
    lines = [f"set: {of.name}" + ("" if of.layers else ", nothing overridden")]
    for layer in of.layers:
        lines += textwrap.wrap(
            f"{layer.summary()} ({layer.where})",
            WIDTH,
            initial_indent="  overrides  ",
            subsequent_indent=" " * 13,
            break_long_words=False,
            break_on_hyphens=False,
        )
    return "\n".join(lines)


@character.command()
@click.argument("path", type=click.Path(path_type=Path), metavar="NAME.json")
@click.option("--model", metavar="MODEL", help="head, or a .glb, .vrm or .gltf file.")
@click.option("--base", metavar="WHO", help="A character to start from: head, or a file.")
@click.option("--set", "bigram_set", metavar="SET", help="The bigram set it is drawn for.")
def new(path: Path, model: str | None, base: str | None, bigram_set: str | None) -> None:
    """Write a character file to start from; it is then edited.

    With --model it holds how each pose is made on the model; with --base it differs in
    nothing yet.
    """
    from lipwright.casting import engine_for
    from lipwright.character.start_file import start_character

    if model is None and base is None:
        raise click.UsageError("give --model, --base, or both")
    if bigram_set is not None:
        # Refused before anything is written: the base may not suit the set.
        engine_for(bigram_set, character=base or "head")
    start_character(path, model, base, bigram_set)
    click.echo(f"written: {path}; edit it, and give it with --character {path}")
