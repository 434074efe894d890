"""Reductions by name, or from a user's file, with what finds classes for other labels."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from lipwright.errors import LabelError
from lipwright.phones.reduction import Finder, Piece, Reduction, read_table
from lipwright.phones.sets import DATA


@cache
def load_reduction(source: str, target: str = "common") -> Reduction:
    """Return the reduction between two phone sets, or the one in a file.

    Parameters
    ----------
    source : str
        A phone set's name, or the path of a reduction file ending in ``.json``.
    target : str
        The phone set to reduce to.

    Raises
    ------
    LabelError
        If there is no such reduction.
    """
    if source == target:
        return Reduction(source, target, {}, lambda label: ((Piece(label),), True))
    by_path = source.endswith(".json")
    path = Path(source) if by_path else DATA / f"{source}-to-{target}.json"
    if not by_path and not path.exists():
        raise LabelError(
            f"no reduction from {source!r} to {target!r}", cure="write one, and give its path"
        )
    table = read_table(path)
    return Reduction(table.source, table.target, table.pieces, _finder(table.source, table.target))


def _finder(source: str, target: str) -> Finder | None:
    if target != "common" or source not in ("ipa", "sampa"):
        return None
    from lipwright.phones.ipa import nearest_class  # only IPA needs its tables

    if source == "ipa":
        return nearest_class
    to_ipa = read_table(DATA / "sampa-to-ipa.json").pieces
    return lambda label: nearest_class(to_ipa[label][0].label) if label in to_ipa else None
