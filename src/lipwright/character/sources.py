"""Where each thing of a character comes from: its base, its file, or the user's mapping."""

from __future__ import annotations

from typing import Any

from lipwright.character.character import BUILT_IN, Character
from lipwright.character.character_file import OWN_PLACES


def source_of(character: Character, control: str) -> str:
    """Return the file that makes a control, and the one that says its gain.

    Nothing where both are the vocabulary's own.
    """
    made = [_file(place) for one, place in character.mappings if control in one.controls]
    gain = [_file(place) for one, place in character.mappings if control in one.gains]
    if not gain or (made and made[-1] == gain[-1]):
        return made[-1] if made else ""
    return f"{made[-1]}; gain from {gain[-1]}" if made else f"its vocabulary; gain from {gain[-1]}"


def _file(place: str) -> str:
    for end in OWN_PLACES:
        place = place.removesuffix(f", {end}")
    return place


def inspect_layers(character: Character) -> dict[str, Any]:
    """Return a character file's layers as JSON values; nothing for a model by itself."""
    file = character.file
    if file is None:
        return {}
    layers = [
        {"name": layer.name, "file": layer.path, "about": layer.about, "base": layer.base}
        for layer in file.layers
    ]
    model, model_from = file.model
    limits = {channel: _file(place) for one, place in character.mappings for channel in one.limits}
    return {
        "file": file.path,
        "layers": layers,
        "model": {"name": model, "from": model_from},
        "limits_from": limits,
        "speech_rate": list(file.rate) if file.rate else None,
    }


def describe_layers(character: Character) -> list[tuple[str, str]]:
    """Return a character file's layers as headed lines for people."""
    file = character.file
    if file is None:
        return []
    beneath = [f"{file.built_in} (built in)"] if file.built_in else []
    chain = [*beneath, *(f"{layer.path} ({layer.name})" for layer in file.layers)]
    model, model_from = file.model
    built_in = "built in" if model in BUILT_IN else f"named by {model_from}"
    lines = [("layers", ", then ".join(chain)), ("model", f"{model} ({built_in})")]
    if file.layers[-1].about:
        lines.append(("about", file.layers[-1].about))
    if file.rate:
        lines.append(("speech", f"{file.rate[0]:g} to {file.rate[1]:g} words per minute"))
    limits = {
        channel: f"{channel} {low:g} to {high:g} ({_file(place)})"
        for one, place in character.mappings
        for channel, (low, high) in one.limits.items()
    }
    if limits:
        lines.append(("limits", ", ".join(limits.values())))
    return lines
