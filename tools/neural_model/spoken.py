"""Lines spoken and animated: sound, poses, and the class of mouth, at even times."""

from __future__ import annotations

import os
import pickle
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import soxr
from numpy.typing import NDArray

from lipwright import pipeline
from lipwright.errors import LipwrightError
from lipwright.phones import load_phone_set, load_reduction
from lipwright.speech import Speech
from tools.neural_model import flite
from tools.neural_model.lines import Line

RATE = 16000
FRAMES = 100
"""Of poses and classes per second."""
POSES = ("open", "W", "wide", "ShCh", "FV", "PBM", "tBack", "tRoof", "tTeeth")
CLASSES = load_phone_set("common").labels


@dataclass(frozen=True, slots=True, eq=False)
class Spoken:
    """A line with the face that goes with it.

    Parameters
    ----------
    samples : (N,) int16
        At 16 kHz.
    poses : (T, P) float16
        The bigram engine's, at 100 Hz from 0 on.
    classes : (T,) int8
        Place of the phone's class in :data:`CLASSES`.
    voice : str
    """

    samples: NDArray[np.int16]
    poses: NDArray[np.float16]
    classes: NDArray[np.int8]
    voice: str


def speech_of(line: Line) -> Speech:
    """Speak a line."""
    if line.engine == "flite":
        return flite.speak(line.text, line.voice, line.rate, line.pitch)
    if line.engine == "festival":
        return pipeline.say(line.text, voice=f"festival:{line.voice}", rate=line.rate)
    return pipeline.say(line.text, voice=line.voice, rate=line.rate, pitch=line.pitch)


def spoken(line: Line) -> Spoken | None:
    """Speak and animate a line; None where a synthesiser cannot."""
    try:
        speech = speech_of(line)
    except LipwrightError:
        return None
    return told(speech, f"{line.engine} {line.voice}")


def told(speech: Speech, voice: str) -> Spoken:
    """Animate speech with the bigram engine."""
    assert speech.sound is not None
    animation = pipeline.animate(speech, rate=FRAMES).animation
    assert animation.controls == POSES
    sound = speech.sound
    samples = np.asarray(soxr.resample(sound.samples, sound.rate, RATE))
    times = np.arange(int(len(samples) / RATE * FRAMES)) / FRAMES
    classes = np.full(len(times), CLASSES.index("sil"), np.int8)
    for label, start, end in load_reduction(speech.phones.phone_set).rows(speech.phones)[0]:
        classes[np.searchsorted(times, start) : np.searchsorted(times, end)] = CLASSES.index(label)
    loud = np.clip(np.rint(samples * 32767), -32768, 32767).astype(np.int16)
    return Spoken(loud, animation.at(times).astype(np.float16), classes, voice)


def write_spoken(path: Path, lines: Iterable[Spoken]) -> None:
    """Keep lines in a file."""
    part = path.with_suffix(".part")
    with part.open("wb") as file:
        pickle.dump(list(lines), file)
    part.replace(path)


def read_spoken(path: Path) -> list[Spoken]:
    """Return the lines that :func:`write_spoken` kept: read only what you wrote yourself."""
    with path.open("rb") as file:
        found: list[Spoken] = pickle.load(file)
    return found


def speak_all(wanted: Sequence[Line], workers: int | None = None) -> Iterator[Spoken]:
    """Speak all lines over the machine's cores, in their order."""
    with ProcessPoolExecutor(workers or os.cpu_count()) as pool:
        for one in pool.map(spoken, wanted, chunksize=8):
            if one is not None:
                yield one
