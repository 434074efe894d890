"""``character build``: a face file and a plain mesh become a model that can speak."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

import click

from lipwright.cli import options


@click.command()
@click.argument("face", type=click.Path(path_type=Path), metavar="FACE.json")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), required=True, metavar="FILE",
    help="Where to: a .glb file.",
)  # fmt: skip
@options.as_json
def build(face: Path, output: Path, as_json: bool) -> None:
    """Make morph targets for a plain mesh, as a face file says.

    FACE.json names a model (.obj, .glb, .gltf or .vrm), clusters of its vertices, and how
    each expression moves them.
    """
    from lipwright.character.plain import build_face
    from lipwright.errors import InputError
    from lipwright.files import check_target, write_atomically

    if output.suffix.lower() != ".glb":
        raise InputError(f"no model format {output.suffix!r}", where=str(output), expected=".glb")
    check_target(output)
    built = build_face(face)
    write_atomically(output, built.model.to_glb())
    if as_json:
        click.echo(json.dumps({"name": built.name, "targets": [asdict(o) for o in built.losses]}))
        return
    click.echo(f"{output}: {len(built.losses)} morph targets")
    width = max(len(loss.name) for loss in built.losses)
    for loss in built.losses:
        bent = f", {1e3 * loss.with_between:.2f} with in-betweens"
        lost = f"; off its arc by up to {1e3 * loss.linear:.2f} mm" if loss.linear > 5e-6 else ""
        lost += bent if lost and loss.with_between < loss.linear else ""
        click.echo(
            f"  {loss.name:<{width}}  {loss.vertices:>6} vertices, up to "
            f"{1e3 * loss.farthest:.1f} mm{lost}"
        )
