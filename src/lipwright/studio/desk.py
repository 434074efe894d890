"""The documents on the desk: which can be saved, what each holds now, where it lies."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec

from lipwright.engines.bigram.edits import edits_from
from lipwright.engines.bigram.overrides import overrides_from
from lipwright.engines.bigram.set_text import edits_bytes
from lipwright.errors import InputError
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.studio.changes import LineData
from lipwright.studio.lines import tier_of
from lipwright.studio.merging import laid_over, same
from lipwright.studio.messages import Document, FileInfo, PreviewView
from lipwright.studio.naming import named_overrides
from lipwright.studio.patching import patched
from lipwright.studio.saving import Beside, Known, new_path, on_disk, preview, write
from lipwright.studio.state import OwnSet, State, overrides_content

Place = tuple[Document, str]
UNNAMED = re.compile(r"[^\w-]+")


class Desk:
    """The documents of one studio.

    Parameters
    ----------
    folder : Path
        Where new files come to lie.
    first : State
    paths : dict of (document, line) to str
        Files that were opened.
    files : dict of (document, line) to bytes
        Their contents.
    character : str
        The character that was opened: its file comes to name overrides that are new.
    """

    def __init__(
        self,
        folder: Path,
        first: State,
        paths: dict[Place, str],
        files: dict[Place, bytes],
        character: str = "",
    ) -> None:
        self.folder = folder
        self._character = character
        self._known: dict[Place, Known] = {}
        self._first = first
        documents: tuple[Place, ...] = (("set", ""), ("overrides", ""))
        for place in documents:
            self._open(place, first, paths.get(place, ""), files.get(place))
        for line in first.lines:
            edits: Place = ("edits", line)
            self._open(edits, first, paths.get(edits, ""), files.get(edits))
            self._open(("labels", line), first, "", None)

    def _open(self, place: Place, state: State, path: str, content: bytes | None) -> Known:
        document, line = place
        known = Known(document, line, path, content, part_of(state, place))
        self._known[place] = known
        return known

    def known(self, place: Place, state: State) -> Known:
        """Return what is known of a document's file; one of a new line is begun."""
        if place in self._known:
            return self._known[place]
        if place[1] not in state.lines:
            raise InputError(f"no line {place[1]!r}", expected="one that is open")
        return self._open(place, state, "", None)

    def begin_line(self, line: str, state: State) -> None:
        """Take note of a line that has just come: as it is now it needs no saving."""
        places: tuple[Place, ...] = (("edits", line), ("labels", line))
        for place in places:
            self._open(place, state, "", None)

    def places(self, state: State) -> Iterator[Place]:
        """Yield the documents that there are."""
        yield "set", ""
        yield "overrides", ""
        for line in state.lines:
            yield "edits", line
            yield "labels", line

    def infos(self, state: State) -> tuple[FileInfo, ...]:
        """Return all documents as the page lists them."""
        return tuple(self._info(place, state) for place in self.places(state))

    def _info(self, place: Place, state: State) -> FileInfo:
        document, line = place
        known = self.known(place, state)
        return FileInfo(
            document,
            line,
            known.path,
            Path(known.path).name if known.path else suggested_name(state, place),
            self.is_dirty(place, state),
            "" if document != "set" else state.own.document.about,
        )

    def is_dirty(self, place: Place, state: State) -> bool:
        """Whether a document says anything that its file does not."""
        clean, now = self.known(place, state).clean, part_of(state, place)
        return not (clean is now or same(clean, now))

    def dirty(self, state: State) -> list[Place]:
        """Return the documents with changes that were not saved."""
        return [place for place in self.places(state) if self.is_dirty(place, state)]

    def path(self, place: Place, state: State, name: str) -> str:
        """Return where a document is, or would be, written."""
        known = self.known(place, state)
        if known.path and name in ("", Path(known.path).name):
            return known.path
        return str(new_path(self.folder, name or suggested_name(state, place), place[0]))

    def preview(self, place: Place, state: State, name: str) -> PreviewView:
        """Return what saving would change."""
        known, path = self._as_named(place, state, name)
        now = part_of(state, place)
        reader = reader_of(place, path, state)
        beside = self._beside(place, known, path)
        return preview(known, path, self._content(place, state, path), now, reader, beside)

    def _content(self, place: Place, state: State, path: str) -> bytes:
        """What a document's file would hold: in its own form, where it has another than ours."""
        new, known = content_of(state, place, path), self.known(place, state)
        if place[0] not in ("set", "overrides") or known.content is None or path != known.path:
            return new
        was = content_of(with_part(state, place, known.clean), place, path)
        own = known.content.replace(b"\r\n", b"\n")
        if own != was:
            text = patched(*(one.decode("utf-8-sig") for one in (own, was, new)))
            new = text.encode() if self._says_the_same(place, path, state, text) else new
        return new.replace(b"\n", b"\r\n") if own != known.content else new

    def _says_the_same(self, place: Place, path: str, state: State, text: str) -> bool:
        """Whether a text that was put together says what is open, and nothing else."""
        try:
            read = reader_of(place, path, state)(text.encode())
        except InputError:
            return False
        made = content_of(with_part(state, place, read), place, path)
        return made == content_of(state, place, path)

    def _beside(self, place: Place, known: Known, path: str) -> Beside | None:
        """Let a character file name the overrides that are new, and made for it."""
        is_file = Path(self._character).suffix.lower() == ".json"
        if place[0] != "overrides" or known.content is not None or not is_file:
            return None
        was = on_disk(self._character)
        if was is None:
            return None
        return Beside(self._character, was, named_overrides(was, self._character, path))

    def save(self, place: Place, state: State, name: str, seen: str) -> tuple[str, bytes] | None:
        """Write a document; None where its file is another by now.

        Raises
        ------
        InputError, OutputError
            If it cannot be written; then nothing was.
        """
        known, path = self._as_named(place, state, name)
        content = self._content(place, state, path)
        refused = self.preview(place, state, name).refused
        if refused:
            raise InputError(refused, where=path)
        if not write(known, path, content, seen, self._beside(place, known, path)):
            return None
        self.wrote(place, state, path, content)
        return path, content

    def _as_named(self, place: Place, state: State, name: str) -> tuple[Known, str]:
        """A document's file; under another name it is a new one."""
        known, path = self.known(place, state), self.path(place, state, name)
        if known.path and path != known.path:
            return replace(known, path=path, content=None), path
        return known, path

    def wrote(self, place: Place, state: State, path: str, content: bytes) -> None:
        """Remember that a document was written."""
        known = self.known(place, state)
        known.path, known.content, known.clean = path, content, part_of(state, place)

    def reread(self, place: Place, state: State, content: bytes, *, keep: bool) -> State:
        """Return the state with a document as it is on disk, ours over it where it is kept."""
        known = self.known(place, state)
        theirs = reader_of(place, known.path, state)(content)
        ours = laid_over(known.clean, part_of(state, place), theirs) if keep else theirs
        known.content, known.clean = content, theirs
        return with_part(state, place, ours)

    def content_on_disk(self, place: Place, state: State) -> bytes:
        """Return what a document's file holds now.

        Raises
        ------
        InputError
            If there is none.
        """
        known = self.known(place, state)
        content = on_disk(known.path) if known.path else None
        if content is None:
            raise InputError("no such file", where=known.path or place[0], cure="save it first")
        return content


def part_of(state: State, place: Place) -> Any:
    """Return the part of a state that a document holds."""
    document, line = place
    if document == "set":
        return state.own
    if document == "overrides":
        return state.overrides
    if line not in state.lines:
        return ()
    return state.lines[line].edits if document == "edits" else state.lines[line].phones


def with_part(state: State, place: Place, part: Any) -> State:
    """Return a state with a document's part put in."""
    document, line = place
    if document == "set":
        return replace(state, own=part)
    if document == "overrides":
        return replace(state, overrides=part)
    changed = msgspec.structs.replace(state.lines[line], edits=part)
    return replace(state, lines={**state.lines, line: changed})


def reader_of(place: Place, path: str, state: State) -> Callable[[bytes], Any]:
    """Return what makes a document's part of the content of a file."""
    readers: dict[Document, Callable[[bytes], Any]] = {
        "set": lambda data: OwnSet.read(data, path),
        "overrides": lambda data: overrides_from(data, path, state.own.of.phone_set),
        "edits": lambda data: edits_from(data, path),
        "labels": lambda data: (),
    }
    return readers[place[0]]


def content_of(state: State, place: Place, path: str) -> bytes:
    """Return what a document's file would hold."""
    document, line = place
    if document == "set":
        return state.own.to_bytes()
    if document == "overrides":
        return overrides_content(state.overrides)
    data = state.lines[line]
    if document == "edits":
        return edits_bytes(data.edits, f"Corrections of the line {data.title!r}.")
    return _labels(data, Path(path).suffix)


def _labels(line: LineData, suffix: str) -> bytes:
    from lipwright.schedule.labels import write_labels

    track = PhoneTrack(tier_of(line.phones), line.phone_set)
    return write_labels(
        Speech(track, tier_of(line.words), text=line.text, language=line.language), suffix
    )


def suggested_name(state: State, place: Place) -> str:
    """Return a name for a file that has none yet."""
    document, line = place
    if document == "set":
        return f"{_plain(state.own.document.name)}.json"
    if document == "overrides":
        return f"{_plain(state.overrides.name)}.json"
    data = state.lines[line]
    is_file = data.text != data.title
    stem = _plain(data.title.rsplit(".", 1)[0] if is_file else data.title)
    return f"{stem[:40]}.edits.json" if document == "edits" else f"{stem[:40]}.TextGrid"


def _plain(title: str) -> str:
    return UNNAMED.sub("-", title.lower()).strip("-") or "line"
