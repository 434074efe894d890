"""Exports: one module per format, and the table of suffixes.

A format is a plain module with one function, ``encode(performance) -> bytes``; it is
imported when first used and never touches the disk. Its docstring says what it loses.
To add one, copy ``csv_table.py`` and name it in :data:`FORMATS`.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path

from lipwright.errors import InputError
from lipwright.files import STANDARD_STREAM, check_target, write_all
from lipwright.performance import Performance

FORMATS = {
    ".json": "lossless_json",
    ".csv": "csv_table",
    ".c3d": "c3d_points",
    ".glb": "glb",
    ".html": "html",
    ".wav": "wav_sound",
    ".tsv": "rhubarb_tsv",
    ".xml": "rhubarb_xml",
    ".rhubarb.json": "rhubarb_json",
    ".dat": "moho_dat",
}
"""Each suffix and the module of this package that writes it."""


def encode(performance: Performance, suffix: str) -> bytes:
    """Return a performance in the format that ``suffix`` names, such as ``".csv"``.

    Raises
    ------
    InputError
        If the suffix is unknown, or the performance lacks what the format needs.
    """
    name = FORMATS.get(suffix.lower())
    if name is None:
        raise _unknown(suffix, suffix)
    encoded: bytes = import_module(f"{__name__}.{name}").encode(performance)
    return encoded


def check_outputs(paths: Sequence[str | Path], formats: Sequence[str] = tuple(FORMATS)) -> None:
    """Refuse names that cannot be written, before hours are spent on what goes there.

    Parameters
    ----------
    paths : sequence of str or Path
        Files to be written; ``"-"`` is standard output.
    formats : sequence of str
        The suffixes that are allowed.

    Raises
    ------
    InputError
        If a suffix is unknown, or two paths are the same file.
    OutputError
        If a folder does not exist, or a file is read-only.
    """
    seen: set[str] = set()
    for path in paths:
        suffix = suffix_of(path, formats)
        if suffix not in formats:
            raise _unknown(suffix, str(path), formats)
        is_stream = str(path) == STANDARD_STREAM
        place = STANDARD_STREAM if is_stream else os.path.normcase(os.path.realpath(path))
        if place in seen:
            raise InputError("is named twice", where=str(path), expected="outputs that differ")
        seen.add(place)
        if not is_stream:
            check_target(path)


def save(performance: Performance, *paths: str | Path) -> None:
    """Write a performance to files, the format of each by its suffix.

    All are encoded before the first is written; each is written whole or not at all.

    Parameters
    ----------
    performance : Performance
        What to write.
    *paths : str or Path
        Where to; ``"-"`` is standard output, as JSON.

    Raises
    ------
    InputError
        If a suffix is unknown, two paths are the same file, or the performance lacks
        what a format needs.
    OutputError
        If a file cannot be written.

    Examples
    --------
    ``save(performance, "line.json", "line.csv", "line.glb")``
    """
    check_outputs(paths)
    sounds = [Path(path).name for path in paths if suffix_of(path) == ".wav"]
    if sounds and not performance.sound_file:
        performance = replace(performance, sound_file=sounds[0])
    suffixes = dict.fromkeys(map(suffix_of, paths))
    encoded = {suffix: encode(performance, suffix) for suffix in suffixes}
    write_all((path, encoded[suffix_of(path)]) for path in paths)


def suffix_of(path: str | Path, formats: Sequence[str] = tuple(FORMATS)) -> str:
    """Return the suffix that picks a file's format: ``.rhubarb.json`` before ``.json``."""
    if str(path) == STANDARD_STREAM:
        return ".json"
    name = Path(path).name.lower()
    double = [each for each in formats if each.count(".") > 1 and name.endswith(each)]
    return double[0] if double else Path(path).suffix.lower()


def sound_beside(path: str | Path) -> Path:
    """Return where the sound of an output lies that holds none: ``line.wav`` by ``line.tsv``."""
    name = Path(path).name
    return Path(path).with_name(name[: len(name) - len(suffix_of(path))] + ".wav")


def _unknown(suffix: str, where: str, formats: Sequence[str] = tuple(FORMATS)) -> InputError:
    found = f"the suffix {suffix!r} names no format" if suffix else "has no suffix"
    return InputError(found, where=where, expected=f"one of {' '.join(formats)}")
