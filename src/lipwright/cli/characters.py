"""``character inspect``: what a rig has, how it is mapped, and what is missing."""

from __future__ import annotations

import json
from pathlib import Path

import click

from lipwright.cli import options
from lipwright.cli.faces import build


@click.group()
def character() -> None:
    """Look into characters and their rigs."""


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
@options.as_json
def inspect(model: str, mapping: Path | None, write: Path | None, as_json: bool) -> None:
    """Say what the rig of MODEL has and how each pose is made from it.

    MODEL is head, or a .glb, .vrm or .gltf file.
    """
    from lipwright.character import describe_character, inspect_character, load_character

    loaded = load_character(model, mapping=mapping)
    if write is not None:
        loaded.write_mapping(write)
    if as_json:
        click.echo(json.dumps(inspect_character(loaded), indent=1))
    else:
        click.echo(describe_character(loaded))
        if write is not None:
            click.echo(f"\nwritten: {write}")
