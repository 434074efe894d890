"""Overrides: what a character, or an animator, changes of a bigram set (DESIGN section 4).

They name only what differs: single bigrams, a gain for each pose, single-phone curves,
numbers of poses, thresholds, settings. A file is one layer; of several the later one wins.
What a character file says itself, in its overrides and in its settings, is one layer too:
there nothing may be said twice, since nothing would decide between the two.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec

from lipwright.curves import Keys
from lipwright.engines.bigram.layer import Layer
from lipwright.engines.bigram.model import (
    BigramSet,
    Conflict,
    Curves,
    Pose,
    Rules,
    Settings,
)
from lipwright.engines.bigram.set_file import (
    BigramEntry,
    KeyList,
    digest_of,
    read_bigrams,
    read_curves,
)
from lipwright.errors import InputError, SetError, did_you_mean
from lipwright.files import check_document, convert, read_bytes, read_document
from lipwright.phones import load_phone_set

FORMAT, VERSION = "lipwright/bigram-overrides", 1


class _Overrides(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    name: str
    about: str = ""
    boundary: float = 0.5
    bigrams: list[BigramEntry] = []
    gains: dict[str, float] = {}
    phones: dict[str, dict[str, KeyList]] = {}
    poses: dict[str, dict[str, Any]] = {}
    conflicts: list[Conflict] = []
    settings: dict[str, Any] = {}


def read_overrides(path: str | Path, base: BigramSet, character: str = "") -> BigramSet:
    """Return ``base`` with what an override file changes.

    Parameters
    ----------
    path : str or Path
    base : BigramSet
    character : str
        The character that names the file, if one does.

    Raises
    ------
    SetError, FileFormatError
        If it is broken, or names what the set has not.
    """
    where = str(path)
    document = read_document(path, format=FORMAT, version=VERSION)
    read = convert(document, _Overrides, where)
    return _with_layer(base, read, where, character, read_bytes(path))


def with_character(
    base: BigramSet,
    name: str,
    where: str,
    overrides: Sequence[str | Mapping[str, Any]],
    settings: Mapping[str, Any],
) -> BigramSet:
    """Return ``base`` with what a character file changes; what says nothing leaves it alone.

    Parameters
    ----------
    base : BigramSet
    name, where : str
        The character's name and file.
    overrides : sequence of str or mapping
        Paths of override files, and overrides that stand in the character file itself; of
        several files, and of a file and the character, the later one wins.
    settings : mapping
        Settings of the stages, with ``poses`` and ``conflicts`` as in a set; they go last.

    Raises
    ------
    SetError, FileFormatError
        If something is broken, unknown to the set, or said twice in the character file.
    """
    own = _own_parts(name, where, overrides, settings)
    _refuse_twice(own, where)
    for number, part in enumerate(overrides):
        if isinstance(part, str):
            try:
                base = read_overrides(part, base, name)
            except InputError as error:
                raise error.at(f"{where}, overrides") from None
        else:
            base = _with_own(base, own[number], name, part)
    if settings:
        base = _with_own(base, own[len(overrides)], name, settings)
    return base


Part = tuple[str, _Overrides]


def _own_parts(
    name: str,
    where: str,
    overrides: Sequence[str | Mapping[str, Any]],
    settings: Mapping[str, Any],
) -> dict[int, Part]:
    """What stands in the character file itself: where, and what; by place in the list."""
    parts = {}
    for number, part in enumerate(overrides):
        if not isinstance(part, str):
            place = f"overrides[{number}]" if len(overrides) > 1 else "overrides"
            place = f"{where}, {place}"
            whole = {"format": FORMAT, "version": VERSION, "name": name, **part}
            checked = check_document(whole, place, format=FORMAT, version=VERSION)
            parts[number] = (place, convert(checked, _Overrides, place))
    if settings:
        known = ("poses", "conflicts", *Settings.__struct_fields__)
        _refuse_unknown(settings, known, "setting", f"{where}, settings")
        rest = {key: value for key, value in settings.items() if key not in ("poses", "conflicts")}
        of_poses = {key: settings[key] for key in ("poses", "conflicts") if key in settings}
        whole = {"version": VERSION, "name": name, **of_poses, "settings": rest}
        place = f"{where}, settings"
        parts[len(overrides)] = (place, convert(whole, _Overrides, place))
    return parts


def _with_own(base: BigramSet, part: Part, name: str, content: Mapping[str, Any]) -> BigramSet:
    if not any(True for _ in _sayings(part[1])):
        return base
    data = json.dumps(content, sort_keys=True).encode()
    return _with_layer(base, part[1], part[0], name, data)


def _refuse_twice(parts: Mapping[int, Part], where: str) -> None:
    said: dict[object, tuple[str, str]] = {}
    for place, read in parts.values():
        short = place.removeprefix(f"{where}, ")
        for key, what, value in _sayings(read):
            text = f"{value} in {short}" if value else f"in {short}"
            if key in said:
                raise SetError(
                    f"{what} is said twice: {said[key][1]}, {text}",
                    where=where,
                    cure="keep one of the two",
                )
            said[key] = (what, text)


def _sayings(read: _Overrides) -> Iterator[tuple[object, str, str]]:
    """What overrides say: a key, what it is about, and the value where it is short."""
    for entry in read.bigrams:
        yield entry.pair, f"the bigram {'-'.join(entry.pair)}", ""
    for label in read.phones:
        yield ("phone", label), f"the single curve of {label!r}", ""
    for pose, gain in read.gains.items():
        yield ("gain", pose), f"the gain of {pose}", f"{gain:g}"
    for pose, fields in read.poses.items():
        for field, value in fields.items():
            yield (pose, field, "pose"), f"{field!r} of the pose {pose}", str(value)
    for conflict in read.conflicts:
        names = " and ".join(sorted(conflict.poses))
        yield frozenset(conflict.poses), f"the threshold of {names}", f"{conflict.threshold:g}"
    for field, value in read.settings.items():
        yield ("setting", field), f"{field!r}", str(value)


def _with_layer(
    base: BigramSet, read: _Overrides, where: str, character: str, data: bytes
) -> BigramSet:
    try:
        classes = load_phone_set(base.phone_set)
        changed = read_bigrams(read.bigrams, read.boundary, read.name, classes)
        singles = {label: read_curves(c, f"phone {label!r}") for label, c in read.phones.items()}
        merged = replace(
            base,
            rules=_override_rules(base.rules, read),
            bigrams={**base.bigrams, **changed},
            singles={**base.singles, **singles},
            digest=digest_of(base.digest.encode() + data),
            layers=(*base.layers, _layer(read, where, character)),
            beneath=base.beneath or base,
        )
        return with_gains(merged, read.gains)
    except InputError as error:
        raise error.at(where) from None


def _layer(read: _Overrides, where: str, character: str) -> Layer:
    return Layer(
        read.name,
        where,
        character,
        frozenset(entry.pair for entry in read.bigrams),
        frozenset(read.phones),
        read.gains,
        read.poses,
        {frozenset(conflict.poses): conflict.threshold for conflict in read.conflicts},
        read.settings,
    )


def _override_rules(rules: Rules, read: _Overrides) -> Rules:
    fields = tuple(field for field in Pose.__struct_fields__ if field != "name")
    for name, changes in read.poses.items():
        _refuse_unknown([name], rules.names, "pose", "")
        _refuse_unknown(changes, fields, "field", f"pose {name!r}")
    _refuse_unknown(read.settings, Settings.__struct_fields__, "setting", "")
    poses = []
    for pose in rules.poses:
        merged = {**msgspec.structs.asdict(pose), **read.poses.get(pose.name, {})}
        poses.append(convert(merged, Pose, f"pose {pose.name!r}"))
    settings = {**msgspec.structs.asdict(rules.settings), **read.settings}
    conflicts = {frozenset(conflict.poses): conflict for conflict in rules.conflicts}
    conflicts |= {frozenset(conflict.poses): conflict for conflict in read.conflicts}
    for conflict in read.conflicts:
        _refuse_unknown(conflict.poses, rules.names, "pose", "conflicts")
    changed = convert(settings, Settings, "settings")
    return Rules(tuple(poses), tuple(conflicts.values()), changed)


def _refuse_unknown(
    names: Sequence[str] | Mapping[str, Any], known: Sequence[str], what: str, where: str
) -> None:
    for name in names:
        if name not in known:
            raise SetError(
                f"unknown {what} {name!r}",
                where=where,
                expected=f"one of {', '.join(known)}",
                cure=did_you_mean(name, known),
            )


def with_gains(base: BigramSet, gains: Mapping[str, float]) -> BigramSet:
    """Return the set with the curves of some poses scaled; weights stay in 0..1."""
    for name, gain in gains.items():
        _refuse_unknown([name], base.rules.names, "pose", "gains")
        if not 0 <= gain <= 10:
            raise SetError(f"gain {gain} for {name!r}", expected="0 to 10")
    if not gains:
        return base

    def scaled(curves: Curves) -> Curves:
        return {
            pose: Keys(keys.times, (keys.values * gains.get(pose, 1.0)).clip(0, 1))
            for pose, keys in curves.items()
        }

    return replace(
        base,
        bigrams={p: replace(b, curves=scaled(b.curves)) for p, b in base.bigrams.items()},
        singles={label: scaled(curves) for label, curves in base.singles.items()},
    )
