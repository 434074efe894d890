"""Why a control has the value it has: from a frame back to the key that an artist drew.

Section 3.2.4 of Xu et al. 2013: segments of the animation can be mapped back to their
bigrams. Each instant of each control is followed back through the stages; whatever
changed the value is named: the bigrams that overlap there and the one that won, the two
maxima whose chord lifted it, the pose that bounded it, the key whose slope limited it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lipwright.engines.bigram.edits import Found
from lipwright.engines.bigram.engine import BigramEngine, Solved
from lipwright.engines.bigram.model import Bigram
from lipwright.engines.bigram.polyline import Line, maxima
from lipwright.engines.bigram.spoken import own_bigram, value_alone, who_bound, who_drew, who_set
from lipwright.engines.bigram.stages import Stages
from lipwright.errors import InputError

SEEN = 1e-6
TOLD = 5e-4


@dataclass(frozen=True, slots=True)
class Origin:
    """A bigram that has a curve at the instant asked for, or had one before an override.

    Attributes
    ----------
    pair : str
        ``"f-ah"``.
    source : str
        The set, the override, or ``"stand-in"``.
    start, end : float
        Seconds that it spans.
    value : float
        Its own curve there.
    keys : tuple of ((time, weight), (time, weight))
        The two keys, in the set's 0..1, between which the instant lies.
    override : str
        Which overrides made the curve, of which character, in which file; nothing where it
        is the set's own.
    own : float, optional
        What the set's own curve would be there, where an override spoke.
    """

    pair: str
    source: str
    start: float
    end: float
    value: float
    keys: tuple[tuple[float, float], ...]
    override: str = ""
    own: float | None = None


@dataclass(frozen=True, slots=True)
class Reason:
    """What one stage did to a value.

    Attributes
    ----------
    stage : str
        ``"smoothed"``, ``"constrained"``, ``"limited"``, ``"softened"``.
    before, after : float
    text : str
        In words.
    """

    stage: str
    before: float
    after: float
    text: str


@dataclass(frozen=True, slots=True)
class Explanation:
    """Why one control has its value at one instant.

    Attributes
    ----------
    control : str
    time : float
    phone : str
        The class that sounds then.
    value : float
        What is exported.
    origins : tuple of Origin
        The bigrams there, the one that won first.
    reasons : tuple of Reason
        The stages that changed the value, in order.
    edits : tuple of str
        Edits of this line that act on the control in this phone.
    alone : float, optional
        What would be exported without any overrides, where there are some.
    set_name : str
        The set beneath them.
    """

    control: str
    time: float
    phone: str
    value: float
    origins: tuple[Origin, ...] = ()
    reasons: tuple[Reason, ...] = ()
    edits: tuple[str, ...] = ()
    alone: float | None = None
    set_name: str = ""

    def text(self) -> str:
        """Return the explanation as lines for a terminal."""
        lines = [f"{self.control} = {self.value:.3f} at {self.time:.3f} s, in /{self.phone}/"]
        for origin in self.origins:
            keys = " to ".join(f"({t:g}, {v:g})" for t, v in origin.keys) or "none"
            won = "drawn by" if origin is self.origins[0] else "   below:"
            lines.append(
                f"  {won} {origin.pair} ({origin.source}), {origin.start:.3f} to "
                f"{origin.end:.3f} s: {origin.value:.3f}, keys {keys}"
            )
            if origin.override:
                own = "no curve" if origin.own is None else f"{origin.own:.3f}"
                lines.append(f"            {origin.override}; {self.set_name} itself: {own}")
        for edit in self.edits:
            lines.append(f"  edited: {edit}")
        for reason in self.reasons:
            lines.append(
                f"  {reason.stage}: {reason.before:.3f} becomes {reason.after:.3f}, {reason.text}"
            )
        if self.alone is not None and abs(self.alone - self.value) > TOLD:
            lines.append(f"  without overrides: {self.alone:.3f}")
        return "\n".join(lines)


def why(engine: BigramEngine, solved: Solved, control: str, time: float) -> Explanation:
    """Return why a control has its value at an instant.

    Parameters
    ----------
    engine : BigramEngine
    solved : Solved
        What :meth:`BigramEngine.solve` returned.
    control : str
        Name of a pose.
    time : float
        Seconds.

    Raises
    ------
    InputError
        If there is no such control.
    """
    if control not in engine.plan.names:
        raise InputError(
            f"no control {control!r}", expected=f"one of {', '.join(engine.rules.names)}"
        )
    column = engine.rules.names.index(control)
    value = float(engine.sample(solved, time, 1, 60.0)[0, column])
    if solved.stages is None:
        return Explanation(control, time, "sil", value)
    tracer = _Tracer(engine, solved, engine.plan.names.index(control), time)
    edits = tuple(
        one.edit.name
        for one in solved.edits
        if one.edit.pose == control and abs(time - one.phone.middle) <= _reach_of(one)
    )
    reasons = tuple(tracer.reasons(value))
    origins = tracer.origins()
    alone = value_alone(engine, solved, control, time)
    name = (engine.of.beneath or engine.of).name
    return Explanation(control, time, tracer.phone(), value, origins, reasons, edits, alone, name)


def _reach_of(one: Found) -> float:
    return 0.5 * one.phone.duration + one.edit.hold


class _Tracer:
    """Follows one control at one instant back through the stages."""

    def __init__(self, engine: BigramEngine, solved: Solved, pose: int, time: float) -> None:
        assert solved.stages is not None
        self.engine, self.solved, self.pose, self.time = engine, solved, pose, time
        self.stages: Stages = solved.stages

    def _line(self, stage: Line, pose: int | None = None) -> Line:
        return self.stages.axis.own(stage, self.pose if pose is None else pose)

    def _at(self, stage: Line, time: float | None = None) -> float:
        return float(np.interp(self.time if time is None else time, *self._line(stage)))

    def phone(self, time: float | None = None) -> str:
        """The class that sounds at an instant."""
        spans = self.solved.spans
        index = int(np.searchsorted(spans.ends, self.time if time is None else time, "right"))
        return spans.labels[min(index, len(spans.labels) - 1)]

    def origins(self, time: float | None = None) -> tuple[Origin, ...]:
        """The bigrams that have a curve of this pose at an instant, greatest first."""
        at = self.time if time is None else time
        spans = self.solved.spans
        found = []
        for index in np.flatnonzero((spans.first <= at) & (at <= spans.last)):
            origin = self._origin(int(index), at)
            if origin is not None:
                found.append(origin)
        return tuple(sorted(found, key=lambda origin: -origin.value))

    def _origin(self, index: int, time: float) -> Origin | None:
        placed, spans = self.stages.placed, self.solved.spans
        mine = (placed.bigram == index) & (placed.pose == self.pose)
        times, values = placed.times[mine], placed.values[mine]
        pair = spans.pairs[index]
        bigram = self.engine.table.bigrams[self.engine.table.rows_of([pair])[0]]
        override = who_drew(self.engine.of, bigram, self.engine.plan.names[self.pose])
        own = self._own(index, time) if override else None
        if not len(times) and own is None:
            return None
        return Origin(
            "-".join(pair),
            bigram.source,
            float(spans.first[index]),
            float(spans.last[index]),
            float(np.interp(time, times, values, left=0, right=0)) if len(times) else 0.0,
            self._drawn(bigram, self._share(index, time, bigram.boundary)),
            override,
            own,
        )

    def _own(self, index: int, time: float) -> float | None:
        """What the set's own curve of the pair would be at an instant."""
        bigram = own_bigram(self.engine.of, self.solved.spans.pairs[index])
        keys = bigram.curves.get(self.engine.plan.names[self.pose]) if bigram else None
        if bigram is None or keys is None:
            return None
        return float(keys.at(np.array([self._share(index, time, bigram.boundary)]))[0])

    def _drawn(self, bigram: Bigram, share: float) -> tuple[tuple[float, float], ...]:
        """The two keys on both sides of an instant, as drawn in 0..1."""
        keys = bigram.curves.get(self.engine.plan.names[self.pose])
        drawn = keys.pairs() if keys is not None else []
        before = [key for key in drawn if key[0] <= share][-1:]
        after = [key for key in drawn if key[0] > share][:1]
        return tuple(before + after)

    def _share(self, index: int, time: float, boundary: float) -> float:
        """An instant in the 0..1 of a bigram: placing (stage 1) undone."""
        spans = self.solved.spans
        first, middle, last = (float(s[index]) for s in (spans.first, spans.boundary, spans.last))
        if self.engine.rules.settings.warp == "linear":
            return (time - first) / (last - first)
        if time <= middle:
            return (time - first) / (middle - first) * boundary
        return 1 - (last - time) / (last - middle) * (1 - boundary)

    def reasons(self, value: float) -> list[Reason]:
        """What each stage did."""
        stages = self.stages
        values = [
            self._at(line)
            for line in (stages.stitched, stages.smoothed, stages.constrained, stages.limited)
        ]
        values.append(value)
        steps = (
            ("smoothed", self._smoothed),
            ("constrained", self._constrained),
            ("limited", self._limited),
            ("softened", self._softened),
        )
        return [
            Reason(name, before, after, explain(before, after))
            for (name, explain), before, after in zip(steps, values, values[1:], strict=False)
            if abs(after - before) > SEEN
        ]

    def _smoothed(self, before: float, after: float) -> str:
        times, values = self._line(self.stages.smoothed)
        stitched = self._line(self.stages.stitched)
        peaks = stitched[0][maxima(stitched[1])[0]]
        left = peaks[peaks <= self.time]
        right = peaks[peaks > self.time]
        if not (len(left) and len(right)):
            return "by the chord between two maxima"
        ends = []
        for at in (float(left[-1]), float(right[0])):
            winner = self.origins(at)
            name = winner[0].pair if winner else self.phone(at)
            ends.append(f"{name} at {at:.3f} s ({np.interp(at, times, values):.3f})")
        return f"by the chord between the maxima of {ends[0]} and {ends[1]}"

    def _constrained(self, before: float, after: float) -> str:
        rooms = []
        for a, b, threshold in self.engine.plan.bounds:
            if b == self.pose:
                high = float(np.interp(self.time, *self._line(self.stages.limited, a)))
                ramp = self.engine.rules.settings.bound == "ramp"
                room = 1 - high / threshold if ramp else threshold - high
                rooms.append((max(room, 0.0), self.engine.plan.names[a], high, threshold))
        room, name, high, threshold = min(rooms)
        whose = who_bound(self.engine, name, self.engine.plan.names[self.pose])
        return f"{name} is at {high:.3f} and leaves {room:.3f} (threshold {threshold:g}{whose})"

    def _limited(self, before: float, after: float) -> str:
        pose = self.engine.plan.poses[self.pose]
        verb = "rises early and falls late" if after > before else "gives up what is too fast"
        whose = who_set(self.engine, pose.name, "limit")
        text = f"to keep {pose.limit:g} per second{whose} it {verb}"
        if pose.meets == "widen" and self.engine.rules.settings.spline == "soften":
            text += f", held by {pose.softness:g} s"
        return text

    def _softened(self, before: float, after: float) -> str:
        if self.engine.rules.settings.spline != "soften":
            return f"by the {self.engine.rules.settings.spline} through the keys"
        width = self.engine.plan.poses[self.pose].softness
        whose = who_set(self.engine, self.engine.plan.names[self.pose], "softness")
        return f"by the mean over {width:g} s on either side{whose}"
