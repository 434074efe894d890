"""Spoken lines as microphones hear them: bands, and the poses and classes that go with them."""

from __future__ import annotations

import os
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural import mel
from tools.neural_model.shape import Shape
from tools.neural_model.spoil import levelled, noise, spoilt
from tools.neural_model.spoken import CLASSES, FRAMES, RATE, Spoken, read_spoken

SILENCE = CLASSES.index("sil")
NOISES = 5
"""One piece of noise or silence for so many lines."""
_LIKELY = (-45.0, -18.0)
"""dB: how loud a speaker is taken to be at the start of a sound."""
_EMPTY = 1e-10
_PAUSE = 0.6  # s, the longest before and after a line


@dataclass(frozen=True, slots=True, eq=False)
class Heard:
    """Lines one after the other.

    Parameters
    ----------
    powers : (T, 40) float16
        Natural logarithm of the power in each band, a hundred times a second.
    poses : (T, P) float16
    classes : (T,) int8
    lengths : (N,) int64
        Of each line, in frames.
    """

    powers: NDArray[np.float16]
    poses: NDArray[np.float16]
    classes: NDArray[np.int8]
    lengths: NDArray[np.int64]

    def only(self, kept: NDArray[np.bool_]) -> Heard:
        """Return some of the lines."""
        rows = np.repeat(kept, self.lengths)
        return Heard(self.powers[rows], self.poses[rows], self.classes[rows], self.lengths[kept])

    def save(self, path: Path) -> None:
        """Write it to a file; read it with :func:`read_heard`."""
        part = path.with_suffix(".part.npz")
        np.savez(part, **{name: getattr(self, name) for name in self.__slots__})
        part.replace(path)


def read_heard(path: Path) -> Heard:
    """Return what :meth:`Heard.save` wrote."""
    with np.load(path) as file:
        return Heard(**{name: file[name] for name in Heard.__slots__})


def hear_lines(speech: Path, seed: int, workers: int | None = None) -> Heard:
    """Spoil every line anew and hear it, noises and silences in between.

    Parameters
    ----------
    speech : path
        What :func:`~tools.neural_model.spoken.write_spoken` wrote.
    seed : int
    workers : int, optional
        Processes; one a core, where it is not given.
    """
    order = order_of(len(read_spoken(speech)), seed)
    jobs = [(int(line), seed, number) for number, line in enumerate(order)]
    with ProcessPoolExecutor(
        workers or os.cpu_count(), initializer=_take, initargs=(speech,)
    ) as pool:
        found = list(pool.map(_heard, jobs, chunksize=32))
    powers, poses, classes = zip(*found, strict=True)
    return Heard(
        np.concatenate(powers),
        np.concatenate(poses),
        np.concatenate(classes),
        np.array([len(one) for one in powers]),
    )


def order_of(count: int, seed: int) -> NDArray[np.int64]:
    """Return which of so many lines comes when; -1 is a noise."""
    order: NDArray[np.int64] = np.r_[np.arange(count), np.full(count // NOISES, -1)]
    np.random.default_rng(seed).shuffle(order)
    return order


def bands_of(heard: Heard, shape: Shape, rng: np.random.Generator) -> NDArray[np.float16]:
    """Return what a net of a shape hears of lines, (T, 40)."""
    found = np.empty(heard.powers.shape, np.float16)
    start = 0
    for length in heard.lengths.tolist():
        power = np.exp(heard.powers[start : start + length].astype(np.float64))
        loud = mel.loudness(power)
        if shape.both_ways:
            level = mel.settled(loud)
        else:  # the start of a sound, or the middle of one
            known = float(loud.max()) + rng.uniform(-8, 6)
            level = mel.followed(loud, rng.uniform(*_LIKELY) if rng.random() < 0.5 else known)
        found[start : start + length] = mel.told(power, level)
        start += length
    return found


_lines: list[Spoken] = []

Piece = tuple[NDArray[np.float16], NDArray[np.float16], NDArray[np.int8]]


def _take(speech: Path) -> None:
    _lines[:] = read_spoken(speech)


def _heard(job: tuple[int, int, int]) -> Piece:
    line, *seeds = job
    rng = np.random.default_rng(seeds)
    return _noise_alone(rng) if line < 0 else _line(_lines[line], rng)


def _line(line: Spoken, rng: np.random.Generator) -> Piece:
    before, after = (int(RATE * rng.uniform(0, _PAUSE)) for _ in range(2))
    padded = np.concatenate([np.zeros(before, np.int16), line.samples, np.zeros(after, np.int16)])
    sound, faster = spoilt(padded, rng, _others(rng, 3 * len(padded)))
    powers = _powers(levelled(sound, rng))
    at = FRAMES * (np.arange(len(powers)) / FRAMES * faster - before / RATE)
    inside = (at >= 0) & (at <= len(line.poses) - 1)
    at = np.clip(at, 0, len(line.poses) - 1)
    low = np.minimum(at.astype(np.intp), len(line.poses) - 2)
    share = (at - low)[:, None]
    poses = line.poses.astype(np.float32)
    values = (poses[low] * (1 - share) + poses[low + 1] * share) * inside[:, None]
    classes = np.where(inside, line.classes[np.rint(at).astype(np.intp)], SILENCE)
    return powers, values.astype(np.float16), classes.astype(np.int8)


def _noise_alone(rng: np.random.Generator) -> Piece:
    count = int(RATE * rng.uniform(2, 6))
    sound = np.zeros(count)
    if rng.random() < 0.85:
        sound = noise(count, rng, _others(rng, 3 * count)) * 10 ** (rng.uniform(-45, -8) / 20)
        if rng.random() < 0.3:
            sound[: int(rng.integers(count))] = 0.0
    powers = _powers(levelled(sound, rng))
    poses = np.zeros((len(powers), _lines[0].poses.shape[1]), np.float16)
    return powers, poses, np.full(len(powers), SILENCE, np.int8)


def _powers(sound: NDArray[np.float32]) -> NDArray[np.float16]:
    frames = (len(sound) - mel.WINDOW) // mel.HOP + 1
    return np.log(mel.powers(sound, frames) + _EMPTY).astype(np.float16)


def _others(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    """Return so many samples of other lines."""
    parts: list[NDArray[np.int16]] = []
    while sum(map(len, parts)) < count:
        parts.append(_lines[int(rng.integers(len(_lines)))].samples)
    return np.concatenate(parts)[:count] / 32768.0
