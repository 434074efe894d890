"""What DESIGN section 4 promises on the keys of stage 5, for random sets and lines."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipwright.engines.bigram.engine import BigramEngine, Solved
from lipwright.engines.bigram.polyline import combine
from lipwright.speech import Speech
from tests.engines.bigram.random_lines import random_set, random_track

LINES_PER_SET = 5
SETS = 200
EXACT = 1e-9


def check_stages(engine: BigramEngine, solved: Solved) -> None:
    """Hold every promise on the keys of stage 5."""
    stages = solved.stages
    if stages is None:
        return
    lines = [stages.axis.own(stages.limited, n) for n in range(len(engine.plan.poses))]
    for number, (pose, (times, values)) in enumerate(zip(engine.plan.poses, lines, strict=True)):
        assert np.all(np.diff(times) > 0)
        assert values.min() >= -EXACT
        assert values.max() <= 1 + EXACT
        assert np.all(np.abs(np.diff(values)) <= pose.limit * np.diff(times) + EXACT)
        free = all(b != number for _, b, _ in engine.plan.bounds)
        if pose.meets == "widen" and free:
            at, peaks = stages.axis.own(stages.stitched, number)
            assert np.all(np.interp(at, times, values) >= peaks - EXACT)
    for a, b, threshold in engine.plan.bounds:
        # On the union of both poses' keys both are linear: checking there is checking all.
        times, _ = combine(lines[a], lines[b])
        high, low = np.interp(times, *lines[a]), np.interp(times, *lines[b])
        assert np.all(low <= np.maximum(0, 1 - high / threshold) + EXACT)


@settings(max_examples=SETS, deadline=None, print_blob=True)
@given(st.integers(0, 2**32 - 1))
def test_stage_5_keeps_bounds_slopes_ranges_and_peaks(seed: int) -> None:
    rng = np.random.default_rng(seed)
    engine = BigramEngine(random_set(rng))
    for _ in range(LINES_PER_SET):
        check_stages(engine, engine.solve(random_track(rng)))


@pytest.mark.parametrize("rate", [24.0, 30.0, 60.0])
@settings(max_examples=60, deadline=None, print_blob=True)
@given(st.integers(0, 2**32 - 1))
def test_exported_frames_keep_bounds_and_ranges(rate: float, seed: int) -> None:
    rng = np.random.default_rng(seed)
    engine = BigramEngine(random_set(rng))
    animation = engine.animate(Speech(random_track(rng)), rate)
    assert animation.values.min() >= 0
    assert animation.values.max() <= 1
    for a, b, threshold in engine.rules.bounds():
        high, low = animation.control(a.name), animation.control(b.name)
        assert np.all(low <= np.maximum(0, 1 - high / threshold) + 1e-6)
