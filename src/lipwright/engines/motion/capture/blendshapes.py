"""Names of ARKit's blendshapes as files spell them, and which of them speech moves.

A name is known whatever its case, separators, prefix and spelling of its side:
``JawOpen``, ``head.jaw_open`` and ``mouthSmile_L`` are ``jawOpen`` and
``mouthSmileLeft``. What is learnt from a take is the mouth, jaw and tongue (DESIGN
section 5); head, eyes, brows, and lengths measured on the face are left out.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

_SIDED = """
    eyeBlink eyeLookDown eyeLookIn eyeLookOut eyeLookUp eyeSquint eyeWide mouthSmile mouthFrown
    mouthDimple mouthStretch mouthPress mouthLowerDown mouthUpperUp browDown browOuterUp
    cheekSquint noseSneer
"""
_WHOLE = """
    jawForward jawLeft jawRight jawOpen mouthClose mouthFunnel mouthPucker mouthLeft mouthRight
    mouthRollLower mouthRollUpper mouthShrugLower mouthShrugUpper browInnerUp cheekPuff tongueOut
"""
ARKIT = tuple(
    [f"{name}{side}" for name in _SIDED.split() for side in ("Left", "Right")] + _WHOLE.split()
)
_KNOWN = {name.lower(): name for name in ARKIT}
_MOUTH = ("jaw", "mouth", "tongue")
_ELSEWHERE = re.compile(r"head|neck|eye|brow|lid|gaze|pupil|blink", re.IGNORECASE)


def arkit_name(name: str) -> str | None:
    """Return ARKit's own spelling of a name; None where it is none of ARKit's.

    Examples
    --------
    >>> arkit_name("JawOpen"), arkit_name("face.mouth_smile_L"), arkit_name("lipWidth")
    ('jawOpen', 'mouthSmileLeft', None)
    """
    last = re.split(r"[.:|]", name.strip())[-1]
    flat = re.sub(r"[\W_]+", "", last).lower()
    sided = re.sub(r"r$", "right", re.sub(r"l$", "left", flat))
    return _KNOWN.get(flat) or (_KNOWN.get(sided) if re.search(r"[\W_][lrLR]$", last) else None)


def learnt(names: Sequence[str]) -> tuple[dict[int, str], tuple[str, ...]]:
    """Choose the columns that an engine learns from.

    Parameters
    ----------
    names : sequence of str
        Of a file's columns, those of time left out.

    Returns
    -------
    chosen : dict of int to str
        Column to channel name: ARKit's jaw, mouth and tongue where the file has ARKit
        names; of other files all that does not name head, eyes or brows.
    left_out : tuple of str
    """
    known = {column: found for column, name in enumerate(names) if (found := arkit_name(name))}
    if known:
        chosen = {column: name for column, name in known.items() if name.startswith(_MOUTH)}
    else:
        chosen = {
            column: name.strip() for column, name in enumerate(names) if not _ELSEWHERE.search(name)
        }
    return chosen, tuple(name for column, name in enumerate(names) if column not in chosen)
