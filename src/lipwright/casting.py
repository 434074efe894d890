"""Who speaks, and with which set: the engine that a line is animated with.

A set is the user's, else the character's, else a default. What a character and the user
change of it is laid over it. Engines are kept, and made anew when a file of theirs changes.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from lipwright.errors import InputError
from lipwright.files import Kept, Version, file_version

if TYPE_CHECKING:
    from lipwright.character import CharacterFile
    from lipwright.engines.bigram import BigramEngine, BigramSet
    from lipwright.engines.motion.engine import MotionEngine

ENGINES = ("bigram", "motion", "neural", "auto")
DEFAULT_SET = "english"
SETS_BY_LANGUAGE = {"cmn": "mandarin", "zh": "mandarin"}
"""Languages that have a set of their own, by their first part."""


def engine_for(
    bigram_set: str | Path | None = None,
    preset: str = "default",
    overrides: str | Path | None = None,
    reduction: str | Path | None = None,
    character: str | Path = "head",
    language: str = "",
) -> BigramEngine:
    """Return the engine for a set and who speaks; made once, and anew when a file changes."""
    from lipwright.character import set_of

    file = character_file(character)
    chosen = _chosen_set(bigram_set, set_of(file, str(character)), language)
    paths = [str(path) if path else "" for path in (overrides, reduction)]
    key = (chosen, preset, *paths, file, *map(os.path.abspath, (chosen, *paths)))
    return _engines.get(key, lambda: _cast(chosen, preset, paths[0], paths[1], file)).engine


def set_for(bigram_set: str | Path | None, character: str | Path | None) -> BigramSet:
    """Return a set as a character has it: the user's, else the character's, else English."""
    from lipwright.character import keep_character
    from lipwright.character.pictures import is_pictures
    from lipwright.engines.bigram import load_set

    if character is None:
        return load_set(str(bigram_set or DEFAULT_SET))
    if not is_pictures(character):
        keep_character(character)  # one that is not there is refused
    return engine_for(bigram_set, character=character).of


def files_read(character: str | Path, bigram_set: str | Path | None = None) -> list[str]:
    """Return the files that a character and its set are made of: they are not written over."""
    file = character_file(character)
    named = [str(character)]
    if file is not None:
        named += [*(path for path, _ in file.files), file.model[0]]
    chosen = str(bigram_set or (file.bigram_set[0] if file else ""))
    return [*named, *_set_files(chosen)] if chosen.endswith(".json") else named


def _set_files(path: str) -> list[str]:
    from lipwright.engines.bigram import load_set

    try:
        return [name for name, _ in load_set(path).files]
    except InputError:
        return [path]  # whoever animates with it says what is wrong


def character_file(character: str | Path | None) -> CharacterFile | None:
    """Return a character's file; None, at once, where it is a model or a built-in one."""
    if character is None or Path(character).suffix.lower() != ".json":
        return None
    from lipwright.character import file_of
    from lipwright.character.pictures import is_pictures

    return None if is_pictures(character) else file_of(character)


def _chosen_set(given: str | Path | None, own: str, language: str) -> str:
    """Return the set to animate with: the user's, else the character's, else the language's."""
    if given is not None:
        return str(given)
    first = language.replace("_", "-").split("-")[0].lower()
    return own or SETS_BY_LANGUAGE.get(first, DEFAULT_SET)


@dataclass(frozen=True, slots=True)
class _Cast:
    """An engine, and the files that it was made from."""

    engine: BigramEngine
    files: tuple[tuple[str, Version | None], ...]


_engines: Kept[_Cast] = Kept(32)


def _cast(
    bigram_set: str, preset: str, overrides: str, reduction: str, file: CharacterFile | None
) -> _Cast:
    from lipwright.engines.bigram import BigramEngine, read_overrides

    given = tuple((path, file_version(path)) for path in (overrides, reduction) if path)
    base = _loaded_set(bigram_set, file)
    of = read_overrides(overrides, base) if overrides else base
    files = (*(file.files if file else ()), *base.files, *given)
    return _Cast(BigramEngine(of, preset, reduction or None), files)


def _loaded_set(name: str, file: CharacterFile | None) -> BigramSet:
    """Return a set with what a character, and each character beneath it, changes of it."""
    from lipwright.engines.bigram import load_set, with_character

    named, where = file.bigram_set if file else ("", "")
    try:
        base = load_set(name)
    except InputError as error:
        raise (error.at(f"{where}, at set") if name == named else error) from None
    for layer in file.layers if file else ():
        base = with_character(base, layer.name, layer.path, layer.overrides, layer.settings)
    return base


def check_engine(
    engine: str,
    database: str | Path | None,
    of_bigrams: Sequence[object],
    model: str | Path | None = None,
    of_motion: Sequence[object] = (),
) -> None:
    """Refuse an engine that is unknown, lacks what it needs, or is given what it cannot use.

    Raises
    ------
    InputError
    """
    if engine not in ENGINES:
        raise InputError(f"no engine {engine!r}", expected=" or ".join(ENGINES))
    if engine != "motion" and database is not None:
        raise InputError(
            f"a motion database, with the {engine} engine", cure="choose the motion engine"
        )
    if engine != "motion" and any(given is not None for given in of_motion):
        raise InputError(
            f"controls or markers, with the {engine} engine",
            cure="leave them out: they are the motion engine's",
        )
    if engine not in ("neural", "auto") and model is not None:
        raise InputError(
            f"a neural model, with the {engine} engine", cure="choose the neural engine"
        )
    if engine not in ("bigram", "auto") and any(given is not None for given in of_bigrams):
        raise InputError(
            f"{'a set, ' if engine == 'neural' else ''}overrides, a reduction or edits,"
            f" with the {engine} engine",
            cure="leave them out: they are the bigram engine's",
        )


def motion_engine(database: str | Path | None = None, search: str = "several") -> MotionEngine:
    """Return the engine for a motion database; made once, and anew when it is built anew.

    Without a database it is the built-in one, see :mod:`lipwright.engines.motion.synthetic`.
    """
    from lipwright.engines.motion.synthetic import FOLDER, NAME, database_folder

    folder = database_folder(database)
    header = file_version(str(folder / "database.json"))
    return _motion_engine(str(folder), search, header, NAME if folder == FOLDER else "")


@lru_cache(maxsize=4)
def _motion_engine(database: str, search: str, version: object, name: str) -> MotionEngine:
    from lipwright.engines.motion.database import open_database
    from lipwright.engines.motion.engine import MotionEngine

    return MotionEngine(open_database(database), search, name)
