"""Writing: beside the target first, then renamed onto it; several files all or none."""

from __future__ import annotations

import contextlib
import errno
import os
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

from lipwright.errors import OutputError

STANDARD_STREAM = "-"
"""The path that stands for standard input or output."""

_FULL = (errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC))
_ANY_WRITE = 0o222


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
        if not Path(os.path.realpath(target)).parent.is_dir():
            raise _output_error(OSError(errno.ENOENT, ""), path)
        if target.exists() and not (
            target.stat().st_mode & _ANY_WRITE and os.access(target, os.W_OK)
        ):
            raise OutputError("is read-only", where=str(path), cure="choose another name")
    except OutputError:
        raise
    except OSError as error:
        raise _output_error(error, path) from None
    except ValueError as error:  # a zero byte in the name
        raise OutputError(f"cannot be written ({error})", where=repr(str(path))) from None


def write_atomically(path: str | Path, data: bytes) -> None:
    """Put ``data`` into a file, whole; on failure what was there stays as it was.

    A link is followed. What is no file (a pipe, a device) is written into, never replaced.

    Raises
    ------
    OutputError
        If the folder is missing, the disk is full, or writing is not allowed.
    """
    write_all([(path, data)])


def write_output(path: str | Path, data: bytes) -> None:
    """Write ``data`` to a file, or to standard output where ``path`` is ``"-"``.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    write_all([(path, data)])


def write_all(outputs: Iterable[tuple[str | Path, bytes]]) -> None:
    """Write several files, and standard output for ``"-"``: all, or none.

    Every file is written beside its target before the first is renamed onto it.

    Raises
    ------
    OutputError
        If one of them cannot be written: then none has changed.
    """
    staged: list[tuple[Path, Path]] = []
    try:
        streams = []
        for path, data in outputs:
            if str(path) == STANDARD_STREAM or _is_stream(path):
                streams.append((path, data))
            else:
                staged.append(_staged(path, data))
        for path, data in streams:
            _pour(path, data)
        for part, target in staged:
            _rename(part, target)
    except BaseException:
        for part, _ in staged:
            with contextlib.suppress(OSError):
                part.unlink()
        raise


def _rename(part: Path, target: Path) -> None:
    try:
        part.replace(target)
    except OSError as error:
        raise _output_error(error, target) from None


def _is_stream(path: str | Path) -> bool:
    check_target(path)
    try:
        return Path(path).exists() and not Path(path).is_file()
    except (OSError, ValueError):
        return False


def _staged(path: str | Path, data: bytes) -> tuple[Path, Path]:
    """Write a file beside its target; return both."""
    try:
        target = Path(os.path.realpath(path))
        rights = target.stat().st_mode & 0o777 if target.exists() else 0o666 & ~_umask()
        handle, name = tempfile.mkstemp(dir=target.parent, prefix=".lipwright-", suffix=".part")
        part = Path(name)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(data)
                file.flush()
                os.fsync(file.fileno())
            part.chmod(rights)
        except BaseException:
            with contextlib.suppress(OSError):
                part.unlink()
            raise
    except OSError as error:
        raise _output_error(error, path) from None
    except ValueError as error:  # a zero byte in the name
        raise OutputError(f"cannot be written ({error})", where=repr(str(path))) from None
    return part, target


def _pour(path: str | Path, data: bytes) -> None:
    """Write into a pipe, a device, or standard output."""
    if str(path) != STANDARD_STREAM:
        try:
            Path(path).write_bytes(data)
        except OSError as error:
            raise _output_error(error, path) from None
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
    folder = Path(os.path.realpath(path)).parent
    linked = os.path.islink(path)  # noqa: PTH114 - the method raises on names that are too long
    shown = str(folder if linked else Path(path).parent)
    if error.errno in _FULL:
        return OutputError("the disk is full", where=str(path), cure="free some space, then again")
    if error.errno in (errno.ENOENT, errno.ENOTDIR):
        if os.path.lexists(folder):
            return OutputError(f"{shown!r} is a file, not a folder", where=str(path))
        return OutputError(
            f"the folder {shown!r} does not exist", where=str(path), cure="make it first"
        )
    if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        return OutputError(
            f"the folder {shown!r} is read-only, or another program holds the file",
            where=str(path),
        )
    return OutputError(f"cannot be written ({error.strerror})", where=str(path))
