"""A folder of arrays that is whole at every instant (DESIGN sections 5 and 8).

``database.json`` names a folder beside it that holds the arrays as ``.npy`` files. New
arrays are written into a folder of their own, then that folder is renamed, then
``database.json`` is replaced: until that last step everyone who opens the database
finds the old one, after it the new one. What was learnt from the old arrays goes just
before, so that it never stands beside others. What a killed writer left is cleared by
the next. Two writers at once are not kept apart: one of them may be told that it cannot
write, and the database is the other's.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import FileFormatError, InputError, OutputError
from lipwright.files import read_document, write_atomically

HEADER = "database.json"
LEARNT = "learnt.json"
FORMAT, VERSION = "lipwright/motion-database", 1
_BUILDING = ".building-"
_ARRAYS = "arrays-"


def check_folder(folder: Path) -> None:
    """Refuse a place where no database can be put, before work is spent on it.

    Raises
    ------
    OutputError
        If it is a file, holds what is no database, or its parent folder does not exist.
    """
    if folder.exists() and not folder.is_dir():
        raise OutputError("is a file", where=str(folder), expected="a database's folder")
    if not folder.exists() and not folder.parent.is_dir():
        raise OutputError(
            f"the folder {str(folder.parent)!r} does not exist",
            where=str(folder),
            cure="make it first",
        )
    if folder.is_dir() and not (folder / HEADER).exists():
        others = [entry.name for entry in folder.iterdir() if not entry.name.startswith(_BUILDING)]
        others = [name for name in others if not name.startswith((_ARRAYS, ".lipwright-"))]
        if others:
            raise OutputError(
                f"holds {min(others)!r} and is no motion database",
                where=str(folder),
                expected="a new folder, an empty one, or a motion database",
            )


def write(folder: Path, header: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> None:
    """Put a database into a folder, whole; until the end the old one stays.

    Parameters
    ----------
    folder : Path
        Made where it does not exist.
    header : mapping
        What ``database.json`` says beside its format and version.
    arrays : mapping of name to array

    Raises
    ------
    OutputError
        If it cannot be written: then the folder holds what it held.
    """
    check_folder(folder)
    with _as_output_error(folder):
        folder.mkdir(exist_ok=True)
        name = _next_name(folder)
        part = Path(tempfile.mkdtemp(prefix=_BUILDING, dir=folder))
        try:
            part.chmod(folder.stat().st_mode & 0o777)
            for key, array in arrays.items():
                _save(part / f"{key}.npy", array)
            part.rename(folder / name)
        except BaseException:
            shutil.rmtree(part, ignore_errors=True)
            raise
    document = {"format": FORMAT, "version": VERSION, "arrays": name, **header}
    text = json.dumps(document, ensure_ascii=False, indent=1, allow_nan=False)
    try:
        with contextlib.suppress(OSError):
            (folder / LEARNT).unlink()
        write_atomically(folder / HEADER, (text + "\n").encode())
    except OutputError:
        shutil.rmtree(folder / name, ignore_errors=True)
        raise
    _clear(folder, keep=name)


def clear(folder: Path) -> None:
    """Remove what killed writers left in a database's folder.

    Raises
    ------
    InputError, FileFormatError
        If the folder is no database, or its header is broken: then nothing is removed.
    """
    _clear(folder, keep=str(read_header(folder)["arrays"]))


def _save(path: Path, array: NDArray[Any]) -> None:
    with path.open("wb") as file:
        np.save(file, array, allow_pickle=False)
        file.flush()
        os.fsync(file.fileno())


def _next_name(folder: Path) -> str:
    """A name that no folder of arrays has, one above that of the present database."""
    taken = [entry.name.removeprefix(_ARRAYS) for entry in folder.glob(f"{_ARRAYS}*")]
    return f"{_ARRAYS}{1 + max((int(number) for number in taken if number.isdecimal()), default=0)}"


def _clear(folder: Path, keep: str) -> None:
    """Remove what is older, and what killed writers left; a reader may still hold it open."""
    for entry in folder.iterdir():
        left = entry.name.startswith((_BUILDING, _ARRAYS)) and entry.name != keep
        if left and entry.is_dir():
            shutil.rmtree(entry, ignore_errors=True)
        elif entry.name.startswith(".lipwright-"):
            with contextlib.suppress(OSError):
                entry.unlink()


@contextmanager
def _as_output_error(folder: Path) -> Iterator[None]:
    try:
        yield
    except OutputError:
        raise
    except OSError as error:
        reason = error.strerror or str(error)
        raise OutputError(f"cannot be written ({reason})", where=str(folder)) from None


def read_header(folder: Path) -> dict[str, Any]:
    """Return what a database's ``database.json`` says, at the newest version.

    Raises
    ------
    InputError, FileFormatError
        If the folder is no database, or its header is broken.
    """
    if not folder.exists():
        raise InputError(
            "no such folder", where=str(folder), cure="build it: lipwright motion build"
        )
    if not folder.is_dir():
        raise InputError("is a file", where=str(folder), expected="a motion database's folder")
    if not (folder / HEADER).is_file():
        raise InputError(
            f"is no motion database: it has no {HEADER}",
            where=str(folder),
            cure="build it: lipwright motion build",
        )
    return read_document(folder / HEADER, format=FORMAT, version=VERSION)


def open_array(path: Path, dtype: str, shape: tuple[int | None, ...]) -> NDArray[Any]:
    """Return an array by memory map; None in ``shape`` stands for any length.

    Raises
    ------
    FileFormatError
        If it is missing, cut short, or not what the header says.
    """
    wanted = (
        f"numbers of type {dtype}, {' by '.join('any' if n is None else str(n) for n in shape)}"
    )
    cure = "the database is damaged: build it again"
    try:
        # Nothing can be mapped of an array without elements.
        empty = any(n == 0 for n in shape)
        array: NDArray[Any] = np.asarray(np.load(path, mmap_mode=None if empty else "r"))
    except FileNotFoundError:
        raise FileFormatError("is missing", where=str(path), cure=cure) from None
    except (OSError, ValueError, EOFError, SyntaxError) as error:
        raise FileFormatError(
            f"cannot be read ({str(error).splitlines()[0] if str(error) else 'empty'})",
            where=str(path),
            expected=wanted,
            cure=cure,
        ) from None
    fits = len(shape) == array.ndim and all(
        n is None or n == has for n, has in zip(shape, array.shape, strict=True)
    )
    if not fits or array.dtype != np.dtype(dtype):
        found = f"numbers of type {array.dtype.str}, {' by '.join(map(str, array.shape))}"
        raise FileFormatError(found, where=str(path), expected=wanted, cure=cure)
    return array
