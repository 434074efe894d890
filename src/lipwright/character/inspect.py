"""What a character is made of, for people and for programs.

Which vocabulary was found, how each control is made from it, what is missing and what
stands in, which joint turns, and how the mesh made the gains: ``lipwright character
inspect``.
"""

from __future__ import annotations

import re
import textwrap
from typing import Any

from lipwright.character.calibration import Calibration
from lipwright.character.character import Character
from lipwright.character.fitting import EXACT, MISSING, FittedControl, Fitting
from lipwright.character.rig import Rig
from lipwright.character.sources import describe_layers, inspect_layers, source_of
from lipwright.files import format_number

_WIDTH = 80


def inspect_character(character: Character) -> dict[str, Any]:
    """Return what a character is made of, as JSON values.

    Returns
    -------
    dict
        ``name``; ``vocabulary`` (or None), ``found`` and ``asked`` (its channels on the
        rig); ``controls`` (for each its ``status``, ``weights``, ``gain``, ``missing``
        and ``note``); ``limits``; ``meshes`` (their ``name`` and ``targets``);
        ``unused`` (morph targets that no control moves); ``expressions``; ``jaws``;
        ``joints`` (channels that turn one: its name, ``axis`` and ``degrees``);
        ``calibration`` (see :func:`_calibration`). Of a
        character file also ``file``, ``layers``, ``model`` and ``speech_rate``. A control's
        ``from`` names the mapping that makes it, where it is not the vocabulary's.
    """
    rig, fitting = character.read_rig(), character.fit()
    used = {target for fitted in fitting.controls.values() for target in fitted.weights}
    return {
        "name": character.name,
        "vocabulary": fitting.vocabulary or None,
        "found": fitting.found,
        "asked": fitting.asked,
        "controls": {
            name: {
                "status": fitted.status,
                "weights": fitted.weights,
                "gain": fitting.gains.get(name, 1.0),
                "missing": list(fitted.missing),
                "note": fitted.note,
                "from": source_of(character, name),
            }
            for name, fitted in fitting.controls.items()
        },
        "limits": {name: list(limits) for name, limits in fitting.limits.items()},
        "meshes": [{"name": mesh.name, "targets": list(mesh.targets)} for mesh in rig.meshes],
        "unused": [target for target in rig.targets if target not in used],
        "expressions": rig.expressions,
        "jaws": list(rig.jaws),
        "joints": {
            name: {"joint": turn.name, "axis": list(turn.axis), "degrees": turn.degrees}
            for name, turn in fitting.joints.items()
        },
        "calibration": _calibration(character.calibration()),
        **inspect_layers(character),
    }


def _calibration(found: Calibration) -> dict[str, Any]:
    """Return what was found on the mesh; shares are of the mouth's width at rest."""
    if found.mouth is None or found.rest is None:
        return {"mouth": None, "reason": found.reason}
    return {
        "mouth": {
            "width": found.mouth.width,
            "gap_at_rest": found.rest.gap,
            "upper": len(found.mouth.upper),
            "lower": len(found.mouth.lower),
        },
        "controls": {
            control: {
                "measure": each.measure,
                "wanted": each.wanted,
                "at_gain_1": each.before,
                "gain": each.gain,
                "reached": each.after,
                "note": each.note,
            }
            for control, each in found.controls.items()
        },
    }


def describe_character(character: Character) -> str:
    """Return what a character is made of, as a table of at most 80 columns."""
    rig, fitting = character.read_rig(), character.fit()
    lines = [f"{character.name}: {len(rig.targets)} morph targets on {_meshes(len(rig.meshes))}"]
    for head, text in describe_layers(character):
        lines += _wrapped(f"{head}: ", text)
    if fitting.vocabulary:
        lines.append(
            f"vocabulary: {fitting.vocabulary}, "
            f"{fitting.found} of the {fitting.asked} channels that its poses use"
        )
    else:
        lines.append("vocabulary: none that Lipwright knows; write a mapping for it")
    if fitting.controls:
        width = max(map(len, fitting.controls))
        lines.append("")
        for name, fitted in fitting.controls.items():
            lines += _row(name.ljust(width), fitted, fitting.gains.get(name, 1.0))
            source = source_of(character, name)
            lines += _wrapped(" " * (width + 14), f"(from {source})") if source else []
    else:
        lines += _wrapped("morph targets  ", ", ".join(rig.targets))
    lines += _joints(rig, fitting) + _gains(character.calibration())
    return "\n".join(lines) + "\n"


def _joints(rig: Rig, fitting: Fitting) -> list[str]:
    lines = []
    for name, turn in fitting.joints.items():
        axis = ", ".join(format_number(value, 3) for value in turn.axis)
        by = f"{format_number(turn.degrees, 3)}° about its own ({axis})"
        lines += _wrapped("joint: ", f"{turn.name!r} turns by {by} when {name!r} is 1")
    driven = {turn.name for turn in fitting.joints.values()}
    still = [name for name in rig.jaws if name not in driven]
    if still:
        lines += _wrapped("joints like a jaw (not driven): ", ", ".join(still))
    return ["", *lines] if lines else []


def _gains(found: Calibration) -> list[str]:
    if found.mouth is None or found.rest is None:
        return ["", f"calibration: none, {found.reason}; gains are as given"]
    lines = [
        "",
        f"calibration: lips at {len(found.mouth.upper)} pairs of vertices; shares of the mouth's",
        f"width at rest, where the lips are {found.rest.gap:.1%} apart:",
    ]
    for control, each in found.controls.items():
        at = "at 0.5" if control == "open" else "at 1"
        change = f"{each.measure.ljust(5)} {each.before:.1%} -> {each.after:.1%}"
        wanted = f"(wanted {each.wanted:.1%}), gain {each.gain:g}"
        lines.append(f"  {control.ljust(4)} {at.ljust(6)} {change} {wanted}")
        if each.note:
            lines += _wrapped(" " * 14, f"({each.note})")
    return lines


def _meshes(count: int) -> str:
    return "1 mesh" if count == 1 else f"{count} meshes"


def _row(name: str, fitted: FittedControl, gain: float) -> list[str]:
    made = _formula(fitted.weights) or "-"
    if gain != 1:
        made = f"{format_number(gain, 3)} × ({made})"
    head = f"  {name}  {fitted.status.ljust(8)}  "
    lines = _wrapped(head, made)
    lacks = [f"lacks {', '.join(fitted.missing)}"] if fitted.missing else []
    remarks = [*lacks, fitted.note] if fitted.note and fitted.status != EXACT else lacks
    if fitted.status == MISSING and not remarks:
        remarks = ["kept still by the mapping"]
    for remark in remarks:
        lines += _wrapped(" " * len(head), f"({remark})")
    return lines


def _formula(weights: dict[str, float]) -> str:
    """Write weights as a sum; two sides of equal weight as one term."""
    terms = []
    left = dict(weights)
    for target, weight in weights.items():
        if target not in left:
            continue
        del left[target]
        other = re.sub("Left", "Right", re.sub(r"(?<=_)L\b", "R", target))
        if other != target and left.get(other) == weight:
            del left[other]
            target = target.replace("Left", "Left/Right") if "Left" in target else f"{target}/R"
        terms.append(f"{format_number(weight, 3)} {target}")
    return " + ".join(terms).replace("+ -", "- ")


def _wrapped(head: str, text: str) -> list[str]:
    return textwrap.wrap(
        text,
        _WIDTH,
        initial_indent=head,
        subsequent_indent=" " * len(head),
        break_long_words=False,
        break_on_hyphens=False,
    )
