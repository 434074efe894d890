"""What a set is fitted to: recorded faces as weights of poses over time, with their phones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.bigram.model import BigramSet
from lipwright.errors import InputError, did_you_mean
from lipwright.phones import SILENCE, PhoneTrack
from lipwright.timeline import Tier

FEWEST_FRAMES = 4
SLOWEST, FASTEST = 5.0, 1000.0


@dataclass(frozen=True, slots=True, eq=False)
class FaceTake:
    """A recorded face in the poses of a set.

    Parameters
    ----------
    name : str
        In errors.
    poses : tuple of str
        Which poses were seen.
    values : (T, P) float
        Their weights, 0..1; frame ``k`` holds what is seen at ``start + (k + 0.5) / rate``.
    rate : float
        Frames per second.
    start : float
        Seconds, on the clock of the phones.
    phones : PhoneTrack
    words : Tier
        What is said; says only which frames are left out together when the fit tries itself.

    Raises
    ------
    InputError
        If it is too short, has no phones, or its numbers make no sense.
    """

    name: str
    poses: tuple[str, ...]
    values: NDArray[np.floating]
    rate: float
    start: float
    phones: PhoneTrack
    words: Tier = field(default_factory=Tier)

    def __post_init__(self) -> None:
        shape = self.values.shape
        if len(shape) != 2 or shape[1] != len(self.poses):
            raise InputError(
                f"values of shape {shape}",
                where=self.name,
                expected=f"a column for each of {len(self.poses)} poses",
            )
        if shape[0] < FEWEST_FRAMES:
            raise InputError(
                f"{shape[0]} frames", where=self.name, expected=f"{FEWEST_FRAMES} or more"
            )
        if not SLOWEST <= self.rate <= FASTEST:
            raise InputError(
                f"{self.rate:g} frames per second",
                where=self.name,
                expected=f"{SLOWEST:g} to {FASTEST:g}",
            )
        if not np.isfinite(self.values).all():
            raise InputError("a weight is not finite", where=self.name, expected="finite numbers")
        if all(phone.label == SILENCE for phone in self.phones):
            raise InputError(
                "no phones", where=self.name, expected="what is said in it, with its times"
            )

    @property
    def times(self) -> NDArray[np.float64]:
        """The middles of the frames, seconds."""
        count = len(self.values)
        return np.asarray(self.start + (np.arange(count) + 0.5) / self.rate, dtype=np.float64)


def check_takes(takes: Sequence[FaceTake], base: BigramSet) -> None:
    """Refuse takes that a set cannot be fitted to.

    Raises
    ------
    InputError
        If there are none, they hold different poses, the set lacks a pose, or nothing moves.
    """
    if not takes:
        raise InputError("no takes", expected="one or more recordings of a speaking face")
    first = takes[0]
    for take in takes:
        if take.poses != first.poses:
            raise InputError(
                f"the poses {', '.join(take.poses)}",
                where=take.name,
                expected=f"those of {first.name}: {', '.join(first.poses)}",
            )
    for pose in first.poses:
        if pose not in base.rules.names:
            raise InputError(
                f"unknown pose {pose!r}",
                where=first.name,
                expected=f"one of {', '.join(base.rules.names)}",
                cure=did_you_mean(pose, base.rules.names),
            )
    if not any((take.values > 0).any() for take in takes):
        raise InputError("no pose ever moves", where=first.name)
