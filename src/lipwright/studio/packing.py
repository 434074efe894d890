"""Numbers as the page takes them: float32, little-endian, in base64."""

from __future__ import annotations

from base64 import b64encode

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lipwright.animation import Animation
from lipwright.engines.bigram.engine import BigramEngine, Solved
from lipwright.engines.bigram.polyline import Line
from lipwright.sound import Sound
from lipwright.studio.messages import Frames, Packed, Stage, StageCurve, StageName

PEAKS_PER_SECOND = 400.0
MOST_PEAKS = 240_000
MARGIN = 1.0
Window = tuple[float, float]


def packed(values: ArrayLike) -> Packed:
    """Return numbers as the page takes them."""
    return b64encode(np.ascontiguousarray(values, dtype="<f4").tobytes()).decode("ascii")


def frames_in(animation: Animation, window: Window | None) -> Frames:
    """Return the frames of an animation that lie in a window, and as much on both sides."""
    first, last = 0, len(animation)
    if window is not None:
        start, end = _widened(window)
        first = min(max(int((start - animation.start) * animation.rate), 0), last)
        last = min(max(int((end - animation.start) * animation.rate) + 1, first), last)
    return Frames(
        animation.controls,
        animation.rate,
        animation.start + first / animation.rate,
        last - first,
        packed(animation.values[first:last]),
    )


def _widened(window: Window) -> Window:
    start, end = window
    margin = max(end - start, MARGIN)
    return start - margin, end + margin


def stage_curves(
    engine: BigramEngine, solved: Solved, name: StageName, window: Window | None
) -> Stage:
    """Return the keys of all controls after one stage."""
    if solved.stages is None:
        return Stage(name, ())
    curves = []
    for control in engine.rules.names:
        number = engine.plan.names.index(control)
        if name == "placed":
            curve = _placed(solved, control, number, window)
        else:
            line: Line = getattr(solved.stages, name)
            curve = _whole(control, *_cut(solved.stages.axis.own(line, number), window))
        if curve is not None:
            curves.append(curve)
    return Stage(name, tuple(curves))


def _whole(control: str, times: NDArray[np.float64], values: NDArray[np.float64]) -> StageCurve:
    return StageCurve(control, packed(times), packed(values), (0,), ())


def _cut(line: Line, window: Window | None) -> Line:
    """Keys in a window, with the one before and the one after."""
    times, values = line
    if window is None or not len(times):
        return line
    start, end = _widened(window)
    first = max(int(np.searchsorted(times, start)) - 1, 0)
    last = int(np.searchsorted(times, end)) + 1
    return times[first:last], values[first:last]


def _placed(solved: Solved, control: str, number: int, window: Window | None) -> StageCurve | None:
    assert solved.stages is not None
    placed = solved.stages.placed
    mine = placed.pose == number
    if window is not None:
        start, end = _widened(window)
        seen = (solved.spans.last >= start) & (solved.spans.first <= end)
        mine &= seen[placed.bigram]
    if not mine.any():
        return None
    pairs = placed.bigram[mine]
    breaks = np.flatnonzero(np.diff(pairs, prepend=-1))
    return StageCurve(
        control,
        packed(placed.times[mine]),
        packed(placed.values[mine]),
        tuple(breaks.tolist()),
        tuple(pairs[breaks].tolist()),
    )


def peaks(sound: Sound) -> tuple[Packed, float]:
    """Return least and greatest sample of each stretch, by turns, and stretches per second."""
    samples = sound.samples
    if not len(samples):
        return "", PEAKS_PER_SECOND
    size = max(int(sound.rate / PEAKS_PER_SECOND), -(-len(samples) // MOST_PEAKS), 1)
    starts = np.arange(0, len(samples), size)
    both = np.stack(
        (np.minimum.reduceat(samples, starts), np.maximum.reduceat(samples, starts)), axis=1
    )
    return packed(both), sound.rate / size
