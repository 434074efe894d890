"""A database small enough to reason about: two takes, five units each."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

LABELS = ("sil", "aa", "p", "iy", "f")
CHANNELS = ("jawOpen", "mouthClose", "mouthPucker")


@dataclass
class Tiny:
    """What joining needs of a database."""

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
    labels: tuple[str, ...] = LABELS
    rate: float = 60.0

    @property
    def values(self) -> NDArray[np.float32]:
        """The channels of all frames."""
        return (self.mean + self.frames @ self.basis).astype(np.float32)

    @classmethod
    def of(cls, takes: list[list[tuple[str, int]]], rate: float = 60.0, seed: int = 0) -> Tiny:
        """Build a database of takes given as labels with their numbers of frames."""
        rng = np.random.default_rng(seed)
        units = [(label, count, n) for n, take in enumerate(takes) for label, count in take]
        last = np.cumsum([count for _, count, _ in units])
        total = int(last[-1])
        bases, _ = np.linalg.qr(rng.normal(size=(3, 2)))
        return cls(
            frames=smooth(rng, total, 2),
            features=smooth(rng, total, 9),
            label=np.array([LABELS.index(label) for label, _, _ in units], np.int16),
            first=np.append(0, last[:-1]),
            last=last,
            take=np.array([n for _, _, n in units], np.int32),
            spans=np.stack((last - [count for _, count, _ in units], last), axis=1).astype(float),
            take_first=np.cumsum([0] + [sum(count for _, count in take) for take in takes]),
            sound_scale=np.ones(9, np.float32),
            mean=np.array([0.3, 0.1, 0.2], np.float32),
            basis=bases.T.astype(np.float32),
            rate=rate,
        )

    @classmethod
    def made(cls, rate: float = 60.0) -> Tiny:
        """sil aa p iy sil, and sil iy p aa sil."""
        one = [("sil", 8), ("aa", 9), ("p", 6), ("iy", 10), ("sil", 7)]
        other = [("sil", 6), ("iy", 8), ("p", 5), ("aa", 9), ("sil", 7)]
        return cls.of([one, other], rate)


def smooth(rng: np.random.Generator, count: int, width: int) -> NDArray[np.float32]:
    """Random curves without fast motion."""
    noise = rng.normal(size=(count + 8, width))
    kernel = np.hanning(9) / np.hanning(9).sum()
    curves = [np.convolve(noise[:, c], kernel, "valid") for c in range(width)]
    return np.stack(curves, axis=1).astype(np.float32)
