"""TSV as Rhubarb Lip Sync writes it: ``seconds <tab> shape`` where each shape starts.

The last line is the end, with the shape of rest. It loses all but the held shapes, and what
is finer than a hundredth of a second.
"""

from __future__ import annotations

from lipwright.export.cue_times import seconds, timed
from lipwright.performance import Performance


def encode(performance: Performance) -> bytes:
    """Return the table.

    Raises
    ------
    CharacterError
        If the shapes do not lie among the animation's controls.
    """
    cues = performance.cues()
    rows = [f"{start}\t{shape}\n" for start, _, shape in timed(cues)]
    return "".join([*rows, f"{seconds(cues.end, cues.fps)}\t{cues.rest}\n"]).encode()
