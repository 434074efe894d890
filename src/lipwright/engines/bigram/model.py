"""A bigram set in memory: poses, curves for pairs of phones, and the stages' settings.

Section 3.1 of Xu et al. 2013, and DESIGN section 4. Everything here is checked when it
is made, so that the stages need not check again. Files are read in
:mod:`~lipwright.engines.bigram.set_file`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import msgspec

from lipwright.curves import Keys
from lipwright.engines.bigram.layer import Layer
from lipwright.errors import InputError, SetError, did_you_mean
from lipwright.files import Version
from lipwright.phones import SILENCE

Pair = tuple[str, str]
Curves = Mapping[str, Keys]
NO_CONFLICT = 1.0


class Pose(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A face shape of the set and how its curve may move.

    Parameters
    ----------
    name : str
    priority : int
        Of two poses that exclude each other, the lower one gives way.
    meets : {"cut", "widen"}
        How the curve meets its speed limit: by losing what is too fast, or by starting
        earlier and ending later. Closures widen: their peaks are never lost.
    limit : float
        Greatest slope, per second (section 3.2.3).
    window : float
        Maxima no further apart than this are joined, seconds (section 3.2.1).
    softness : float
        Half-width of the softening kernel, seconds.
    """

    name: str
    priority: int
    meets: Literal["cut", "widen"] = "cut"
    limit: float = 15.0
    window: float = 0.18
    softness: float = 0.0

    def __post_init__(self) -> None:
        for what, value, least, most in (
            ("limit", self.limit, 1e-3, 1e6),
            ("window", self.window, 0.0, 10.0),
            ("softness", self.softness, 0.0, 1.0),
        ):
            if not least <= value <= most:
                raise SetError(
                    f"{what} {value}",
                    where=f"pose {self.name!r}",
                    expected=f"{least:g} to {most:g}",
                )


class Conflict(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Two poses that exclude each other past a threshold: C(a, b) of section 3.2.2."""

    poses: tuple[str, str]
    threshold: float


class Settings(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What the stages do, where it does not belong to one pose.

    Parameters
    ----------
    warp : {"boundary", "linear"}
        Whether curves are pinned at the boundary of their two phones.
    padding : float
        Seconds of silence put where speech starts or ends without any.
    silence_reach : float
        How much of a silence belongs to its bigram, seconds.
    valleys : {"lift", "replace"}
        Whether the chord between two maxima lifts what is below it, or replaces all.
    chords : {"stop", "cross"}
        Whether a chord ends where a pose that bounds this one is above half its threshold.
    bound : {"ramp", "sum"}
        ``b <= 1 - a / C`` where C <= 1, or ``b <= C - a`` where a + b > C.
    solve : {"together", "in turn"}
        Whether bounds and speed limits are solved together, or one after the other.
    spline : {"soften", "bspline", "pchip", "linear"}
        The curve through, or near, the keys of stage 5.
    """

    warp: Literal["boundary", "linear"] = "boundary"
    padding: float = 0.2
    silence_reach: float = 0.2
    valleys: Literal["lift", "replace"] = "lift"
    chords: Literal["stop", "cross"] = "stop"
    bound: Literal["ramp", "sum"] = "ramp"
    solve: Literal["together", "in turn"] = "together"
    spline: Literal["soften", "bspline", "pchip", "linear"] = "soften"

    def __post_init__(self) -> None:
        for what, value in (("padding", self.padding), ("silence_reach", self.silence_reach)):
            if not 1e-3 <= value <= 10:
                raise SetError(f"{what} {value}", expected="0.001 to 10 s")


class Rules(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A set's rules under one preset: its poses, their conflicts, and the settings.

    Raises
    ------
    SetError
        If a name repeats or is unknown, if two poses that both widen exclude each other,
        or two of equal priority do: nothing could then decide between them.
    """

    poses: tuple[Pose, ...]
    conflicts: tuple[Conflict, ...] = ()
    settings: Settings = Settings()

    def __post_init__(self) -> None:
        names = [pose.name for pose in self.poses]
        if not names:
            raise SetError("no poses", expected="at least one")
        for name in names:
            if names.count(name) > 1:
                raise SetError(f"the pose {name!r} stands twice")
        for conflict in self.conflicts:
            self._check(conflict, {pose.name: pose for pose in self.poses})

    def _check(self, conflict: Conflict, poses: Mapping[str, Pose]) -> None:
        where = f"conflict of {conflict.poses[0]!r} and {conflict.poses[1]!r}"
        for name in conflict.poses:
            if name not in poses:
                raise SetError(f"unknown pose {name!r}", where=where, expected=", ".join(poses))
        if not conflict.threshold > 0:
            raise SetError(f"threshold {conflict.threshold}", where=where, expected="above 0")
        one, other = poses[conflict.poses[0]], poses[conflict.poses[1]]
        if one is other:
            raise SetError("a pose cannot exclude itself", where=where)
        if not self.is_active(conflict):
            return
        if one.priority == other.priority:
            raise SetError(
                f"both have priority {one.priority}: nothing says which one gives way",
                where=where,
                cure="give them different priorities",
            )
        if self.settings.solve == "together" and one.meets == other.meets == "widen":
            raise SetError(
                "both widen: each would have to keep its peak where the other forbids it",
                where=where,
                cure="let one of them 'cut', or raise the threshold above 1",
            )

    def is_active(self, conflict: Conflict) -> bool:
        """Whether a conflict can ever bound anything under these settings."""
        return conflict.threshold <= NO_CONFLICT if self.settings.bound == "ramp" else True

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the poses."""
        return tuple(pose.name for pose in self.poses)

    def pose(self, name: str) -> Pose:
        """Return a pose by name."""
        return next(pose for pose in self.poses if pose.name == name)

    def bounds(self) -> tuple[tuple[Pose, Pose, float], ...]:
        """Return ``(a, b, C)`` of each active conflict: a, of higher priority, bounds b."""
        found = []
        for conflict in self.conflicts:
            if self.is_active(conflict):
                pair = tuple(self.pose(name) for name in conflict.poses)
                low, high = sorted(pair, key=lambda pose: pose.priority)
                found.append((high, low, conflict.threshold))
        return tuple(sorted(found, key=lambda bound: -bound[0].priority))


@dataclass(frozen=True, slots=True)
class Bigram:
    """What an animator drew for two neighbouring phones.

    Parameters
    ----------
    pair : tuple of two str
        Classes of the first and second phone.
    curves : mapping of str to Keys
        For each pose used, keys over 0..1 from the start of the first phone to the end of
        the second; first and last value 0.
    boundary : float
        Where in 0..1 the boundary of the two phones was when it was drawn.
    word : str
        A word in which the pair sounds.
    source : str
        Where it comes from: the set's name, ``"stand-in"``, or the override's name.
    """

    pair: Pair
    curves: Curves
    boundary: float = 0.5
    word: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        where = f"bigram {self.pair[0]}-{self.pair[1]}"
        if not 0.01 <= self.boundary <= 0.99:
            raise SetError(f"boundary {self.boundary}", where=where, expected="0.01 to 0.99")
        for pose, keys in self.curves.items():
            place = f"{where}, pose {pose!r}"
            check_curve(keys, place, 0.0, 1.0)
            if keys.values[0] != 0 or keys.values[-1] != 0:
                raise SetError(
                    f"the curve starts at {keys.values[0]:g} and ends at {keys.values[-1]:g}",
                    where=place,
                    expected="0 at both ends",
                    cure="what should hold on is held by the neighbouring bigram",
                )


def check_curve(keys: Keys, where: str, first: float, last: float) -> None:
    """Refuse a curve whose keys leave ``first``..``last`` or weights 0..1.

    Raises
    ------
    SetError
    """
    if len(keys) < 2:
        raise SetError(f"{len(keys)} keys", where=where, expected="two or more")
    if keys.times[0] < first or keys.times[-1] > last:
        raise SetError(
            f"keys from {keys.times[0]:g} to {keys.times[-1]:g}",
            where=where,
            expected=f"times in {first:g}..{last:g}",
        )
    if keys.values.min() < 0 or keys.values.max() > 1:
        raise SetError(
            f"weights from {keys.values.min():g} to {keys.values.max():g}",
            where=where,
            expected="weights in 0..1",
        )


@dataclass(frozen=True, slots=True)
class BigramSet:
    """Everything an artist made for one family of characters.

    Parameters
    ----------
    name : str
    phone_set : str
        The classes that pairs are made of, usually ``"common"``.
    rules : Rules
        Poses, conflicts and settings of the preset ``default``.
    bigrams : mapping of pair to Bigram
    singles : mapping of str to curves
        For each class, curves over the phone's own time 0..1; keys down to -1 and up to 2
        reach that far into its neighbours. Pairs that are missing are made from them.
    reach : mapping of str to str
        For each class that must reach a shape, the pose: ``{"bmp": "PBM", "f": "FV"}``.
    presets : mapping of str to Rules
        Other presets by name; ``"published"`` is the paper's.
    about : str
    digest : str
        Tells the files it was read from from any others, overrides included.
    layers : tuple of Layer
        What characters and override files changed, the last one on top.
    beneath : BigramSet, optional
        The set as it was before the first of them.
    files : tuple of (str, Version)
        All files that it was read from: its own, its base's and their phone sets.

    Raises
    ------
    SetError
        If a curve names an unknown pose, or a class must reach one.
    """

    name: str
    phone_set: str
    rules: Rules
    bigrams: Mapping[Pair, Bigram]
    singles: Mapping[str, Curves] = field(default_factory=dict)
    reach: Mapping[str, str] = field(default_factory=dict)
    presets: Mapping[str, Rules] = field(default_factory=dict)
    about: str = ""
    digest: str = ""
    layers: tuple[Layer, ...] = ()
    beneath: BigramSet | None = None
    files: tuple[tuple[str, Version | None], ...] = ()

    def __post_init__(self) -> None:
        known = set(self.rules.names)
        for pair, bigram in self.bigrams.items():
            self._check_poses(bigram.curves, known, f"bigram {pair[0]}-{pair[1]}")
        for label, curves in self.singles.items():
            self._check_poses(curves, known, f"phone {label!r}")
            for pose, keys in curves.items():
                check_curve(keys, f"phone {label!r}, pose {pose!r}", -1.0, 2.0)
        self._check_poses(dict.fromkeys(self.reach.values()), known, "reach")

    def _check_poses(self, curves: Mapping[str, object], known: set[str], where: str) -> None:
        for pose in curves:
            if pose not in known:
                raise SetError(
                    f"unknown pose {pose!r}",
                    where=f"{self.name}, {where}",
                    expected=f"one of {', '.join(self.rules.names)}",
                    cure=did_you_mean(pose, self.rules.names),
                )

    def preset(self, name: str) -> Rules:
        """Return the rules of a preset.

        Raises
        ------
        InputError
            If there is none of that name.
        """
        if name == "default":
            return self.rules
        if name in self.presets:
            return self.presets[name]
        if name == "published":
            return published(self.rules)
        raise InputError(
            f"no preset {name!r} in set {self.name!r}",
            expected=f"one of {', '.join(dict.fromkeys(['default', 'published', *self.presets]))}",
        )

    def needed(self, classes: tuple[str, ...]) -> tuple[Pair, ...]:
        """Return all pairs of classes that a complete set has, silence with itself left out."""
        return tuple(
            (a, b) for a in classes for b in classes if not (a == SILENCE and b == SILENCE)
        )


def published(rules: Rules) -> Rules:
    """Return rules as the paper states them, for a set that has no preset of that name.

    Linear warp, maximum, valleys replaced by the chord, bounds and then limits one after
    the other, every pose cut at 15 per second, B-spline (sections 3.2.1 to 3.2.3).
    """
    poses = tuple(
        msgspec.structs.replace(pose, meets="cut", limit=15.0, softness=0.0) for pose in rules.poses
    )
    return Rules(poses, rules.conflicts, PUBLISHED)


PUBLISHED = Settings(
    warp="linear",
    valleys="replace",
    chords="cross",
    bound="sum",
    solve="in turn",
    spline="bspline",
)
