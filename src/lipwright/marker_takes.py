"""Takes of markers: one face at rest for all of them, and the markers that all have.

Takes of one actor are laid on one rest face, so that the same place in two takes is the
same place on the face. It is that of the first take that keeps all its markers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from lipwright.errors import InputError, LipwrightError

if TYPE_CHECKING:
    from lipwright.engines.motion.capture import RestFace, TakeFiles
    from lipwright.engines.motion.database import Database
    from lipwright.engines.motion.preparing import Prepared

TRIED = 8
"""Takes that are looked at for one that keeps all its markers."""
MOST_LEFT_OUT = 0.25
"""A take without a greater share of the markers is left out; else the markers are."""


def are_markers(found: Sequence[TakeFiles], folder: str) -> bool:
    """Tell whether takes are of markers.

    Raises
    ------
    InputError
        If some are and some are not.
    """
    kinds: dict[bool, str] = {}
    for take in found:
        kinds.setdefault(take.motion.suffix.lower() == ".c3d", take.motion.name)
    if len(kinds) > 1:
        raise InputError(
            f"shapes ({kinds[False]}) and markers ({kinds[True]})",
            where=folder,
            expected="takes of one kind: what is learnt from one says nothing of the other",
            cure="put them into two folders and build two databases",
        )
    return True in kinds


def rest_of_takes(found: Sequence[TakeFiles]) -> RestFace | None:
    """Return the rest face of the first take that keeps all its markers.

    If none of the first eight that can be cleaned does, that of the take that keeps most;
    None where no take can be cleaned.
    """
    from lipwright.engines.motion.capture import clean, read_motion

    best: RestFace | None = None
    tried = 0
    for take in found:
        try:
            report = clean(read_motion(take.motion))[1]
        except LipwrightError:
            continue  # whoever prepares it says what is wrong
        if best is None or len(report.rest.labels) > len(best.labels):
            best = report.rest
        tried += 1
        if not report.refused or tried == TRIED:
            break
    return best


def rest_of_database(database: Database) -> RestFace | None:
    """Return the rest face on which a database's takes lie; None where it has no markers."""
    from lipwright.engines.motion.capture import RestFace

    if not database.markers:
        return None
    points = np.asarray(database.rest, np.float64).reshape(-1, 3)
    return RestFace(database.markers, points, database.rigid)


def with_same_markers(
    takes: Sequence[Prepared], wanted: Sequence[str] | None = None
) -> tuple[list[Prepared], list[str], list[str]]:
    """Bring takes to the markers that all of them have.

    Parameters
    ----------
    takes : sequence of Prepared
        Of coordinates of markers.
    wanted : sequence of str, optional
        The channels of a database that they are added to: a take without one is left out.

    Returns
    -------
    takes : list of Prepared
    notes : list of str
        Markers that were left out, and why.
    refused : list of str
        Takes that were left out, and why.
    """
    every = list(wanted) if wanted else list(dict.fromkeys(c for t in takes for c in t.channels))
    least = len(every) * (1.0 if wanted else 1.0 - MOST_LEFT_OUT)
    kept, refused = [], []
    for take in takes:
        lacks = [name for name in every if name not in take.channels]
        if len(every) - len(lacks) < least:
            shown = ", ".join(dict.fromkeys(name[:-2] for name in lacks[:12]))
            refused.append(f"{take.name}: lost the markers {shown} for too long")
        else:
            kept.append(take)
    common = [name for name in every if all(name in take.channels for take in kept)]
    lost = [name[:-2] for name in every[::3] if name not in common]
    notes = [f"markers that some take lost for too long: {', '.join(lost)}"] if lost else []
    return [_taken(take, common) for take in kept], notes, refused


def _taken(take: Prepared, channels: Sequence[str]) -> Prepared:
    if list(take.channels) == list(channels):
        return take
    columns = [take.channels.index(name) for name in channels]
    values = np.ascontiguousarray(take.values[:, columns])
    return replace(take, channels=tuple(channels), values=values)
