"""``set fit``: a bigram set from recorded faces."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from lipwright.cli import options
from lipwright.cli.progress import progress
from lipwright.errors import InputError

if TYPE_CHECKING:
    from lipwright.engines.bigram.fit import FitReport


@click.command()
@click.argument("takes", type=click.Path(path_type=Path), metavar="TAKES")
@click.option("-o", "--output", required=True, metavar="SET.json", help="The set to write.")
@click.option(
    "--text", type=click.Path(path_type=Path), metavar="FILE",
    help="CSV: a take's name, and what is said in it in the column 'text'.",
)  # fmt: skip
@click.option(
    "--base", default="english", show_default=True, metavar="SET",
    help="Gives the rules, the closures, and what no take shows.",
)  # fmt: skip
@click.option("--name", metavar="NAME", help="The new set's name; else the file's.")
@click.option("--as-scored", is_flag=True, help="Take scores as they are: do not mend a tracker's.")
@options.as_json
def fit(
    takes: Path,
    output: str,
    text: Path | None,
    base: str,
    name: str | None,
    as_scored: bool,
    as_json: bool,
) -> None:
    """Learn the curves of a set from recorded faces.

    TAKES is a folder of tables of ARKit's shapes over time, each with its sound and words or
    its labels beside it by name; or a motion database.
    """
    from lipwright.engines.bigram.set_file import set_bytes
    from lipwright.files import check_target, write_atomically
    from lipwright.pipeline import fit_set

    if Path(output).suffix.lower() != ".json":
        raise InputError(f"cannot write {output!r}", expected="a name that ends in .json")
    check_target(output)
    with progress("fitting") as show:
        made, report = fit_set(
            takes, text=text, base=base, name=name or Path(output).stem,
            as_scored=as_scored, progress=show,
        )  # fmt: skip
    write_atomically(output, set_bytes(made))
    click.echo(json.dumps(asdict(report)) if as_json else _text(report, output))


def _text(report: FitReport, output: str) -> str:
    poses = ", ".join(f"{pose} {rms:.3f}" for pose, rms in report.fitted.items())
    return "\n".join(
        [
            f"wrote {output}: {report.takes} takes, {report.minutes:.1f} min",
            f"pairs     {report.measured} from takes, {report.from_phones} from their phones' "
            f"own levels, {report.kept} as in the base set",
            f"left over {poses} (rms, in weights)",
            f"as in the base set: {', '.join(report.base_poses)}",
        ]
    )
