"""Names of pictures, looked at before there is anything to draw."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

from lipwright.errors import InputError
from lipwright.files.writing import check_target


def check_picture(path: str | Path, read: Iterable[object] = ()) -> None:
    """Refuse a name that no picture can have, before any work is spent.

    Parameters
    ----------
    path : path
    read : iterable
        What is read: it must not be written over.

    Raises
    ------
    InputError
        If the suffix is not ``.svg``, or it is a file that is read.
    OutputError
        If it cannot be written.
    """
    if Path(path).suffix.lower() != ".svg":
        found = Path(path).suffix or "no suffix"
        raise InputError(f"a picture with {found!r}", where=str(path), expected=".svg")
    target = os.path.realpath(path)
    if any(source and os.path.realpath(str(source)) == target for source in read):
        raise InputError("would be written over its own input", where=str(path), cure="rename one")
    check_target(path)
