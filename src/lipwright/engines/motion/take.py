"""A take: one recording of motion with its sound and what is said in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.timeline import Tier


@dataclass(frozen=True, slots=True, eq=False)
class Take:
    """One recording of motion with its sound.

    Parameters
    ----------
    name : str
        What it is called in reports.
    channels : tuple of str
        What is learnt: names of blendshapes, or marker coordinates (``"chin.x"``).
    values : (T, C) float32
        Free of NaN; frame k holds what is seen at ``start + (k + 0.5) / rate``.
    rate : float
        Frames per second.
    start : float
        Seconds, on the sound's clock.
    phones : PhoneTrack
        ARPAbet, full labels, ``sil`` included.
    words : Tier
        When each word sounds; empty where unknown.
    sound : Sound or None
        The sound itself, where there is one.
    """

    name: str
    channels: tuple[str, ...]
    values: NDArray[np.float32]
    rate: float
    start: float
    phones: PhoneTrack
    words: Tier
    sound: Sound | None
