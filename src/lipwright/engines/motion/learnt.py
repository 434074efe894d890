"""What smoothing and closing learn from a database, kept beside it.

To learn it takes a pass over all frames; to read it, a millisecond.
"""

from __future__ import annotations

import json
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.closures import Opening, opening_of
from lipwright.engines.motion.database import Database
from lipwright.engines.motion.joining import Learnt, learn
from lipwright.errors import LipwrightError
from lipwright.files import read_bytes, write_atomically

FILE = "learnt.json"


def opening_in(database: Database) -> Opening | None:
    """Return how the motion of a database opens the mouth; None where nobody knows."""
    opening = opening_of(database.channels)
    if opening is None:
        return None
    rest = np.asarray(database.rest, np.float64)

    def with_rest(motion: NDArray[Any]) -> NDArray[Any]:
        return opening(motion + rest)

    return with_rest


def keep_learnt(database: Database) -> Learnt:
    """Learn from a database and put it beside it.

    Raises
    ------
    OutputError
        If the folder cannot be written.
    """
    learnt = learn(database, opening_in(database))
    document = {"of": _of(database), **learnt.document()}
    write_atomically(database.folder / FILE, json.dumps(document).encode())
    return learnt


def learnt_of(database: Database) -> Learnt:
    """Return what was learnt from a database; it is learnt anew where nothing is kept."""
    try:
        document = msgspec.json.decode(read_bytes(database.folder / FILE))
        if document["of"] == _of(database):
            return Learnt.of(document)
    except (LipwrightError, msgspec.DecodeError, KeyError, TypeError, ValueError):
        pass
    return learn(database, opening_in(database))


def _of(database: Database) -> list[float]:
    """What tells one state of a database from the next."""
    return [len(database.frames), len(database.label), float(database.total_variance)]
