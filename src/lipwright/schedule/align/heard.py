"""A phone as the aligner heard it: what its stages hand on to each other."""

from __future__ import annotations

from dataclasses import dataclass

from lipwright.phones import SILENCE

NO_TOKEN = -1


@dataclass(frozen=True, slots=True)
class Heard:
    """A phone, or a pause, in time.

    Parameters
    ----------
    label : str
        ARPAbet, lower case; ``sil`` for pauses.
    start, end : float
        Seconds.
    token : int
        Index of the token it belongs to; ``NO_TOKEN`` for pauses.
    margin : float
        How much better than the best phone it fits, nats per frame; see
        :mod:`.confidence`.
    """

    label: str
    start: float
    end: float
    token: int
    margin: float

    @property
    def is_pause(self) -> bool:
        """Whether nothing is said."""
        return self.label == SILENCE
