"""``motion build``, ``motion add`` and ``motion info``: databases of recorded motion."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lipwright.cli import options
from lipwright.cli.progress import progress
from lipwright.cli.report import note

if TYPE_CHECKING:
    from lipwright.engines.motion.info import Info

SHOWN = 12

_reading = options.stack(
    click.option(
        "--text", "texts", type=click.Path(path_type=Path), metavar="FILE",
        help="A table (CSV) of take names and what is said.",
    ),
    click.option(
        "--language", default="en-us", show_default=True, help="That is spoken in the takes."
    ),
    click.option(
        "--by-ear", is_flag=True, help="Use takes without words too: their phones are heard.",
    ),
    click.option(
        "--workers", type=click.IntRange(1), metavar="N",
        help="Takes at once; one for each processor by default.",
    ),
    options.as_json,
)  # fmt: skip


@click.group()
def motion() -> None:
    """Databases of recorded motion, which the motion engine searches."""


@motion.command()
@click.argument("takes", type=click.Path(path_type=Path), metavar="TAKES")
@click.option(
    "-o",
    "--output",
    "database",
    type=click.Path(path_type=Path),
    required=True,
    metavar="DB",
    help="The folder of the database.",
)
@click.option(
    "--clusters", type=click.IntRange(0), default=0, metavar="N",
    help="Merge units of like motion into so many nodes.",
)  # fmt: skip
@_reading
def build(takes: Path, database: Path, as_json: bool, **how: Any) -> None:
    """Build a database from a folder of recordings.

    TAKES holds motion (NAME.csv of blendshapes, NAME.c3d of markers) and beside it by name
    sound and words (NAME.txt, or --text), or labels; sound alone with --by-ear. A run that was
    stopped is gone on with.
    """
    _build(takes, database, as_json, **how)


@motion.command()
@click.argument("takes", type=click.Path(path_type=Path), metavar="TAKES")
@click.argument("database", type=click.Path(path_type=Path), metavar="DB")
@_reading
def add(takes: Path, database: Path, as_json: bool, **how: Any) -> None:
    """Add a folder of recordings to a database."""
    _build(takes, database, as_json, add=True, **how)


def _build(takes: Path, database: Path, as_json: bool, **how: Any) -> None:
    from lipwright.motion_takes import build_motion

    with progress("reading takes") as report:
        built = build_motion(takes, database, progress=report, **how)
    if as_json:
        click.echo(json.dumps(asdict(built)))
        return
    click.echo(f"{database}: {built.takes} takes")
    for text in built.notes:
        note(text)
    for text in built.refused:
        note(f"left out: {text}")


@motion.command()
@click.argument("database", type=click.Path(path_type=Path), metavar="DB")
@options.as_json
def info(database: Path, as_json: bool) -> None:
    """Say what a database holds, and what is thin in it."""
    from lipwright.engines.motion.database import open_database
    from lipwright.engines.motion.info import info as count

    found = count(open_database(database))
    if as_json:
        click.echo(json.dumps(asdict(found)))
        return
    click.echo(_text(database, found))


def _text(database: Path, found: Info) -> str:
    phones = list(found.units_per_phone.items())
    most = "  ".join(f"{label} {count}" for label, count in phones[:SHOWN])
    kept = [f"{100 * share:.1f} %" for share in found.variance]
    lines = [
        f"{database}: {found.takes} takes ({found.takes_with_sound} with sound), "
        f"{found.minutes:.1f} minutes, {found.frames} frames",
        f"units: {found.units} of {len(phones)} phones, {found.nodes} nodes in the graph",
        f"most: {most}",
        f"pairs of phones: {found.bigrams.different} of {found.bigrams.possible}; "
        f"threes: {found.trigrams.different} of {found.trigrams.possible}",
        f"variance of {len(kept)} components: {' '.join(kept)}",
    ]
    if found.thin:
        lines.append(f"thin: {' '.join(found.thin)}")
    return "\n".join(lines)
