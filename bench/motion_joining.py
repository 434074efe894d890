"""What follows the motion engine's search, for 4 s of speech: features, warps, joins, closures.

On random takes of 120 frames per second, 109 markers in 6 components, with a path that
jumps at every third phone. The whole of it should take 30 ms or less.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bench.measure import milliseconds, say
from lipwright.engines.motion import warping
from lipwright.engines.motion.closures import Opening
from lipwright.engines.motion.joining import join, learn
from lipwright.engines.motion.rasta_plp import Features, rasta_plp
from lipwright.engines.motion.splicing import PairTable
from lipwright.phones import load_phone_set
from lipwright.sound import Sound

LABELS = ("sil", *load_phone_set("arpabet").labels)
COMPONENTS, CHANNELS, RATE, SECONDS = 6, 327, 120.0, 4.0
TAKES, PHONES, FRAMES = 240, 30, 10


@dataclass
class Takes:
    """A database of random takes; every phone lasts ten frames."""

    frames: NDArray[np.float32]
    features: NDArray[np.float32]
    label: NDArray[np.int16]
    first: NDArray[np.int64]
    last: NDArray[np.int64]
    take: NDArray[np.int32]
    spans: NDArray[np.float64]
    take_first: NDArray[np.int64]
    sound_scale: NDArray[np.float32]
    mean: NDArray[np.float32]
    basis: NDArray[np.float32]
    values: NDArray[np.float32]
    labels: tuple[str, ...] = LABELS
    rate: float = RATE


def takes() -> Takes:
    """Return the random takes: curves below about 8 Hz."""
    rng = np.random.default_rng(0)
    units = TAKES * PHONES
    total = units * FRAMES
    kernel = np.hanning(15) / np.hanning(15).sum()
    curves = [np.convolve(rng.normal(size=total), kernel, "same") for _ in range(COMPONENTS + 9)]
    values = np.stack(curves, axis=1).astype(np.float32)
    edges = np.arange(units + 1) * FRAMES
    basis = np.linalg.qr(rng.normal(size=(CHANNELS, COMPONENTS)))[0].T.astype(np.float32)
    return Takes(
        frames=np.ascontiguousarray(values[:, :COMPONENTS]),
        features=np.ascontiguousarray(values[:, COMPONENTS:]),
        label=rng.integers(0, len(LABELS), units).astype(np.int16),
        first=edges[:-1],
        last=edges[1:],
        take=np.repeat(np.arange(TAKES), PHONES).astype(np.int32),
        spans=np.stack((edges[:-1], edges[1:]), axis=1).astype(np.float64),
        take_first=np.arange(TAKES + 1) * (PHONES * FRAMES),
        sound_scale=np.ones(9, np.float32),
        mean=np.zeros(CHANNELS, np.float32),
        basis=basis,
        values=values[:, :COMPONENTS] @ basis,
    )


def path(count: int) -> NDArray[np.int64]:
    """Return units in runs of three."""
    rng = np.random.default_rng(1)
    starts = rng.integers(0, PHONES - 3, count) + PHONES * rng.integers(0, TAKES, count)
    return np.asarray((starts[:, None] + np.arange(3)).ravel()[:count], np.int64)


def measure(data: Takes, opening: Opening, rate: float) -> None:
    """The whole, and the whole without each part."""
    rng = np.random.default_rng(2)
    units = path(44)
    lengths = rng.uniform(0.05, 0.13, len(units))
    edges = np.append(0.0, np.cumsum(lengths) / lengths.sum() * SECONDS)
    spans = np.stack((edges[:-1], edges[1:]), axis=1)
    sound = Sound(rng.normal(0, 0.1, int(16000 * SECONDS)).astype(np.float32), 16000)
    learnt, pairs = learn(data, opening), PairTable(data)
    features = rasta_plp(sound, data.rate)

    def whole(heard: Features) -> int:
        joined = join(
            data, units, spans, rate, learnt=learnt, features=heard, opening=opening, pairs=pairs
        )
        return len(joined.splices)

    say(
        f"joining at {rate:g} Hz",
        splices=whole(features),
        **milliseconds(lambda: whole(rasta_plp(sound, data.rate))),
    )
    say(f"joining at {rate:g} Hz, features known", **milliseconds(lambda: whole(features)))
    evenly = milliseconds(lambda: join(data, units, spans, rate, pairs=pairs))
    say(f"joining at {rate:g} Hz, no warp, no smoothing, no closures", **evenly)


if __name__ == "__main__":
    made = takes()
    weights = np.zeros(CHANNELS)
    weights[:2] = 1.0, -1.0
    noise = np.random.default_rng(3).normal(size=(2, 40, 9))
    say("warp, 30 by 40 frames", **milliseconds(lambda: warping.warp(noise[0, :30], noise[1]), 200))
    for one in (25.0, 60.0, 120.0):
        measure(made, lambda motion: motion @ weights, one)
