"""What every set that a tool draws whole promises: all pairs, few keys, closures in place."""

import itertools
from collections.abc import Mapping

import numpy as np
import pytest
from tools.crab.__main__ import crab
from tools.english.__main__ import english

from lipwright.curves import Keys
from lipwright.engines.bigram import BigramSet, load_set
from lipwright.engines.bigram.set_file import DATA, set_bytes
from lipwright.phones import load_phone_set

CLASSES = load_phone_set("common").labels
TOOLS = {"english": english, "crab": crab}


@pytest.fixture(params=TOOLS)
def drawn_set(request: pytest.FixtureRequest) -> BigramSet:
    return load_set(request.param)


def drawn(curves: Mapping[str, Keys]) -> tuple[object, ...]:
    return tuple((pose, tuple(keys.pairs())) for pose, keys in sorted(curves.items()))


def test_all_483_pairs_and_all_single_phones_are_drawn(drawn_set: BigramSet) -> None:
    assert set(drawn_set.bigrams) == set(itertools.product(CLASSES, CLASSES)) - {("sil", "sil")}
    assert len(drawn_set.bigrams) == 483
    assert all(drawn_set.singles[label] for label in CLASSES if label != "sil")


@pytest.mark.parametrize("name", TOOLS)
def test_the_file_is_what_the_tool_makes(name: str) -> None:
    assert (DATA / f"{name}.json").read_bytes() == set_bytes(TOOLS[name]())


def test_curves_are_an_artists_few_keys(drawn_set: BigramSet) -> None:
    bigrams = drawn_set.bigrams.values()
    counts = [len(keys) for bigram in bigrams for keys in bigram.curves.values()]
    assert np.median(counts) <= 5
    assert max(counts) <= 8


def test_no_two_pairs_are_the_same(drawn_set: BigramSet) -> None:
    # Of 21 classes no two look alike on the lips and the tongue: neither do their pairs.
    assert len({drawn(bigram.curves) for bigram in drawn_set.bigrams.values()}) == 483


def test_every_pose_of_the_set_is_used(drawn_set: BigramSet) -> None:
    used = {pose for bigram in drawn_set.bigrams.values() for pose in bigram.curves}
    assert used == set(drawn_set.rules.names)


@pytest.mark.parametrize("label", CLASSES)
def test_a_closure_is_drawn_where_there_is_one_and_nowhere_else(
    drawn_set: BigramSet, label: str
) -> None:
    assert set(drawn_set.reach) == {"bmp", "f"}
    for other in CLASSES:
        for pair in {(label, other), (other, label)} - {("sil", "sil")}:
            for closing, pose in drawn_set.reach.items():
                keys = drawn_set.bigrams[pair].curves.get(pose)
                assert (keys is not None) == (closing in pair), (pair, pose)
                assert keys is None or keys.values.max() == 1
