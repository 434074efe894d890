"""Names of mouth shapes, as rigs spell them: which of a rig's names means which known one.

Blind to case and separators (``jaw_open``), to what exporters put before and after
(``Head_jawOpen``, ``blendShape1.jawOpen``, ``viseme_aa``), and to how sides are spelled
(``mouthSmileLeft``, ``MouthSmile_L``): a known name without a side means both sides. One
letter is a mouth shape only alone or after a word such as mouth, face or viseme: ``Mouth_A``,
not ``Outfit_A``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

_WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+|[^\W\dA-Za-z_]+")
_SIDES = {"l", "r", "left", "right"}
_ELSEWHERE = """
    eye eyes brow brows eyebrow eyebrows lid lids eyelid eyelids lash lashes pupil iris nose
    nostril ear ears hand hands finger fingers fist arm leg foot toe wing tail hair cloth door
    visor
"""
_MOUTH = """
    mouth mth mouthshape lip lips viseme visemes vis vrc v phoneme phonemes phon vowel vowels
    speech talk lipsync rhubarb preston blair papagayo shape shapes mund boca bouche
"""
_NEUTRAL = """
    blend blendshape blendshapes bs key keys morph morphs target targets head face facial geo
    mesh skin fcl fac
"""
_ELSEWHERE_WORDS, _MOUTH_WORDS, _NEUTRAL_WORDS = (
    frozenset(words.split()) for words in (_ELSEWHERE, _MOUTH, _NEUTRAL)
)
_WHOLE, _END, _START, _PART = 0, 2, 4, 6
_ALIAS = 10
"""How much worse another spelling of a name fits than the name itself."""


def match_names(
    channels: Sequence[str], known: Mapping[str, Iterable[str]]
) -> dict[str, tuple[str, ...]]:
    """Find known names among a rig's.

    Parameters
    ----------
    channels : sequence of str
        What the rig calls its shapes.
    known : mapping of str to iterable of str
        Known names, each with its other spellings. These count only where the name
        itself is not found.

    Returns
    -------
    dict of str to tuple of str
        For each known name that was found, the rig's names for it.

    Examples
    --------
    >>> match_names(["Head_JawOpen", "mouth_smile_L", "mouth_smile_R"],
    ...             {"jawOpen": [], "mouthSmile": [], "mouthFunnel": []})
    {'jawOpen': ('Head_JawOpen',), 'mouthSmile': ('mouth_smile_L', 'mouth_smile_R')}
    """
    lookup: dict[str, tuple[str, int]] = {}
    for name, aliases in known.items():
        for alias in aliases:
            lookup.setdefault(_flat(alias), (name, _ALIAS))
    lookup |= {_flat(name): (name, 0) for name in known}
    ranked: dict[str, list[tuple[int, str]]] = {}
    for channel in channels:
        for rank, key in _spellings(channel):
            if key in lookup:
                name, penalty = lookup[key]
                ranked.setdefault(name, []).append((rank + penalty, channel))
                break
    return {name: _best(ranked[name]) for name in known if name in ranked}


def _best(found: list[tuple[int, str]]) -> tuple[str, ...]:
    """Keep what fits well; of what fits badly, only if there is nothing else."""
    least = min(rank for rank, _ in found)
    limit = _END + 1 if least <= _END + 1 else least
    kept = [(rank, channel) for rank, channel in found if rank <= limit]
    # A rig with mouthSmile and mouthSmileLeft has one movement twice.
    whole = any(rank % 2 == 0 for rank, _ in kept)
    return tuple(channel for rank, channel in kept if rank % 2 == 0 or not whole)


def _chunks(name: str) -> list[list[str]]:
    """Return the words of a name, in lower case, grouped by its separators."""
    chunks = re.split(r"[\W_]+", name)
    return [[word.lower() for word in _WORDS.findall(chunk)] for chunk in chunks if chunk]


def _flat(name: str) -> str:
    return "".join(word for chunk in _chunks(name) for word in chunk)


def _spellings(name: str) -> list[tuple[int, str]]:
    """Return what a rig's name could mean, best first; odd ranks are without side or number."""
    chunks = _chunks(name)
    found = []
    for first in range(len(chunks)):
        for end in range(first + 1, len(chunks) + 1):
            words = [word for chunk in chunks[first:end] for word in chunk]
            before = {word for chunk in chunks[:first] for word in chunk}
            if before & _ELSEWHERE_WORDS:
                continue
            at_end = end == len(chunks)
            rank = (_END if at_end else _PART) if first else (_WHOLE if at_end else _START)
            last = at_end or not _bare([word for chunk in chunks[end:] for word in chunk])
            for key, worse in (("".join(words), 0), (_bare(words), 1)):
                alone = len(key) == 1 and at_end and not worse and _says(before)
                if len(key) > 2 or (len(key) == 2 and last) or alone:
                    found.append((rank + worse, key))
    return sorted(found, key=lambda item: item[0])


def _says(before: set[str]) -> bool:
    """Return whether one letter, such as VRM's A, is a mouth's: alone, or after such words."""
    named = {word for word in before if not word.isdecimal()}
    plain = named & (_MOUTH_WORDS | _NEUTRAL_WORDS)
    strange = {word for word in named - plain if len(word) > 1}
    return not strange and (not named or bool(plain))


def _bare(words: list[str]) -> str:
    """Drop a side and a number: what is left may be a known name."""
    kept = [word for word in words if word not in _SIDES and not word.isdecimal()]
    return re.sub(r"(?<=...)(left|right)$", "", "".join(kept))


def some(names: Sequence[str], count: int = 8) -> str:
    """Return the first of many names, for a message."""
    return ", ".join(names[:count]) + (", …" if len(names) > count else "")
