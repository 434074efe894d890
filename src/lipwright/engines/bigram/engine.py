"""The bigram engine: phones in, animation out (Xu et al. 2013, section 3.2).

Reads as a recipe: prepare, place, stages 2 to 5 on keys, soften, sample, keep closures.
An engine is made once for a set and then takes any number of lines.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from lipwright.animation import Animation
from lipwright.curves import Keys
from lipwright.engines.bigram.classes import reduction_for
from lipwright.engines.bigram.closures import keep_closures
from lipwright.engines.bigram.edits import (
    Edit,
    Found,
    added_lines,
    check_poses,
    find,
    reach,
    redraw,
    scale_placed,
)
from lipwright.engines.bigram.model import BigramSet, Pair, Rules
from lipwright.engines.bigram.polyline import Axis, Floats
from lipwright.engines.bigram.preparation import Spans, prepare
from lipwright.engines.bigram.softening import sample
from lipwright.engines.bigram.stages import Plan, Stages, bound, run
from lipwright.engines.bigram.table import Placed, Table
from lipwright.errors import InputError
from lipwright.phones import SILENCE, PhoneTrack
from lipwright.phones.reduction import ReductionReport
from lipwright.speech import Speech
from lipwright.timeline import Tier

RATE = 60.0
FASTEST = 10_000.0


@dataclass(frozen=True, slots=True, eq=False)
class Solved:
    """A line after stage 5, with all that is needed to say why.

    Attributes
    ----------
    spans : Spans
        Its phones and bigrams.
    stages : Stages or None
        None where nothing is said.
    reduction : ReductionReport
        Which phones only the nearest class stood in for.
    edits : tuple of Found
        Edits that found their phone.
    lost : tuple of str
        Names of those that did not.
    track : PhoneTrack, optional
        The line itself, so that it can be solved in another way too.
    words : Tier, optional
    """

    spans: Spans
    stages: Stages | None
    reduction: ReductionReport
    edits: tuple[Found, ...] = ()
    lost: tuple[str, ...] = ()
    track: PhoneTrack | None = None
    words: Tier | None = None

    @property
    def unlocked(self) -> set[str]:
        """Poses that an edit keeps free of bounds."""
        return {one.edit.pose for one in self.edits if one.edit.keys and one.edit.unlocked}


def _keep_freed_memory() -> None:
    """Let the C library keep the memory of one line for the next.

    glibc hands freed memory back above a threshold that grows with the largest block ever
    freed, up to 32 MB. Without this every line pays for the same pages again, a quarter of
    its time; elsewhere it does nothing. The block is never touched: it costs no memory.
    """
    np.empty(2**21)


class BigramEngine:
    """Animates phones with the curves of one set.

    Parameters
    ----------
    of : BigramSet
        The set, with a character's overrides in it if there are any.
    preset : str
        ``"default"``, ``"published"``, or one of the set's own.
    reduction : str, optional
        Path of a reduction file to use instead of the one for the track's phone set.
    like : BigramEngine, optional
        An engine of nearly the same set: what both share is not made again.

    Raises
    ------
    InputError
        If the set has no such preset.
    """

    def __init__(
        self,
        of: BigramSet,
        preset: str = "default",
        reduction: str | None = None,
        like: BigramEngine | None = None,
    ) -> None:
        self.of = of
        self.preset = preset
        self.rules: Rules = of.preset(preset)
        self.plan = Plan.of(self.rules)
        names = self.plan.names
        self.table: Table = like.table.for_set(of, names) if like else Table(of, names)
        self._reduction = reduction
        _keep_freed_memory()

    @cached_property
    def beneath(self) -> BigramEngine | None:
        """The engine of the set without any overrides; None where there are none."""
        own = self.of.beneath
        return BigramEngine(own, self.preset, self._reduction) if own is not None else None

    @cached_property
    def _reach(self) -> dict[str, int]:
        return {label: self.plan.names.index(pose) for label, pose in self.of.reach.items()}

    @cached_property
    def _output(self) -> list[int]:
        return [self.plan.names.index(name) for name in self.rules.names]

    def solve(
        self, track: PhoneTrack, words: Tier | None = None, edits: Sequence[Edit] = ()
    ) -> Solved:
        """Take a line through stages 1 to 5.

        Parameters
        ----------
        track : PhoneTrack
        words : Tier, optional
            What edits hang on.
        edits : sequence of Edit
            Corrections of this line.

        Raises
        ------
        LabelError
            If phones are unknown or overlap.
        InputError
            If an edit names a pose that the set has not.
        """
        rows, report = reduction_for(self.of, track.phone_set, self._reduction).rows(track)
        settings = self.rules.settings
        spans = prepare(rows, settings.padding, settings.silence_reach)
        if not spans.labels:
            return Solved(spans, None, report, lost=tuple(edit.name for edit in edits))
        placed = self.table.place(spans, settings.warp)
        check_poses(edits, self.plan.names)
        found, lost = find(edits, track.tier.intervals, words or Tier())
        stages = self._run(placed, spans, found)
        return Solved(spans, stages, report, found, lost, track, words)

    def _run(self, placed: Placed, spans: Spans, found: tuple[Found, ...]) -> Stages:
        first, last = float(spans.first[0]), float(spans.last[-1])
        if not found:
            return run(placed, first, last, self.plan, self.rules)
        plan, names = self.plan, self.plan.names
        placed = scale_placed(placed, found, names)
        stages = run(
            placed,
            first,
            last,
            plan,
            self.rules,
            room=reach(found, plan.poses),
            added=lambda axis: added_lines(placed, found, plan.poses, axis),
        )
        locked = [one for one in found if one.edit.keys and not one.edit.unlocked]
        free = [one for one in found if one.edit.keys and one.edit.unlocked]
        line = stages.limited
        if locked:
            line = redraw(line, locked, names, stages.axis)
            _, line = bound(line, stages.axis, plan, self.rules, held=True)
        return replace(stages, limited=redraw(line, free, names, stages.axis))

    def sample(self, solved: Solved, first: float, count: int, rate: float) -> Floats:
        """Return stage 7 at ``first + k / rate``: (T, P) weights in the set's order."""
        if solved.stages is None:
            return np.zeros((count, len(self.plan.poses)))
        stages = solved.stages
        spline = self.rules.settings.spline
        values = sample(stages.limited, stages.axis, self.plan.poses, first, count, rate, spline)
        if self.rules.settings.solve == "together":
            keep_closures(values, solved.spans, stages, self._reach, first, rate)
        return self._kept_apart(values, solved.unlocked)[self._output].T

    def _kept_apart(self, values: Floats, unlocked: set[str]) -> Floats:
        """Apply the bounds once more to what is exported: softening bends them a little."""
        for a, b, threshold in self.plan.bounds:
            if unlocked and self.plan.names[b] in unlocked:
                continue
            if self.rules.settings.bound == "ramp":
                room = 1 - values[a] / threshold
            else:
                room = threshold - values[a]
            np.minimum(values[b], np.maximum(room, 0.0), out=values[b])
        return values

    def animate(self, speech: Speech, rate: float = RATE, edits: Sequence[Edit] = ()) -> Animation:
        """Return the animation of a line.

        Parameters
        ----------
        speech : Speech
            Its phones drive the mouth; its sound, if any, says how long to go on.
        rate : float
            Frames per second.
        edits : sequence of Edit
            Corrections of this line.

        Returns
        -------
        Animation
            Frames lie on whole multiples of ``1 / rate`` on the sound's clock, from the
            first movement (or 0) to the last (or the sound's end). ``keys`` are those of
            stage 5. The report names stand-ins.

        Raises
        ------
        LabelError
            If phones are unknown or overlap.
        InputError
            If the rate is out of range.
        """
        if not 1 <= rate <= FASTEST:
            raise InputError(f"{rate:g} frames per second", expected=f"1 to {FASTEST:g}")
        return self.animate_solved(self.solve(speech.phones, speech.words, edits), speech, rate)

    def animate_solved(self, solved: Solved, speech: Speech, rate: float = RATE) -> Animation:
        """Return the animation of a line that was solved already."""
        start, end = self._range(solved, speech)
        first = math.floor(start * rate + 1e-6)
        count = max(math.ceil(end * rate - 1e-6) - first, 0) + 1
        values = self.sample(solved, first / rate, count, rate)
        return Animation(
            self.rules.names,
            values.astype(np.float32, order="C"),
            rate,
            first / rate,
            self.keys(solved),
            speech.phones,
            speech.words,
            "bigram",
            self._report(solved),
        )

    def _range(self, solved: Solved, speech: Speech) -> tuple[float, float]:
        start, end = min(0.0, speech.phones.tier.start), speech.duration
        if solved.stages is not None:
            times = solved.stages.limited[0]
            moving = self._moving(solved.stages.axis, times, solved.stages.limited[1])
            start, end = min(start, moving[0]), max(end, moving[1])
        return start, end

    def _moving(self, axis: Axis, times: Floats, values: Floats) -> tuple[float, float]:
        """First and last instant at which any pose is not at rest."""
        active = np.flatnonzero(values > 1e-6)
        if not len(active):
            return math.inf, -math.inf
        own = times - axis.block_of(times) * axis.width + axis.base
        soft = max(pose.softness for pose in self.plan.poses)
        # A B-spline is moved by keys up to two away.
        reach = 2 if self.rules.settings.spline == "bspline" else 1
        before = own[np.maximum(active - reach, 0)]
        after = own[np.minimum(active + reach, len(times) - 1)]
        return float(before.min()) - soft, float(after.max()) + soft

    def keys(self, solved: Solved) -> dict[str, Keys]:
        """Return each pose's keys after stage 5; poses at rest have none."""
        result: dict[str, Keys] = {}
        if solved.stages is None:
            return result
        for name in self.rules.names:
            number = self.plan.names.index(name)
            times, values = solved.stages.axis.own(solved.stages.limited, number)
            if values.any():
                result[name] = Keys(times, values)
        return result

    def stand_ins(self, solved: Solved) -> list[Pair]:
        """Return the pairs of a line that the set lacks, in order of appearance."""
        pairs = dict.fromkeys(solved.spans.pairs)
        return [pair for pair in pairs if pair not in self.of.bigrams]

    def _report(self, solved: Solved) -> dict[str, Any]:
        missing = self.stand_ins(solved)
        # Classes that have no single-phone curve either: nothing moves there.
        bare = {label for pair in missing for label in pair} - {SILENCE, *self.of.singles}
        report: dict[str, Any] = {
            "set": self.of.name,
            "set_digest": self.of.digest,
            "preset": self.preset,
            "bigrams": len(solved.spans.pairs),
            "stand_ins": ["-".join(pair) for pair in missing],
            "nearest_classes": solved.reduction.stand_ins,
        }
        if self.of.layers:
            report["overrides"] = list(dict.fromkeys(layer.name for layer in self.of.layers))
        if self.preset != "default" and any(layer.has_rules for layer in self.of.layers):
            report["settings_unused"] = True
        if bare:
            report["without_curves"] = sorted(bare)
        if solved.edits or solved.lost:
            report["edits"] = [one.edit.name for one in solved.edits]
            report["edits_lost"] = list(solved.lost)
        return report
