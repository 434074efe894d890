"""Drafts: every change on disk before the page hears of it, so that nothing is lost.

One folder for each opening, in the user's state folder: what was opened, a journal of
changes (one JSON a line, only ever appended to), sounds and models that were sent. A
studio that ends with all saved leaves no draft; any other one is offered when the same
files are opened again. What is dropped is moved aside, not deleted.
"""

from __future__ import annotations

import os
import secrets
import shutil
import sys
import time
from collections.abc import Iterator, Mapping
from hashlib import sha256
from pathlib import Path

import msgspec

from lipwright.errors import OutputError
from lipwright.files import write_atomically
from lipwright.studio.changes import AnyChange, LineData
from lipwright.studio.messages import Document

JOURNAL = "journal.jsonl"
VARIABLE = "LIPWRIGHT_STATE"
MOST_ASIDE = 20


class Opened(msgspec.Struct, frozen=True, tag="opened"):
    """The first line of a journal: what was open when it began.

    ``files`` has the content of each file by document; ``lines`` what was made of the sounds.
    """

    session: str
    started: float
    files: dict[str, str] = {}
    lines: tuple[LineData, ...] = ()


class Did(msgspec.Struct, frozen=True, tag="do"):
    """A change."""

    change: AnyChange
    merge: str = ""


class Undid(msgspec.Struct, frozen=True, tag="undo"):
    """Steps taken back."""

    steps: int


class Redid(msgspec.Struct, frozen=True, tag="redo"):
    """Steps done again."""

    steps: int


class Wrote(msgspec.Struct, frozen=True, tag="wrote"):
    """A document was saved: from here on this is what is on disk."""

    document: Document
    line: str
    path: str
    content: str


class Reread(msgspec.Struct, frozen=True, tag="reread"):
    """A document was taken as it was on disk, and our changes laid over it."""

    document: Document
    line: str
    content: str
    keep: bool


Record = Opened | Did | Undid | Redid | Wrote | Reread
_ENCODER = msgspec.json.Encoder()
_DECODER: msgspec.json.Decoder[Record] = msgspec.json.Decoder(Record)


def state_folder() -> Path:
    """Return where this user's programs keep what is to outlive them."""
    given = os.environ.get(VARIABLE)
    if given:
        return Path(given)
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA", Path.home())) / "Lipwright"
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Application Support" / "Lipwright"
    base = os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    return Path(base) / "lipwright"


def draft_folder(names: Mapping[str, str]) -> Path:
    """Return the folder of an opening: the same for the same files and options."""
    text = msgspec.json.encode(sorted(names.items()))
    return state_folder() / "studio" / sha256(text).hexdigest()[:16]


class Draft:
    """The journal of one opening.

    Parameters
    ----------
    folder : Path
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.path = folder / JOURNAL
        folder.mkdir(parents=True, exist_ok=True, mode=0o700)

    def read(self) -> list[Record]:
        """Return what an earlier studio left; a line that was cut short is left out."""
        try:
            data = self.path.read_bytes()
        except FileNotFoundError:
            return []
        return list(_records(data))

    def begin(self, files: Mapping[str, str], lines: tuple[LineData, ...]) -> Opened:
        """Begin a new journal; what was there is moved aside."""
        self.set_aside()
        opened = Opened(secrets.token_hex(8), time.time(), dict(files), lines)
        write_atomically(self.path, _ENCODER.encode(opened) + b"\n")
        return opened

    def resume(self, records: list[Record]) -> None:
        """Go on with a journal that was read, without what was cut short at its end."""
        write_atomically(self.path, b"".join(_ENCODER.encode(one) + b"\n" for one in records))

    def append(self, record: Record) -> None:
        """Put a record on disk: whole, or not at all.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        with self.path.open("ab", buffering=0) as file:
            size = file.tell()
            try:
                file.write(_ENCODER.encode(record) + b"\n")
            except OSError as error:
                file.truncate(size)
                raise OutputError(
                    f"the draft cannot be written ({error.strerror}): nothing was changed",
                    where=str(self.path),
                    cure="make room on the disk",
                ) from None

    def set_aside(self) -> None:
        """Move a journal with changes aside; the oldest of many go."""
        if len(self.read()) > 1:
            self.path.replace(self.folder / f"aside-{time.time_ns()}.jsonl")
        for old in sorted(self.folder.glob("aside-*.jsonl"))[:-MOST_ASIDE]:
            old.unlink(missing_ok=True)

    def close(self) -> None:
        """Forget the journal, all being saved; and the sounds, if no other speaks of them."""
        self.path.unlink(missing_ok=True)
        if not any(self.folder.glob("aside-*.jsonl")):
            shutil.rmtree(self.folder / "sounds", ignore_errors=True)

    def keep(self, kind: str, name: str, data: bytes) -> Path:
        """Keep a sound or a model under a name; return where."""
        path = self.folder / kind / name
        if not path.exists():
            path.parent.mkdir(exist_ok=True, mode=0o700)
            write_atomically(path, data)
        return path


def _records(data: bytes) -> Iterator[Record]:
    for row in data.split(b"\n"):
        if row:
            try:
                yield _DECODER.decode(row)
            except msgspec.MsgspecError:
                return
