"""Files that people edit: read whole or refused, written whole or not at all.

Every such file is JSON with a ``format`` and an integer ``version``. Reading goes
bytes → text → JSON (no duplicate keys, no NaN) → upgrade, one step per version →
a checked structure. Writing goes beside the target first and is renamed onto it.
This is the only module that replaces files on disk.
"""

from __future__ import annotations

import contextlib
import errno
import json
import math
import os
import re
import sys
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NoReturn, TypeVar

import msgspec

from lipwright.errors import FileFormatError, InputError, OutputError

STANDARD_STREAM = "-"
"""The path that stands for standard input or output."""

_FULL = (errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC))
_ANY_WRITE = 0o222

T = TypeVar("T")
Upgrade = Callable[[dict[str, Any]], dict[str, Any]]


def read_bytes(path: str | Path) -> bytes:
    """Return a file's bytes.

    Raises
    ------
    InputError
        If it does not exist, is a folder, or may not be read.
    """
    try:
        return Path(path).read_bytes()
    except FileNotFoundError:
        raise InputError("no such file", where=str(path), cure="check the path") from None
    except IsADirectoryError:
        raise InputError("is a folder", where=str(path), expected="a file") from None
    except PermissionError:
        if Path(path).is_dir():
            raise InputError("is a folder", where=str(path), expected="a file") from None
        raise InputError("may not be read", where=str(path), cure="check its rights") from None
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror})", where=str(path)) from None
    except ValueError as error:  # a zero byte in the name
        raise InputError(f"cannot be read ({error})", where=repr(str(path))) from None


def _refuse_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    result = dict(pairs)
    if len(result) != len(pairs):
        keys = [key for key, _ in pairs]
        twice = next(key for key in keys if keys.count(key) > 1)
        raise FileFormatError(f"the key {twice!r} stands twice", cure="remove one of the two")
    return result


def _refuse_constant(name: str) -> NoReturn:
    raise FileFormatError(f"the number {name}", expected="finite numbers")


def _finite(text: str) -> float:
    value = float(text)
    if value in (math.inf, -math.inf):
        _refuse_constant(text)
    return value


_HUGE = re.compile(rb"[eE][+]?\d{3}|\d{300}")
_HALF_A_LETTER = re.compile(rb"\\u[dD][89a-fA-F]")


def parse_json(data: bytes, where: str) -> Any:
    """Return the JSON value in ``data``; ``where`` names it in errors.

    Raises
    ------
    FileFormatError
        For bytes that are not UTF-8, broken JSON, duplicate keys, NaN or Infinity.
    """
    try:
        value = json.loads(
            data.decode("utf-8-sig"),
            object_pairs_hook=_refuse_duplicates,
            parse_constant=_refuse_constant,
            parse_float=_finite if _HUGE.search(data) else None,
        )
        if _HALF_A_LETTER.search(data):
            json.dumps(value, ensure_ascii=False).encode()
        return value
    except UnicodeDecodeError as error:
        raise FileFormatError(
            f"byte {error.start} is not UTF-8 text", where=where, expected="a JSON file in UTF-8"
        ) from None
    except json.JSONDecodeError as error:
        raise FileFormatError(
            f"broken JSON ({error.msg})", where=f"{where}, line {error.lineno} column {error.colno}"
        ) from None
    except FileFormatError as error:
        raise error.at(where) from None
    except UnicodeEncodeError:
        raise FileFormatError(
            "an escape \\ud8.. without its other half", where=where, expected="whole letters"
        ) from None
    except RecursionError:
        raise FileFormatError("nested too deeply", where=where) from None
    except ValueError:  # Python refuses whole numbers of thousands of digits
        raise FileFormatError("a number that is too long", where=where) from None


def check_document(
    value: Any,
    where: str,
    *,
    format: str,
    version: int,
    upgrades: Mapping[int, Upgrade] | None = None,
) -> dict[str, Any]:
    """Return a document at the newest version, or refuse it.

    Parameters
    ----------
    value : Any
        What :func:`parse_json` returned.
    where : str
        Its name in errors.
    format : str
        The expected ``format``, such as ``"lipwright/animation"``.
    version : int
        The newest version that this program knows.
    upgrades : mapping of int to function, optional
        The step from each older version to the next.

    Raises
    ------
    FileFormatError
        If it is of another format, of a version from the future, or of none.
    """
    found = value.get("format") if isinstance(value, dict) else None
    if not isinstance(value, dict) or found != format:
        kind = f"a file of format {found!r}" if found else "no 'format' that Lipwright knows"
        raise FileFormatError(kind, where=where, expected=f"a file of format {format!r}")
    has = value.get("version")
    if not isinstance(has, int) or isinstance(has, bool) or has < 1:
        raise FileFormatError(f"version {has!r}", where=where, expected=f"1 to {version}")
    if has > version:
        raise FileFormatError(
            f"{format} version {has}",
            where=where,
            expected=f"version {version} or older",
            cure="it was written by a newer Lipwright: install that one",
        )
    document = dict(value)
    for step in range(has, version):
        document = (upgrades or {})[step](document)
    document.pop("format")
    document["version"] = version
    return document


def convert(value: Any, to: type[T], where: str) -> T:
    """Return ``value`` as the msgspec structure ``to``; the error names the place in it."""
    try:
        return msgspec.convert(value, to, strict=True)
    except msgspec.ValidationError as error:
        found, _, place = str(error).partition(" - at `$")
        place = place.rstrip("`").lstrip(".")
        raise FileFormatError(found, where=f"{where}, at {place}" if place else where) from None


def read_document(
    path: str | Path,
    *,
    format: str,
    version: int,
    upgrades: Mapping[int, Upgrade] | None = None,
) -> dict[str, Any]:
    """Return the document in a file: :func:`parse_json` and :func:`check_document`."""
    data = read_bytes(path)
    if not data.strip():
        raise FileFormatError("is empty", where=str(path), expected=f"a file of format {format!r}")
    return check_document(
        parse_json(data, str(path)), str(path), format=format, version=version, upgrades=upgrades
    )


def check_target(path: str | Path) -> None:
    """Refuse a name that cannot be written, before work is spent on what goes there.

    A file without any right to write is refused even where the user could replace it:
    someone meant it to stay.

    Raises
    ------
    OutputError
        If it is a folder or read-only, or its folder does not exist.
    """
    target = Path(path)
    try:
        if target.is_dir():
            raise OutputError("is a folder", where=str(path), expected="a file's name")
        if not target.parent.is_dir():
            raise _output_error(OSError(errno.ENOENT, ""), path)
        if target.exists() and not (
            target.stat().st_mode & _ANY_WRITE and os.access(target, os.W_OK)
        ):
            raise OutputError("is read-only", where=str(path), cure="choose another name")
    except OutputError:
        raise
    except OSError as error:
        raise _output_error(error, path) from None


def write_atomically(path: str | Path, data: bytes) -> None:
    """Put ``data`` into a file, whole; on failure what was there stays as it was.

    A link is followed. What is no file (a pipe, a device) is written into, never replaced.

    Raises
    ------
    OutputError
        If the folder is missing, the disk is full, or writing is not allowed.
    """
    check_target(path)
    try:
        if Path(path).exists() and not Path(path).is_file():
            Path(path).write_bytes(data)
        else:
            _replace(Path(os.path.realpath(path)), data)
    except OSError as error:
        raise _output_error(error, path) from None
    except ValueError as error:  # a zero byte in the name
        raise OutputError(f"cannot be written ({error})", where=repr(str(path))) from None


def _replace(target: Path, data: bytes) -> None:
    rights = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~_umask()
    handle, name = tempfile.mkstemp(dir=target.parent, prefix=".lipwright-", suffix=".part")
    part = Path(name)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        part.chmod(rights)
        part.replace(target)
    except BaseException:
        with contextlib.suppress(OSError):
            part.unlink()
        raise


def write_output(path: str | Path, data: bytes) -> None:
    """Write ``data`` to a file, or to standard output where ``path`` is ``"-"``.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    if str(path) != STANDARD_STREAM:
        write_atomically(path, data)
        return
    try:
        sys.stdout.flush()
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()
    except OSError as error:
        with contextlib.suppress(OSError):  # else the interpreter tries again when it ends
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise _output_error(error, "standard output") from None


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _output_error(error: OSError, path: str | Path) -> OutputError:
    folder = str(Path(path).parent)
    if error.errno in _FULL:
        return OutputError("the disk is full", where=str(path), cure="free some space, then again")
    if error.errno in (errno.ENOENT, errno.ENOTDIR):
        return OutputError(
            f"the folder {folder!r} does not exist", where=str(path), cure="make it first"
        )
    if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        return OutputError(
            f"the folder {folder!r} is read-only, or another program holds the file",
            where=str(path),
        )
    return OutputError(f"cannot be written ({error.strerror})", where=str(path))


def format_number(value: float, digits: int = 4) -> str:
    """Return a number as short text: at most ``digits`` decimals, no trailing zeros.

    Examples
    --------
    >>> format_number(0.25), format_number(1.0), format_number(-0.00001)
    ('0.25', '1', '0')
    """
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".") if digits else f"{value:.0f}"
    return "0" if text in ("-0", "") else text


def format_row(values: Sequence[float], digits: int = 4) -> str:
    """Return numbers as one JSON list on one line.

    Examples
    --------
    >>> format_row([0, 0.5, 1])
    '[0, 0.5, 1]'
    """
    return "[" + ", ".join(format_number(value, digits) for value in values) + "]"


def quote(text: str) -> str:
    """Return text as a JSON string, letters kept as they are."""
    return json.dumps(text, ensure_ascii=False)
