"""Reading: bytes → text → JSON → upgrade → a checked structure; or one clear refusal."""

from __future__ import annotations

import json
import math
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn, TypeVar

import msgspec

from lipwright.errors import FileFormatError, InputError, LipwrightError

T = TypeVar("T")
Upgrade = Callable[[dict[str, Any]], dict[str, Any]]
_NOT_A_NUMBER = re.compile(r'(?<![\w"])-?(?:NaN|Infinity)(?![\w"])')


def read_bytes(path: str | Path) -> bytes:
    """Return a file's bytes.

    Raises
    ------
    InputError
        If it does not exist, is a folder, or may not be read.
    """
    with readable(path):
        return Path(path).read_bytes()


@contextmanager
def readable(path: str | Path) -> Iterator[None]:
    """Refuse a file that cannot be read, in one clear line, while it is read.

    Raises
    ------
    InputError
    """
    try:
        yield
    except FileNotFoundError:
        raise InputError("no such file", where=str(path), cure="check the path") from None
    except IsADirectoryError:
        raise InputError("is a folder", where=str(path), expected="a file") from None
    except PermissionError:
        if Path(path).is_dir():
            raise InputError("is a folder", where=str(path), expected="a file") from None
        raise InputError("may not be read", where=str(path), cure="check its rights") from None
    except LipwrightError:
        raise
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror})", where=str(path)) from None
    except ValueError as error:  # a zero byte in the name
        raise InputError(f"cannot be read ({error})", where=repr(str(path))) from None


Version = tuple[int, int, int]


def file_version(path: str | Path) -> Version | None:
    """Return what tells one state of a file from the next; None for what is no file.

    Whoever keeps what was made from a file takes it before reading, and reads anew when
    it is another.
    """
    try:
        state = Path(path).stat()
    except (OSError, ValueError):
        return None
    return (state.st_mtime_ns, state.st_size, state.st_ino)


def read_standard_input() -> bytes:
    """Return all of standard input.

    Raises
    ------
    InputError
        If it is closed.
    """
    if sys.stdin is None:
        raise InputError("is closed", where="standard input", cure="pipe something into it")
    data: bytes = sys.stdin.buffer.read()
    return data


def decode_text(data: bytes, where: str) -> str:
    """Return UTF-8 bytes as text; ``where`` names them in the error.

    Raises
    ------
    FileFormatError
        If they are not UTF-8.
    """
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileFormatError(
            f"byte {error.start} is not UTF-8 text", where=where, expected="a text in UTF-8"
        ) from None


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


def _line_of_constant(data: bytes, where: str) -> str:
    """The place of the first NaN or Infinity, where there is one."""
    found = _NOT_A_NUMBER.search(data.decode("utf-8-sig"))
    if found is None:
        return where
    return f"{where}, line {data.decode('utf-8-sig').count(chr(10), 0, found.start()) + 1}"


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
        raise error.at(_line_of_constant(data, where)) from None
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
