"""In-between targets: what a morph target's straight line loses of a rotation.

A target named ``open@50`` holds by how much ``open`` at the intensity 0.5 differs from half
of its target. Its weight is 1 there and falls to 0 at the next in-between, at 0 and at 1:
the corrections are interpolated. Any model may have such targets; whoever drives ``open``
drives them, too. glTF itself knows no in-betweens.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from lipwright.animation import Animation
from lipwright.character.face_model import Move, displacement
from lipwright.curves import Floats

_NAME = re.compile(r"(.+)@(\d{1,2}(?:\.\d+)?)")


def between_name(target: str, intensity: float) -> str:
    """Return the name of an in-between.

    Examples
    --------
    >>> between_name("open", 0.5)
    'open@50'
    """
    return f"{target}@{100 * intensity:g}"


def betweens(targets: Iterable[str]) -> dict[str, list[float]]:
    """Return, for each target that has in-betweens, their intensities, rising.

    Examples
    --------
    >>> betweens(["open", "open@50", "open@25", "W"])
    {'open': [0.25, 0.5]}
    """
    names = set(targets)
    found: dict[str, list[float]] = {}
    for name in names:
        match = _NAME.fullmatch(name)
        if not match or match[1] not in names:
            continue
        step = float(match[2]) / 100
        # Of two spellings of one number, open@50 and open@50.0, only the first is one.
        if step > 0 and name == between_name(match[1], step):
            found.setdefault(match[1], []).append(step)
    return {name: sorted(steps) for name, steps in sorted(found.items())}


def between_names(targets: Iterable[str]) -> frozenset[str]:
    """Return which of some targets are in-betweens of others."""
    found = betweens(targets)
    return frozenset(between_name(name, step) for name, steps in found.items() for step in steps)


def corrections(whole: Floats, bent: Sequence[Floats], steps: Sequence[float]) -> list[Floats]:
    """Return what each in-between holds.

    Parameters
    ----------
    whole : (V, 3), metres
        The displacement at intensity 1.
    bent : sequence of (V, 3)
        The true displacements at ``steps``.
    steps : sequence of float
    """
    return [true - step * whole for true, step in zip(bent, steps, strict=True)]


def morph_targets(
    points: Floats,
    moves: Mapping[str, Sequence[Move]],
    between: Mapping[str, Sequence[float]],
) -> dict[str, Floats]:
    """Return the targets of expressions and of their in-betweens.

    Parameters
    ----------
    points : (V, 3) float64, metres
        The neutral face.
    moves : mapping of str to sequence of Move
    between : mapping of str to sequence of float
        Intensities at which an expression gets an in-between.

    Returns
    -------
    dict of str to (V, 3) float64, metres
    """
    targets: dict[str, Floats] = {}
    for name, own in moves.items():
        targets[name] = displacement(points, own)
        steps = between.get(name, ())
        bent = [displacement(points, own, step) for step in steps]
        for step, held in zip(steps, corrections(targets[name], bent, steps), strict=True):
            targets[between_name(name, step)] = held
    return targets


def hats(values: Floats, steps: Sequence[float]) -> list[Floats]:
    """Return the weight of each in-between where its target has these values.

    Examples
    --------
    >>> [weight.tolist() for weight in hats(np.array([0.25, 0.5, 0.75]), [0.5])]
    [[0.5, 1.0, 0.5]]
    """
    knots = [0.0, *steps, 1.0]
    return [np.interp(values, knots, row) for row in np.eye(len(knots))[1:-1]]


def between_values(values: Mapping[str, float], targets: Iterable[str]) -> dict[str, float]:
    """Return the weights of the in-betweens of some targets, at one instant.

    Examples
    --------
    >>> between_values({"open": 0.25, "W": 1.0}, ["open", "open@50", "W"])
    {'open@50': 0.5}
    """
    found = {}
    for name, steps in betweens(targets).items():
        if name in values:
            weights = hats(np.array([values[name]]), steps)
            for step, weight in zip(steps, weights, strict=True):
                found[between_name(name, step)] = float(weight[0])
    return found


def with_betweens(animation: Animation, targets: Iterable[str]) -> Animation:
    """Return an animation of morph targets with that of their in-betweens.

    Parameters
    ----------
    animation : Animation
        Its controls are morph targets.
    targets : iterable of str
        All targets of the model.
    """
    added: dict[str, Floats] = {}
    for name, steps in betweens(targets).items():
        if name not in animation.controls:
            continue
        for step, weight in zip(
            steps, hats(animation.control(name).astype(np.float64), steps), strict=True
        ):
            added[between_name(name, step)] = weight
    if not added:
        return animation
    columns = np.stack(list(added.values()), axis=1).astype(np.float32)
    return replace(
        animation,
        controls=(*animation.controls, *added),
        values=np.concatenate((animation.values, columns), axis=1),
    )
