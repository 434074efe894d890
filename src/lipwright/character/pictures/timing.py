"""How long pictures are held: frames per second, ones or twos, the shortest hold, the lead.

"On twos" is an animator's word: a new drawing at every second frame at most.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass

from lipwright.errors import InputError

SLOWEST, FASTEST = 1.0, 100.0
LONGEST_HOLD = 2.0
MOST_ON = 12

_TIME = re.compile(r"\s*(\d+(?:\.\d*)?|\.\d+)\s*(frames?|f|seconds?|s|ms)\s*", re.ASCII)
_SECONDS = {"s": 1.0, "second": 1.0, "seconds": 1.0, "ms": 1e-3}


@dataclass(frozen=True, slots=True)
class Timing:
    """When a new picture may be shown.

    Parameters
    ----------
    fps : float
        Frames per second of the film.
    on : int
        A new picture at every ``on``-th frame at most: 1 for ones, 2 for twos.
    minimum_hold : str
        The shortest time that a picture is shown, in frames or seconds:
        ``"2 frames"``, ``"80 ms"``. It is rounded up to whole drawings.
    lead : str
        How much earlier than its sound a picture is shown, likewise.
    rest_after : float
        A silence of so many seconds or more shows the shape of rest.

    Raises
    ------
    InputError
        If a number makes no sense.

    Examples
    --------
    >>> Timing(fps=24).drawings(), Timing(fps=24, on=2).drawings(), Timing(fps=60).drawings()
    (2, 1, 4)
    >>> Timing(fps=60, minimum_hold="2 frames").drawings()
    2
    """

    fps: float = 24.0
    on: int = 1
    minimum_hold: str = "60 ms"
    lead: str = "40 ms"
    rest_after: float = 0.3

    def __post_init__(self) -> None:
        if not SLOWEST <= self.fps <= FASTEST:
            found = f"{self.fps:g} frames per second"
            raise InputError(found, where="fps", expected=f"{SLOWEST:g} to {FASTEST:g}")
        if isinstance(self.on, bool) or not 1 <= self.on <= MOST_ON:
            expected = f"1 for ones, 2 for twos, at most {MOST_ON}"
            raise InputError(f"a drawing every {self.on} frames", where="on", expected=expected)
        if not 0 < self.seconds(self.minimum_hold, "minimum_hold") <= LONGEST_HOLD:
            raise InputError(
                repr(self.minimum_hold),
                where="minimum_hold",
                expected=f"more than 0, at most {LONGEST_HOLD:g} s",
            )
        if self.seconds(self.lead, "lead") > LONGEST_HOLD:
            raise InputError(repr(self.lead), where="lead", expected=f"at most {LONGEST_HOLD:g} s")
        if not 0 < self.rest_after <= 60:
            raise InputError(f"{self.rest_after:g} s", where="rest_after", expected="0 to 60 s")

    def seconds(self, text: str, where: str = "") -> float:
        """Return a time that is written in frames or seconds, in seconds.

        Raises
        ------
        InputError
            If it is neither.
        """
        found = _TIME.fullmatch(text)
        if found is None:
            raise InputError(
                repr(text), where=where, expected="frames or seconds, as '2 frames' or '80 ms'"
            )
        number, unit = float(found[1]), found[2]
        return number * _SECONDS[unit] if unit in _SECONDS else number / self.fps

    def drawings(self) -> int:
        """Return the shortest hold in drawings, each ``on`` frames long."""
        frames = self.seconds(self.minimum_hold) * self.fps
        return max(1, math.ceil(frames / self.on - 1e-6))
