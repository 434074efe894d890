"""JSON as Rhubarb Lip Sync writes it: ``metadata`` and ``mouthCues``.

Not the lossless format, which is ``.json`` too: this one is ``.rhubarb.json``. It loses all
but the held shapes, and what is finer than a hundredth of a second. The sound is named
without its folder.
"""

from __future__ import annotations

from lipwright.export.cue_times import seconds, timed
from lipwright.files import quote
from lipwright.performance import Performance


def encode(performance: Performance) -> bytes:
    """Return the document.

    Raises
    ------
    CharacterError
        If the shapes do not lie among the animation's controls.
    """
    cues = performance.cues()
    rows = [
        f'    {{ "start": {start}, "end": {end}, "value": {quote(shape)} }}'
        for start, end, shape in timed(cues)
    ]
    lines = [
        "{",
        '  "metadata": {',
        f'    "soundFile": {quote(performance.sound_file)},',
        f'    "duration": {seconds(cues.end, cues.fps)}',
        "  },",
        '  "mouthCues": [',
        ",\n".join(rows),
        "  ]",
        "}",
    ]
    return ("\n".join(lines) + "\n").encode("utf-8", "replace")
