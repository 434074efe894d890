"""Switch data of Moho, which Papagayo writes and OpenToonz reads: ``.dat``.

The first line names the format; then ``frame shape`` where each shape starts, the first frame
being 1; the last line is the end, with the shape of rest. The frames are those of the held
shapes; the file does not say how many go into a second. It loses all but the held shapes.

Moho sets a switch layer to the drawing of the shape's name. OpenToonz knows the names of
Preston Blair's list only.
"""

from __future__ import annotations

from lipwright.performance import Performance


def encode(performance: Performance) -> bytes:
    """Return the switch data.

    Raises
    ------
    CharacterError
        If the shapes do not lie among the animation's controls.
    """
    cues = performance.cues()
    rows = [f"{first + 1} {shape}\n" for shape, first, _ in cues.rows()]
    return "".join(["MohoSwitch1\n", *rows, f"{cues.end + 1} {cues.rest}\n"]).encode()
