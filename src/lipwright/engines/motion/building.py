"""Building a database from takes, and adding takes to one (DESIGN section 5).

``prepare`` does what one take needs, ``build`` puts prepared takes together. ``append``
puts the takes of a database before the new ones and gives what building all at once
would give: no sound is aligned or analysed anew, only the components, the graph and
the index are.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.assembling import MOST_UNITS, assembled
from lipwright.engines.motion.database import Database, Settings, open_database
from lipwright.engines.motion.preparing import Prepared
from lipwright.engines.motion.storage import check_folder, clear, write
from lipwright.engines.motion.units import Cut
from lipwright.errors import InputError


def build(
    folder: str | Path,
    takes: Iterable[Prepared],
    settings: Settings | None = None,
    rest: NDArray[np.floating] | None = None,
    rigid: Sequence[str] = (),
    about: str = "",
) -> Database:
    """Build a database; one that is there stays whole until the new one is complete.

    Parameters
    ----------
    folder : str or Path
    takes : iterable of Prepared
        In the order that they are to have.
    settings : Settings, optional
    rest : (C,) float32, optional
        The face at rest that was subtracted from the channels; zeros where not given.
    rigid : sequence of str
        Of markers, those that do not deform.
    about : str
        What whoever animates with it is told.

    Raises
    ------
    InputError
        If the takes do not go together, or there is none.
    OutputError
        If the folder cannot be written.
    """
    place = Path(folder)
    check_folder(place)
    settings = settings or Settings()
    check_settings(settings)
    ready = list(takes)
    _check_together(ready)
    shape = len(ready[0].channels)
    rest = np.zeros(shape, np.float32) if rest is None else np.asarray(rest, np.float32)
    if rest.shape != (shape,):
        raise InputError(f"a rest face of shape {rest.shape}", expected=f"{shape} channels")
    header, arrays = assembled(ready, settings)
    if rigid:
        header["rigid"] = list(rigid)
    if about:
        header["about"] = about
    write(place, header, {**arrays, "rest": rest})
    return open_database(place)


def append(folder: str | Path, takes: Iterable[Prepared]) -> Database:
    """Add takes to a database: what building all of them at once would give.

    Raises
    ------
    InputError
        If there is no database, or the takes do not go with those in it.
    OutputError
        If it cannot be written; then it stays as it was.
    """
    database = open_database(folder)
    new = list(takes)
    if not new:
        clear(database.folder)
        return database
    old = takes_of(database)
    rest = np.array(database.rest)
    return build(folder, [*old, *new], database.settings, rest, database.rigid, database.about)


def held_already(database: Database, takes: Iterable[Prepared]) -> frozenset[str]:
    """Return the names of takes that a database holds, just as they are.

    Who was stopped after takes were added, before it could say so, adds them again.
    """
    held = {take.name: take for take in takes_of(database)}
    return frozenset(
        take.name for take in takes if take.name in held and _same(take, held[take.name])
    )


def _same(one: Prepared, other: Prepared) -> bool:
    def said(take: Prepared) -> tuple[object, ...]:
        return (take.channels, take.rate, take.start, take.phone_set, take.cut.labels)

    if one.features is None or other.features is None:
        heard = one.features is other.features
    else:
        heard = np.array_equal(one.features, other.features)
    return (
        heard
        and said(one) == said(other)
        and np.array_equal(one.values, other.values)
        and np.array_equal(one.cut.spans, other.cut.spans)
    )


def takes_of(database: Database) -> list[Prepared]:
    """Return what a database was built from, without a copy of its frames."""
    labels = np.array(database.labels)[database.label]
    found = []
    for take, start in enumerate(database.take_start.tolist()):
        frames = slice(*database.take_first[take : take + 2].tolist())
        units = slice(*database.take_unit[take : take + 2].tolist())
        sound = database.features[frames] if database.take_has_sound[take] else None
        found.append(
            Prepared(
                database.take_name(take),
                database.channels,
                database.values[frames],
                sound,
                database.rate,
                start,
                database.phone_set,
                Cut(tuple(labels[units].tolist()), database.spans[units] - frames.start),
            )
        )
    return found


def check_settings(settings: Settings) -> None:
    """Refuse settings that no database can be built with, naming the first.

    Raises
    ------
    InputError
    """
    limits: dict[str, tuple[float, float]] = {
        "variance": (1e-6, 1.0),
        "least_components": (1, 1000),
        "sound_points": (1, 100),
        "motion_points": (1, 1000),
        "velocity_time": (0.0, 10.0),
        "clusters": (0, MOST_UNITS),
        "seed": (0, 2**63 - 1),
    }
    for name, (least, most) in limits.items():
        value = getattr(settings, name)
        if not least <= value <= most:
            raise InputError(f"{name} = {value}", expected=f"{least:g} to {most:g}")


def _check_together(takes: Sequence[Prepared]) -> None:
    if not takes:
        raise InputError("no take", expected="at least one take with motion and phones")
    one = takes[0]
    seen: set[str] = set()
    for take in takes:
        where = f"take {take.name!r}"
        if take.name in seen:
            raise InputError("is there twice", where=where, cure="rename one of the two")
        seen.add(take.name)
        if take.channels != one.channels:
            differing = sorted(set(take.channels) ^ set(one.channels))
            shown = repr(differing[0]) if differing else "another order"
            raise InputError(
                f"other channels than take {one.name!r} ({shown})",
                where=where,
                expected=f"the same {len(one.channels)} channels in every take",
            )
        if not np.isclose(take.rate, one.rate, rtol=1e-6):
            raise InputError(
                f"{take.rate:g} frames per second",
                where=where,
                expected=f"{one.rate:g}, as take {one.name!r} has",
            )
        if take.phone_set != one.phone_set:
            raise InputError(
                f"phones of {take.phone_set!r}",
                where=where,
                expected=f"phones of {one.phone_set!r}",
            )
