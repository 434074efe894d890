"""A page of its own: one HTML file that plays a performance in any browser, from disk.

A character of pictures has a page of its own: :mod:`lipwright.export.pictures_page`.

It holds the player (the client in ``web/``, built into ``player.html`` beside this module),
the animation, the model and the sound. It asks for nothing else: no server, no network.

Lossy: frames are rounded to four decimals, sound is 16 bit (of at most 48 kHz; 24 kHz when
longer than two minutes), the curves' keys are left out, and so are the model's morph targets
that this line does not move. What the animation has to report is
in the page, to be read there.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Collection
from importlib import resources
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.errors import CharacterError, LipwrightError
from lipwright.gltf import Gltf, keep_morphs, morph_meshes, parse_glb
from lipwright.performance import JointTurn, Performance
from lipwright.sound import Sound
from lipwright.timeline import Tier

SUFFIXES = (".html",)

_PLACE = "<!-- lipwright:data -->"
_DIGITS = 4
_LONG = 120.0
# The rates that every browser has to play (Web Audio API, AudioBuffer).
_LOWEST_RATE, _HIGHEST_RATE, _LONG_RATE = 8_000, 48_000, 24_000
_COMPRESSIONS = ("KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu")
# The page lets the eyes blink of themselves.
_LIDS = ("eyeBlinkLeft", "eyeBlinkRight")


def encode(performance: Performance) -> bytes:
    """Return the page.

    Parameters
    ----------
    performance : Performance
        What is played; without a sound the page keeps time by itself.

    Returns
    -------
    bytes
        An HTML document in UTF-8.

    Raises
    ------
    CharacterError
        If the model is broken, or needs a decoder that the page has not.
    LipwrightError
        If the player has not been built.
    """
    if performance.flat:
        from lipwright.export.pictures_page import encode as encode_pictures

        return encode_pictures(performance)
    before, after = _player()
    rigged = performance.rig()
    model = parse_glb(rigged.glb, rigged.name)
    held = _held(model)
    channels = _moving(rigged.channels, held)
    content = {
        **_content(performance),
        "model": rigged.name,
        "backwards": "VRM" in model.json.get("extensions", {}),
        "channels": _channels(channels),
        "joints": {name: _turn(turn) for name, turn in rigged.joints.items()},
    }
    glb = _light(model, held.union(channels.controls)).to_glb()
    blocks = [
        json_block("performance", content),
        block("model", "model/gltf-binary;base64", _base64(glb)),
    ]
    sound = performance.speech.sound
    if sound is not None and len(sound.samples):
        wav = playable(sound).wav_bytes()
        blocks.append(block("sound", "audio/wav;base64", _base64(wav)))
    return "\n".join([before, *blocks, after]).encode()


def _player() -> tuple[str, str]:
    """Return what stands before and after the data in the built page."""
    page = resources.files("lipwright.export").joinpath("player.html")
    if not page.is_file():
        raise LipwrightError(
            "the player of HTML pages has not been built",
            cure="install Lipwright again, or type in its source folder: python hatch_build.py",
        )
    before, found, after = page.read_text("utf-8").partition(_PLACE)
    if not found:
        raise LipwrightError("the player of HTML pages is damaged", cure="install Lipwright again")
    return before.rstrip(), after.lstrip()


def _content(performance: Performance) -> dict[str, Any]:
    animation, speech = performance.animation, performance.speech
    if performance.curves is not None:
        animation = performance.curves()
    return {
        "text": speech.text,
        "engine": animation.engine,
        "report": animation.report,
        "notes": list(speech.notes),
        "rate": animation.rate,
        "start": animation.start,
        "controls": animation.controls,
        "frames": _frames(animation.values),
        "phones": _rows(animation.phones.tier),
        "words": _rows(animation.words),
    }


def _moving(channels: Animation, held: Collection[str]) -> Animation:
    """Return the channels that are ever away from zero, or whose model is at rest."""
    used = [
        index
        for index, (name, values) in enumerate(
            zip(channels.controls, channels.values.T, strict=True)
        )
        if name in held or values.any()
    ]
    names = tuple(channels.controls[index] for index in used)
    return Animation(names, channels.values[:, used], channels.rate, channels.start)


def _held(model: Gltf) -> set[str]:
    """Return the morph targets that are away from zero when the model is at rest."""
    return {
        name
        for mesh in morph_meshes(model)
        for weights in mesh.weights
        for name, weight in zip(mesh.targets, weights, strict=True)
        if weight
    }


def _channels(channels: Animation) -> dict[str, Any]:
    return {
        "names": channels.controls,
        "rate": channels.rate,
        "start": channels.start,
        "frames": _frames(channels.values),
    }


def _turn(turn: JointTurn) -> dict[str, Any]:
    return {"node": turn.node, "axis": turn.axis, "degrees": turn.degrees}


def _frames(values: NDArray[np.float32]) -> list[list[float]]:
    rounded: list[list[float]] = (np.round(values.astype(np.float64), _DIGITS) + 0.0).tolist()
    return rounded


def _rows(tier: Tier) -> list[tuple[str, float, float]]:
    return [(each.label, each.start, each.end) for each in tier]


def json_block(name: str, value: Any) -> str:
    """Return a block of JSON that cannot end it, whatever a label holds."""
    text = json.dumps(value, separators=(",", ":"))
    text = text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")
    return block(name, "application/json", text)


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode("ascii")


def block(name: str, kind: str, text: str) -> str:
    """Return data that the page's script reads."""
    return f'<script type="{kind}" id="lipwright-{name}">{text}</script>'


def playable(sound: Sound) -> Sound:
    """Return the sound at a rate that browsers play, and that keeps a long page small."""
    highest = _LONG_RATE if sound.duration > _LONG else _HIGHEST_RATE
    return sound.resampled(min(max(sound.rate, _LOWEST_RATE), highest))


def _light(model: Gltf, shown: Collection[str]) -> Gltf:
    """Return the model with the morph targets that this page can show."""
    needed = [name for name in model.json.get("extensionsRequired", ()) if name in _COMPRESSIONS]
    if needed:
        raise CharacterError(
            f"its model is compressed ({', '.join(needed)})",
            where=model.where,
            expected="a GLB that a page can open without a decoder",
            cure="export the model without compression",
        )
    return keep_morphs(model, {*shown, *_LIDS})
