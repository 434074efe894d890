"""Reductions by name, or from a user's file, with what finds classes for other labels."""

from __future__ import annotations

from functools import lru_cache, partial
from pathlib import Path

from lipwright.errors import LabelError, LipwrightError
from lipwright.files import file_version
from lipwright.phones.reduction import Finder, Piece, Reduction, Table, read_table
from lipwright.phones.sets import DATA, load_phone_set


def load_reduction(source: str, target: str = "common") -> Reduction:
    """Return the reduction between two phone sets, or the one in a file.

    Parameters
    ----------
    source : str
        A phone set's name, or the path of a reduction file ending in ``.json``, which need
        name only what differs from the reduction that comes with Lipwright, if one does.
    target : str
        The phone set to reduce to: its name, or its path. IPA and SAMPA reduce to any set
        whose classes have segments in IPA. Where it extends another set, that one's
        reduction holds for every other label that the reduction to this one does not name.

    Raises
    ------
    LabelError
        If there is no such reduction.
    """
    files = (name for name in (source, target) if name.endswith(".json"))
    return _load(source, target, tuple(map(file_version, files)))


@lru_cache(maxsize=64)
def _load(source: str, target: str, versions: tuple[object, ...]) -> Reduction:
    if source == target:
        return Reduction(source, target, {}, lambda label: ((Piece(label),), True))
    by_path = source.endswith(".json")
    path = Path(source) if by_path else DATA / f"{source}-to-{target}.json"
    finder = None if by_path else _finder(source, target)
    base = "" if by_path or finder else _extended(target)
    if base:
        table = read_table(path) if path.exists() else Table(source, target, {})
        finder = partial(_own_or_base, table, load_reduction(source, base))
        return Reduction(source, target, table.pieces, finder, table.nearest)
    if by_path or path.exists():
        table = read_table(path)
        finder = _finder(table.source, table.target) or (_usual(table) if by_path else None)
        return Reduction(table.source, table.target, table.pieces, finder, table.nearest)
    if finder is None:
        raise LabelError(
            f"no reduction from {source!r} to {target!r}", cure="write one, and give its path"
        )
    return Reduction(source, load_phone_set(target).name, {}, finder)


def _extended(target: str) -> str:
    """Return the phone set that the target adds labels to, if it does."""
    try:
        return load_phone_set(target).extends
    except LabelError:
        return ""  # the caller names both ends of what is missing


def _usual(table: Table) -> Finder | None:
    """What finds the labels that a user's file leaves as they are."""
    none = Table(table.source, table.target, {})
    try:
        return partial(_own_or_base, none, load_reduction(table.source, table.target))
    except LabelError:  # there is no other reduction between these sets
        return None


def _own_or_base(own: Table, base: Reduction, label: str) -> tuple[tuple[Piece, ...], bool] | None:
    """Return what a label becomes: by the own rows, else by the base."""
    if label in own.pieces:
        return own.pieces[label], label not in own.nearest
    try:
        return base.of(label)
    except LabelError:
        return None


def _finder(source: str, target: str) -> Finder | None:
    """What asks for the nearest class, where the target's classes have segments in IPA."""
    if source not in ("ipa", "sampa"):
        return None
    from lipwright.phones.ipa import has_examples, nearest_class  # only IPA needs its tables

    try:
        if not has_examples(target):
            return None
    except LipwrightError:  # a user's reduction may name classes that no file lists
        return None
    if source == "ipa":
        return lambda label: nearest_class(label, target)
    to_ipa = read_table(DATA / "sampa-to-ipa.json").pieces
    return lambda label: nearest_class(to_ipa[label][0].label, target) if label in to_ipa else None
