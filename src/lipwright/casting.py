"""Who speaks, and with which set: the engine that a line is animated with.

A set is the user's, else the character's, else a default. What a character and the user
change of it is laid over it. Engines are kept, and made anew when a file of theirs changes.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from lipwright.errors import InputError
from lipwright.files import file_version

if TYPE_CHECKING:
    from lipwright.character import CharacterFile
    from lipwright.engines.bigram import BigramEngine, BigramSet

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
    files = [str(path) if path else None for path in (overrides, reduction)]
    read = (chosen, *(path for path in files if path))
    versions = (file.files if file else (), *map(file_version, read))
    return _engine(chosen, preset, files[0], files[1], file, versions)


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


@lru_cache(maxsize=32)
def _engine(
    bigram_set: str,
    preset: str,
    overrides: str | None,
    reduction: str | None,
    file: CharacterFile | None,
    versions: tuple[object, ...],
) -> BigramEngine:
    from lipwright.engines.bigram import BigramEngine, read_overrides

    base = _loaded_set(bigram_set, file)
    return BigramEngine(read_overrides(overrides, base) if overrides else base, preset, reduction)


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
