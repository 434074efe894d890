"""From the labels of any phone set to the classes of a bigram set."""

from __future__ import annotations

from lipwright.engines.bigram.model import BigramSet
from lipwright.errors import LabelError
from lipwright.phones import Reduction, load_phone_set, load_reduction


def reduction_for(of: BigramSet, source: str, path: str | None = None) -> Reduction:
    """Return what reduces a phone set's labels to a set's classes.

    Parameters
    ----------
    of : BigramSet
    source : str
        The phone set of the labels.
    path : str, optional
        A reduction file of the user's.

    Raises
    ------
    LabelError
        If there is none, or the file is for other labels or other classes.
    """
    if path is None:
        return load_reduction(source, of.phone_set)
    found = load_reduction(path)
    classes = load_phone_set(of.phone_set).name
    if (found.source, found.target) != (load_phone_set(source).name, classes):
        raise LabelError(
            f"reduces {found.source!r} to {found.target!r}",
            where=path,
            expected=f"{source!r} to {classes!r}, as these phones and this set need",
        )
    return found
