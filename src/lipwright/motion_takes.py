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
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import InputError, LipwrightError
from lipwright.files import file_version, write_atomically
from lipwright.phones import PhoneTrack, load_reduction
from lipwright.timeline import Interval, Tier

if TYPE_CHECKING:
    from lipwright.engines.motion.capture import TakeFiles
    from lipwright.engines.motion.preparing import Prepared
    from lipwright.engines.motion.take import Take

Progress = Callable[[float], None]
_PART = ".takes"
_VERSION = 1


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
    """

    takes: int
    notes: tuple[str, ...]
    refused: tuple[str, ...]


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
    from lipwright.engines.motion.building import append, build
    from lipwright.engines.motion.capture import find_takes
    from lipwright.engines.motion.database import Settings
    from lipwright.engines.motion.learnt import keep_learnt

    found = [replace(take, by_ear=by_ear) for take in find_takes(folder, texts)]
    target = Path(database)
    _check(target)
    part = target.parent / f".{target.name}{_PART}"
    heard = sum(take.has_only_sound for take in found)
    prepared, notes, refused = _prepared(found, part, language, workers, progress)
    if not prepared:
        reasons = "; ".join(refused[:3])
        cure = "" if by_ear or not heard else "takes without words are used with --by-ear"
        raise InputError("no take can be used", where=str(folder), expected=reasons, cure=cure)
    made = append(target, prepared) if add else build(target, prepared, Settings(clusters=clusters))
    keep_learnt(made)
    shutil.rmtree(part, ignore_errors=True)
    if by_ear and heard:
        notes.append(f"takes without words: {heard}; their phones are heard, by an English model")
    return Building(len(made.take_start), tuple(notes), tuple(refused))


def _check(target: Path) -> None:
    from lipwright.engines.motion.storage import check_folder

    check_folder(target)


def _prepared(
    found: Sequence[TakeFiles],
    part: Path,
    language: str,
    workers: int | None,
    progress: Progress | None,
) -> tuple[list[Prepared], list[str], list[str]]:
    """Prepare takes, or take them from where an earlier run left them."""
    part.mkdir(parents=True, exist_ok=True)
    kept = {take.name: part / f"{_key(take, language)}.take" for take in found}
    missing = [take for take in found if not kept[take.name].is_file()]
    done = len(found) - len(missing)
    for _ in _work(missing, kept, language, workers):
        done += 1
        if progress is not None:
            progress(0.95 * done / len(found))
    prepared, notes, refused = [], [], []
    for take in found:
        answer, said = pickle.loads(kept[take.name].read_bytes())
        if answer is None:
            refused.append(said[0])
        else:
            prepared.append(answer)
            notes += said
    return prepared, notes, refused


def _key(take: TakeFiles, language: str) -> str:
    """What tells a take in its present state from any other."""
    paths = [path for path in (take.motion, take.sound, take.labels) if path is not None]
    state = [[str(path), file_version(str(path))] for path in paths]
    text = json.dumps([_VERSION, take.name, take.text, language, take.by_ear, state])
    return hashlib.sha256(text.encode()).hexdigest()[:24]


def _work(
    takes: Sequence[TakeFiles], kept: dict[str, Path], language: str, workers: int | None
) -> Iterator[str]:
    """Prepare takes, several at once; give each one's name when it is done."""
    count = min(workers or os.cpu_count() or 1, len(takes))
    if count <= 1:
        for take in takes:
            yield _one(take, kept[take.name], language)
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(count, mp_context=context) as pool:
        waiting = [pool.submit(_one, take, kept[take.name], language) for take in takes]
        try:
            for future in as_completed(waiting):
                yield future.result()
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _one(take: TakeFiles, path: Path, language: str) -> str:
    answer: tuple[Prepared | None, list[str]]
    try:
        answer = _prepare(take, language)
    except LipwrightError as error:
        answer = None, [str(error)]
    write_atomically(path, pickle.dumps(answer))
    return take.name


def _prepare(files: TakeFiles, language: str) -> tuple[Prepared, list[str]]:
    """Read a take, put its words in time, listen to its sound."""
    from lipwright.engines.motion.preparing import prepare
    from lipwright.engines.motion.take import Take
    from lipwright.recorded import read_take

    take = read_take(files, language)
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
    return ready, [f"{take.name}: {note}" for note in take.notes]


def _features(take: Take) -> NDArray[np.float32]:
    from lipwright.engines.motion.rasta_plp import rasta_plp

    assert take.sound is not None  # it is asked only of takes that have sound
    return rasta_plp(take.sound, take.rate, take.start, len(take.values)).values


def _full_labels(track: PhoneTrack) -> PhoneTrack:
    """Return phones in ARPAbet, the notation of all databases."""
    if track.phone_set == "arpabet":
        return track
    rows, _ = load_reduction(track.phone_set, "arpabet").rows(track.normalised())
    return PhoneTrack(Tier(tuple(Interval(*row) for row in rows)), "arpabet")
