"""What smoothing and closing learn from a database, kept beside it.

To learn it takes a pass over all frames; to read it, a millisecond.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.closures import Opening, opening_of
from lipwright.engines.motion.database import Database
from lipwright.engines.motion.joining import Learnt, learn
from lipwright.engines.motion.lips import opening_row
from lipwright.engines.motion.storage import LEARNT
from lipwright.errors import LipwrightError
from lipwright.files import read_bytes, write_atomically

_VERSION = 2


@dataclass(frozen=True, slots=True, eq=False)
class Known:
    """All that is learnt from a database once it is built.

    Parameters
    ----------
    learnt : Learnt
        For joining.
    opening : function or None
        How far a motion (T, C), without the rest face, opens the mouth; None where nobody
        knows.
    row : (C,) float64 or None
        The opening of markers, see :func:`.lips.opening_row`.
    """

    learnt: Learnt
    opening: Opening | None
    row: NDArray[np.float64] | None


def learn_known(database: Database) -> Known:
    """Learn from a database."""
    places = np.asarray(database.rest, np.float64).reshape(-1, 3) if database.markers else None
    row = opening_row(database, places) if places is not None else None
    opening = _opening(database, row)
    return Known(learn(database, opening), opening, row)


def keep_learnt(database: Database) -> Known:
    """Learn from a database and put it beside it.

    Raises
    ------
    OutputError
        If the folder cannot be written.
    """
    known = learn_known(database)
    row = None if known.row is None else known.row.tolist()
    document = {"of": _of(database), "opening": row, **known.learnt.document()}
    write_atomically(database.folder / LEARNT, json.dumps(document).encode())
    return known


def learnt_of(database: Database) -> Known:
    """Return what was learnt from a database; it is learnt anew where nothing is kept."""
    try:
        document = msgspec.json.decode(read_bytes(database.folder / LEARNT))
        if document["of"] == _of(database):
            kept = document["opening"]
            row = None if kept is None else np.array(kept, np.float64)
            return Known(Learnt.of(document), _opening(database, row), row)
    except (LipwrightError, msgspec.DecodeError, KeyError, TypeError, ValueError):
        pass
    return learn_known(database)


def _opening(database: Database, row: NDArray[np.float64] | None) -> Opening | None:
    if row is not None:
        return lambda motion: motion @ row
    named = None if database.markers else opening_of(database.channels)
    if named is None:
        return None
    rest = np.asarray(database.rest, np.float64)

    def with_rest(motion: NDArray[Any]) -> NDArray[Any]:
        return named(motion + rest)

    return with_rest


def _of(database: Database) -> list[float]:
    """What tells one state of a database from the next."""
    return [
        _VERSION,
        len(database.frames),
        len(database.label),
        float(database.total_variance),
    ]
