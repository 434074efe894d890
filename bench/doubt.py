"""Whether alignment knows when the words are not what is spoken.

Each recording beside the project is aligned with its own text and with that of another
sentence of the same length of list. AUC: how often, of a right and a wrong text, the
right one is surer. Doubted: below the confidence under which a command says so.
"""

from pathlib import Path

import numpy as np

from bench.aligning import sentences
from bench.measure import say
from bench.recordings import DATA, is_damaged
from lipwright import pipeline
from lipwright.errors import LipwrightError
from lipwright.schedule.align.confidence import DOUBTFUL
from lipwright.sound_files import read_sound

MOST = 140
"""Recordings of a folder that are used, spread over it."""


def confidence(path: Path, text: str) -> float:
    """How sure the aligner is of a line; 0 where it refuses."""
    try:
        return pipeline.align(path, text).confidence or 0.0
    except LipwrightError:
        return 0.0


def measure(folder: str) -> None:
    """Print the line of one folder."""
    lines = [
        (path, text) for path, text in sentences(folder) if not is_damaged(read_sound(path).samples)
    ]
    lines = lines[:: max(1, len(lines) // MOST)]
    others = [text for _, text in lines[len(lines) // 2 :] + lines[: len(lines) // 2]]
    right = np.array([confidence(path, text) for path, text in lines])
    wrong = np.array(
        [
            confidence(path, other)
            for (path, text), other in zip(lines, others, strict=True)
            if other != text
        ]
    )
    pairs = right[:, None] - wrong[None, :]
    say(
        f"confidence {folder}",
        recordings=len(right),
        auc=round(float(np.mean(pairs > 0) + 0.5 * np.mean(pairs == 0)), 4),
        right_doubted=round(float(np.mean(right < DOUBTFUL)), 3),
        wrong_doubted=round(float(np.mean(wrong < DOUBTFUL)), 3),
    )


if __name__ == "__main__":
    for name in ("timit", "grid"):
        if (DATA / name).is_dir():
            measure(name)
