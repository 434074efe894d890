"""Who speaks in a line that exists: its character file, found again or asked for."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from lipwright.cli.report import note
from lipwright.errors import InputError, LipwrightError


def character_of(report: Mapping[str, Any], line: Path, given: str | None) -> tuple[str, bool]:
    """Return who spoke a line, and whether the character's file brings the set.

    Parameters
    ----------
    report : mapping
        The animation's report: it names the character file and its digest.
    line : Path
        The animation's file; the character file is looked for where it was, and beside it.
    given : str, optional
        What the user says.

    Raises
    ------
    InputError
        If the character file is not found, or has changed since.
    """
    from lipwright.character import BUILT_IN, file_of, set_of

    made_by = report.get("character")
    made_by = made_by if isinstance(made_by, dict) else {}
    known = made_by.get("name")
    who = given or _found_again(made_by, line) or (known if known in BUILT_IN else "head")
    file = file_of(who)
    if given and file and made_by.get("digest") not in (None, file.digest):
        note(f"{line} was made with another state of {made_by.get('name')!r}")
    return str(who), file is not None and bool(set_of(file, str(who)))


def _found_again(made_by: Mapping[str, Any], line: Path) -> str:
    from lipwright.character import file_of

    if not made_by.get("file"):
        return ""
    path = Path(str(made_by["file"]))
    found = ""
    for candidate in (path, line.parent / path, line.parent / path.name):
        try:
            file = file_of(candidate)
        except LipwrightError:
            continue
        if file is not None and file.digest == made_by.get("digest"):
            return str(candidate)
        found = found or str(candidate)
    raise InputError(
        f"made by the character {made_by.get('name')!r}, whose file {path.as_posix()!r} "
        + (f"is now another ({found})" if found else "is not found"),
        where=str(line),
        cure="name the file with --character",
    )
