"""Overrides: what a character, or an animator, changes of a bigram set (DESIGN section 4).

They name only what differs: single bigrams, a gain for each pose, single-phone curves,
numbers of poses, thresholds, settings. A file is one layer; of several the later one wins.
What a character file says itself, in its overrides and in its settings, is one layer too:
there nothing may be said twice, since nothing would decide between the two.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import msgspec

from lipwright.curves import Keys
from lipwright.engines.bigram.documents import OVERRIDES_FORMAT, OverridesDocument
from lipwright.engines.bigram.layer import Layer
from lipwright.engines.bigram.model import (
    Bigram,
    BigramSet,
    Conflict,
    Curves,
    Pair,
    Pose,
    Rules,
    Settings,
)
from lipwright.engines.bigram.set_file import digest_of, read_bigrams, read_curves
from lipwright.errors import InputError, SetError, did_you_mean
from lipwright.files import check_document, convert, parse_json, read_bytes
from lipwright.phones import load_phone_set

FORMAT, VERSION = OVERRIDES_FORMAT, 1


@dataclass(frozen=True, slots=True)
class Overrides:
    """What one layer changes of a set, checked against its classes; poses are checked later.

    Parameters
    ----------
    name : str
        Its own name.
    where : str
        Its file, and for one inside a character file the place in it.
    character : str
        The character that brought it; nothing where the user gave it.
    bigrams : mapping of pair to Bigram
    singles : mapping of str to curves
    gains, poses, conflicts, settings
        As :class:`~lipwright.engines.bigram.documents.OverridesDocument` has them.
    about : str
    boundary : float
        Of bigrams that do not say their own.
    digest : str
        Tells its content from any other.
    named_by : str
        The character file, and the place in it, that names the override file.
    """

    name: str
    where: str = ""
    character: str = ""
    bigrams: Mapping[Pair, Bigram] = field(default_factory=dict)
    singles: Mapping[str, Curves] = field(default_factory=dict)
    gains: Mapping[str, float] = field(default_factory=dict)
    poses: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    conflicts: tuple[Conflict, ...] = ()
    settings: Mapping[str, Any] = field(default_factory=dict)
    about: str = ""
    boundary: float = 0.5
    digest: str = ""
    named_by: str = ""

    @property
    def says_nothing(self) -> bool:
        """Whether it changes nothing."""
        said = self.bigrams, self.singles, self.gains, self.poses, self.conflicts, self.settings
        return not any(said)


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
    return lay_over(base, open_overrides(path, base.phone_set, character))


def open_overrides(path: str | Path, phone_set: str, character: str = "") -> Overrides:
    """Return what an override file says, to be laid over a set of these classes."""
    return overrides_from(read_bytes(path), str(path), phone_set, character)


def overrides_from(data: bytes, where: str, phone_set: str, character: str = "") -> Overrides:
    """Return what the content of an override file says."""
    document = check_document(parse_json(data, where), where, format=FORMAT, version=VERSION)
    read = convert(document, OverridesDocument, where)
    return checked_overrides(read, phone_set, where, character, data)


def checked_overrides(
    read: OverridesDocument, phone_set: str, where: str, character: str = "", data: bytes = b""
) -> Overrides:
    """Return what overrides say, its bigrams and curves made; an error names the place."""
    try:
        classes = load_phone_set(phone_set)
        bigrams = read_bigrams(read.bigrams, read.boundary, read.name, classes)
        singles = {label: read_curves(c, f"phone {label!r}") for label, c in read.phones.items()}
    except InputError as error:
        raise error.at(where) from None
    return Overrides(
        read.name,
        where,
        character,
        bigrams,
        singles,
        read.gains,
        read.poses,
        tuple(read.conflicts),
        read.settings,
        read.about,
        read.boundary,
        digest_of(data),
    )


def with_character(
    base: BigramSet,
    name: str,
    where: str,
    overrides: Sequence[str | Mapping[str, Any]],
    settings: Mapping[str, Any],
) -> BigramSet:
    """Return ``base`` with what a character file changes; what says nothing leaves it alone.

    The parameters and errors are those of :func:`character_overrides`.
    """
    for part in character_overrides(base.phone_set, name, where, overrides, settings):
        base = lay_over(base, part)
    return base


def character_overrides(
    phone_set: str,
    name: str,
    where: str,
    overrides: Sequence[str | Mapping[str, Any]],
    settings: Mapping[str, Any],
) -> tuple[Overrides, ...]:
    """Return what a character file changes of a set, layer by layer.

    Parameters
    ----------
    phone_set : str
        Of the set.
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
    found = []
    for number, part in enumerate((*overrides, settings)):
        if isinstance(part, str):
            place = f"{where}, overrides"
            try:
                found.append(replace(open_overrides(part, phone_set, name), named_by=place))
            except InputError as error:
                raise error.at(place) from None
        elif number in own and any(True for _ in _sayings(own[number][1])):
            data = json.dumps(part, sort_keys=True).encode()
            found.append(checked_overrides(own[number][1], phone_set, own[number][0], name, data))
    return tuple(found)


_Part = tuple[str, OverridesDocument]


def _own_parts(
    name: str,
    where: str,
    overrides: Sequence[str | Mapping[str, Any]],
    settings: Mapping[str, Any],
) -> dict[int, _Part]:
    """What stands in the character file itself: where, and what; by place in the list."""
    parts = {}
    for number, part in enumerate(overrides):
        if not isinstance(part, str):
            place = f"overrides[{number}]" if len(overrides) > 1 else "overrides"
            place = f"{where}, {place}"
            whole = {"format": FORMAT, "version": VERSION, "name": name, **part}
            checked = check_document(whole, place, format=FORMAT, version=VERSION)
            parts[number] = (place, convert(checked, OverridesDocument, place))
    if settings:
        known = ("poses", "conflicts", *Settings.__struct_fields__)
        _refuse_unknown(settings, known, "setting", f"{where}, settings")
        rest = {key: value for key, value in settings.items() if key not in ("poses", "conflicts")}
        of_poses = {key: settings[key] for key in ("poses", "conflicts") if key in settings}
        whole = {"version": VERSION, "name": name, **of_poses, "settings": rest}
        place = f"{where}, settings"
        parts[len(overrides)] = (place, convert(whole, OverridesDocument, place))
    return parts


def _refuse_twice(parts: Mapping[int, _Part], where: str) -> None:
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


def _sayings(read: OverridesDocument) -> Iterator[tuple[object, str, str]]:
    """What overrides say: a key, what it is about, and the value where it is short."""
    for entry in read.bigrams:
        yield entry.pair, f"the bigram {'-'.join(entry.pair)}", ""
    for label in read.phones:
        yield ("phone", label), f"the single curve of {label!r}", ""
    for pose, gain in read.gains.items():
        yield ("gain", pose), f"the gain of {pose}", f"{gain:g}"
    for pose, fields in read.poses.items():
        for one, value in fields.items():
            yield (pose, one, "pose"), f"{one!r} of the pose {pose}", str(value)
    for conflict in read.conflicts:
        names = " and ".join(sorted(conflict.poses))
        yield frozenset(conflict.poses), f"the threshold of {names}", f"{conflict.threshold:g}"
    for one, value in read.settings.items():
        yield ("setting", one), f"{one!r}", str(value)


def lay_over(base: BigramSet, read: Overrides) -> BigramSet:
    """Return ``base`` with what one layer changes.

    Raises
    ------
    SetError
        If it names what the set has not.
    """
    try:
        merged = replace(
            base,
            rules=_override_rules(base.rules, read),
            bigrams={**base.bigrams, **read.bigrams},
            singles={**base.singles, **read.singles},
            digest=digest_of(f"{base.digest} {read.digest}".encode()),
            layers=(*base.layers, layer_of(read)),
            beneath=base.beneath or base,
        )
        return with_gains(merged, read.gains)
    except InputError as error:
        place = error.at(read.where)
        raise (place.at(read.named_by) if read.named_by else place) from None


def layer_of(read: Overrides) -> Layer:
    """Return the record of who said what."""
    return Layer(
        read.name,
        read.where,
        read.character,
        frozenset(read.bigrams),
        frozenset(read.singles),
        read.gains,
        read.poses,
        {frozenset(conflict.poses): conflict.threshold for conflict in read.conflicts},
        read.settings,
    )


def _override_rules(rules: Rules, read: Overrides) -> Rules:
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
