"""Small databases: takes whose phones are the letters of a word, with random motion and sound."""

from pathlib import Path

import msgspec
import numpy as np

from lipwright.engines.motion.assembling import assembled
from lipwright.engines.motion.database import Database, Header, Settings, database_of
from lipwright.engines.motion.preparing import Prepared
from lipwright.engines.motion.storage import VERSION
from lipwright.engines.motion.units import Cut

RATE = 25.0
CHANNELS = ("jawOpen", "mouthFunnel", "mouthSmile")


def prepared(word: str, seed: int = 0, name: str = "", sound: bool = True) -> Prepared:
    """A take of some letters, each two to four frames long."""
    rng = np.random.default_rng((seed, *word.encode()))
    edges = np.cumsum(np.append(0.0, rng.integers(16, 32, len(word)) / 8))
    frames = int(np.ceil(edges[-1]))
    values = rng.random((frames, len(CHANNELS))).astype(np.float32)
    heard = rng.random((frames, 9)).astype(np.float32) if sound else None
    spans = np.stack((edges[:-1], edges[1:]), axis=1)
    cut = Cut(tuple(word), spans)
    return Prepared(name or f"{word}-{seed}", CHANNELS, values, heard, RATE, 0.0, "arpabet", cut)


def database(*words: str, settings: Settings | None = None) -> Database:
    """A database in memory with a take for each word."""
    takes = [prepared(word, seed) for seed, word in enumerate(words)]
    header, arrays = assembled(takes, settings or Settings())
    named = msgspec.convert({**header, "version": VERSION, "arrays": "none"}, Header)
    rest = np.zeros(len(CHANNELS), np.float32)
    return database_of(Path("memory"), named, {**arrays, "rest": rest})
