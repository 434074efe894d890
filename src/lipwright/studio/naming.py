"""A character file that comes to name an override file; all else in it stays as it is."""

from __future__ import annotations

import os
from pathlib import Path

from lipwright.files import quote
from lipwright.files.json_places import members


def named_overrides(data: bytes, character: str, path: str) -> bytes:
    """Return a character file's content with an override file named behind its others.

    Parameters
    ----------
    data : bytes
        The content: valid JSON.
    character : str
        Where it lies.
    path : str
        The override file.
    """
    folder = Path(character).absolute().parent
    name = quote(Path(os.path.relpath(path, folder)).as_posix())
    text = data.decode("utf-8-sig")
    known = next((one for one in members(text) if one.name == "overrides"), None)
    if known is None:
        return _with_member(text, f'"overrides": {name}').encode()
    value = text[known.start : known.end]
    if value.startswith("["):
        inner = value[1:-1].rstrip()
        value = f"{inner}, {name}" if inner.strip() else f"{inner}{name}"
        value = f"[{value}]"
    else:
        value = f"[{value}, {name}]"
    return (text[: known.start] + value + text[known.end :]).encode()


def _with_member(text: str, member: str) -> str:
    """Put a member behind the name, on a line of its own where the name has one."""
    places = list(members(text))
    after = next((one for one in places if one.name == "name"), places[-1])
    line = text.rfind("\n", 0, after.start) + 1
    indent = text[line : len(text) - len(text[line:].lstrip())] if line else " "
    gap = f"\n{indent}" if line else " "
    return f"{text[: after.end]},{gap}{member}{text[after.end :]}"
