"""From a folder of recordings to a motion database: read, align, listen, build.

Each take is prepared by itself, several at a time, and kept in a folder beside the
database until that is whole: a second run goes on where the first was stopped.
"""

from __future__ import annotations

import hashlib
import json
import multiprocessing
import os
import pickle
import shutil
import threading
from collections.abc import Callable, Container, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, replace
from multiprocessing.connection import wait
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import InputError, LipwrightError
from lipwright.files import file_version, write_atomically
from lipwright.marker_takes import (
    are_markers,
    rest_of_database,
    rest_of_takes,
    with_same_markers,
)
from lipwright.phones import PhoneTrack
from lipwright.phones.through import through_classes
from lipwright.timeline import Interval, Tier

if TYPE_CHECKING:
    from lipwright.engines.motion.capture import RestFace, TakeFiles
    from lipwright.engines.motion.database import Database
    from lipwright.engines.motion.preparing import Prepared
    from lipwright.engines.motion.take import Take

Progress = Callable[[float], None]
_PART = ".takes"
_VERSION = 3


@dataclass(frozen=True, slots=True)
class TakeReport:
    """What became of one take.

    Parameters
    ----------
    name : str
    seconds : float
        Of motion.
    phones : int
    gaps : float
        Of markers, the share of places that were not seen, 0..1.
    variance : float
        Share of its variance that the database's components keep, 0..1.
    notes : tuple of str
        What was mended.
    refused : str
        Why it was left out; nothing where it was not.
    """

    name: str
    seconds: float = 0.0
    phones: int = 0
    gaps: float = 0.0
    variance: float = 0.0
    notes: tuple[str, ...] = ()
    refused: str = ""


@dataclass(frozen=True, slots=True)
class Building:
    """How a build went.

    Parameters
    ----------
    takes : int
        How many are in the database.
    notes : tuple of str
        What was mended in a take.
    refused : tuple of str
        Takes that were left out, each with the reason.
    reports : tuple of TakeReport
        Of every take of the folder.
    """

    takes: int
    notes: tuple[str, ...]
    refused: tuple[str, ...]
    reports: tuple[TakeReport, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class _How:
    """How takes are prepared."""

    language: str
    rest: RestFace | None = None

    @property
    def state(self) -> list[object]:
        """What tells it from another, as JSON values."""
        rest = self.rest
        return [self.language, rest and [rest.labels, rest.points.tolist(), rest.rigid]]


@dataclass(frozen=True, slots=True, eq=False)
class _Answer:
    """What comes of preparing a take, as it is kept."""

    prepared: Prepared | None
    report: TakeReport


def build_motion(
    folder: str | Path,
    database: str | Path,
    *,
    texts: str | Path | None = None,
    clusters: int = 0,
    language: str = "en-us",
    by_ear: bool = False,
    add: bool = False,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Building:
    """Build a motion database from a folder of recordings, or add them to one.

    Parameters
    ----------
    folder : path
        Motion (CSV of blendshapes, C3D) with sound and words beside it by name.
    database : path
        A folder; what is there stays whole until the new database is.
    texts : path, optional
        A table of names and texts.
    clusters : int
        Into how many nodes units of like motion are merged; 0: they are not.
    language : str
        That is spoken.
    by_ear : bool
        Whether takes without words and labels are used too, their phones heard
        (:mod:`lipwright.schedule.by_ear`).
    add : bool
        Whether the takes go behind those of a database that is there.
    workers : int, optional
        How many takes are prepared at once; one per processor where not given.
    progress : function, optional
        Called with the share that is done, 0..1.

    Raises
    ------
    InputError
        If no take can be used.
    OutputError
        If the database cannot be written.
    """
    from lipwright.engines.motion.building import append, build, held_already
    from lipwright.engines.motion.capture import find_takes
    from lipwright.engines.motion.database import Settings, open_database
    from lipwright.engines.motion.learnt import keep_learnt

    found = [replace(take, by_ear=by_ear) for take in find_takes(folder, texts)]
    target = Path(database)
    _check(target)
    old = open_database(target) if add else None
    rest = _rest(found, str(folder), old)
    part = target.parent / f".{target.name}{_PART}"
    answers = _prepared(found, part, _How(language, rest), workers, progress)
    prepared = [answer.prepared for answer in answers if answer.prepared is not None]
    notes = [f"{one.report.name}: {note}" for one in answers for note in one.report.notes]
    refused = [one.report.refused for one in answers if one.report.refused]
    if rest is not None:
        prepared, lost, short = with_same_markers(prepared, old.channels if old else None)
        notes, refused = [*notes, *lost], [*refused, *short]
    heard = sum(take.has_only_sound for take in found)
    if not prepared:
        shutil.rmtree(part, ignore_errors=True)
        reasons = "; ".join(refused[:3])
        cure = "" if by_ear or not heard else "takes without words are used with --by-ear"
        raise InputError("no take can be used", where=str(folder), expected=reasons, cure=cure)
    if by_ear and heard:
        notes.append(f"takes without words: {heard}; their phones are heard, by an English model")
    if old is not None:
        there = held_already(old, prepared)
        notes += [f"{name}: is in the database already" for name in sorted(there)]
        made = append(target, (take for take in prepared if take.name not in there))
    else:
        face, rigid = _resting(prepared[0].channels, rest)
        made = build(target, prepared, Settings(clusters=clusters), face, rigid)
    keep_learnt(made)
    shutil.rmtree(part, ignore_errors=True)
    reports = _reports(answers, made, dict.fromkeys(take.name for take in prepared))
    return Building(len(made.take_start), tuple(notes), tuple(refused), reports)


def _rest(found: Sequence[TakeFiles], folder: str, old: Database | None) -> RestFace | None:
    """Return the face at rest that takes of markers are laid on; None for shapes."""
    if not are_markers(found, folder):
        return None
    return rest_of_takes(found) if old is None else rest_of_database(old)


def _resting(
    channels: Sequence[str], rest: RestFace | None
) -> tuple[NDArray[np.float64] | None, tuple[str, ...]]:
    """Return the places of a database's markers at rest, and those that do not deform."""
    from lipwright.markers import marker_channels, marker_labels

    if rest is None:
        return None, ()
    places = dict(zip(marker_channels(rest.labels), rest.points.ravel().tolist(), strict=True))
    kept = set(marker_labels(channels))
    return np.array([places[name] for name in channels]), tuple(
        label for label in rest.rigid if label in kept
    )


def _reports(
    answers: Sequence[_Answer], made: Database, used: Container[str]
) -> tuple[TakeReport, ...]:
    """Return what became of each take, with what the components keep of it."""
    names = {made.take_name(take): take for take in range(len(made.take_start))}
    found = []
    for one in (answer.report for answer in answers):
        if one.refused or one.name not in used:
            found.append(replace(one, refused=one.refused or "lost too many markers"))
            continue
        frames = slice(*made.take_first[names[one.name] : names[one.name] + 2].tolist())
        away = made.values[frames] - made.mean
        left = away - made.frames[frames] @ made.basis
        whole = float((away**2).sum(dtype=np.float64))
        kept = 1.0 - float((left**2).sum(dtype=np.float64)) / whole if whole > 0 else 1.0
        found.append(replace(one, variance=round(kept, 5)))
    return tuple(found)


def _check(target: Path) -> None:
    from lipwright.engines.motion.storage import check_folder

    check_folder(target)


def _prepared(
    found: Sequence[TakeFiles],
    part: Path,
    how: _How,
    workers: int | None,
    progress: Progress | None,
) -> list[_Answer]:
    """Prepare takes, or take them from where an earlier run left them."""
    part.mkdir(parents=True, exist_ok=True)
    paths = {take.name: part / f"{_key(take, how)}.take" for take in found}
    answers = {name: answer for name, path in paths.items() if (answer := _kept(path))}
    missing = [take for take in found if take.name not in answers]
    for report in _work(missing, paths, how, workers):
        path = paths[report.name]
        kept = None if report.refused else pickle.loads(path.read_bytes())
        answers[report.name] = kept or _Answer(None, report)
        if progress is not None:
            progress(0.95 * len(answers) / len(found))
    return [answers[take.name] for take in found]


def _kept(path: Path) -> _Answer | None:
    """Return what was kept of a take, or None where it is missing or damaged."""
    try:
        answer = pickle.loads(path.read_bytes())
    except (OSError, pickle.UnpicklingError, EOFError, ValueError, LookupError, AttributeError):
        return None
    return answer if isinstance(answer, _Answer) else None


def _key(take: TakeFiles, how: _How) -> str:
    """What tells a take in its present state from any other."""
    paths = [path for path in (take.motion, take.sound, take.labels) if path is not None]
    state = [[str(path), file_version(str(path))] for path in paths]
    text = json.dumps([_VERSION, take.name, take.text, take.by_ear, how.state, state])
    return hashlib.sha256(text.encode()).hexdigest()[:24]


def _work(
    takes: Sequence[TakeFiles], paths: dict[str, Path], how: _How, workers: int | None
) -> Iterator[TakeReport]:
    """Prepare takes, several at once; say of each how it went when it is done."""
    count = min(workers or os.cpu_count() or 1, len(takes))
    if count <= 1:
        for take in takes:
            yield _one(take, paths[take.name], how)
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(count, mp_context=context, initializer=_end_with_parent) as pool:
        waiting = [pool.submit(_one, take, paths[take.name], how) for take in takes]
        try:
            for future in as_completed(waiting):
                yield future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _end_with_parent() -> None:
    """End this process when the one that started it has ended, killed or not.

    Otherwise it would wait for work for ever.
    """
    parent = multiprocessing.parent_process()
    if parent is None:
        return

    def follow(sentinel: int) -> None:
        wait([sentinel])
        os._exit(1)

    threading.Thread(target=follow, args=(parent.sentinel,), daemon=True).start()


def _one(take: TakeFiles, path: Path, how: _How) -> TakeReport:
    """Prepare a take and keep it; not why it is refused: what it lacked may be there next time."""
    try:
        answer = _prepare(take, how)
    except LipwrightError as error:
        return TakeReport(take.name, refused=str(error))
    write_atomically(path, pickle.dumps(answer))
    return answer.report


def _prepare(files: TakeFiles, how: _How) -> _Answer:
    """Read a take, put its words in time, listen to its sound."""
    from lipwright.engines.motion.preparing import prepare
    from lipwright.engines.motion.take import Take
    from lipwright.recorded import read_take

    take = read_take(files, how.language, how.rest)
    ready = prepare(
        Take(
            take.name,
            take.channels,
            np.asarray(take.values, np.float32),
            take.rate,
            take.start,
            _full_labels(take.phones),
            take.words,
            take.sound,
        ),
        features=_features,
    )
    report = TakeReport(
        take.name,
        seconds=round(len(take.values) / take.rate, 3),
        phones=len(ready.cut.labels),
        gaps=round(take.cleaning.gap_share, 5) if take.cleaning else 0.0,
        notes=take.notes,
    )
    return _Answer(ready, report)


def _features(take: Take) -> NDArray[np.float32]:
    from lipwright.engines.motion.rasta_plp import rasta_plp

    assert take.sound is not None  # it is asked only of takes that have sound
    return rasta_plp(take.sound, take.rate, take.start, len(take.values)).values


def _full_labels(track: PhoneTrack) -> PhoneTrack:
    """Return phones in ARPAbet, the notation of all databases."""
    if track.phone_set == "arpabet":
        return track
    rows, _ = through_classes(track.phone_set, "arpabet").rows(track)
    return PhoneTrack(Tier(tuple(Interval(*row) for row in rows)), "arpabet")
