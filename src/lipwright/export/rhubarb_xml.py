"""XML as Rhubarb Lip Sync writes it: ``mouthCue`` elements with start and end.

It loses all but the held shapes, and what is finer than a hundredth of a second. The sound is
named without its folder.
"""

from __future__ import annotations

import re
from xml.sax.saxutils import escape

from lipwright.export.cue_times import seconds, timed
from lipwright.performance import Performance

_NOT_IN_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def encode(performance: Performance) -> bytes:
    """Return the document.

    Raises
    ------
    CharacterError
        If the shapes do not lie among the animation's controls.
    """
    cues = performance.cues()
    rows = [
        f'    <mouthCue start="{start}" end="{end}">{_text(shape)}</mouthCue>'
        for start, end, shape in timed(cues)
    ]
    lines = [
        '<?xml version="1.0" encoding="utf-8"?>',
        "<rhubarbResult>",
        "  <metadata>",
        f"    <soundFile>{_text(performance.sound_file)}</soundFile>",
        f"    <duration>{seconds(cues.end, cues.fps)}</duration>",
        "  </metadata>",
        "  <mouthCues>",
        *rows,
        "  </mouthCues>",
        "</rhubarbResult>",
    ]
    return ("\n".join(lines) + "\n").encode()


def _text(value: str) -> str:
    return escape(_NOT_IN_XML.sub("\ufffd", value))
