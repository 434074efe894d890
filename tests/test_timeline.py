"""Intervals and tiers: half-open, in order, and errors that name what is wrong."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.errors import LabelError
from lipwright.timeline import Interval, Tier


@st.composite
def tiers(draw: st.DrawFn) -> Tier:
    lengths = draw(st.lists(st.tuples(st.floats(0, 2), st.floats(0.001, 2)), max_size=20))
    result, reached = [], draw(st.floats(-5, 5))
    for index, (gap, length) in enumerate(lengths):
        start = reached + gap
        reached = start + length
        result.append(Interval(f"{index}", start, reached))
    return Tier(tuple(result))


@pytest.mark.parametrize(
    ("start", "end", "words"),
    [
        (1.0, 1.0, r"'aa' runs from 1 to 1 s; expected an end after its start"),
        (1.0, 0.5, r"'aa' runs from 1 to 0.5 s"),
        (math.nan, 1.0, r"'aa' runs from nan to 1.0 s; expected finite times"),
        (0.0, math.inf, r"expected finite times"),
    ],
)
def test_an_interval_that_makes_no_sense_is_refused(start: float, end: float, words: str) -> None:
    with pytest.raises(LabelError, match=words):
        Interval("aa", start, end)


def test_an_interval_holds_its_start_and_not_its_end() -> None:
    interval = Interval("aa", 1.0, 2.0)
    assert 1.0 in interval
    assert 2.0 not in interval
    assert interval.duration == 1.0
    assert interval.middle == 1.5
    assert interval.shifted(-1.0) == Interval("aa", 0.0, 1.0)


@pytest.mark.parametrize(
    ("second", "words"),
    [
        (("b", 0.9, 2.0), r"interval 2: 'b' at 0.9 s overlaps 'a' \(0 to 1 s\)"),
        (("b", -1.0, -0.5), r"interval 2: 'b' at -1 s starts before 'a' \(0 to 1 s\)"),
    ],
)
def test_a_tier_out_of_order_names_both_neighbours(
    second: tuple[str, float, float], words: str
) -> None:
    with pytest.raises(LabelError, match=words):
        Tier.of(("a", 0.0, 1.0), second)


@given(tiers(), st.floats(-10, 50))
def test_at_finds_exactly_the_interval_that_holds_an_instant(tier: Tier, time: float) -> None:
    holding = [interval for interval in tier if time in interval]
    assert tier.at(time) == (holding[0] if holding else None)
    index = tier.index_at(time)
    assert (index is None) == (not holding)
    if index is not None:
        assert tier[index] == holding[0]


@given(tiers())
def test_every_start_is_found_and_every_end_is_not(tier: Tier) -> None:
    for index, interval in enumerate(tier):
        assert tier.index_at(interval.start) == index
        assert tier.index_at(interval.end) != index


@given(tiers(), st.floats(-10, 50), st.floats(0, 10))
def test_within_keeps_what_touches_whole(tier: Tier, start: float, length: float) -> None:
    end = start + length
    kept = tier.within(start, end)
    assert list(kept) == [i for i in tier if i.start < end and i.end > start]


def test_ends_of_a_tier() -> None:
    assert (Tier().start, Tier().end, len(Tier())) == (0.0, 0.0, 0)
    tier = Tier.of(("a", 0.5, 1.0), ("b", 1.5, 2.0))
    assert (tier.start, tier.end, tier.labels) == (0.5, 2.0, ("a", "b"))
    assert tier.shifted(1.0).start == 1.5
    assert tier.at(1.2) is None
