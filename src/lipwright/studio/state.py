"""What is open, as one immutable value: the set, the overrides, the lines.

Whoever keeps the values keeps all of the past: to undo is to take the value before. What
changes do to it is in :mod:`~lipwright.studio.applying`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import msgspec

from lipwright.engines.bigram.documents import BigramEntry, KeyList, OverridesDocument, SetDocument
from lipwright.engines.bigram.model import Bigram, BigramSet, Curves, Pair
from lipwright.engines.bigram.overrides import Overrides
from lipwright.engines.bigram.set_file import base_of, load_set, set_document, set_of
from lipwright.engines.bigram.set_text import overrides_bytes, set_document_bytes
from lipwright.studio.changes import LineData


@dataclass(frozen=True, slots=True, eq=False)
class OwnSet:
    """A set's document as it is now, and the set that comes of it.

    Parameters
    ----------
    document : SetDocument
        What the file says beside pairs, single phones and rules.
    base : BigramSet, optional
        What the file builds on.
    of : BigramSet
        The base with all that the document says.
    bigrams, phones : mapping
        What the document itself says.
    """

    document: SetDocument
    base: BigramSet | None
    of: BigramSet
    bigrams: Mapping[Pair, Bigram]
    phones: Mapping[str, Curves]

    @classmethod
    def read(cls, data: bytes, path: str) -> OwnSet:
        """Open the content of a set's file."""
        document = set_document(data, path)
        return cls._of(document, base_of(document, path), set_of(document, path, data))

    @classmethod
    def on(cls, name: str) -> OwnSet:
        """Begin a set of one's own on one that comes with Lipwright."""
        base = load_set(name)
        document = SetDocument(1, f"my {name}", [], base=name, phone_set=base.phone_set)
        return cls._of(document, base, base)

    @classmethod
    def _of(cls, document: SetDocument, base: BigramSet | None, of: BigramSet) -> OwnSet:
        bigrams = {entry.pair: of.bigrams[entry.pair] for entry in document.bigrams}
        phones = {label: of.singles[label] for label in document.phones}
        return cls(document, base, of, bigrams, phones)

    def to_bytes(self) -> bytes:
        """Return the content of its file."""
        own_rules = self.base is None or self.of.rules != self.base.rules
        return set_document_bytes(
            msgspec.structs.replace(
                self.document,
                bigrams=_entries(self.bigrams),
                phones={label: _lists(curves) for label, curves in self.phones.items()},
                rules=self.of.rules if own_rules else None,
            )
        )


def overrides_content(of: Overrides) -> bytes:
    """Return the content of an override file."""
    return overrides_bytes(
        OverridesDocument(
            1,
            of.name,
            of.about,
            of.boundary,
            _entries(of.bigrams),
            dict(of.gains),
            {label: _lists(curves) for label, curves in of.singles.items()},
            {name: dict(fields) for name, fields in of.poses.items()},
            list(of.conflicts),
            dict(of.settings),
        )
    )


def _entries(bigrams: Mapping[Pair, Bigram]) -> list[BigramEntry]:
    return [
        BigramEntry(pair, _lists(one.curves), one.boundary, one.word)
        for pair, one in bigrams.items()
    ]


def _lists(curves: Curves) -> dict[str, KeyList]:
    return {pose: keys.pairs() for pose, keys in curves.items()}


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """All that undo brings back.

    Parameters
    ----------
    own : OwnSet
    overrides : Overrides
        On top of the set and of what the character changes of it.
    lines : mapping of str to LineData
    """

    own: OwnSet
    overrides: Overrides
    lines: Mapping[str, LineData] = field(default_factory=dict)
