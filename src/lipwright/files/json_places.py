"""Where things stand in a JSON text, so that a small change leaves all the rest as it is."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass

_DECODER = json.JSONDecoder()
_BLANK = " \t\r\n"


@dataclass(frozen=True, slots=True)
class Place:
    """A value in a text: ``text[start:end]``; of a member of an object its name too."""

    name: str
    start: int
    end: int


def members(text: str, start: int = 0) -> Iterator[Place]:
    """Yield the members of the object that begins at or behind ``start``.

    The text must be valid JSON.

    Examples
    --------
    >>> text = '{"a": [1, 2], "b": "x"}'
    >>> [(place.name, text[place.start:place.end]) for place in members(text)]
    [('a', '[1, 2]'), ('b', '"x"')]
    """
    at = _skip(text, _skip(text, start) + 1)
    while text[at] != "}":
        name, at = _DECODER.raw_decode(text, at)
        first = _skip(text, _skip(text, at) + 1)
        _, last = _DECODER.raw_decode(text, first)
        yield Place(name, first, last)
        at = _skip(text, last)
        at = _skip(text, at + 1) if text[at] == "," else at


def items(text: str, start: int = 0) -> Iterator[Place]:
    """Yield the items of the list that begins at or behind ``start``.

    Examples
    --------
    >>> text = '[1, {"a": 2}]'
    >>> [text[place.start:place.end] for place in items(text)]
    ['1', '{"a": 2}']
    """
    at = _skip(text, _skip(text, start) + 1)
    while text[at] != "]":
        _, last = _DECODER.raw_decode(text, at)
        yield Place("", at, last)
        at = _skip(text, last)
        at = _skip(text, at + 1) if text[at] == "," else at


def _skip(text: str, at: int) -> int:
    while text[at] in _BLANK:
        at += 1
    return at
