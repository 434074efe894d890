"""A character file to start from: what an animator opens first and then edits.

With a model it holds how each pose is made on it, one row per line, in the model's own
names; what is left to the set and the model is not in it.
"""

from __future__ import annotations

import os
from pathlib import Path

from lipwright.character.character import BUILT_IN, load_character
from lipwright.character.character_reading import FORMAT, SUFFIX, VERSION, is_character_file
from lipwright.character.mapping import block, row
from lipwright.errors import OutputError
from lipwright.files import check_target, format_number, quote, write_atomically


def start_character(
    path: str | Path, model: str | None, base: str | None, bigram_set: str | None
) -> None:
    """Write a character file to start from.

    Parameters
    ----------
    path : str or Path
        The new file; nothing is written over.
    model : str, optional
        A GLB, VRM or glTF file, or a built-in character's name.
    base : str, optional
        Another character file, or a built-in character's name.
    bigram_set : str, optional
        A set's name or file.

    Raises
    ------
    OutputError
        If the file exists, or cannot be written.
    InputError
        If the model or the base cannot be used.
    """
    target = Path(path)
    if target.suffix.lower() != SUFFIX:
        raise OutputError("is no name for a character file", where=str(path), expected=SUFFIX)
    if target.exists():
        raise OutputError("exists already", where=str(path), cure="choose another name")
    check_target(target)
    if base is not None:
        load_base(base)
    if model in BUILT_IN:
        base, model = base or model, model if base else None
    parts = {"format": quote(FORMAT), "version": str(VERSION), "name": quote(target.stem)}
    parts["about"] = quote("")
    for key, value in (("base", base), ("model", model), ("set", bigram_set)):
        if value:
            parts[key] = quote(_from(target, value, key))
    rows = [f"{quote(key)}: {value}" for key, value in parts.items()]
    rows += _mapping(model or "") or ['"gains": {}']
    rows += ['"settings": {"poses": {}}', '"overrides": {"bigrams": []}']
    write_atomically(target, ("{\n  " + ",\n  ".join(rows) + "\n}\n").encode())


def load_base(base: str) -> None:
    """Refuse a base that cannot be read, or that is a model."""
    from lipwright.character.character import file_of  # only what a file can be

    if base not in BUILT_IN and not is_character_file(base):
        raise OutputError(
            f"the base {base!r}",
            expected=f"{' or '.join(BUILT_IN)}, or a character file",
            cure="a model is given with --model",
        )
    file_of(base)


def _from(target: Path, name: str, key: str) -> str:
    """Return a name as the new file says it: paths as seen from its folder."""
    if name in BUILT_IN or (key == "set" and not name.endswith(SUFFIX)):
        return name
    try:
        return Path(os.path.relpath(name, target.parent)).as_posix()
    except ValueError:  # on another drive of Windows
        return Path(name).resolve().as_posix()


def _mapping(model: str) -> list[str]:
    if not model:
        return []
    made = load_character(model).fit().to_mapping("")
    sections = [block("mapping", {c: row(weights) for c, weights in made.controls.items()})]
    sections.append(block("gains", {c: format_number(gain) for c, gain in made.gains.items()}))
    limits = {c: f"[{format_number(a)}, {format_number(b)}]" for c, (a, b) in made.limits.items()}
    return [*sections, block("limits", limits)]
