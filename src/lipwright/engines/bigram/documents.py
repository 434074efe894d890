"""Sets and overrides as their files say them, before anything is laid over anything.

What the studio edits and writes back. A document says only what its file says; the
:class:`~lipwright.engines.bigram.model.BigramSet` that comes of it is made in
:mod:`~lipwright.engines.bigram.set_file` and :mod:`~lipwright.engines.bigram.overrides`.
"""

from __future__ import annotations

from typing import Any

import msgspec

from lipwright.engines.bigram.model import Conflict, Pair, Rules

SET_FORMAT = "lipwright/bigram-set"
OVERRIDES_FORMAT = "lipwright/bigram-overrides"

KeyList = list[tuple[float, float]]


class BigramEntry(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A bigram as it stands in a file."""

    pair: Pair
    curves: dict[str, KeyList]
    boundary: float | None = None
    word: str = ""


class SetDocument(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a set's file says."""

    version: int
    name: str
    bigrams: list[BigramEntry]
    rules: Rules | None = None
    base: str = ""
    about: str = ""
    phone_set: str = "common"
    boundary: float = 0.5
    phones: dict[str, dict[str, KeyList]] = {}
    reach: dict[str, str] = {}
    presets: dict[str, Rules] = {}


class OverridesDocument(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What an override file says, or the overrides in a character file."""

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
