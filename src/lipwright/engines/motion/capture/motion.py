"""Recorded motion as it comes from a file: channels over time on the sound's clock."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import InputError
from lipwright.markers import marker_labels

Floats = NDArray[np.float64]
Kind = Literal["blendshapes", "markers"]

DISAGREE = 0.2
"""Seconds by which a take and its sound may differ in length."""


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Recorded motion.

    Parameters
    ----------
    channels : tuple of str
        C names: blendshapes, or coordinates of markers ``"chin.x", "chin.y", "chin.z"``.
    values : (T, C) float32
        Frame ``k`` holds what is seen at ``start + (k + 0.5) / rate``. Blendshapes are
        free of NaN; markers, metres, are NaN where they were not seen, until cleaned.
    rate : float
        Frames per second.
    start : float
        Seconds, on the sound's clock, at which the first frame begins.
    notes : tuple of str
        What was mended or left out.
    kind : str
        ``"blendshapes"`` or ``"markers"``.
    where : str
        The file, for messages.
    """

    channels: tuple[str, ...]
    values: NDArray[np.float32]
    rate: float
    start: float
    notes: tuple[str, ...] = ()
    kind: Kind = "blendshapes"
    where: str = ""

    @property
    def duration(self) -> float:
        """Length of the frames in seconds."""
        return len(self.values) / self.rate

    @property
    def end(self) -> float:
        """Seconds, on the sound's clock, at which the last frame ends."""
        return self.start + self.duration

    @property
    def times(self) -> Floats:
        """The instant of each frame, its middle, in seconds."""
        return self.start + (np.arange(len(self.values), dtype=np.float64) + 0.5) / self.rate

    @property
    def labels(self) -> tuple[str, ...]:
        """The names of the markers."""
        return marker_labels(self.channels)

    @property
    def points(self) -> Floats:
        """The markers' places, (T, M, 3) float64, metres."""
        return self.values.reshape(len(self.values), -1, 3).astype(np.float64)


def check_length(motion: Motion, sound_seconds: float) -> None:
    """Refuse motion that does not belong to its sound.

    Parameters
    ----------
    motion : Motion
    sound_seconds : float
        The length of the sound.

    Raises
    ------
    InputError
        If one begins or ends more than 0.2 s from the other.
    """
    apart = motion.end - sound_seconds
    if abs(apart) > DISAGREE or abs(motion.start) > DISAGREE:
        raise InputError(
            f"motion from {motion.start:.2f} to {motion.end:.2f} s beside {sound_seconds:.2f} s "
            "of sound",
            where=motion.where,
            expected=f"a take and its sound that agree within {DISAGREE:g} s",
            cure="cut both to the same moment, or check the frame rate",
        )
