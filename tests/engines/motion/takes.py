"""Takes made by code: sentences spoken by the synthesiser, moved by the bigram engine."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np

from lipwright import pipeline
from lipwright.animation import Animation

RATE = 50.0
LINES = {
    "one": "Peter bought a big map of the town.",
    "two": "We saw five blue boats on the water.",
    "three": "My father wants more coffee in the morning.",
    "four": "Those who move too fast may stumble.",
    "five": "Please bring the paper back before Monday.",
}


def shapes(animation: Animation) -> dict[str, np.ndarray]:
    """Shapes of ARKit's that look like an animation of poses."""
    opened, round_, wide = (animation.control(name) for name in ("open", "W", "wide"))
    pressed = animation.control("PBM")
    return {
        "jawOpen": 0.7 * opened,
        "mouthPucker": 0.9 * round_,
        "mouthSmileLeft": 0.5 * wide,
        "mouthSmileRight": 0.5 * wide,
        "mouthPressLeft": 0.8 * pressed,
        "mouthPressRight": 0.8 * pressed,
        "mouthRollLower": 0.4 * pressed + 0.6 * animation.control("FV"),
    }


def record(folder: Path, lines: dict[str, str] = LINES) -> Path:
    """Write takes: a table of shapes, the sound and the words of each."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in lines.items():
        speech = pipeline.say(text)
        performance = pipeline.animate(speech, rate=RATE)
        animation = performance.animation
        first = int(np.flatnonzero(animation.times > -1e-9)[0])
        moved = {shape: values[first:] for shape, values in shapes(animation).items()}
        pipeline.save(performance, folder / f"{name}.wav")
        (folder / f"{name}.txt").write_text(text, "utf-8")
        with (folder / f"{name}.csv").open("w", newline="") as file:
            table = csv.writer(file)
            table.writerow(["time", *moved])
            count = min(len(animation) - first, round(speech.duration * RATE))
            for frame in range(count):
                # A frame begins half a frame before what it shows.
                time = (frame - 0.5) / RATE
                table.writerow([f"{time:.4f}", *(f"{v[frame]:.5f}" for v in moved.values())])
    return folder
