"""Reading character files: the file, and all that it is layered on (DESIGN section 8).

What breaks the format, leads back to itself or names a file that is not there is refused
with the file and the place in it. What concerns the engine is read by the engine.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Collection
from pathlib import Path
from typing import Annotated, Any

import msgspec

from lipwright.character.character_file import RATES, CharacterFile, CharacterLayer
from lipwright.character.mapping import Mapping, Row, check_numbers, read_mapping
from lipwright.errors import CharacterError, FileFormatError, InputError, did_you_mean
from lipwright.files import (
    Kept,
    Version,
    check_document,
    convert,
    file_version,
    parse_json,
    read_bytes,
)

FORMAT, VERSION = "lipwright/character", 1
SUFFIX = ".json"
_ELSEWHERE = {
    "lipwright/face": "make a model with it: lipwright character build",
    "lipwright/mapping": "it goes with --mapping",
    "lipwright/bigram-overrides": "it goes with --overrides",
    "lipwright/bigram-set": "it goes with --set",
}
"""Files that are taken for a character's, and where they belong."""
Rows = dict[str, Row]


class _Speech(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    rate: tuple[float, float] | None = None


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    name: Annotated[str, msgspec.Meta(min_length=1)]
    about: str = ""
    base: str = ""
    model: str = ""
    bigram_set: str = msgspec.field(name="set", default="")
    mapping: str | Rows | list[str | Rows] = msgspec.field(default_factory=list)
    gains: dict[str, float] = {}
    limits: dict[str, tuple[float, float]] = {}
    overrides: str | dict[str, Any] | list[str | dict[str, Any]] = msgspec.field(
        default_factory=list
    )
    settings: dict[str, Any] = {}
    speech: _Speech = _Speech()


_files: Kept[CharacterFile] = Kept(64)


def is_character_file(spec: str | Path) -> bool:
    """Whether a character is named by a character file, not by a model or built-in name."""
    return Path(spec).suffix.lower() == SUFFIX


def read_character_file(path: str | Path, built_in: Collection[str]) -> CharacterFile:
    """Return a character file with all that it is layered on; read anew when one changes.

    Parameters
    ----------
    path : str or Path
    built_in : collection of str
        Names of the built-in characters.

    Raises
    ------
    InputError
        If a file that is named cannot be read.
    FileFormatError
        If a file breaks its format.
    CharacterError
        If the bases lead back to themselves.
    """
    # As it is spelled and where that is: reports name it as the user does.
    key = (str(path), os.path.abspath(path))  # noqa: PTH100
    return _files.get(key, lambda: _read_layers(Path(path), built_in))


def _read_layers(path: Path, built_in: Collection[str]) -> CharacterFile:
    layers: list[CharacterLayer] = []
    seen: list[str] = []
    while True:
        real = os.path.realpath(path)
        if real in seen:
            chain = [Path(layer.path).name for layer in layers[seen.index(real) :]]
            raise CharacterError(
                f"its base leads back to itself: {' → '.join([*chain, path.name])}",
                where=f"{layers[-1].path}, at base",
                cure="take one of these bases out",
            )
        seen.append(real)
        try:
            layers.append(_read_layer(path, built_in))
        except InputError as error:
            raise (error.at(f"{layers[-1].path}, at base") if layers else error) from None
        base = layers[-1].base
        if not base or base in built_in:
            return CharacterFile(tuple(layers[::-1]), base)
        path = Path(base)


def _read_layer(path: Path, built_in: Collection[str]) -> CharacterLayer:
    where = str(path)
    files: list[tuple[str, Version | None]] = [(where, file_version(path))]
    data = read_bytes(path)
    if not data.strip():
        raise FileFormatError("is empty", where=where, expected=f"a file of format {FORMAT!r}")
    parsed = parse_json(data, where)
    _refuse_other(parsed, where)
    document = check_document(parsed, where, format=FORMAT, version=VERSION)
    read = convert(document, _Document, where)
    check_numbers(read.gains, read.limits, where)
    _check_rate(read.speech.rate, where)
    mappings = _mappings(read, path, files)
    overrides = tuple(
        _beside(path, part) if isinstance(part, str) else part for part in _listed(read.overrides)
    )
    for part in overrides:
        if isinstance(part, str):
            files.append((part, file_version(part)))
    return CharacterLayer(
        read.name,
        where,
        read.about,
        _base(read.base, path, built_in),
        _model(read.model, path, built_in),
        _beside(path, read.bigram_set) if read.bigram_set.endswith(SUFFIX) else read.bigram_set,
        mappings,
        overrides,
        read.settings,
        read.speech.rate,
        tuple(files),
        _digest(data, [name for name, _ in files[1:]], where),
    )


def _refuse_other(document: Any, where: str) -> None:
    """Say where a file of another format goes."""
    found = document.get("format") if isinstance(document, dict) else None
    if isinstance(found, str) and found in _ELSEWHERE:
        raise FileFormatError(
            f"a file of format {found!r}",
            where=where,
            expected=f"a file of format {FORMAT!r}",
            cure=_ELSEWHERE[found],
        )


def _listed(parts: Any) -> list[Any]:
    return parts if isinstance(parts, list) else [parts]


def _beside(path: Path, name: str) -> str:
    return str(path.parent / name)


def _base(name: str, path: Path, built_in: Collection[str]) -> str:
    if not name or name in built_in:
        return name
    if not is_character_file(name):
        raise CharacterError(
            f"the base {name!r}",
            where=f"{path}, at base",
            expected=f"{' or '.join(built_in)}, or another character file, in {SUFFIX}",
            cure="a model goes into 'model'" if Path(name).suffix else did_you_mean(name, built_in),
        )
    return _beside(path, name)


def _model(name: str, path: Path, built_in: Collection[str]) -> str:
    if is_character_file(name):
        raise CharacterError(
            f"the model {name!r}",
            where=f"{path}, at model",
            expected=f"{' or '.join(built_in)}, or a GLB, VRM or glTF file",
            cure="another character goes into 'base'",
        )
    return _beside(path, name) if name and name not in built_in else name


def _mappings(
    read: _Document, path: Path, files: list[tuple[str, Version | None]]
) -> tuple[tuple[Mapping, str], ...]:
    found = []
    for part in _listed(read.mapping):
        if isinstance(part, str):
            name = _beside(path, part)
            files.append((name, file_version(name)))
            try:
                found.append((read_mapping(name), name))
            except InputError as error:
                raise error.at(f"{path}, at mapping") from None
        else:
            found.append((Mapping(read.name, part), f"{path}, at mapping"))
    if read.gains:
        found.append((Mapping(read.name, {}, gains=read.gains), f"{path}, at gains"))
    if read.limits:
        found.append((Mapping(read.name, {}, limits=read.limits), f"{path}, at limits"))
    return tuple(found)


def _check_rate(rate: tuple[float, float] | None, where: str) -> None:
    if rate is not None and not RATES[0] <= rate[0] <= rate[1] <= RATES[1]:
        raise FileFormatError(
            f"{rate[0]:g} to {rate[1]:g} words per minute",
            where=f"{where}, at speech.rate",
            expected=f"the slowest and the fastest, within {RATES[0]:g} to {RATES[1]:g}",
        )


def _digest(data: bytes, others: list[str], where: str) -> str:
    whole = hashlib.sha256(data.replace(b"\r\n", b"\n"))
    for name in others:
        try:
            whole.update(read_bytes(name).replace(b"\r\n", b"\n"))
        except InputError as error:
            raise error.at(f"{where}, at overrides") from None
    return whole.hexdigest()[:12]
