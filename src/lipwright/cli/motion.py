"""``motion build``, ``motion add`` and ``motion info``: databases of recorded motion."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from lipwright.cli import options
from lipwright.cli.progress import progress
from lipwright.cli.report import note

if TYPE_CHECKING:
    from lipwright.motion_takes import TakeReport

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
    click.option(
        "--report", type=click.Path(path_type=Path), metavar="FILE.csv",
        help="A table of what became of each take.",
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
def build(takes: Path, database: Path, report: Path | None, as_json: bool, **how: Any) -> None:
    """Build a database from a folder of recordings.

    TAKES holds motion (NAME.csv of blendshapes, NAME.c3d of markers) and beside it by name
    sound and words (NAME.txt, or --text), or labels; sound alone with --by-ear. A run that was
    stopped is gone on with.
    """
    _build(takes, database, report, as_json, **how)


@motion.command()
@click.argument("takes", type=click.Path(path_type=Path), metavar="TAKES")
@click.argument("database", type=click.Path(path_type=Path), metavar="DB")
@_reading
def add(takes: Path, database: Path, report: Path | None, as_json: bool, **how: Any) -> None:
    """Add a folder of recordings to a database."""
    _build(takes, database, report, as_json, add=True, **how)


def _build(takes: Path, database: Path, report: Path | None, as_json: bool, **how: Any) -> None:
    from lipwright.files import check_target, write_atomically
    from lipwright.motion_takes import build_motion

    if report is not None:
        check_target(report)
    with progress("reading takes") as show:
        built = build_motion(takes, database, progress=show, **how)
    if report is not None:
        write_atomically(report, _table(built.reports))
    if as_json:
        click.echo(json.dumps(asdict(built)))
        return
    click.echo(f"{database}: {built.takes} takes{_kept(built.reports)}")
    for text in built.notes:
        note(text)
    for text in built.refused:
        note(f"left out: {text}")


def _kept(reports: Sequence[TakeReport]) -> str:
    """Say how much of their variance is kept, and of which take least."""
    used = [one for one in reports if not one.refused]
    if not used:
        return ""
    least = min(used, key=lambda one: one.variance)
    seconds = sum(one.seconds for one in used)
    mean = sum(one.variance * one.seconds for one in used) / seconds
    return (
        f" ({seconds / 60:.1f} min, {100 * mean:.1f} % of their variance kept; "
        f"least of {least.name}: {100 * least.variance:.1f} %)"
    )


def _table(reports: Sequence[TakeReport]) -> bytes:
    """Return reports as a table, a row for each take."""
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\r\n")
    writer.writerow(("take", "used", "seconds", "phones", "gaps", "variance", "notes"))
    for one in reports:
        notes = one.refused or "; ".join(one.notes)
        figures = (one.seconds, one.phones, one.gaps, one.variance)
        writer.writerow((one.name, "no" if one.refused else "yes", *figures, notes))
    return text.getvalue().encode()


@motion.command()
@click.argument("database", type=click.Path(path_type=Path), metavar="DB")
@click.option("--picture", type=click.Path(path_type=Path), metavar="FILE.svg", help="Draw it.")
@options.as_json
def info(database: Path, picture: Path | None, as_json: bool) -> None:
    """Say what a database holds, and what is thin in it."""
    from lipwright.cli.motion_info import told
    from lipwright.engines.motion.database import open_database
    from lipwright.engines.motion.info import info as count
    from lipwright.engines.motion.info_picture import write_picture
    from lipwright.engines.motion.synthetic import database_folder
    from lipwright.files import check_picture

    if picture is not None:
        check_picture(picture)
    held = open_database(database_folder(database))
    found = count(held)
    if picture is not None:
        write_picture(picture, held, str(database))
    if as_json:
        click.echo(json.dumps(asdict(found)))
        return
    click.echo(told(str(database), held, found))
    if picture is not None:
        click.echo(f"  {picture}  (picture)")
    if held.about:
        note(held.about)


@motion.command()
@click.argument("database", type=click.Path(path_type=Path), metavar="DB")
@click.option(
    "--character", default="head", show_default=True, metavar="WHO",
    help="head, a character file, or a .glb, .vrm or .gltf file.",
)  # fmt: skip
@click.option(
    "--pins", type=click.Path(path_type=Path), metavar="FILE",
    help="A marker file with what is known already: its pins are kept.",
)  # fmt: skip
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), required=True, metavar="FILE.json",
    help="The marker file to write, to be looked at and changed.",
)  # fmt: skip
def bind(database: Path, character: str, pins: Path | None, output: Path) -> None:
    """Lay the markers of a database onto a character's face.

    The file that is written says where each marker lies on the model. Move one under "pins"
    and give the file to 'animate' with --markers.
    """
    from lipwright.acting import bind_markers
    from lipwright.cli.speak import keep_inputs
    from lipwright.files import check_target

    check_target(output)
    keep_inputs([str(output)], [character] if Path(character).is_file() else [])
    binding = bind_markers(database, character, pins)
    binding.file.write(output)
    click.echo(f"{output}: {binding.note}")
