"""What lies in a folder of recordings: motion, and beside it by name sound and words.

Motion is ``NAME.csv`` or ``NAME.c3d`` in the folder itself, or in its subfolder
``motion``. Beside it, in the folder, or in a subfolder or neighbour of a usual name,
are looked for: sound of the same name; phone or word times of the same name; the words as
``NAME.txt``, or in a table ``text.csv`` with a column of names and one of texts.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from lipwright.errors import FileFormatError, InputError
from lipwright.files import decode_text, read_bytes
from lipwright.files.reading import readable

MOTION = (".csv", ".c3d")
SOUND = (".wav", ".flac", ".aiff", ".aif", ".ogg", ".opus", ".mp3", ".m4a", ".mp4", ".mov")
LABELS = (".textgrid", ".lab", ".phn", ".ctm")
_BESIDE = ("audio", "sound", "sounds", "wav", "labels", "text")
_NAME = ("name", "take", "file", "sentence", "line", "id")
_TEXT = ("text", "transcript", "words")


@dataclass(frozen=True, slots=True)
class TakeFiles:
    """The files of one take.

    Parameters
    ----------
    name : str
    motion : Path
    sound, labels : Path or None
    text : str or None
        The words that are said, where they are known.
    by_ear : bool
        Whether phones may be heard where neither words nor labels are known.
    """

    name: str
    motion: Path
    sound: Path | None = None
    text: str | None = None
    labels: Path | None = None
    by_ear: bool = False

    @property
    def has_only_sound(self) -> bool:
        """Whether there is sound, and nothing says what is spoken in it."""
        return self.sound is not None and not self.text and self.labels is None


def find_takes(folder: str | Path, texts: str | Path | None = None) -> list[TakeFiles]:
    """Return the takes of a folder, by name.

    Parameters
    ----------
    folder : path
    texts : path, optional
        The table of texts; without it ``text.csv`` in or beside the folder, if there.

    Raises
    ------
    InputError
        If the folder cannot be read or has no motion in it, two files are one take, or a
        text is no table of names and texts.
    """
    root = Path(folder)
    with readable(root):
        inner = next((path for path in sorted(root.iterdir()) if _is_folder(path, "motion")), root)
        found = [path for path in _files(inner) if path.suffix.lower() in MOTION]
    places = list(_places(inner))
    table = Path(texts) if texts else _table(places)
    said = read_texts(table) if table else {}
    motion = [path for path in found if not _is_text_table(path, table)]
    if not motion:
        raise InputError(
            "no recorded motion", where=str(folder), expected="files NAME.csv or NAME.c3d"
        )
    beside = {suffixes: _index(places, suffixes) for suffixes in (SOUND, LABELS, (".txt",))}
    takes: dict[str, TakeFiles] = {}
    for path in motion:
        name = path.stem
        if name in takes:
            raise InputError(
                f"{takes[name].motion.name!r} and {path.name!r} are both the take {name!r}",
                where=str(inner),
                expected="one file of motion per take",
            )
        sound, labels = (beside[suffixes].get(name) for suffixes in (SOUND, LABELS))
        written = beside[(".txt",)].get(name)
        text = said.get(name) or (_text_of(written) if written else None)
        takes[name] = TakeFiles(name, path, sound, text, labels)
    return [takes[name] for name in sorted(takes)]


def read_texts(path: str | Path) -> dict[str, str]:
    """Return a table's texts by the names of takes (a suffix on the names is dropped).

    Raises
    ------
    FileFormatError
        If it has no columns of names and texts, or names a take twice.
    InputError
        If it cannot be read.
    """
    where = str(path)
    rows = csv.reader(decode_text(read_bytes(path), where).splitlines())
    header = [cell.strip().lower() for cell in next(rows, [])]
    name = next((header.index(known) for known in _NAME if known in header), None)
    text = next((header.index(known) for known in _TEXT if known in header), None)
    if name is None or text is None or name == text:
        raise FileFormatError(
            f"the columns {', '.join(header) or 'none'}",
            where=f"{where}, line 1",
            expected="'name' and 'text'",
        )
    texts: dict[str, str] = {}
    for row in rows:
        if not any(cell.strip() for cell in row):
            continue
        place = f"{where}, line {rows.line_num}"
        if len(row) <= max(name, text):
            raise FileFormatError(f"{len(row)} cells", where=place, expected=f"{len(header)}")
        key = _stem(row[name].strip())
        if texts.setdefault(key, row[text].strip()) != row[text].strip():
            raise FileFormatError(
                f"{key!r} a second time, with other words", where=place, expected="each take once"
            )
    return texts


def _stem(name: str) -> str:
    """A name without the suffix of motion or sound."""
    path = Path(name)
    return path.stem if path.suffix.lower() in MOTION + SOUND else name


def _is_folder(path: Path, name: str) -> bool:
    return path.name.lower() == name and path.is_dir()


def _files(folder: Path) -> list[Path]:
    """Files by name; those that systems hide are passed over."""
    return [path for path in sorted(folder.iterdir()) if path.is_file() and path.name[0] != "."]


def _places(folder: Path) -> Iterator[Path]:
    """Where to look for what belongs to motion in a folder, nearest first."""
    yield folder
    around = [folder] if folder.name.lower() != "motion" else [folder, folder.parent]
    if folder.name.lower() == "motion":
        yield folder.parent
    for root in around:
        for path in sorted(root.iterdir()):
            if path.is_dir() and path.name.lower() in _BESIDE:
                yield path


def _table(places: Sequence[Path]) -> Path | None:
    tables = (place / "text.csv" for place in places)
    return next((table for table in tables if table.is_file()), None)


def _is_text_table(path: Path, table: Path | None) -> bool:
    return path.suffix.lower() == ".csv" and (
        path.name in ("text.csv", "words.csv") or path == table
    )


def _index(places: Sequence[Path], suffixes: Sequence[str]) -> dict[str, Path]:
    """Return the files of these kinds by their stem: the nearest place, then the first kind."""
    found: dict[str, Path] = {}
    for place in places:
        here: dict[str, Path] = {}
        for path in _files(place):
            kind = path.suffix.lower()
            if kind in suffixes:
                known = here.get(path.stem)
                if known is None or suffixes.index(kind) < suffixes.index(known.suffix.lower()):
                    here[path.stem] = path
        found = here | found
    return found


def _text_of(path: Path) -> str:
    text = " ".join(decode_text(read_bytes(path), str(path)).split())
    if not text:
        raise FileFormatError("is empty", where=str(path), expected="the words that are said")
    return text
