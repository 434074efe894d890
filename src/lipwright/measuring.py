"""Animations held against recorded faces: what both do to a mouth, on the built-in head."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from lipwright.errors import CharacterError
from lipwright.phones import PhoneTrack, load_reduction
from lipwright.timeline import Interval, Tier

if TYPE_CHECKING:
    from lipwright.animation import Animation
    from lipwright.character.head import Landmarks
    from lipwright.character.mesh import Part
    from lipwright.evaluate import MotionReport, Recording


def evaluate_motion(
    pairs: Sequence[tuple[Animation | str | Path, Recording | str | Path]],
    *,
    shapes: Sequence[str | Path] | None = None,
    labels: Sequence[str | Path] | None = None,
) -> MotionReport:
    """Hold animations against recorded faces, on the built-in head.

    Parameters
    ----------
    pairs : sequence of (animation, recording)
        Each an object or a file: an animation in the lossless format or a TSV of Rhubarb's,
        a recording as CSV with ``time``, ``lipGapInner`` and ``lipWidth``.
    shapes : sequence of path, optional
        For each recording a CSV with ``time`` and ``mouthPucker``.
    labels : sequence of path, optional
        For each animation the phones, where it holds none.

    Raises
    ------
    InputError
        If a file cannot be used, or a recording does not move.
    CharacterError
        If an animation has no control that moves the head's mouth.
    """
    from lipwright.animation import Animation
    from lipwright.character.between import with_betweens
    from lipwright.character.head import measure
    from lipwright.evaluate import Curve, Pair, compare, is_rhubarb, read_recording, read_rhubarb
    from lipwright.schedule.labels import speech_from_labels

    skin, marks = head_mouth()
    found = []
    for number, (made, recorded) in enumerate(pairs):
        name = f"pair {number + 1}" if isinstance(made, Animation) else str(made)
        if not isinstance(made, Animation):
            made = read_rhubarb(made) if is_rhubarb(made) else Animation.load(made)
        if isinstance(recorded, str | Path):
            recorded = read_recording(recorded, shapes[number] if shapes else None)
        if not set(made.controls) & set(skin.morphs):
            raise CharacterError("no control moves the head's mouth", where=name)
        phones = speech_from_labels(Path(labels[number]), None).phones if labels else made.phones
        moved = with_betweens(made, skin.morphs)
        mouth = measure([skin], marks, dict(zip(moved.controls, moved.values.T, strict=True)))
        opening, breadth = Curve(made.times, mouth.opening), Curve(made.times, mouth.breadth)
        found.append(Pair(opening, breadth, recorded, _classes(phones), name))
    return compare(found)


def _classes(phones: PhoneTrack) -> PhoneTrack:
    """Return phones as classes of the Common Phoneme Set, whatever their notation."""
    rows, _ = load_reduction(phones.phone_set).rows(phones)
    return PhoneTrack(Tier(tuple(Interval(*row) for row in rows)), "common")


@lru_cache(maxsize=1)
def head_mouth() -> tuple[Part, Landmarks]:
    """Return what is measured of the built-in head: its skin, and where the mouth is."""
    from lipwright.character.head import build_head, landmarks

    return next(part for part in build_head() if part.name == "skin"), landmarks()
