"""Of phones that nobody vouches for, the sound decides: what a line of them is made of."""

import numpy as np
import pytest

from lipwright.engines.motion.database import Database
from lipwright.engines.motion.search import several
from tests.engines.motion.small import database


@pytest.fixture(scope="module")
def small() -> Database:
    return database("abcab", "bacca", "cabba")


def chosen(of: Database, label: str, like: int, *, unsure: bool) -> int:
    """The unit that one phone of a label gets, which sounds and lasts like some unit."""
    first, last = of.spans[like]
    lengths = np.array([(last - first) / of.rate])
    classes = np.arange(len(of.labels))
    sound = np.asarray(of.unit_sound[like : like + 1], np.float32)
    wanted = np.array([of.labels.index(label)])
    return int(several(of, wanted, lengths, classes, sound, 1, unsure=unsure)[0, 0])


def test_a_unit_of_another_phone_stands_in_where_it_sounds_right(small: Database) -> None:
    other = next(u for u, label in enumerate(small.label) if small.labels[label] == "b")
    assert chosen(small, "a", other, unsure=True) == other


def test_sure_phones_get_units_of_their_own(small: Database) -> None:
    for unit in range(len(small.label)):
        for label in "abc":
            found = chosen(small, label, unit, unsure=False)
            assert small.labels[small.label[found]] == label


def test_a_unit_of_the_phone_itself_is_still_preferred(small: Database) -> None:
    for unit in range(len(small.label)):
        label = small.labels[small.label[unit]]
        assert chosen(small, label, unit, unsure=True) == unit


def test_without_sound_labels_are_all_there_is(small: Database) -> None:
    wanted = np.array([small.labels.index("a"), small.labels.index("b")])
    lengths, classes = np.array([0.1, 0.1]), np.arange(len(small.labels))
    found = several(small, wanted, lengths, classes, None, 2, unsure=True)
    assert (small.label[found] == wanted).all()
