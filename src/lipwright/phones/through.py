"""From one notation to another, through the classes that both have.

Where no table says what a sound is in the other notation, it is a sound of its class: a
French ``y`` is what ``w`` is in English, rounded and narrow. What looks alike on a face is
of one class (DESIGN section 3); the report says which sounds were not exact.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lipwright.errors import LabelError
from lipwright.phones.loading import load_reduction
from lipwright.phones.reduction import Piece, Reduction
from lipwright.phones.sets import SILENCE, load_phone_set


def through_classes(source: str, target: str, preferred: Sequence[str] = ()) -> Reduction:
    """Return a reduction that knows every sound of which a class is known.

    Parameters
    ----------
    source, target : str
        Names of phone sets.
    preferred : sequence of str
        Labels of the target; the first of a class is taken for it before all others.

    Examples
    --------
    >>> reduction = through_classes("ipa", "arpabet")
    >>> reduction.of("iː"), reduction.of("ʁ")
    (((Piece(label='iy', share=1.0),), True), ((Piece(label='g', share=1.0),), False))
    """
    try:
        direct = load_reduction(source, target)
    except LabelError:
        direct = Reduction(source, target, {})
    classes = load_reduction(source)
    examples = _examples(target, preferred)

    def find(label: str) -> tuple[tuple[Piece, ...], bool] | None:
        try:
            return direct.of(label)
        except LabelError:
            pieces, _ = classes.of(label)
            return tuple(Piece(examples[one.label], one.share) for one in pieces), False

    return Reduction(source, target, {}, find)


def _examples(target: str, preferred: Sequence[str]) -> Mapping[str, str]:
    """A label of the target for each class."""
    reduction = load_reduction(target)
    found = {SILENCE: SILENCE}
    for label in (*preferred, *load_phone_set(target).labels):
        if label != SILENCE:
            pieces, _ = reduction.of(label)
            found.setdefault(pieces[0].label, label)
    return found
