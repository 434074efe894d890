"""Strings of labels are found where they are, and in the right order."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipwright.engines.motion.label_index import LabelIndex, pack, packing, suffix_array

takes = st.lists(st.lists(st.integers(0, 1), min_size=1, max_size=40), min_size=1, max_size=6)


def columns(words: list[list[int]]) -> tuple[np.ndarray, np.ndarray]:
    label = np.array([label for word in words for label in word], np.int16)
    take = np.repeat(np.arange(len(words), dtype=np.int32), [len(word) for word in words])
    return label, take


def strings(words: list[list[int]]) -> list[list[int]]:
    """What each unit begins."""
    return [word[at:] for word in words for at in range(len(word))]


def index(words: list[list[int]], labels: int) -> LabelIndex:
    label, take = columns(words)
    suffixes = suffix_array(label, take, labels)
    keys = pack(label, take, labels)[suffixes]
    first = np.concatenate(([0], np.cumsum([len(word) for word in words])))
    return LabelIndex(suffixes, keys, label, take, first, labels)


# Of 30,000 labels a packed number holds four: longer strings go deeper.
@settings(max_examples=150, deadline=None)
@given(words=takes, labels=st.sampled_from([3, 100, 30_000]))
def test_units_are_sorted_by_the_strings_that_they_begin(
    words: list[list[int]], labels: int
) -> None:
    label, take = columns(words)
    every = strings(words)
    expected = sorted(range(len(every)), key=lambda unit: (every[unit], unit))
    assert suffix_array(label, take, labels).tolist() == expected


@settings(max_examples=200, deadline=None)
@given(
    words=takes,
    wanted=st.lists(st.integers(0, 1), min_size=1, max_size=40),
    labels=st.sampled_from([3, 100, 30_000]),
    quote=st.booleans(),
)
def test_the_longest_match_is_found_with_all_its_places(
    words: list[list[int]], wanted: list[int], labels: int, quote: bool
) -> None:
    if quote:  # else long matches are rare
        wanted = [*words[-1], *wanted]
    every = strings(words)
    expected = max(
        next((n for n, (a, b) in enumerate(zip(one, wanted, strict=False)) if a != b),
             min(len(one), len(wanted)))
        for one in every
    )  # fmt: skip
    found = index(words, labels)
    length, low, high = found.longest(wanted)
    assert length == expected
    if length:
        units = found.suffixes[low:high].tolist()
        starting = [u for u, one in enumerate(every) if one[:length] == wanted[:length]]
        assert sorted(units) == starting
        assert sorted(found.occurrences(wanted[:length]).tolist()) == starting
    if length < len(wanted):
        assert len(found.occurrences(wanted)) == 0


def test_of_two_long_matches_side_by_side_the_longer_one_counts() -> None:
    found = index([[0, 0, 0, 0, 1, 1, 0], [0, 0, 0, 0, 2, 0]], 30_000)
    assert found.longest([0, 0, 0, 0, 1, 1, 1]) == (6, 2, 3)


def test_a_string_does_not_reach_into_the_next_take() -> None:
    found = index([[0, 1], [2, 0]], 3)
    assert found.longest([1, 2])[0] == 1
    assert found.longest([0, 1, 2])[0] == 2


@pytest.mark.parametrize(("labels", "expected"), [(1, (1, 63)), (46, (6, 10)), (30_000, (15, 4))])
def test_how_many_labels_a_number_holds(labels: int, expected: tuple[int, int]) -> None:
    assert packing(labels) == expected
