"""Random sets and random lines, for what the stages promise whatever comes."""

import numpy as np

from lipwright.curves import Keys
from lipwright.engines.bigram.model import Bigram, BigramSet, Conflict, Pose, Rules, Settings
from lipwright.errors import SetError
from lipwright.phones import PhoneTrack, load_phone_set
from lipwright.timeline import Interval, Tier

CLASSES = load_phone_set("common").labels


def random_keys(rng: np.random.Generator) -> Keys:
    count = int(rng.integers(1, 6))
    times = np.unique(np.round(rng.uniform(0, 1, count + 2), 3))
    if len(times) < 3:
        times = np.array([0.0, 0.5, 1.0])
    values = np.round(rng.uniform(0, 1, len(times)), 3)
    values[rng.uniform(size=len(values)) < 0.2] = 1.0
    values[0] = values[-1] = 0.0
    return Keys(times, values)


def random_rules(rng: np.random.Generator, settings: Settings | None = None) -> Rules:
    while True:
        count = int(rng.integers(1, 8))
        poses = tuple(
            Pose(
                f"pose{i}",
                priority=int(rng.integers(0, 20)),
                meets="widen" if rng.uniform() < 0.4 else "cut",
                limit=float(np.exp(rng.uniform(np.log(1), np.log(60)))),
                window=float(rng.uniform(0, 0.3)),
                softness=float(rng.choice([0.0, 0.02, 0.05])),
            )
            for i in range(count)
        )
        conflicts = tuple(
            Conflict((poses[i].name, poses[j].name), float(rng.uniform(0.1, 2.0)))
            for i in range(count)
            for j in range(i)
            if rng.uniform() < 0.3
        )
        try:
            return Rules(poses, conflicts, settings or Settings())
        except SetError:
            continue


def random_set(rng: np.random.Generator, settings: Settings | None = None) -> BigramSet:
    rules = random_rules(rng, settings)
    bigrams = {}
    for a in CLASSES:
        for b in CLASSES:
            if (a, b) != ("sil", "sil") and rng.uniform() < 0.9:
                curves = {n: random_keys(rng) for n in rules.names if rng.uniform() < 0.5}
                boundary = float(rng.uniform(0.2, 0.8))
                bigrams[(a, b)] = Bigram((a, b), curves, boundary, source="random")
    singles = {
        label: {n: random_keys(rng) for n in rules.names if rng.uniform() < 0.5}
        for label in CLASSES
    }
    return BigramSet("random", "common", rules, bigrams, singles)


def random_track(rng: np.random.Generator, classes: tuple[str, ...] = CLASSES) -> PhoneTrack:
    time = float(rng.uniform(-0.5, 1))
    phones = []
    for _ in range(int(rng.integers(1, 40))):
        if rng.uniform() < 0.1:
            time += float(rng.choice([0.004, 0.02, 0.7]))
        length = float(np.exp(rng.uniform(np.log(0.008), np.log(0.4))))
        phones.append(Interval(str(rng.choice(classes)), time, time + length))
        time += length
    return PhoneTrack(Tier(tuple(phones)), "common")
