"""Phones in time, in the notation of one phone set."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from lipwright.errors import LabelError
from lipwright.phones.sets import SILENCE, load_phone_set
from lipwright.timeline import Interval, Tier


@dataclass(frozen=True, slots=True)
class PhoneTrack:
    """Phones in order of time.

    Parameters
    ----------
    tier : Tier
        The phones; silence is ``sil`` in every set.
    phone_set : str
        Name of the set that the labels belong to.
    """

    tier: Tier
    phone_set: str = "arpabet"

    def __iter__(self) -> Iterator[Interval]:
        return iter(self.tier)

    def __len__(self) -> int:
        return len(self.tier)

    def normalised(self) -> PhoneTrack:
        """Return the track with every label in its set's own spelling.

        Raises
        ------
        LabelError
            If labels are not in the set: all of them are named at once.
        """
        phone_set = load_phone_set(self.phone_set)
        unknown: list[str] = []
        result: list[Interval] = []
        for phone in self.tier:
            try:
                label = SILENCE if phone.label == SILENCE else phone_set.normalise(phone.label)
            except LabelError:
                if phone.label not in unknown:
                    unknown.append(phone.label)
                continue
            result.append(Interval(label, phone.start, phone.end, phone.confidence))
        if unknown:
            raise LabelError(
                f"{', '.join(map(repr, unknown))}: not phones of {self.phone_set!r}",
                expected=f"labels among {' '.join(phone_set.labels)}",
            )
        return PhoneTrack(Tier(tuple(result)), self.phone_set)
