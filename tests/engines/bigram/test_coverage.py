"""Coverage: counted by hand on a tiny corpus, ordered, marked where a set lacks something."""

from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.engines.bigram import load_set
from lipwright.engines.bigram.coverage import coverage
from lipwright.engines.bigram.model import BigramSet
from lipwright.errors import LabelError
from lipwright.phones import PhoneTrack
from lipwright.speech import Speech
from lipwright.timeline import Tier

SET = load_set("english")


def track(text: str, phone_set: str = "arpabet", length: float = 0.1) -> PhoneTrack:
    """Phones of equal length, one after the other."""
    labels = text.split()
    rows = [(label, length * i, length * (i + 1)) for i, label in enumerate(labels)]
    return PhoneTrack(Tier.of(*rows), phone_set)


def lacking(*pairs: tuple[str, str], without: str = "") -> BigramSet:
    bigrams = {pair: bigram for pair, bigram in SET.bigrams.items() if pair not in pairs}
    singles = {label: curves for label, curves in SET.singles.items() if label != without}
    return replace(SET, bigrams=bigrams, singles=singles)


# "map" and "a map", with words: m ae p | ax, m ae p
MAP = Speech(track("m ae p"), Tier.of(("map", 0, 0.3)))
A_MAP = Speech(track("ax m ae p"), Tier.of(("a", 0, 0.1), ("map", 0.1, 0.4)))


def test_pairs_are_counted_as_by_hand() -> None:
    found = coverage(SET, [MAP, A_MAP])
    assert found.needed == {
        ("ah", "bmp"): 3,
        ("bmp", "ah"): 2,
        ("bmp", "sil"): 2,
        ("sil", "ah"): 1,
        ("sil", "bmp"): 1,
    }
    assert list(found.needed)[:3] == [("ah", "bmp"), ("bmp", "ah"), ("bmp", "sil")]
    assert (found.lines, found.phones, found.total) == (2, 7, 9)
    assert len(found.possible) == 483


def test_silence_and_other_words_can_be_left_out() -> None:
    quiet = coverage(SET, [MAP, A_MAP], silence=False)
    assert quiet.needed == {("ah", "bmp"): 3, ("bmp", "ah"): 2}
    assert len(quiet.possible) == 441
    inside = coverage(SET, [MAP, A_MAP], within_words=True)
    assert inside.needed == {("ah", "bmp"): 2, ("bmp", "ah"): 2}


def test_neighbours_across_a_pause_are_none() -> None:
    paused = PhoneTrack(Tier.of(("m", 0, 0.1), ("ae", 0.1, 0.2), ("p", 0.5, 0.6)))
    assert coverage(SET, [paused], silence=False).needed == {("bmp", "ah"): 1}


def test_time_counts_no_instant_twice() -> None:
    long = PhoneTrack(Tier.of(("sil", 0, 1), ("m", 1, 1.2), ("ae", 1.2, 1.6), ("sil", 1.6, 9)))
    found = coverage(SET, [long], by="time")
    # Of a silence 0.2 s belong to its pair; each pair has half of its two phones.
    assert found.needed == pytest.approx(
        {("bmp", "ah"): 0.3, ("ah", "sil"): 0.3, ("sil", "bmp"): 0.2}
    )
    assert found.total == pytest.approx(0.1 + 0.2 + 0.4 + 0.1)


def test_a_word_shows_where_a_pair_occurs() -> None:
    found = coverage(SET, [A_MAP, MAP])
    assert found.words["bmp", "ah"] == "map"
    assert found.words["ah", "bmp"] == "map"  # "a map" came first; one word says it better
    assert found.words["sil", "ah"] == "a"
    assert coverage(SET, [A_MAP.phones]).words == {}


def test_order_and_cumulative_share() -> None:
    of = lacking(("ah", "bmp"), ("bmp", "sil"), ("oy", "oy"))
    found = coverage(of, [MAP, A_MAP])
    needs = found.needs()
    assert [need.share for need in needs] == pytest.approx([3 / 9, 2 / 9, 2 / 9, 1 / 9, 1 / 9])
    assert [need.cumulative for need in needs] == pytest.approx([3 / 9, 5 / 9, 7 / 9, 8 / 9, 1])
    assert found.share == pytest.approx(4 / 9)
    steps = found.order()
    assert [step.need.pair for step in steps] == [("ah", "bmp"), ("bmp", "sil")]
    assert [step.covered for step in steps] == pytest.approx([7 / 9, 1])
    assert found.share_of_first(2) == pytest.approx(5 / 9)
    assert [found.pairs_for(share) for share in (1 / 3, 0.5, 0.9, 1)] == [1, 2, 5, 5]


PHONES = st.lists(st.sampled_from(["m", "ae", "t", "iy", "uw", "s", "sh"]), min_size=1, max_size=12)


@given(st.lists(PHONES, min_size=1, max_size=4), st.integers(0, 482))
def test_each_step_gains_and_the_last_completes(lines: list[list[str]], kept: int) -> None:
    of = replace(SET, bigrams=dict(list(SET.bigrams.items())[:kept]))
    found = coverage(of, [track(" ".join(line)) for line in lines])
    steps = found.order()
    gains = [step.need.share for step in steps]
    assert gains == sorted(gains, reverse=True)
    for (before, gain), after in zip(
        pairwise([(found.share, 0.0), *((s.covered, s.need.share) for s in steps)]),
        steps,
        strict=True,
    ):
        assert after.covered == pytest.approx(before[0] + gain[1])
    assert (steps[-1].covered if steps else found.share) == pytest.approx(1)


def test_what_a_set_lacks_is_told_apart() -> None:
    of = lacking(("ah", "bmp"), ("bmp", "ah"), ("oy", "oy"), without="bmp")
    found = coverage(of, [MAP])
    assert found.missing == (("ah", "bmp"), ("bmp", "ah"))
    assert found.bare == ("bmp",)
    assert {found.state(pair) for pair in found.missing} == {"no curve"}
    assert found.state(("oy", "oy")) == "stand-in"
    assert found.state(("sil", "bmp")) == "drawn"
    assert found.undrawn == {("ah", "bmp"), ("bmp", "ah"), ("oy", "oy")}


def test_silence_needs_no_curve_of_its_own() -> None:
    found = coverage(lacking(("sil", "bmp"), without="sil"), [MAP])
    assert found.bare == ()
    assert found.state(("sil", "bmp")) == "stand-in"


def test_phones_whose_class_is_only_the_nearest_are_named() -> None:
    found = coverage(SET, [track("n ɪ ç t", "ipa")], silence=False)
    assert list(found.nearest_phones) == ["ç"]
    assert found.nearest_phones["ç"].share == 0.25
    touched = {need.pair: need.nearest for need in found.needs()}
    near = found.nearest_phones["ç"].classes
    assert touched == {("d", "ih"): 0, ("ih", near): 1, (near, "d"): 1}


def test_lines_are_taken_one_by_one() -> None:
    alive = 0

    def lines() -> object:
        nonlocal alive
        for _ in range(50):
            alive += 1
            yield MAP
            alive -= 1

    found = coverage(SET, lines())  # type: ignore[arg-type]
    assert (found.lines, alive) == (50, 0)


def test_nothing_needed_is_nothing_missing() -> None:
    found = coverage(SET, [])
    assert (found.share, found.needs(), found.order(), found.pairs_for(1)) == (1, (), (), 0)


def test_words_that_are_not_there_are_asked_for() -> None:
    with pytest.raises(LabelError, match=r"no words\. Count across words"):
        coverage(SET, [MAP.phones], within_words=True)


def test_phones_without_a_class_are_all_named() -> None:
    with pytest.raises(LabelError, match="'q', 'zz': no class"):
        coverage(SET, [track("m q ae zz")])
