"""A bigram set learnt from recorded faces: the outlook of Xu et al. 2013 (DESIGN section 5).

Recipe: takes on a fine clock, poses one after the other (how soft; what phones do, and how
far they may leave the base; the levels of pairs), and the result drawn as keys. The poses
that a class must reach, its closures, stay the base set's: a camera of 25 frames per second
misses half of them, and a set promises them all. So do poses that the takes do not show,
such as the tongue's.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import msgspec
import numpy as np

from lipwright.engines.bigram.fit.drawing import draw_pair, draw_phone
from lipwright.engines.bigram.fit.levels import Found, Problem, Room, solve_causes, solve_levels
from lipwright.engines.bigram.fit.prior import Prior, phones_of, prior
from lipwright.engines.bigram.fit.strength import with_strength
from lipwright.engines.bigram.fit.stretches import LEVELS, Floats, Ints, Pairs, Stretch, stretches
from lipwright.engines.bigram.fit.takes import FaceTake, check_takes
from lipwright.engines.bigram.model import Bigram, BigramSet, Pair, Rules
from lipwright.errors import InputError
from lipwright.phones import SILENCE, load_phone_set

Progress = Callable[[float], None]

SOFTNESSES = (0.03, 0.05, 0.07, 0.09, 0.11, 0.14)
"""What is tried, half-widths in seconds."""
FAR, CARRIED = 0.2, 0.16
"""Seconds: a pose whose maxima the base joins over more than the first is carried so far."""
ENOUGH = 120
"""Stretches that are looked at to choose among them."""


@dataclass(frozen=True, slots=True)
class FitReport:
    """What a fit rests on.

    Parameters
    ----------
    takes : int
    minutes : float
        Of the takes together.
    measured : int
        Pairs that takes show.
    from_phones : int
        Pairs that no take shows, made of their phones' own levels.
    kept : int
        Pairs that stay as the base set has them: no take shows either phone.
    fitted : dict of str to float
        For each pose that was fitted, what is left of the difference: rms, in weights.
    base_poses : tuple of str
        Poses whose curves are the base set's.
    """

    takes: int
    minutes: float
    measured: int
    from_phones: int
    kept: int
    fitted: dict[str, float]
    base_poses: tuple[str, ...]


def fit_set(
    takes: Sequence[FaceTake],
    base: BigramSet,
    name: str = "fitted",
    *,
    alike: Floats | None = None,
    progress: Progress | None = None,
) -> tuple[BigramSet, FitReport]:
    """Fit a set to recorded faces.

    Parameters
    ----------
    takes : sequence of FaceTake
        All with the same poses.
    base : BigramSet
        Gives the classes, the rules, and everything that the takes do not show.
    name : str
        Of the new set.
    alike : (P, P) float64, optional
        How alike the takes' poses look on the character: the products of their
        displacements. What one pose cannot follow, those fitted after it make good as far as
        they share it.
    progress : function, optional
        Called with the share that is done, 0..1.

    Returns
    -------
    set : BigramSet
    report : FitReport

    Raises
    ------
    InputError
        If there are no takes, or they cannot be used: see
        :func:`~lipwright.engines.bigram.fit.takes.check_takes`.
    LabelError
        If phones have no class in the set.
    """
    check_takes(takes, base)
    labels = load_phone_set(base.phone_set).labels
    pairs = Pairs(labels if SILENCE in labels else (*labels, SILENCE))
    closures = set(base.reach.values())
    poses = [pose for pose in takes[0].poses if pose not in closures]
    if not poses:
        raise InputError(
            f"only the poses {', '.join(takes[0].poses)}",
            where=takes[0].name,
            expected="one that is not a closure",
        )
    above = [pose for pose in base.rules.names if pose not in poses]
    cut = stretches(takes, base, pairs, above)
    job = _Job(base, pairs, cut, _used(cut), above, takes[0].poses, _alike(takes[0], alike))
    found: dict[str, Fit] = {}
    for number, pose in enumerate(poses):
        if progress is not None:
            progress((number + 0.1) / (len(poses) + 0.2))
        found[pose] = job.fit(pose, found)
    if progress is not None:
        progress(1.0)
    return _drawn(job, found, takes, name)


def _used(cut: Sequence[Stretch]) -> Ints:
    """Return the levels of pairs that takes show."""
    if not cut:
        raise InputError("no take moves while anything is said", cure="check the takes' times")
    pairs = np.unique(np.concatenate([stretch.keys for stretch in cut]) // LEVELS)
    return (LEVELS * pairs[:, None] + np.arange(LEVELS)).ravel()


def _alike(take: FaceTake, alike: Floats | None) -> Floats:
    count = len(take.poses)
    if alike is None:
        return np.eye(count)
    if alike.shape != (count, count) or not (np.diag(alike) > 0).all():
        raise InputError(
            f"likeness of poses of shape {alike.shape}",
            expected=f"({count}, {count}), with what is above 0 on the diagonal",
        )
    return alike


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """One pose as it came out."""

    half: float
    found: Found
    made: list[Floats]


@dataclass(frozen=True, slots=True, eq=False)
class _Job:
    base: BigramSet
    pairs: Pairs
    cut: list[Stretch]
    used: Ints
    above: list[str]
    seen: tuple[str, ...]
    alike: Floats

    def fit(self, pose: str, others: Mapping[str, Fit]) -> Fit:
        """Fit a pose, given how those before it came out."""
        expected, room = prior(self.base, self.pairs, pose), self._room(pose)
        wanted = self._wanted(pose, others)
        begin, half = self._begun(expected, wanted, room)
        problem = Problem(self.cut, wanted, room, half)
        chosen = with_strength(problem, expected, self.used, begin.levels)
        if not np.array_equal(chosen.strength, expected.strength):
            begin, half = self._begun(chosen, wanted, room)
            problem = Problem(self.cut, wanted, room, half)
        found = solve_levels(problem, chosen, self.used, begin)
        return Fit(half, found, problem.made(found.levels))

    def _begun(self, expected: Prior, wanted: Sequence[Floats], room: Room) -> tuple[Found, float]:
        """Fit gain and phones alone, on some of the takes; and find how soft the pose moves."""
        every = max(1, len(self.cut) // ENOUGH)
        some, few = self.cut[::every], wanted[::every]
        tried = [
            (solve_causes(Problem(some, few, room, half), expected, self.used), half)
            for half in SOFTNESSES
        ]
        return min(tried, key=lambda one: one[0].rms)

    def _wanted(self, pose: str, others: Mapping[str, Fit]) -> list[Floats]:
        """What is wanted of a pose where the others miss what was recorded of them.

        Poses share parts of the face: what one does not reach another makes good, as far as
        it looks alike.
        """
        column = self.seen.index(pose)
        share = self.alike[column] / self.alike[column, column]
        wanted = []
        for number, stretch in enumerate(self.cut):
            frames = stretch.frames[:, column].copy()
            for other, name in enumerate(self.seen):
                if name in self.above:
                    made = stretch.held[self.above.index(name)]
                elif name in others:
                    made = others[name].made[number]
                else:
                    continue
                frames += share[other] * (stretch.frames[:, other] - made)
            wanted.append(frames)
        return wanted

    def _room(self, pose: str) -> Room:
        """Poses of the base that bound a pose: only as a ramp, as all but old presets do."""
        rules = self.base.rules
        if rules.settings.bound != "ramp":
            return ()
        return tuple(
            (self.above.index(high.name), threshold)
            for high, low, threshold in rules.bounds()
            if low.name == pose and high.name in self.above
        )


def _drawn(
    job: _Job,
    fits: dict[str, Fit],
    takes: Sequence[FaceTake],
    name: str,
) -> tuple[BigramSet, FitReport]:
    base, labels = job.base, job.pairs.labels
    found = {pose: fit.found for pose, fit in fits.items()}
    measured = {int(key) // LEVELS for key in job.used[::LEVELS]}
    phones = {pose: phones_of(one.levels, len(labels)) for pose, one in found.items()}
    shown = {labels[n] for pair in measured for n in divmod(pair, len(labels))}
    bigrams: dict[Pair, Bigram] = {}
    counts = [0, 0, 0]
    for pair in base.needed(labels):
        key = job.pairs.key(*pair)
        kind = 0 if key // LEVELS in measured else 1 if shown.intersection(pair) else 2
        counts[kind] += 1
        if kind < 2:
            levels = {pose: one.levels[key : key + LEVELS] for pose, one in found.items()}
            bigrams[pair] = draw_pair(base, pair, levels, name)
        elif pair in base.bigrams:
            bigrams[pair] = base.bigrams[pair]
    singles = dict(base.singles)
    for number, label in enumerate(labels):
        if label in shown and label != SILENCE:
            own = slice(LEVELS * number, LEVELS * (number + 1))
            levels = {pose: of[own] for pose, of in phones.items()}
            singles[label] = draw_phone(base, label, levels)
    minutes = sum(len(take.values) / take.rate for take in takes) / 60
    rms = {pose: round(one.rms, 4) for pose, one in found.items()}
    report = FitReport(
        len(takes), round(minutes, 2), counts[0], counts[1], counts[2], rms, tuple(job.above)
    )
    about = f"Fitted to {len(takes)} takes, {minutes:.1f} min, on the set {base.name!r}."
    made = replace(
        base,
        name=name,
        rules=_softer(base.rules, {pose: fit.half for pose, fit in fits.items()}),
        bigrams=bigrams,
        singles=singles,
        about=about,
        digest="",
    )
    return made, report


def _softer(rules: Rules, softness: dict[str, float]) -> Rules:
    """Return rules with fitted softness; valleys between fitted levels are meant: no chords.

    But what the base carries far, rounding, consonants carry on in words that no take shows.
    """
    poses = tuple(
        msgspec.structs.replace(
            pose, softness=softness[pose.name], window=CARRIED if pose.window > FAR else 0.0
        )
        if pose.name in softness
        else pose
        for pose in rules.poses
    )
    return Rules(poses, rules.conflicts, rules.settings)
