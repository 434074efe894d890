"""A change put into a file that somebody formatted in their own way: all else stays as it is.

Lipwright writes sets and overrides in one stable form. A file in another form is not brought
into it by saving one curve: a colleague would see every line in the diff. What differs
between two contents in the stable form is put into the file's own text, value by value.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

from lipwright.files.json_places import Place, items, members

Change = tuple[int, int, str]
Pair = tuple[str, ...]
LIST = "bigrams"


def patched(text: str, was: str, now: str) -> str:
    """Return a file's text with what differs between two contents put into it.

    Parameters
    ----------
    text : str
        Valid JSON that says what ``was`` says, in any form.
    was, now : str
        What it said and what it is to say, in the stable form.
    """
    changes = list(_members(text, was, now))
    for start, end, new in sorted(changes, reverse=True):
        text = text[:start] + new + text[end:]
    return text


def _members(text: str, was: str, now: str) -> Iterator[Change]:
    before, after = _by_name(was), _by_name(now)
    own = _by_name(text)
    for name, place in after.items():
        value = now[place.start : place.end]
        if name in before and _same(was, before[name], now, place):
            continue
        if name == LIST and name in own and name in before:
            yield from _pairs(text, own[name], was, before[name], now, place)
        elif name in own:
            yield own[name].start, own[name].end, value
        else:
            last = list(own.values())[-1]
            yield last.end, last.end, f",\n  {json.dumps(name)}: {value}"
    for name in before:
        if name not in after and name in own:
            yield _cut(text, list(own.values()), own[name])


def _by_name(text: str) -> dict[str, Place]:
    return {place.name: place for place in members(text)}


def _value(text: str, place: Place) -> Any:
    return json.loads(text[place.start : place.end])


def _same(one: str, place: Place, other: str, there: Place) -> bool:
    return bool(_value(one, place) == _value(other, there))


def _cut(text: str, places: list[Place], gone: Place) -> Change:
    """Take a member or an item out, with the comma before it, or else the one behind it."""
    number = places.index(gone)
    if number:
        return places[number - 1].end, gone.end, ""
    begin = text.rfind('"', 0, text.rfind('"', 0, gone.start)) if gone.name else gone.start
    if len(places) == 1:
        return begin, gone.end, ""
    behind = text.index(",", gone.end) + 1
    while text[behind].isspace():
        behind += 1
    return begin, behind, ""


# --- pairs ---


def _pairs(
    text: str, own: Place, was: str, before: Place, now: str, after: Place
) -> Iterator[Change]:
    there = _by_pair(text, own)
    old, new = _by_pair(was, before), _by_pair(now, after)
    for pair, place in new.items():
        entry = now[place.start : place.end]
        if pair in there and (pair not in old or not _same(was, old[pair], now, place)):
            yield from _entry(text, there[pair], entry)
    yield from _added(text, own, there, {p: now[one.start : one.end] for p, one in new.items()})
    for pair, place in there.items():
        if pair not in new:
            yield _cut(text, list(there.values()), place)


def _added(
    text: str, own: Place, there: dict[Pair, Place], new: dict[Pair, str]
) -> Iterator[Change]:
    """Put new pairs behind the one that they follow, as many as follow it at once."""
    gap = _gap(text, list(there.values()))
    behind: Place | None = None
    waiting: list[str] = []
    for pair, entry in [*new.items(), (None, "")]:
        if pair is not None and pair not in there:
            waiting.append(entry)
            continue
        if waiting and behind is not None:
            yield behind.end, behind.end, "".join(gap + one for one in waiting)
        elif waiting and there:
            first = next(iter(there.values())).start
            yield first, first, "".join(one + gap for one in waiting)
        elif waiting:
            at = own.start + 1
            yield at, at, "\n    " + gap.join(waiting) + "\n  "
        waiting = []
        behind = there[pair] if pair is not None else None


def _by_pair(text: str, place: Place) -> dict[Pair, Place]:
    return {tuple(_value(text, one)["pair"]): one for one in items(text, place.start)}


def _gap(text: str, places: list[Place]) -> str:
    """What stands between two items of a list."""
    if len(places) < 2:
        return ",\n    "
    return text[places[0].end : places[1].start]


def _entry(text: str, own: Place, entry: str) -> Iterator[Change]:
    """Put a pair's new values in; where it has other members, or poses, the whole of it."""
    there = {place.name: place for place in members(text, own.start)}
    new = {place.name: place for place in members(entry)}
    curves = {place.name: place for place in members(text, there["curves"].start)}
    drawn = {place.name: place for place in members(entry, new["curves"].start)}
    if there.keys() != new.keys() or list(curves) != list(drawn):
        yield own.start, own.end, entry
        return
    for name in ("word", "boundary"):
        if name in new and not _same(text, there[name], entry, new[name]):
            yield there[name].start, there[name].end, entry[new[name].start : new[name].end]
    for pose, place in drawn.items():
        if not _same(text, curves[pose], entry, place):
            yield curves[pose].start, curves[pose].end, entry[place.start : place.end]
