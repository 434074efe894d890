"""Draws the curves of one pair of sounds, with few keys, as an animator would.

A bigram runs from the start of its first sound to the end of its second; 0.5 is the
boundary. Within it the first sound contributes its last target and what leads away from
it, the second sound what leads to its first target: the neighbouring bigrams hold the
rest, and the engine keeps the greater of the two.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from tools.sounds import Levels, Sound

Points = list[tuple[float, float]]
SEEN = 0.04
LATEST = 0.94


@dataclass(frozen=True)
class Hand:
    """How one set is drawn: its sounds, and how its poses come and go.

    Parameters
    ----------
    sounds : mapping of str to Sound
    closing : mapping of str to str
        For each class that must reach a shape, the pose.
    poses : tuple of str
        All poses, in the order in which a pair's curves are written.
    onset, offset : mapping of str to float
        When a shape begins to form out of silence, and when it has gone after the last
        sound, as shares of the pair's time: the tongue moves late and is gone early.
    lead, linger : mapping of str to float
        Share of the sound before in which a shape begins to form, and of the sound after
        in which it is still seen, where that sound does not have it.
    closed : mapping of str to float
        The same of both beside a closure, for the poses that a closure keeps back: the jaw
        is free to move, but lips that must meet keep it nearly shut.
    later : mapping of str to float
        How much later than the jaw a pose reaches a target, as a share of the sound.
    rivals : tuple of pairs of str
        Shapes that cannot be had at once: the stronger one wins. The first lingers no
        longer than the second where the second comes.
    spread : float
        The second rival's level past which it counts as coming.
    """

    sounds: Mapping[str, Sound]
    closing: Mapping[str, str]
    poses: tuple[str, ...]
    onset: Mapping[str, float]
    offset: Mapping[str, float]
    lead: Mapping[str, float]
    linger: Mapping[str, float]
    closed: Mapping[str, float] = field(default_factory=dict)
    later: Mapping[str, float] = field(default_factory=dict)
    rivals: tuple[tuple[str, str], ...] = ()
    spread: float = 0.2

    def curves(self, first: str, second: str) -> dict[str, Points]:
        """Return keys over 0..1 for each pose that the pair uses."""
        before, after = self.sounds[first], self.sounds[second]
        leaving = self._shaded(before, before.last, before.lets_through, after.first, after)
        coming = self._shaded(after, after.first, after.keeps, before.last, before)
        drawn = {}
        for pose in self.poses:
            if pose in self.closing.values():
                points = self._closure(first, second, pose)
            else:
                levels = leaving.get(pose, 0.0), coming.get(pose, 0.0)
                points = self._shape(before, after, *levels, pose)
            if points:
                drawn[pose] = _tidy(points)
        return drawn

    def single(self, label: str) -> dict[str, Points]:
        """Return the single-phone curves of a class, over its own time and beyond."""
        sound = self.sounds[label]
        drawn = {}
        for pose in self.poses:
            a, b = sound.first.get(pose, 0.0), sound.last.get(pose, 0.0)
            if max(a, b) < SEEN:
                continue
            lead = 0.3 if pose in self.closing.values() else 0.5
            points = [(-lead, 0.0), (sound.at[0], a), (sound.at[1], b), (1 + lead, 0.0)]
            drawn[pose] = [(round(t, 3), round(v, 3)) for t, v in points]
        return drawn

    def _shaded(
        self, sound: Sound, levels: Levels, shares: Levels, neighbour: Levels, other: Sound
    ) -> Levels:
        """A sound's levels with what it lets through of its neighbour's."""
        if other.kind == "silence":
            shares = {}
        shaded = dict(levels)
        for pose, share in shares.items():
            own = levels.get(pose, 0.0)
            shaded[pose] = own + share * max(neighbour.get(pose, 0.0) - own, 0.0)
        for pair in self.rivals:
            if min(shaded.get(pose, 0.0) for pose in pair) > 0:
                weaker = min(pair, key=lambda pose: shaded[pose])
                stronger = pair[1] if weaker == pair[0] else pair[0]
                shaded[weaker] *= max(0.0, 1 - 1.5 * shaded[stronger])
        return shaded

    def _shape(
        self, before: Sound, after: Sound, leaving: float, coming: float, pose: str
    ) -> Points:
        leaving = leaving if leaving >= SEEN else 0.0
        coming = coming if coming >= SEEN else 0.0
        later = self.later.get(pose, 0.0)
        leave_at = 0.5 * min(before.at[1] + later, LATEST)
        come_at = 0.5 + 0.5 * min(after.at[0] + later, LATEST)
        if before.kind == "silence" and coming:
            return [(self.onset.get(pose, 0.32), 0.0), (come_at, coming), (1.0, 0.0)]
        if after.kind == "silence" and leaving:
            return [(0.0, 0.0), (leave_at, leaving), (self.offset.get(pose, 0.7), 0.0)]
        if leaving and coming:
            return [(0.0, 0.0), (leave_at, leaving), (come_at, coming), (1.0, 0.0)]
        if leaving:
            # Out of a shape that the next sound does not share.
            gone = 0.5 + 0.5 * self._linger(after, pose)
            return [(0.0, 0.0), (leave_at, leaving), (gone, 0.0)]
        if coming:
            return [(0.5 - 0.5 * self._lead(before, pose), 0.0), (come_at, coming), (1.0, 0.0)]
        return []

    def _lead(self, before: Sound, pose: str) -> float:
        if before.kind == "closure" and pose in self.closed:
            return self.closed[pose]
        return self.lead.get(pose, 0.4)

    def _linger(self, after: Sound, pose: str) -> float:
        if after.kind == "closure" and pose in self.closed:
            return self.closed[pose]
        for round_pose, spread_pose in self.rivals:
            if pose == round_pose and after.first.get(spread_pose, 0.0) > self.spread:
                return self.linger[spread_pose]
        return self.linger.get(pose, 0.35)

    def _closure(self, first: str, second: str, pose: str) -> Points:
        """A closure is reached early in its sound and left as the next one begins."""
        before, after = self.closing.get(first) == pose, self.closing.get(second) == pose
        if before and after:
            return [(0.0, 0.0), (0.15, 1.0), (0.85, 1.0), (1.0, 0.0)]
        if after:
            start = 0.3 if self.sounds[first].kind == "silence" else 0.36
            early, late = (0.5 + 0.5 * at for at in self.sounds[second].at)
            return [(start, 0.0), (early, 1.0), (late, 1.0), (1.0, 0.0)]
        if before:
            end = 0.7 if self.sounds[second].kind == "silence" else 0.62
            early, late = (0.5 * at for at in self.sounds[first].at)
            return [(0.0, 0.0), (early, 1.0), (late, 1.0), (end, 0.0)]
        return []


def _tidy(points: Points) -> Points:
    return [(round(t, 3), round(min(v, 1.0), 3)) for t, v in points]
