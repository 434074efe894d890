"""The takes of a motion database as recorded faces: what a bigram set can be fitted to.

A database keeps what it was built from: each take's channels, frame by frame, and when its
phones sound. Nothing is aligned anew. Databases of ARKit's shapes, and of a set's poses,
can be fitted; those of markers cannot yet.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.recorded import Recorded
from lipwright.timeline import Interval, Tier

if TYPE_CHECKING:
    from lipwright.engines.motion.preparing import Prepared

AXES = (".x", ".y", ".z")


def is_database(folder: str | Path) -> bool:
    """Whether a folder is a motion database, whole or not."""
    from lipwright.engines.motion.storage import HEADER

    return (Path(folder) / HEADER).is_file()


def database_takes(folder: str | Path, text: str | Path | None = None) -> list[Recorded]:
    """Return the takes of a motion database.

    Parameters
    ----------
    folder : path
        As :func:`lipwright.motion_takes.build_motion` makes it.
    text : path, optional
        Refused: a database has phones.

    Raises
    ------
    InputError
        If it holds markers, or words are given.
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
    if any(channel.endswith(AXES) for channel in database.channels):
        raise InputError(
            f"a database of markers ({database.channels[0]!r}), which no set is fitted to yet",
            where=str(folder),
            expected="one of ARKit's shapes, or of a set's poses",
        )
    return [_recorded(take) for take in takes_of(database)]


def _recorded(take: Prepared) -> Recorded:
    times = take.start + take.cut.spans / take.rate
    phones = [
        Interval(label, first, last)
        for label, (first, last) in zip(take.cut.labels, times.tolist(), strict=True)
    ]
    track = PhoneTrack(Tier(tuple(phones)), take.phone_set)
    return Recorded(take.name, take.channels, take.values, take.rate, take.start, track)
