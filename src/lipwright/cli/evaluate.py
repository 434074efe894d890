"""``evaluate motion``: an animated mouth held against a recorded one."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from lipwright.cli import options

if TYPE_CHECKING:
    from lipwright.evaluate import Closures, Likeness, MotionReport


@click.group()
def evaluate() -> None:
    """Hold animation against recordings of real faces."""


@evaluate.command()
@click.argument("animation", type=click.Path(path_type=Path), metavar="ANIMATION")
@click.argument("recording", type=click.Path(path_type=Path), metavar="RECORDING")
@click.option(
    "--shapes", type=click.Path(path_type=Path), metavar="FILE",
    help="CSV of the same face with time and mouthPucker.",
)  # fmt: skip
@click.option(
    "--labels", type=click.Path(path_type=Path), metavar="FILE",
    help="Phone times, where the animation holds none: .TextGrid .lab .ctm .phn .json",
)  # fmt: skip
@options.as_json
def motion(
    animation: Path, recording: Path, shapes: Path | None, labels: Path | None, as_json: bool
) -> None:
    """Say how like a recorded mouth an animated one moves.

    ANIMATION is a .json of lipwright, or a .tsv of Rhubarb's; RECORDING is a .csv with time,
    lipGapInner and lipWidth.
    """
    from lipwright.pipeline import evaluate_motion

    report = evaluate_motion(
        [(animation, recording)],
        shapes=[shapes] if shapes else None,
        labels=[labels] if labels else None,
    )
    click.echo(json.dumps(asdict(report)) if as_json else _text(report))


def _text(report: MotionReport) -> str:
    rows = [
        ("lag", f"the recorded face moves {report.lag_ms:+g} ms later"),
        ("opening", _likeness(report.opening)),
        ("rounding", _likeness(report.rounding)),
    ]
    if report.pucker is not None:
        rows.append(("pucker", _likeness(report.pucker)))
    peaks = report.peaks
    if peaks.median_ms is not None:
        met = f"{peaks.met:.0%} of {peaks.recorded} met, {peaks.median_ms:.0f} ms apart"
        rows.append(("peaks", met))
    rows += [(kind, _closures(found)) for kind, found in report.closures.items()]
    if report.silence is not None:
        speeds = f"{report.silence.animation:.2f} ranges/s, recorded {report.silence.recording:.2f}"
        rows.append(("silence", speeds))
    turns = f"{report.turns.animation:.2f} changes of direction/s"
    rows.append(
        (
            "turns",
            f"{turns}, recorded {report.turns.recording:.2f} (from {report.turn_share:.0%})",
        )
    )
    return "\n".join(f"{name:<10}{text}" for name, text in rows)


def _likeness(found: Likeness) -> str:
    return f"correlation {found.correlation:.2f}, rms {found.rms:.0%} of the range"


def _closures(found: Closures) -> str:
    if found.met is None:
        return f"{found.phones} phones, the recorded face is closed at none"
    text = f"{found.met:.0%} of {found.recorded} recorded closures met"
    if found.median_ms is not None:
        text += f", {found.median_ms:.0f} ms apart"
    if found.own_met is not None:
        text += f"; of {found.own} of its own the face has {found.own_met:.0%}"
    return text
