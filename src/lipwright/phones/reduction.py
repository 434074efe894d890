"""Reductions: what each label of one phone set becomes in another (Xu et al., Table 1).

A reduction is a file, so that a user can split ``bmp`` into ``bp`` and ``m`` and is
then told which bigrams are new. A label may become several (``ɑːɹ`` → aa, r), each
with its share of the time.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path

import msgspec

from lipwright.errors import LabelError
from lipwright.files import convert, file_version, read_document
from lipwright.phones.sets import SILENCE, load_phone_set
from lipwright.phones.track import PhoneTrack
from lipwright.timeline import Interval


class Piece(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A label of the target set and its share of the phone's time, 0..1."""

    label: str
    share: float = 1.0


@dataclass(frozen=True, slots=True)
class ReductionReport:
    """What a reduction did.

    Parameters
    ----------
    exact : dict of str to str
        Labels that the target set has a class for, and that class.
    stand_ins : dict of str to str
        Labels that only the nearest class could stand in for, and that class.
    counts : dict of str to int
        How often each label came, silence left out.
    seconds : dict of str to float
        How long each label sounded, silence left out.
    """

    exact: dict[str, str] = field(default_factory=dict)
    stand_ins: dict[str, str] = field(default_factory=dict)
    counts: dict[str, int] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)

    @property
    def share_exact(self) -> float:
        """Share of the phones whose classes are exact: 0..1, and 1 where there are none."""
        return self._share({label: float(count) for label, count in self.counts.items()})

    @property
    def share_exact_of_time(self) -> float:
        """Share of the time of speech whose classes are exact: 0..1."""
        return self._share(self.seconds)

    def _share(self, amounts: dict[str, float]) -> float:
        total = sum(amounts.values())
        lost = sum(amount for label, amount in amounts.items() if label in self.stand_ins)
        return 1.0 - lost / total if total else 1.0


Row = tuple[str, float, float]
Finder = Callable[[str], tuple[tuple[Piece, ...], bool] | None]


@dataclass(frozen=True, slots=True)
class Reduction:
    """A map from the labels of one phone set to those of another.

    Parameters
    ----------
    source, target : str
        Names of the phone sets.
    table : dict of str to tuple of Piece
        What each label becomes.
    finder : function, optional
        Asked for labels that are not in the table; it returns the pieces and whether
        they are exact, or None where it knows no answer either.
    nearest : frozenset of str
        Labels whose class in the table only stands in.
    """

    source: str
    target: str
    table: dict[str, tuple[Piece, ...]]
    finder: Finder | None = None
    nearest: frozenset[str] = frozenset()

    def of(self, label: str) -> tuple[tuple[Piece, ...], bool]:
        """Return the pieces of one label and whether they are exact.

        Raises
        ------
        LabelError
            If neither the table nor the finder knows the label.
        """
        name = label if label in self.table else self._spelled(label)
        pieces = self.table.get(name)
        if pieces:
            return pieces, name not in self.nearest
        found = self.finder(label) if self.finder is not None else None
        if found is None:
            raise LabelError(
                f"{label!r} has no class in the reduction {self.source} to {self.target}",
                cure="add it to the reduction file",
            )
        return found

    def _spelled(self, label: str) -> str:
        """The source set's own spelling, where a label is one of its phones."""
        try:
            return load_phone_set(self.source).normalise(label)
        except LabelError:
            return label

    def rows(self, track: PhoneTrack) -> tuple[list[Row], ReductionReport]:
        """Return ``(label, start, end)`` of each phone in the target set, with a report.

        Raises
        ------
        LabelError
            If labels are unknown: all of them are named at once.
        """
        report = ReductionReport()
        known = self._pieces({phone.label for phone in track}, report)
        rows: list[Row] = []
        for phone in track:
            if phone.label != SILENCE:
                counts, seconds = report.counts, report.seconds
                counts[phone.label] = counts.get(phone.label, 0) + 1
                seconds[phone.label] = seconds.get(phone.label, 0.0) + phone.duration
            pieces = known[phone.label]
            if len(pieces) == 1:
                rows.append((pieces[0].label, phone.start, phone.end))
            else:
                rows.extend(_split(phone, pieces))
        return rows, report

    def share_exact(self, track: PhoneTrack) -> float:
        """Return the share of a track's phones whose classes are exact, silence left out: 0..1.

        Raises
        ------
        LabelError
            If labels are unknown.
        """
        return self.rows(track)[1].share_exact

    def _pieces(self, labels: set[str], report: ReductionReport) -> dict[str, tuple[Piece, ...]]:
        known: dict[str, tuple[Piece, ...]] = {SILENCE: (Piece(SILENCE),)}
        unknown = []
        for label in sorted(labels - {SILENCE}):
            try:
                pieces, exact = self.of(label)
            except LabelError:
                unknown.append(label)
                continue
            known[label] = pieces
            names = " ".join(piece.label for piece in pieces)
            (report.exact if exact else report.stand_ins)[label] = names
        if unknown:
            raise LabelError(
                f"{', '.join(map(repr, unknown))}: no class in the reduction "
                f"{self.source} to {self.target}",
                cure="add it to the reduction file",
            )
        return known


def _split(phone: Interval, pieces: tuple[Piece, ...]) -> list[Row]:
    total = sum(piece.share for piece in pieces)
    rows: list[Row] = []
    start, passed = phone.start, 0.0
    for index, piece in enumerate(pieces):
        passed += piece.share / total
        last = index == len(pieces) - 1
        end = phone.end if last else phone.start + passed * phone.duration
        rows.append((piece.label, start, end))
        start = end
    return rows


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    source: str
    target: str
    map: dict[str, str | list[Piece]]
    about: str = ""
    nearest: list[str] = []


@dataclass(frozen=True, slots=True)
class Table:
    """A reduction file: ``pieces`` of each label of ``source``; ``nearest`` only stand in."""

    source: str
    target: str
    pieces: dict[str, tuple[Piece, ...]]
    nearest: frozenset[str] = frozenset()


def read_table(path: Path) -> Table:
    """Return the content of a reduction file; it is read anew when it changes."""
    return _read_table(path, file_version(path))


@lru_cache(maxsize=64)
def _read_table(path: Path, version: object) -> Table:
    document = read_document(path, format="lipwright/reduction", version=1)
    read = convert(document, _Document, str(path))
    pieces = {
        label: (Piece(value),) if isinstance(value, str) else tuple(value)
        for label, value in read.map.items()
    }
    return Table(read.source, read.target, pieces, frozenset(read.nearest))
