"""Draws the curves of one pair of sounds, with few keys, as an animator would.

A bigram runs from the start of its first sound to the end of its second; 0.5 is the
boundary. Within it the first sound contributes its last target and what leads away from
it, the second sound what leads to its first target: the neighbouring bigrams hold the
rest, and the engine keeps the greater of the two.
"""

from __future__ import annotations

from tools.english.knowledge import CLOSING, SOUNDS, TONGUE, Levels, Sound

Points = list[tuple[float, float]]
POSES = ("open", "W", "ShCh", "PBM", "FV", "wide", *TONGUE)
SEEN = 0.04

#: When a shape begins to form out of silence, and when it has gone after the last sound,
#: as shares of the pair's time: the tongue moves late and is gone early.
ONSET = {"open": 0.05, "W": 0.05, "ShCh": 0.15, "wide": 0.30}
OFFSET = {"open": 0.68, "W": 0.70, "ShCh": 0.88, "wide": 0.92}
#: Share of the sound before in which a shape begins to form, and of the sound after in
#: which it is still seen, where that sound does not have it.
LEAD = {"open": 0.60, "W": 0.85, "ShCh": 0.70, "wide": 0.60}
#: Rounding stays longest, unless the lips must spread.
LINGER = {"open": 0.50, "W": 0.90, "ShCh": 0.50, "wide": 0.50}
SPREAD = 0.2
#: The same of the jaw beside a closure: it is free to move, but lips that must meet keep
#: it nearly shut.
CLOSED = 0.30
#: How much later than the jaw a pose reaches a target, as a share of the sound: lips
#: come forward more slowly than the jaw drops.
LATER = {"W": 0.28}
LATEST = 0.94


def curves(first: str, second: str) -> dict[str, Points]:
    """Return keys over 0..1 for each pose that the pair uses."""
    before, after = SOUNDS[first], SOUNDS[second]
    leaving = _shaded(before, before.last, before.lets_through, after.first, after)
    coming = _shaded(after, after.first, after.keeps, before.last, before)
    drawn = {}
    for pose in POSES:
        if pose in CLOSING.values():
            points = _closure(first, second, pose)
        else:
            points = _shape(before, after, leaving.get(pose, 0.0), coming.get(pose, 0.0), pose)
        if points:
            drawn[pose] = _tidy(points)
    return drawn


def single(label: str) -> dict[str, Points]:
    """Return the single-phone curves of a class, over its own time and beyond."""
    sound = SOUNDS[label]
    drawn = {}
    for pose in POSES:
        a, b = sound.first.get(pose, 0.0), sound.last.get(pose, 0.0)
        if max(a, b) < SEEN:
            continue
        lead = 0.3 if pose in CLOSING.values() else 0.5
        points = [(-lead, 0.0), (sound.at[0], a), (sound.at[1], b), (1 + lead, 0.0)]
        drawn[pose] = [(round(t, 3), round(v, 3)) for t, v in points]
    return drawn


def _shaded(
    sound: Sound, levels: Levels, shares: Levels, neighbour: Levels, other: Sound
) -> Levels:
    """A sound's levels with what it lets through of its neighbour's."""
    if other.kind == "silence":
        shares = {}
    shaded = dict(levels)
    for pose, share in shares.items():
        own = levels.get(pose, 0.0)
        shaded[pose] = own + share * max(neighbour.get(pose, 0.0) - own, 0.0)
    # Lips cannot be round and spread at once: the stronger one wins.
    if min(shaded.get("W", 0.0), shaded.get("wide", 0.0)) > 0:
        weaker = min(("W", "wide"), key=lambda pose: shaded[pose])
        stronger = "wide" if weaker == "W" else "W"
        shaded[weaker] *= max(0.0, 1 - 1.5 * shaded[stronger])
    return shaded


def _shape(before: Sound, after: Sound, leaving: float, coming: float, pose: str) -> Points:
    leaving = leaving if leaving >= SEEN else 0.0
    coming = coming if coming >= SEEN else 0.0
    later = LATER.get(pose, 0.0)
    leave_at = 0.5 * min(before.at[1] + later, LATEST)
    come_at = 0.5 + 0.5 * min(after.at[0] + later, LATEST)
    if before.kind == "silence" and coming:
        return [(_onset(pose), 0.0), (come_at, coming), (1.0, 0.0)]
    if after.kind == "silence" and leaving:
        return [(0.0, 0.0), (leave_at, leaving), (_offset(pose), 0.0)]
    if leaving and coming:
        return [(0.0, 0.0), (leave_at, leaving), (come_at, coming), (1.0, 0.0)]
    if leaving:
        # Out of a shape that the next sound does not share.
        return [(0.0, 0.0), (leave_at, leaving), (0.5 + 0.5 * _linger(after, pose), 0.0)]
    if coming:
        return [(0.5 - 0.5 * _lead(before, pose), 0.0), (come_at, coming), (1.0, 0.0)]
    return []


def _onset(pose: str) -> float:
    return ONSET.get(pose, 0.32)


def _offset(pose: str) -> float:
    return OFFSET.get(pose, 0.7)


def _lead(before: Sound, pose: str) -> float:
    if before.kind == "closure" and pose == "open":
        return CLOSED
    return LEAD.get(pose, 0.4)


def _linger(after: Sound, pose: str) -> float:
    if after.kind == "closure" and pose == "open":
        return CLOSED
    if pose == "W" and after.first.get("wide", 0.0) > SPREAD:
        return LINGER["wide"]
    return LINGER.get(pose, 0.35)


def _closure(first: str, second: str, pose: str) -> Points:
    """A closure is reached early in its sound and left as the next one begins."""
    before, after = CLOSING.get(first) == pose, CLOSING.get(second) == pose
    if before and after:
        return [(0.0, 0.0), (0.15, 1.0), (0.85, 1.0), (1.0, 0.0)]
    if after:
        start = 0.3 if SOUNDS[first].kind == "silence" else 0.36
        early, late = (0.5 + 0.5 * at for at in SOUNDS[second].at)
        return [(start, 0.0), (early, 1.0), (late, 1.0), (1.0, 0.0)]
    if before:
        end = 0.7 if SOUNDS[second].kind == "silence" else 0.62
        early, late = (0.5 * at for at in SOUNDS[first].at)
        return [(0.0, 0.0), (early, 1.0), (late, 1.0), (end, 0.0)]
    return []


def _tidy(points: Points) -> Points:
    return [(round(t, 3), round(min(v, 1.0), 3)) for t, v in points]
