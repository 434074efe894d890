"""The neural engine as published: 20 s taught, two minutes unseen, one speaker; and its speed.

On a GRID speaker and on facegood's takes, five draws each; without recordings only speed is
measured. ``python -m tools.neural_page`` looks further into the same.
"""

import numpy as np
from tools.neural_page.pieces import Piece, drawn, grid, takes
from tools.neural_page.trials import mean_of, trial

from bench.measure import milliseconds, say
from bench.recordings import DATA
from lipwright.animation import Animation
from lipwright.engines.neural.engine import NeuralEngine
from lipwright.engines.neural.lessons import Lesson
from lipwright.engines.neural.training import train
from lipwright.hearing import sound_alone
from lipwright.sound import Sound

DRAWS = 5


def quality(name: str, pieces: list[Piece]) -> None:
    """Print the figures of one speaker."""
    found = [trial(*drawn(pieces, number)) for number in range(DRAWS)]
    each = np.mean([one.correlations for one in found], axis=0)
    say(
        f"neural engine, {name}",
        rms=round(mean_of([one.rms for one in found]), 4),
        variance_left=round(mean_of([one.unexplained for one in found]), 4),
        frames_to_correct=round(mean_of([one.wrong() for one in found]), 4),
        correlation={
            output: round(float(value), 3)
            for output, value in zip(("a", "i", "o/u", "b/m/p", "open"), each, strict=True)
        },
    )


def speed() -> None:
    """Print how long a minute of sound and 20 s of training take."""
    rng = np.random.default_rng(0)
    minute = Sound(rng.normal(0, 0.1, 60 * 16000).astype(np.float32), 16000)
    short = Sound(minute.samples[: 20 * 16000], 16000)
    shown = Animation(tuple("abcde"), rng.random((500, 5)).astype(np.float32), 25.0)
    lesson = Lesson(short, shown, "noise")
    engine, line = NeuralEngine(train([lesson])), sound_alone(minute)
    say("neural engine, a minute of sound at 60 Hz", **milliseconds(lambda: engine.animate(line)))
    say("neural engine, 20 s taught", **milliseconds(lambda: train([lesson]), runs=5, warm=0))


if __name__ == "__main__":
    speed()
    if DATA.is_dir():
        quality("GRID", grid(DATA / "grid"))
        quality("facegood", takes(DATA / "facegood"))
