"""``neural train`` and ``neural info``: nets that hear."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from lipwright.cli import options
from lipwright.cli.report import note

if TYPE_CHECKING:
    from lipwright.engines.neural.live_model import LiveModel
    from lipwright.engines.neural.model import Model


@click.group()
def neural() -> None:
    """Nets that hear, which the neural engine plays."""


@neural.command()
@click.argument("files", nargs=-1, required=True, metavar="SOUND ANIMATION [SOUND ANIMATION]...")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), required=True, metavar="MODEL",
    help="The model's file.",
)  # fmt: skip
@click.option(
    "--hears", type=click.Choice(["whole", "live", "published"]), default="whole",
    show_default=True,
    help="With which ears: those of a model that comes with Lipwright (live can stream), or the "
    "publication's net, taught from nothing.",
)  # fmt: skip
@click.option(
    "--five", is_flag=True,
    help="Learn a, i, o/u, b/m/p and open, read off ARKit's shapes, instead of the controls.",
)  # fmt: skip
@click.option(
    "--hidden", type=click.IntRange(1, 4096), multiple=True, metavar="N",
    help="Hidden units; several times for several layers.  [default: 64; 18 as published]",
)  # fmt: skip
@click.option("--seed", type=click.IntRange(0, 2**32 - 1), default=0, help="Of the first weights.")
@click.option(
    "--time-is", type=click.Choice(["start", "middle"]),
    help="Of a CSV: whether a row's time is when its frame begins, or its instant.  "
    "[default: start for ARKit's shapes, else middle]",
)  # fmt: skip
@options.as_json
def train(
    files: tuple[str, ...],
    output: Path,
    hears: Literal["whole", "live", "published"],
    five: bool,
    hidden: tuple[int, ...],
    seed: int,
    time_is: Literal["start", "middle"] | None,
    as_json: bool,
) -> None:
    """Learn a model from SOUND and the ANIMATION that goes with it (.json or .csv).

    Any controls are learnt. Twenty seconds of one voice are enough for a first model.
    """
    from lipwright.cli.speak import keep_inputs
    from lipwright.files import check_target
    from lipwright.neural_takes import train_model

    if len(files) % 2:
        raise click.UsageError("name a sound and its animation, in pairs")
    check_target(output)
    keep_inputs([str(output)], files)
    model = train_model(
        list(zip(files[::2], files[1::2], strict=True)),
        hears=hears,
        five=five,
        hidden=hidden or None,
        seed=seed,
        time_is=time_is,
    )
    model.save(output)
    _tell(model, str(output), as_json)


@neural.command()
@click.argument("model", type=click.Path(path_type=Path), metavar="MODEL")
@options.as_json
def info(model: Path, as_json: bool) -> None:
    """Say what a model hears, what it gives, and what it was trained on."""
    from lipwright.engines.neural.built_in import load_model

    _tell(load_model(model), str(model), as_json)


def _tell(model: Model | LiveModel, path: str, as_json: bool) -> None:
    facts = _facts(model, path)
    if as_json:
        click.echo(json.dumps(facts))
        return
    about = model.about
    click.echo(
        f"{path}: {'-'.join(map(str, facts['net']))}, "
        f"{facts['frames_per_second']:g} frames per second"
    )
    click.echo(f"  gives   {', '.join(model.controls)}")
    click.echo(f"  hears   {facts['hears']}")
    how = f"{about['seconds']:g} s from {_many(about['sounds'], 'sound')}"
    if "error" in about:
        how += f"; off by {about['error']:.3f} on them (root mean square)"
    else:
        how += f", each spoilt {about.get('times', 1)} times; it comes with Lipwright"
    click.echo(f"  learnt  {how}")
    for text in about["notes"]:
        note(text)


def _facts(model: Model | LiveModel, path: str) -> dict[str, Any]:
    from lipwright.engines.neural.live_model import LiveModel

    own = _of_live(model) if isinstance(model, LiveModel) else _as_published(model)
    return {"file": path, "controls": list(model.controls), **own, **model.about}


def _as_published(model: Model) -> dict[str, Any]:
    hearing = model.hearing
    return {
        "net": list(model.network.shape),
        "frames_per_second": 1 / hearing.frame,
        "hears": f"{1000 * hearing.context:g} ms: {hearing.segments} segments of "
        f"{1000 * hearing.segment:g} ms, {hearing.areas} areas from {hearing.lowest:g} to "
        f"{hearing.highest:g} Hz ({hearing.scale})",
    }


def _of_live(model: LiveModel) -> dict[str, Any]:
    from lipwright.engines.neural.live_model import FRAME

    before = (model.net.reach + model.behind - model.ahead) * FRAME
    way = "recordings" if model.both_ways else "recordings and streams"
    return {
        "net": list(model.shape),
        "frames_per_second": 1 / FRAME,
        "hears": f"{way}: {before:.2f} s before a frame and {1000 * model.latency:g} ms after it",
        "latency": round(model.latency + FRAME, 4),
    }


def _many(count: int, what: str) -> str:
    return f"{count} {what}" if count == 1 else f"{count} {what}s"
