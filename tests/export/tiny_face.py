"""A face of two lips and a lid, small enough to check by hand, that says "pop"."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.character.builtin import to_glb
from lipwright.character.mesh import Material, Part
from lipwright.performance import Performance, RiggedModel
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Tier

GAP = 0.004
"""Metres between the lips at rest."""

# name: (lowest y, highest y, how each morph target moves it along y)
_PARTS: dict[str, tuple[float, float, dict[str, float]]] = {
    "Skin": (0.015, 0.15, {"eyeBlinkLeft": -0.01, "eyeBlinkRight": -0.01, "browInnerUp": 0.01}),
    "UpperLip": (GAP / 2, 0.02, {"PBM": -GAP / 2, "open": 0.002}),
    "LowerLip": (-0.02, -GAP / 2, {"open": -0.03, "PBM": GAP / 2}),
}
_SKIN = Material("Skin", (0.8, 0.6, 0.5, 1.0), double_sided=True)


def tiny_face() -> bytes:
    """Return the GLB: one square per part; the lips share the names of their targets."""
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)
    parts = []
    for name, (low, high, moves) in _PARTS.items():
        corners = [[-0.03, low, 0], [0.03, low, 0], [0.03, high, 0], [-0.03, high, 0]]
        morphs = {target: np.tile(_row(0, move, 0), (4, 1)) for target, move in moves.items()}
        parts.append(Part(name, np.array(corners, np.float32), triangles, _SKIN, morphs, None))
    return to_glb(parts, "Tiny face")


def _row(*values: float) -> NDArray[np.float32]:
    return np.array(values, np.float32)


def pop(*, sound: bool = True) -> Performance:
    """Return a performance of "pop": lips closed in each p, open in the aa between them."""
    phones = Tier.of(("p", 0.0, 0.2), ("aa", 0.2, 0.5), ("p", 0.5, 0.7), ("sil", 0.7, 0.8))
    rate, start = 60.0, -0.1
    times = start + np.arange(54) / rate
    opened = np.interp(times, [0.2, 0.3, 0.4, 0.5], [0, 1, 1, 0])
    closed = np.interp(times, [0, 0.05, 0.15, 0.2, 0.5, 0.55, 0.65, 0.7], [0, 1, 1, 0, 0, 1, 1, 0])
    values = np.stack([opened, closed, 0 * times], axis=1).astype(np.float32)
    track, words = PhoneTrack(phones), Tier.of(("pop", 0.0, 0.7))
    controls = ("open", "PBM", "FV")
    report: dict[str, Any] = {"set": "english", "stand_ins": ["p-aa"]}
    animation = Animation(
        controls, values, rate, start, phones=track, words=words, engine="bigram", report=report
    )
    channels = Animation(controls, values, rate, start)
    tone = (0.1 * np.sin(2 * np.pi * 220 * np.arange(12_800) / 16_000)).astype(np.float32)
    return Performance(
        animation,
        Speech(track, words, Sound(tone, 16_000) if sound else None, "Pop."),
        lambda: RiggedModel("tiny face", tiny_face(), channels),
    )
