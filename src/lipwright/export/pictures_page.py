"""A page that plays a character of pictures: one HTML file, from disk, without a network.

The page (``pictures.html`` beside this module, no build step) shows the mouth in time with
the sound, the shapes that the character has, the cues and the words. Lossy: it holds neither
the controls nor their keys; the sound is that of :mod:`lipwright.export.html`.
"""

from __future__ import annotations

import base64
import hashlib
from importlib import resources

from lipwright.errors import LipwrightError
from lipwright.export.html import block, json_block, playable
from lipwright.performance import Cues, Performance

_PLACE = "<!-- lipwright:data -->"
_HASH = "script-hash"


def encode(performance: Performance) -> bytes:
    """Return the page.

    Raises
    ------
    CharacterError
        If the shapes do not lie among the animation's controls.
    InputError
        If a picture cannot be read.
    """
    before, after = _page()
    blocks = [json_block("pictures", _content(performance, performance.cues()))]
    sound = performance.speech.sound
    if sound is not None and len(sound.samples):
        wav = base64.b64encode(playable(sound).wav_bytes()).decode("ascii")
        blocks.append(block("sound", "audio/wav;base64", wav))
    return "\n".join([before, *blocks, after]).encode()


def _page() -> tuple[str, str]:
    page = resources.files("lipwright.export").joinpath("pictures.html").read_text("utf-8")
    before, found, after = page.partition(_PLACE)
    script = after.partition("<script>")[2].rpartition("</script>")[0]
    if not (found and script):
        raise LipwrightError("the page of pictures is damaged", cure="install Lipwright again")
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode("ascii")
    return before.replace(_HASH, f"sha256-{digest}").rstrip(), after.lstrip()


def _content(performance: Performance, cues: Cues) -> dict[str, object]:
    pictures = cues.pictures()
    return {
        "text": performance.speech.text,
        "character": cues.character,
        "fps": cues.fps,
        "end": cues.end,
        "rest": cues.rest,
        "cues": cues.rows(),
        "words": [(word.label, word.start, word.end) for word in performance.animation.words],
        "own": not all(picture.drawn_by_code for picture in pictures.values()),
        "pictures": [
            (label, f"data:{picture.media};base64,{base64.b64encode(picture.data).decode('ascii')}")
            for label, picture in pictures.items()
        ],
    }
