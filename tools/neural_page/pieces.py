"""Recorded faces in pieces of a few seconds: what is heard and what is shown, frame by frame."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright import pipeline
from lipwright.engines.motion.capture import read_motion
from lipwright.engines.neural.features import Hearing, features, frame_times
from lipwright.sound import Sound
from lipwright.sound_files import read_sound
from lipwright.speech import Speech

Floats = NDArray[np.float64]

LENGTH = 4.0
"""Seconds of a piece of a long take."""
HEARING = Hearing()


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A few seconds of one speaker.

    Parameters
    ----------
    name : str
        Of the take.
    times : (T,) float64
        Seconds on the take's clock.
    heard : (T, 243) float64
    shapes : (T, C) float64
        ARKit's.
    channels : tuple of str
    sound : Path
        The take's file.
    text : str
        What is said, where known.
    """

    name: str
    times: Floats
    heard: Floats
    shapes: Floats
    channels: tuple[str, ...]
    sound: Path
    text: str = ""

    @property
    def seconds(self) -> float:
        """How long it is."""
        return len(self.times) * HEARING.frame

    def speech(self) -> Speech:
        """Return the whole take with its phones in time; it must have a text."""
        return pipeline.align(self.sound, self.text)

    def samples(self) -> Sound:
        """Return the whole take's sound."""
        return read_sound(self.sound)


def pieces_of(
    sound: Path, motion: Path, text: str = "", length: float | None = None
) -> list[Piece]:
    """Return a take in pieces of ``length`` seconds, or whole."""
    heard_sound, face = read_sound(sound), read_motion(motion)
    times = frame_times(heard_sound, HEARING)
    heard = features(heard_sound, HEARING)
    shapes = np.stack([np.interp(times, face.times, column) for column in face.values.T], axis=1)
    count = len(times) if length is None else round(length / HEARING.frame)
    return [
        Piece(
            sound.stem,
            times[start : start + count],
            heard[start : start + count],
            shapes[start : start + count],
            face.channels,
            sound,
            text,
        )
        for start in range(0, len(times) - count + 1, count)
    ]


def grid(folder: Path) -> list[Piece]:
    """Return the sentences of the GRID speaker: ``audio``, ``motion`` and ``text.csv``."""
    with (folder / "text.csv").open(newline="") as table:
        rows = list(csv.DictReader(table))
    found = []
    for row in rows:
        name = row["sentence"]
        sound, motion = folder / "audio" / f"{name}.flac", folder / "motion" / f"{name}.csv"
        found += pieces_of(sound, motion, row["text"])
    return found


def takes(folder: Path) -> list[Piece]:
    """Return long takes (``NAME.flac`` beside ``NAME.csv``) in pieces of 4 s."""
    found = []
    for sound in sorted(folder.glob("*.flac")):
        found += pieces_of(sound, sound.with_suffix(".csv"), length=LENGTH)
    return found


def drawn(
    pieces: Sequence[Piece], number: int, taught: float = 20.0, unseen: float = 120.0
) -> tuple[list[Piece], list[Piece]]:
    """Draw about 20 s to learn from, and 2 minutes, or what is left, that are not among them.

    A larger sample of the same number holds the smaller one, and the unseen stay the same.
    """
    order = list(np.random.default_rng(number).permutation(len(pieces)))
    chosen = _taken(pieces, order, taught)
    return chosen, _taken(pieces, order[: len(chosen) - 1 : -1], unseen)


def _taken(pieces: Sequence[Piece], order: Sequence[int], seconds: float) -> list[Piece]:
    """Return pieces in their order until they are as long as wanted, within 1 s."""
    found: list[Piece] = []
    for place in order:
        if sum(one.seconds for one in found) < seconds - 1.0:
            found.append(pieces[place])
    return found
