"""The takes of a motion database as recorded faces: what a bigram set can be fitted to.

A database keeps what it was built from: each take's channels, frame by frame, and when its
phones sound. Nothing is aligned anew. Databases of ARKit's shapes, of a set's poses, and of
markers can be fitted; markers are told in poses first, on the built-in head.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.recorded import Progress, Recorded, read_takes
from lipwright.timeline import Interval, Tier

if TYPE_CHECKING:
    from lipwright.engines.motion.database import Database
    from lipwright.engines.motion.preparing import Prepared


def takes_to_fit(
    folder: str | Path,
    text: str | Path | None = None,
    base: str | Path = "english",
    progress: Progress | None = None,
) -> list[Recorded]:
    """Return the takes of a folder of recordings, or of a motion database.

    See :func:`database_takes`, and :func:`lipwright.recorded.read_takes` for recordings.
    """
    if is_database(folder):
        return database_takes(folder, text, base)
    return read_takes(folder, text=text, progress=progress)


def is_database(folder: str | Path) -> bool:
    """Whether a folder is a motion database, whole or not."""
    from lipwright.engines.motion.storage import HEADER

    return (Path(folder) / HEADER).is_file()


def database_takes(
    folder: str | Path, text: str | Path | None = None, base: str | Path = "english"
) -> list[Recorded]:
    """Return the takes of a motion database.

    Parameters
    ----------
    folder : path
        As :func:`lipwright.motion_takes.build_motion` makes it.
    text : path, optional
        Refused: a database has phones.
    base : str or path
        The set in whose poses markers are told.

    Raises
    ------
    InputError
        If words are given.
    CharacterError
        If markers do not fit the built-in head.
    FileFormatError
        If it is broken.
    """
    from lipwright.engines.motion.building import takes_of
    from lipwright.engines.motion.database import open_database

    if text is not None:
        raise InputError(
            "words for a motion database", where=str(text), cure="leave them out: it has phones"
        )
    database = open_database(folder)
    takes = [_recorded(take) for take in takes_of(database)]
    return _told(takes, database, base) if database.markers else takes


def _told(takes: list[Recorded], database: Database, base: str | Path) -> list[Recorded]:
    """Return takes of markers in the poses that they show."""
    from lipwright.acting import marker_telling
    from lipwright.character import keep_character
    from lipwright.engines.bigram import load_set

    names = load_set(str(base)).rules.names
    telling = marker_telling(database, keep_character("head"), names, "", None)
    rest = np.asarray(database.rest, np.float64)
    free = np.full((1, len(telling.poses)), np.nan)
    return [
        replace(
            take,
            channels=telling.poses,
            values=telling.weights(take.values + rest, np.repeat(free, len(take.values), axis=0)),
        )
        for take in takes
    ]


def _recorded(take: Prepared) -> Recorded:
    times = take.start + take.cut.spans / take.rate
    phones = [
        Interval(label, first, last)
        for label, (first, last) in zip(take.cut.labels, times.tolist(), strict=True)
    ]
    track = PhoneTrack(Tier(tuple(phones)), take.phone_set)
    return Recorded(take.name, take.channels, take.values, take.rate, take.start, track)
