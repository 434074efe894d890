"""Random lines for what held pictures promise, and what they are held from."""

import numpy as np

from lipwright.animation import Animation
from lipwright.engines.bigram import BigramEngine, load_set
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier

ENGINE = BigramEngine(load_set("english"))
LABELS = ("p", "b", "m", "f", "v", "aa", "iy", "uw", "ow", "l", "s", "sh", "t", "k", "w", "eh")


def speech(seed: int) -> Speech:
    """Return a line in which lips close often, with gaps and silences."""
    rng = np.random.default_rng(seed)
    time, phones = float(rng.uniform(-0.1, 0.5)), []
    for _ in range(int(rng.integers(1, 40))):
        if rng.uniform() < 0.15:
            pause = float(rng.choice([0.02, 0.15, 0.29, 0.31, 0.9]))
            if rng.uniform() < 0.5:
                phones.append(Interval("sil", time, time + pause))
            time += pause
        length = float(np.exp(rng.uniform(np.log(0.02), np.log(0.25))))
        phones.append(Interval(str(rng.choice(LABELS)), time, time + length))
        time += length
    return Speech(PhoneTrack(Tier(tuple(phones))))


def animated(line: Speech) -> Animation:
    """Return a line animated with the English set."""
    return ENGINE.animate(line)


def spoken_as(*rows: tuple[str, float, float]) -> Animation:
    """Return an animation of these phones."""
    return animated(Speech(PhoneTrack(Tier.of(*rows))))
