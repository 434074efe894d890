"""``set show`` and ``set why``: look into bigram sets (``set coverage`` is its own module)."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

import click

from lipwright.cli import options
from lipwright.cli.coverage import coverage
from lipwright.cli.fit import fit
from lipwright.cli.report import note
from lipwright.errors import InputError

if TYPE_CHECKING:
    from lipwright.animation import Animation
    from lipwright.curves import Keys
    from lipwright.engines.bigram.why import Explanation

COLUMNS = 48
BLOCKS = " ▁▂▃▄▅▆▇█"
SEEN = 0.005
CHANGED = 0.01


@click.group(name="set")
def bigram_set() -> None:
    """Look into bigram sets."""


bigram_set.add_command(coverage)
bigram_set.add_command(fit)


@bigram_set.command()
@click.argument("pair", metavar="PAIR")
@click.option("--set", "name", metavar="SET", help="The set.  [default: english]")
@options.whose
@options.as_json
def show(pair: str, name: str | None, character: str | None, as_json: bool) -> None:
    """Draw the curves of a PAIR, such as f-ah, over its 0..1."""
    from lipwright.casting import set_for
    from lipwright.engines.bigram.stand_in import stand_in
    from lipwright.phones import SILENCE, load_phone_set

    of = set_for(name, character)
    labels = tuple(pair.lower().split("-"))
    known = load_phone_set(of.phone_set).labels
    silent = labels == (SILENCE, SILENCE)
    if len(labels) != 2 or silent or any(label not in known for label in labels):
        raise InputError(
            f"{pair!r} is no pair of {name or of.name!r}",
            expected=f"two of {' '.join(known)}, such as f-ah",
        )
    key = (labels[0], labels[1])
    bigram = of.bigrams.get(key) or stand_in(of, key)
    if as_json:
        curves = {pose: keys.pairs() for pose, keys in bigram.curves.items()}
        facts = {"pair": labels, "word": bigram.word, "source": bigram.source, "curves": curves}
        click.echo(json.dumps(facts))
        return
    word = f", as in {bigram.word!r}" if bigram.word else ""
    click.echo(f"{pair} ({bigram.source}{word}), boundary at {bigram.boundary:g}")
    for pose, keys in bigram.curves.items():
        drawn = "  ".join(f"{t:g},{v:g}" for t, v in keys.pairs())
        click.echo(f"  {pose:<7}{_chart(keys)}  {drawn}")


def _chart(keys: Keys) -> str:
    import numpy as np

    values = keys.at((np.arange(COLUMNS) + 0.5) / COLUMNS)
    return "".join(BLOCKS[round(float(value) * (len(BLOCKS) - 1))] for value in values)


@bigram_set.command()
@click.argument("line", type=click.Path(path_type=Path), metavar="LINE.json")
@click.option("--time", type=float, required=True, metavar="SECONDS", help="The instant.")
@click.option("--control", metavar="NAME", help="Only this control.")
@click.option("--set", "name", metavar="SET", help="The set it was made with, if a file.")
@click.option(
    "--overrides", type=click.Path(path_type=Path), metavar="FILE", help="The same of overrides."
)
@click.option(
    "--reduction", type=click.Path(path_type=Path), metavar="FILE", help="The same of a reduction."
)
@click.option("--edits", type=click.Path(path_type=Path), metavar="FILE", help="The same of edits.")
@click.option("--character", metavar="WHO", help="Who speaks, if the file is not found again.")
@options.as_json
def why(
    line: Path,
    time: float,
    control: str | None,
    name: str | None,
    overrides: Path | None,
    reduction: Path | None,
    edits: Path | None,
    character: str | None,
    as_json: bool,
) -> None:
    """Say why the controls of an animation have their values at an instant.

    The instant is that of the nearest frame. Where a character or --overrides changed what
    the set says, both are shown.
    """
    from lipwright.animation import Animation
    from lipwright.casting import engine_for
    from lipwright.cli.cast import character_of
    from lipwright.engines.bigram import read_edits
    from lipwright.engines.bigram.why import why as explain

    animation = Animation.load(line)
    if animation.engine != "bigram":
        raise InputError(
            f"made by the engine {animation.engine!r}",
            where=str(line),
            expected="an animation of the bigram engine",
        )
    preset = str(animation.report.get("preset", "default"))
    who, own_set = character_of(animation.report, line, character)
    chosen = name or (None if own_set else _set_of(animation.report, line))
    engine = engine_for(chosen, preset, overrides, reduction, who)
    told = name is not None or character is not None
    _check_digest(engine.of.digest, animation.report, line, told=told)
    solved = engine.solve(animation.phones, animation.words, read_edits(edits) if edits else ())
    instants = animation.times
    if not instants[0] - 1 / animation.rate <= time <= instants[-1] + 1 / animation.rate:
        raise InputError(
            f"{time:g} s is outside of it",
            where=str(line),
            expected=f"{instants[0]:.3f} to {instants[-1]:.3f} s",
        )
    frame = int(abs(instants - time).argmin())
    names = [control] if control else list(animation.controls)
    found = [explain(engine, solved, one, float(instants[frame])) for one in names]
    _warn_of_changes(found, animation, frame)
    if not control:
        found = [one for one in found if one.value > SEEN or one.origins]
    _tell(found, time, as_json)


def _set_of(report: dict[str, object], line: Path) -> str:
    from lipwright.engines.bigram.set_file import built_in_sets

    name = str(report.get("set", ""))
    if name not in built_in_sets():
        raise InputError(
            f"made with the set {name!r}", where=str(line), cure="name its file with --set"
        )
    return name


def _check_digest(digest: str, report: dict[str, object], line: Path, *, told: bool) -> None:
    """Refuse to explain a line with another set than the one it was made with."""
    made_with = report.get("set_digest")
    if not made_with or made_with == digest:
        return
    found = f"made with other files of the set {report.get('set')!r}"
    cure = "name the set, its overrides if it has any, and who spoke, with --set, --overrides "
    cure += "and --character"
    if not told:
        raise InputError(found, where=str(line), cure=cure)
    note(f"{line} was {found}")


def _warn_of_changes(found: list[Explanation], animation: Animation, frame: int) -> None:
    for one in found:
        if one.control in animation.controls:
            stored = float(animation.control(one.control)[frame])
            if abs(stored - one.value) > CHANGED:
                note(
                    f"{one.control} is {stored:.3f} in the file and {one.value:.3f} now: it was "
                    f"edited, or made with another set, overrides or reduction"
                )


def _tell(found: list[Explanation], time: float, as_json: bool) -> None:
    if as_json:
        click.echo(json.dumps([asdict(one) for one in found]))
    elif not found:
        click.echo(f"at {time:g} s every control is at rest")
    else:
        click.echo("\n".join(one.text() for one in found))
