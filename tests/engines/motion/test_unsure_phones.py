"""Of phones that nobody vouches for, the sound decides: what a line of them is made of."""

import numpy as np
import pytest

from lipwright.engines.motion.database import Database
from lipwright.engines.motion.search import several
from tests.engines.motion.small import database


@pytest.fixture(scope="module")
def small() -> Database:
    return database("abcab", "bacca", "cabba")


def chosen(of: Database, take: int, wrong: str, *, unsure: bool) -> list[int]:
    """The first path for a line that sounds like a take, its middle phone heard as another."""
    units = np.flatnonzero(of.take == take)
    wanted = np.asarray(of.label[units], np.int64)
    wanted[2] = of.labels.index(wrong)
    lengths = (of.spans[units, 1] - of.spans[units, 0]) / of.rate
    sound = np.asarray(of.unit_sound[units], np.float32)
    found = several(of, wanted, lengths, np.arange(3), sound, 2, unsure=unsure)
    return [int(unit) for unit in found[0]]


@pytest.mark.parametrize(("take", "wrong"), [(0, "a"), (0, "b"), (1, "a"), (2, "c")])
def test_a_unit_of_another_phone_stands_in_where_it_sounds_right(
    small: Database, take: int, wrong: str
) -> None:
    found = chosen(small, take, wrong, unsure=True)
    assert found == np.flatnonzero(small.take == take).tolist()
    sure = chosen(small, take, wrong, unsure=False)
    assert small.labels[small.label[sure[2]]] == wrong


def test_without_sound_labels_are_all_there_is(small: Database) -> None:
    wanted = np.array([small.labels.index("a"), small.labels.index("b")])
    found = several(small, wanted, np.array([0.1, 0.1]), np.arange(3), None, 2, unsure=True)
    assert (small.label[found] == wanted).all()
