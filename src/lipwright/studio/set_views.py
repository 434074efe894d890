"""What the page shows of a set: the matrix, one pair, one phone, the live controls."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

import msgspec

from lipwright.curves import Keys
from lipwright.engines.bigram.model import BigramSet, Pair, Pose, Rules
from lipwright.engines.bigram.stand_in import stand_in
from lipwright.engines.bigram.tally import has_curve
from lipwright.phones import SILENCE, load_phone_set
from lipwright.studio.cast import Cast
from lipwright.studio.changes import Value
from lipwright.studio.messages import (
    BigramView,
    Cell,
    ClassInfo,
    Curves,
    PairState,
    PhoneView,
    PoseInfo,
    Rule,
)

START_PEAK = 0.6


def classes_of(of: BigramSet) -> tuple[ClassInfo, ...]:
    """Return the classes of a set in the order of its phone set."""
    return tuple(
        ClassInfo(phone.label, phone.example) for phone in load_phone_set(of.phone_set).phones
    )


def poses_of(rules: Rules) -> tuple[PoseInfo, ...]:
    """Return the poses of a set."""
    return tuple(PoseInfo(**msgspec.structs.asdict(pose)) for pose in rules.poses)


def state_of(of: BigramSet, pair: Pair) -> PairState:
    """Return how a set serves a pair."""
    if pair in of.bigrams:
        return "drawn"
    return "stand-in" if all(has_curve(of, label) for label in pair) else "no curve"


@dataclass(frozen=True, slots=True)
class Seen:
    """What colours the matrix beside the set itself."""

    need: Mapping[Pair, float]
    edits: Mapping[Pair, int]


class Matrix:
    """The matrix, kept up to date: only cells whose pair became different are made anew."""

    def __init__(self) -> None:
        self.cells: dict[Pair, Cell] = {}
        self._now: Cast | None = None
        self._opened: Cast | None = None
        self._seen: Seen | None = None
        self._overridden: set[Pair] = set()

    def update(self, now: Cast, opened: Cast, seen: Seen) -> tuple[Cell, ...]:
        """Bring the matrix up to date; return the cells that are different."""
        overridden = {pair for layer in now.of.layers for pair in layer.pairs}
        changed = []
        for pair in self._suspects(now, opened, seen, overridden):
            cell = _cell(pair, now, opened, seen, overridden)
            if self.cells.get(pair) != cell:
                self.cells[pair] = cell
                changed.append(cell)
        self._now, self._opened, self._seen = now, opened, seen
        self._overridden = overridden
        return tuple(changed)

    def _suspects(
        self, now: Cast, opened: Cast, seen: Seen, overridden: set[Pair]
    ) -> Iterable[Pair]:
        was = self._now
        if was is None or opened is not self._opened or seen != self._seen:
            return self._all(now)
        if was.of.singles is not now.of.singles:
            return self._all(now)
        before, after = was.of.bigrams, now.of.bigrams
        different = {pair for pair, one in after.items() if before.get(pair) is not one}
        different |= {pair for pair in before if pair not in after}
        return different | (overridden ^ self._overridden)

    def _all(self, now: Cast) -> Iterable[Pair]:
        labels = load_phone_set(now.of.phone_set).labels
        return ((a, b) for a in labels for b in labels if not a == b == SILENCE)


def _cell(pair: Pair, now: Cast, opened: Cast, seen: Seen, overridden: set[Pair]) -> Cell:
    bigram, was = now.of.bigrams.get(pair), opened.of.bigrams.get(pair)
    changed = bigram is not was and (
        bigram is None
        or was is None
        or (bigram.curves, bigram.boundary) != (was.curves, was.boundary)
    )
    return Cell(
        pair,
        state_of(now.of, pair),
        pair in overridden,
        changed,
        round(seen.need.get(pair, 0.0), 6),
        seen.edits.get(pair, 0),
        bigram.word if bigram else "",
    )


def bigram_view(now: Cast, pair: Pair, revision: int) -> BigramView:
    """Return a pair as it is drawn, and what else could be."""
    drawn = now.of.bigrams.get(pair)
    built = stand_in(now.of, pair)
    shown = drawn or built
    own, over = now.state.own.of.bigrams.get(pair), now.state.overrides.bigrams.get(pair)
    under = now.under.bigrams.get(pair) or stand_in(now.under, pair)
    return BigramView(
        revision=revision,
        pair=pair,
        state=state_of(now.of, pair),
        source=shown.source,
        boundary=shown.boundary,
        word=shown.word,
        curves=_lists(shown.curves),
        set_curves=_lists(own.curves) if own else None,
        override_curves=_lists(over.curves) if over else None,
        under=_lists(under.curves),
        stand_in=_lists(built.curves),
        starts=_starts(now.of, built.curves, shown.boundary),
    )


def _starts(of: BigramSet, built: Mapping[str, Keys], boundary: float) -> Curves:
    """Return a useful beginning for each pose: as its phones have it, else a peak at the mark."""
    peak = ((0.0, 0.0), (boundary, START_PEAK), (1.0, 0.0))
    return {pose: tuple(built[pose].pairs()) if pose in built else peak for pose in of.rules.names}


def _lists(curves: Mapping[str, Keys]) -> Curves:
    return {pose: tuple(keys.pairs()) for pose, keys in curves.items()}


def phone_view(now: Cast, label: str, revision: int) -> PhoneView:
    """Return the single-phone curve of a class."""
    return PhoneView(
        revision=revision,
        phone=label,
        word=load_phone_set(now.of.phone_set).example(label),
        curves=_lists(now.of.singles.get(label, {})),
        overridden=label in now.state.overrides.singles,
    )


# --- live controls ---

_ABOUT = {
    "limit": ("How fast the pose may change", "per second", 0.5, 60.0),
    "window": ("Maxima no further apart than this are joined", "s", 0.0, 1.0),
    "softness": ("Half-width of the softening", "s", 0.0, 0.3),
    "priority": ("Of two poses that exclude each other the lower one gives way", "", 0.0, 20.0),
    "meets": ("A closure widens to keep its peak; others are cut", "", 0.0, 0.0),
    "warp": ("Whether curves are pinned at the boundary of their phones", "", 0.0, 0.0),
    "padding": ("Silence put where speech starts or ends without any", "s", 0.001, 2.0),
    "silence_reach": ("How much of a silence belongs to its pair", "s", 0.001, 2.0),
    "valleys": ("Whether a chord lifts what is below it, or replaces all", "", 0.0, 0.0),
    "chords": ("Whether a chord stops where a higher pose bounds this one", "", 0.0, 0.0),
    "bound": ("How a higher pose leaves room to a lower one", "", 0.0, 0.0),
    "solve": ("Bounds and speed limits together, or one after the other", "", 0.0, 0.0),
    "spline": ("The smooth curve through, or near, the keys", "", 0.0, 0.0),
}
_CHOICES = {
    "meets": ("cut", "widen"),
    "warp": ("boundary", "linear"),
    "valleys": ("lift", "replace"),
    "chords": ("stop", "cross"),
    "bound": ("ramp", "sum"),
    "solve": ("together", "in turn"),
    "spline": ("soften", "bspline", "pchip", "linear"),
}


def rules_of(now: Cast, opened: Cast) -> tuple[Rule, ...]:
    """Return the live controls: what they are now, in the set itself, and when opened."""
    return (*_settings(now, opened), *_poses(now, opened), *_thresholds(now, opened))


Three = tuple[Value, Value, Value]


def _three(now: Cast, opened: Cast, of: Callable[[Rules], Value]) -> Three:
    return of(now.of.rules), of(now.state.own.of.rules), of(opened.of.rules)


def _settings(now: Cast, opened: Cast) -> Iterator[Rule]:
    for field in now.of.rules.settings.__struct_fields__:
        values = _three(now, opened, lambda rules, f=field: getattr(rules.settings, f))  # type: ignore[misc]
        yield _rule("setting", (), field, values)


def _poses(now: Cast, opened: Cast) -> Iterator[Rule]:
    for name in now.of.rules.names:
        for field in Pose.__struct_fields__[1:]:
            values = _three(now, opened, lambda rules, n=name, f=field: getattr(rules.pose(n), f))  # type: ignore[misc]
            yield _rule("pose", (name,), field, values)
        gain = now.state.overrides.gains.get(name, 1.0)
        was = opened.state.overrides.gains.get(name, 1.0)
        yield Rule(
            "gain",
            (name,),
            "",
            gain,
            1.0,
            was,
            "What the pose's curves are multiplied by",
            "",
            0,
            3,
        )


def _thresholds(now: Cast, opened: Cast) -> Iterator[Rule]:
    for conflict in now.of.rules.conflicts:
        poses = frozenset(conflict.poses)

        def threshold(rules: Rules, poses: frozenset[str] = poses) -> float:
            found = (c.threshold for c in rules.conflicts if frozenset(c.poses) == poses)
            return next(found, 2.0)

        values = _three(now, opened, threshold)
        about = "The two exclude each other from here; above 1 they do not"
        yield Rule("threshold", conflict.poses, "", *values, about, "", 0.05, 2.0)


def _rule(
    kind: Literal["pose", "setting"], names: tuple[str, ...], field: str, values: Three
) -> Rule:
    about, unit, least, most = _ABOUT[field]
    choices = _CHOICES.get(field, ())
    return Rule(kind, names, field, *values, about, unit, least, most, choices)
