"""The takes and their database: spoken sentences, each moved in a style of its own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.bigram import BigramSet, load_set
from lipwright.engines.motion.building import build
from lipwright.engines.motion.database import Database, Settings
from lipwright.engines.motion.learnt import keep_learnt
from lipwright.engines.motion.preparing import Prepared, prepare
from lipwright.engines.motion.rasta_plp import rasta_plp
from lipwright.engines.motion.synthetic import ABOUT
from lipwright.engines.motion.take import Take
from tools.synthetic_motion.choosing import cover
from tools.synthetic_motion.speaking import Spoken, sentences, spoken
from tools.synthetic_motion.styles import draw, drifted, engine_of

RATE = 25.0
SECONDS = 101.0
"""Of takes; what a few hundred kilobytes hold."""
SEED = 8
SETTINGS = Settings(sound_points=2, variance=0.99, seed=SEED)
"""Two points of a unit's sound instead of three: a tenth of the size."""


def make(folder: Path, seconds: float = SECONDS) -> Database:
    """Make the takes and build the database of them."""
    of = load_set("english")
    chosen = cover(lines(), seconds)
    made = build(folder, [moved(line, of) for line in chosen], SETTINGS, about=ABOUT)
    keep_learnt(made)
    return made


def lines() -> list[Spoken]:
    """Return every sentence, spoken; each draws from a stream of its own."""
    return [
        spoken(number, text, np.random.default_rng([SEED, 0, number]))
        for number, text in enumerate(sentences(), 1)
    ]


def moved(line: Spoken, of: BigramSet) -> Prepared:
    """Return a take: a line moved by the bigram engine in a style of its own."""
    number = int(line.name.split()[1])
    style = draw(of, np.random.default_rng([SEED, 1, number]))
    engine = engine_of(of, style)
    count = round(line.seconds * RATE)
    first = 0.5 / RATE
    values = engine.sample(engine.solve(line.phones), first, count, RATE)
    times = first + np.arange(count) / RATE
    take = Take(
        line.name,
        of.rules.names,
        drifted(values, times, style, of).astype(np.float32),
        RATE,
        0.0,
        line.phones,
        line.words,
        line.sound,
    )
    return prepare(take, features=_features)


def _features(take: Take) -> NDArray[np.float32]:
    assert take.sound is not None  # all of these have
    return rasta_plp(take.sound, take.rate, take.start, len(take.values)).values
