"""Takes of markers made by code: dots on the built-in head, which speaks by the bigram engine."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright import pipeline
from lipwright.character.between import with_betweens
from lipwright.character.head import build_head, landmarks
from lipwright.character.mesh import Part
from tests.engines.motion.capture.made import moving_head, spread, write_c3d
from tests.engines.motion.takes import LINES

Floats = NDArray[np.float64]
RATE = 60.0
ON_FACE, ON_LIP = 36, 6
RED = 0.006
"""Metres from where the lips meet to where their markers sit."""


def dots() -> list[int]:
    """Vertices of the head's skin that bear a marker: along both lips, and over the face."""
    skin, marks = head_skin(), landmarks()
    points = skin.positions.astype(np.float64)
    front = np.flatnonzero(points[:, 2] > np.quantile(points[:, 2], 0.7))
    chosen: list[int] = []
    for loop, above in ((marks.upper_loop, 1), (marks.lower_loop, -1)):
        along = points[list(loop)][:: max(1, len(loop) // ON_LIP)]
        for place in along + np.array([0.0, above * RED, 0.0]):
            apart = np.linalg.norm(points[front] - place, axis=1)
            chosen.append(int(front[apart.argmin()]))
    chosen += front[spread(points[front], ON_FACE, 0)].tolist()
    return list(dict.fromkeys(int(one) for one in chosen))


def head_skin() -> Part:
    """The skin of the built-in head."""
    return next(part for part in build_head() if part.name == "skin")


def labels() -> tuple[str, ...]:
    return tuple(f"dot{number:02}" for number in range(len(dots())))


def record(folder: Path, lines: dict[str, str] = LINES, noise: float = 5e-5) -> Path:
    """Write takes: C3D, sound and words of each; the head moves while it speaks."""
    folder.mkdir(parents=True, exist_ok=True)
    skin, chosen = head_skin(), dots()
    rest = skin.positions[chosen].astype(np.float64)
    for seed, (name, text) in enumerate(lines.items()):
        speech = pipeline.say(text)
        performance = pipeline.animate(speech, rate=RATE)
        moved = with_betweens(performance.animation, tuple(skin.morphs))
        count = round(speech.duration * RATE)
        # Frame k of a capture shows the middle of its time.
        weights = moved.at((np.arange(count) + 0.5) / RATE)
        still = np.zeros_like(skin.positions)  # poses of the tongue move no skin
        shapes = [skin.morphs.get(control, still)[chosen] for control in moved.controls]
        true = rest + np.einsum("tc,cmi->tmi", weights, np.stack(shapes))
        rng = np.random.default_rng(seed)
        turns, shifts = moving_head(count, rng)
        seen = true @ turns + shifts[:, None] + rng.normal(scale=noise, size=true.shape)
        for _ in range(3):
            first, marker = int(rng.integers(count - 8)), int(rng.integers(len(chosen)))
            seen[first : first + 8, marker] = np.nan
        write_c3d(folder / f"{name}.c3d", seen, labels(), rate=RATE)
        pipeline.save(performance, folder / f"{name}.wav")
        (folder / f"{name}.txt").write_text(text, "utf-8")
    return folder
