"""What the nets that are learnt are like."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Shape:
    """What kind of net is learnt.

    Parameters
    ----------
    ahead : int
        Frames of 20 ms that are heard beyond the one whose face is learnt.
    late : int
        By how many frames the answer is stamped later than the face it was taught.
    both_ways : bool
        Whether loudness is that of the whole recording.
    centred : bool
        Whether what a block makes is added to the middle of its instants, not to the newest:
        then the net speaks of the frame in the middle of what it hears.
    last_moved, last_dropped : float
        In the last steps: how far bands are moved along the scale, and which share of units is
        left out. A net that hears much of what comes leans on what only synthesisers do.
    units : int
    dilations : tuple of int
    """

    ahead: int
    late: int
    both_ways: bool
    centred: bool = False
    last_moved: float = 0.5
    last_dropped: float = 0.08
    units: int = 96
    dilations: tuple[int, ...] = (1, 2, 4, 8, 16, 1)


WHOLE = Shape(ahead=32, late=0, both_ways=True, centred=True, last_moved=1.5, last_dropped=0.3)
LIVE = Shape(ahead=1, late=1, both_ways=False)
"""Faces move some 25 ms later than curves are drawn (docs/english-set.md), so a live answer may
be 20 ms later than drawn: it has heard a frame more, and waits for none."""
