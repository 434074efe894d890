"""Saving: what a file would become, shown first; what others wrote meanwhile, never lost.

Only files that were opened are written, and new ones in the folder where the studio was
started: a page cannot name any other.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from difflib import unified_diff
from hashlib import sha256
from pathlib import Path, PurePosixPath, PureWindowsPath
from typing import Any

from lipwright.errors import InputError, LipwrightError, OutputError
from lipwright.files import check_target, write_all
from lipwright.studio.merging import changed_names
from lipwright.studio.messages import Document, PreviewView

CONTEXT = 2
SUFFIXES: dict[Document, tuple[str, ...]] = {
    "set": (".json",),
    "overrides": (".json",),
    "edits": (".json",),
    "labels": (".TextGrid", ".lab", ".ctm", ".json"),
}


@dataclass(slots=True, eq=False)
class Known:
    """A document's file as we know it.

    Parameters
    ----------
    document : {"set", "overrides", "edits", "labels"}
    line : str
        For edits and labels.
    path : str
        Nothing where the file is still to be named.
    content : bytes, optional
        What is on disk as far as we know; None where nothing is.
    clean : object
        What was open when that was so: the state that needs no saving.
    """

    document: Document
    line: str
    path: str
    content: bytes | None
    clean: Any


def on_disk(path: str | Path) -> bytes | None:
    """Return a file's content; None where there is no file."""
    try:
        return Path(path).read_bytes()
    except FileNotFoundError:
        return None
    except OSError as error:
        raise InputError(f"cannot be read ({error.strerror})", where=str(path)) from None


def digest(content: bytes | None, beside: Beside | None = None) -> str:
    """Return what tells a file's state, and that of the one beside it, from others."""
    told = "none" if content is None else sha256(content).hexdigest()
    return told if beside is None else f"{told} {sha256(beside.was).hexdigest()}"


def new_path(folder: Path, name: str, document: Document) -> Path:
    """Return where a new file comes to lie.

    Raises
    ------
    InputError
        If the name is more than a plain file name, or of another kind of file.
    """
    plain = name and PurePosixPath(name).name == name and PureWindowsPath(name).name == name
    if not plain or name.startswith(".") or "\0" in name or ":" in name:
        raise InputError(
            f"the name {name!r}",
            expected=f"a plain file name: it comes to lie in {folder}",
            cure="leave folders out",
        )
    suffixes = SUFFIXES[document]
    if Path(name).suffix.lower() not in (suffix.lower() for suffix in suffixes):
        raise InputError(f"the name {name!r}", expected=f"one that ends in {' '.join(suffixes)}")
    return folder / name


@dataclass(frozen=True, slots=True)
class Beside:
    """Another file that saving changes along: a character file that comes to name overrides."""

    path: str
    was: bytes
    becomes: bytes


def preview(
    known: Known,
    path: str,
    ours: bytes,
    now: Any,
    read: Callable[[bytes], Any],
    beside: Beside | None = None,
) -> PreviewView:
    """Return what writing a document would change.

    Parameters
    ----------
    known : Known
    path : str
    ours : bytes
        What would be written.
    now : object
        The document's state.
    read : function
        Makes a state of a file's content.
    beside : Beside, optional
    """
    disk = on_disk(path)
    refused, theirs = _refusal(path), ""
    both: tuple[str, ...] = ()
    if known.content is None and disk is not None and disk != ours:
        refused = "there is such a file, and it was not opened: choose another name"
    elif known.content is not None and disk is None:
        theirs = "the file is gone\n"
    elif known.content is not None and disk is not None and disk != known.content:
        theirs = diff_of(known.content, disk, path, "as opened", "on disk now")
        try:
            both = tuple(_both(known.clean, now, read(disk)))
        except LipwrightError as error:
            refused = f"what is on disk now cannot be read: {error}"
    return PreviewView(
        document=known.document,
        line=known.line,
        path=path,
        is_new=disk is None,
        diff=diff_of(disk or b"", ours, path, "on disk", "to be written") + _diff_beside(beside),
        theirs=theirs,
        both=both,
        refused=refused,
        digest=digest(disk, beside),
    )


def _diff_beside(beside: Beside | None) -> str:
    if beside is None:
        return ""
    return diff_of(beside.was, beside.becomes, beside.path, "on disk", "to be written")


def _both(clean: Any, now: Any, theirs: Any) -> list[str]:
    ours, others = changed_names(clean, now), changed_names(clean, theirs)
    return [name for name in ours if name in others and ours[name] != others[name]]


def _refusal(path: str) -> str:
    try:
        check_target(path)
    except OutputError as error:
        return str(error)
    return ""


def diff_of(one: bytes, other: bytes, path: str, was: str, becomes: str) -> str:
    """Return a unified diff of two states of a file."""
    name = Path(path).name
    lines = unified_diff(
        one.decode("utf-8", "replace").splitlines(),
        other.decode("utf-8", "replace").splitlines(),
        f"{name} ({was})",
        f"{name} ({becomes})",
        n=CONTEXT,
        lineterm="",
    )
    return "".join(f"{line}\n" for line in lines)


def write(known: Known, path: str, ours: bytes, seen: str, beside: Beside | None = None) -> bool:
    """Write a document, if its file is still as it was when the preview was made.

    Returns
    -------
    bool
        Whether it was written; else a new preview is due.

    Raises
    ------
    InputError
        If the file changed since it was opened, and that was not taken in.
    OutputError
        If it cannot be written.
    """
    disk = on_disk(path)
    if digest(disk, beside) != seen:
        return False
    if disk is not None and disk not in (known.content, ours):
        raise InputError(
            "changed on disk since it was opened; nothing was written",
            where=path,
            cure="take in what is on disk first, then save",
        )
    along = [(beside.path, beside.becomes)] if beside is not None else []
    write_all([(path, ours), *along])
    return True
