"""Times of cues as Rhubarb Lip Sync writes them: seconds with two decimals."""

from __future__ import annotations

import math

from lipwright.performance import Cues


def seconds(frame: int, fps: float) -> str:
    """Return the start of a frame in seconds, rounded up to hundredths.

    Frames seldom start on a hundredth. Rounded up, a reader that cuts ``time * fps`` off
    finds the same frame as one that rounds it, at up to 60 frames per second.

    Examples
    --------
    >>> seconds(1, 24), int(0.05 * 24), round(0.05 * 24)
    ('0.05', 1, 1)
    """
    return f"{math.ceil(round(100 * frame / fps, 6)) / 100:.2f}"


def timed(cues: Cues) -> list[tuple[str, str, str]]:
    """Return start, end and shape of each cue."""
    return [
        (seconds(first, cues.fps), seconds(last, cues.fps), shape)
        for shape, first, last in cues.rows()
    ]
