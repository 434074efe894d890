"""Recorded faces from a folder, and the bigram set that is fitted to them.

As in :mod:`lipwright.pipeline`: motion with sound or labels beside it becomes takes with
phones; scores of ARKit's shapes become weights of the set's poses on the built-in head;
those the bigram engine's curves are fitted to.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import InputError, SoundError
from lipwright.phones import SILENCE, PhoneTrack
from lipwright.sound import Sound
from lipwright.timeline import Tier

if TYPE_CHECKING:
    from lipwright.engines.bigram import BigramSet
    from lipwright.engines.bigram.fit import FitReport
    from lipwright.engines.motion.capture import CleaningReport, RestFace, TakeFiles
    from lipwright.speech import Speech

Progress = Callable[[float], None]
Floats = NDArray[np.float64]

FEWEST = 4
"""Silent frames that say what a face at rest is."""
SETTLED = 0.2
"""Seconds next to speech in which a face moves already, or still."""
STRAIGHT = 0.6
"""The power that scores of the lips are raised to; see :func:`straightened`."""


@dataclass(frozen=True, slots=True, eq=False)
class Recorded:
    """A recorded face with its phones.

    Parameters
    ----------
    name : str
    channels : tuple of str
        ARKit's names, those of a set's poses, or coordinates of markers, see
        :mod:`lipwright.markers`.
    values : (T, C) float
        Frame ``k`` holds what is seen at ``start + (k + 0.5) / rate``.
    rate : float
        Frames per second.
    start : float
        Seconds, on the clock of the phones.
    phones : PhoneTrack
    words : Tier
    sound : Sound or None
    notes : tuple of str
        What was mended.
    cleaning : CleaningReport, optional
        Of markers: what was found and mended, and the face at rest that was subtracted.
    """

    name: str
    channels: tuple[str, ...]
    values: NDArray[np.floating]
    rate: float
    start: float
    phones: PhoneTrack
    words: Tier = field(default_factory=Tier)
    sound: Sound | None = None
    notes: tuple[str, ...] = ()
    cleaning: CleaningReport | None = None


def read_takes(
    folder: str | Path,
    *,
    text: str | Path | None = None,
    language: str = "en-us",
    progress: Progress | None = None,
) -> list[Recorded]:
    """Read a folder of recordings and find their phones.

    Parameters
    ----------
    folder : path
        Motion with sound and words, or labels, beside it by name: see
        :func:`lipwright.engines.motion.capture.find_takes`.
    text : path, optional
        A table of take names and what is said.
    language : str
        That is spoken.
    progress : function, optional
        Called with the share that is done, 0..1.

    Raises
    ------
    InputError
        If there are no takes, one is broken, or nothing says what is spoken in it.
    """
    from lipwright.engines.motion.capture import find_takes

    found = find_takes(folder, text)
    takes = []
    for number, files in enumerate(found, 1):
        takes.append(read_take(files, language))
        if progress is not None:
            progress(number / len(found))
    return takes


def read_take(files: TakeFiles, language: str = "en-us", rest: RestFace | None = None) -> Recorded:
    """Read one take: its motion, and its phones from labels or from its sound and words.

    Parameters
    ----------
    files : TakeFiles
    language : str
    rest : RestFace, optional
        Of markers: the actor's face at rest, from another take.

    Raises
    ------
    InputError
        If a file of it cannot be used, or nothing says what is spoken.
    """
    from lipwright.engines.motion.capture import check_length, clean, read_motion
    from lipwright.sound_files import read_sound

    motion, cleaning = read_motion(files.motion), None
    sound = read_sound(files.sound) if files.sound is not None else None
    if sound is not None:
        check_length(motion, sound.duration)
    if motion.kind == "markers":
        motion, cleaning = clean(motion, rest=rest)
    speech = _speech(files, sound, language)
    return Recorded(
        files.name,
        motion.channels,
        motion.values,
        motion.rate,
        motion.start,
        speech.phones,
        speech.words,
        sound,
        (*motion.notes, *speech.notes),
        cleaning,
    )


def _speech(files: TakeFiles, sound: Sound | None, language: str) -> Speech:
    from lipwright.pipeline import align, from_labels

    if files.labels is not None:
        return from_labels(files.labels, sound)
    if sound is not None and files.by_ear and files.has_only_sound:
        return _heard(sound, str(files.sound))
    if sound is None or not files.text:
        lacks = "sound" if sound is None else "words"
        raise InputError(
            f"has no {lacks}",
            where=str(files.motion),
            expected="sound and words, or labels, beside it by name",
        )
    return align(sound, files.text, language=language)


def _heard(sound: Sound, where: str) -> Speech:
    """Return phones by ear; that they are doubtful is said once for all takes."""
    from lipwright.pipeline import hear

    try:
        return replace(hear(sound), notes=sound.notes)
    except SoundError as error:
        raise error.at(where) from None


def fit_set(
    takes: Sequence[Recorded],
    *,
    base: str | Path = "english",
    name: str = "fitted",
    as_scored: bool = False,
    progress: Progress | None = None,
) -> tuple[BigramSet, FitReport]:
    """Fit a bigram set to recorded faces.

    Parameters
    ----------
    takes : sequence of Recorded
    base : str or path
        The set that gives classes, rules, closures, and whatever no take shows.
    name : str
        Of the new set.
    as_scored : bool
        Whether scores are used as they are; else see
        :func:`~lipwright.character.unmixing.evening` and :func:`straightened`.
    progress : function, optional
        Called with the share that is done, 0..1.

    Raises
    ------
    InputError
        If the takes cannot be used.
    CharacterError
        If none of their channels is a shape of the mouth.
    """
    from lipwright.character.unmixing import evening, unmixing
    from lipwright.engines.bigram import load_set
    from lipwright.engines.bigram.fit import FaceTake, fit_set

    of = load_set(str(base))
    if not takes:
        raise InputError("no takes", expected="one or more recordings of a speaking face")
    channels = takes[0].channels
    for take in takes:
        if take.channels != channels:
            raise InputError(
                "has other channels", where=take.name, expected=f"those of {takes[0].name}"
            )
    moves = [_from_rest(take) for take in takes]
    poses, alike = channels, None
    # Poses are what a set is made of already: they are fitted as they are.
    if not set(channels) <= set(of.rules.names):
        way = unmixing(channels, of.rules.names)
        columns = [channels.index(channel) for channel in way.channels]
        moves = [moved[:, columns] for moved in moves]
        if not as_scored:
            gains = evening(np.concatenate(moves))
            moves = straightened([moved * gains for moved in moves], way.channels)
        moves = [way.weights(moved) for moved in moves]
        poses, alike = way.poses, way.alike
    faces = [
        FaceTake(
            take.name,
            poses,
            np.clip(moved, 0.0, 1.0),
            take.rate,
            take.start,
            take.phones,
            take.words,
        )
        for take, moved in zip(takes, moves, strict=True)
    ]
    return fit_set(faces, of, name, alike=alike, progress=progress)


def straightened(takes: Sequence[Floats], channels: Sequence[str]) -> list[Floats]:
    """Make scores of the lips' shapes proportional to what lips do.

    Trackers score a small movement of the lips as next to nothing and a large one in full;
    the jaw's scores are straight. What a shape shows is raised to the power of 0.6 of its
    own range, the 99th percentile over all takes; that range stays as it is.

    Parameters
    ----------
    takes : sequence of (T, C) float64
        From rest.
    channels : sequence of str
        Those whose names begin with ``mouth`` are of the lips.
    """
    lips = np.array([channel.startswith("mouth") for channel in channels])
    high = np.percentile(np.abs(np.concatenate(takes)), 99, axis=0)
    high = np.maximum(high, 1e-9)
    power = np.where(lips, STRAIGHT, 1.0)
    return [np.sign(values) * high * (np.abs(values) / high) ** power for values in takes]


def _from_rest(take: Recorded) -> Floats:
    """Return how a face differs from its own rest: its median where it is silent."""
    values = np.asarray(take.values, dtype=np.float64)
    times = take.start + (np.arange(len(values)) + 0.5) / take.rate
    silent = np.ones(len(values), dtype=bool)
    for phone in take.phones:
        if phone.label != SILENCE:
            silent &= (times < phone.start - SETTLED) | (times > phone.end + SETTLED)
    if silent.sum() < FEWEST:
        return values
    return np.asarray(values - np.median(values[silent], axis=0))
