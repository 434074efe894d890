"""Keys: linear between, zero outside, and refused where they cannot be drawn."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lipwright.curves import Keys
from lipwright.errors import InputError

key_lists = st.lists(
    st.tuples(st.integers(-1000, 1000), st.floats(-2, 2)), max_size=12, unique_by=lambda k: k[0]
).map(lambda pairs: [(time / 100, value) for time, value in sorted(pairs)])


@given(key_lists)
def test_keys_pass_through_their_own_points(pairs: list[tuple[float, float]]) -> None:
    keys = Keys.of(pairs)
    np.testing.assert_array_equal(keys.at([time for time, _ in pairs]), [v for _, v in pairs])
    assert keys.pairs() == pairs
    assert len(keys) == len(pairs)


@given(key_lists, st.floats(-20, 20))
def test_between_keys_the_curve_stays_between_their_values(
    pairs: list[tuple[float, float]], time: float
) -> None:
    value = Keys.of(pairs).at(time)
    around = [0.0] if not pairs or not pairs[0][0] <= time <= pairs[-1][0] else []
    if not around:
        before = max(pair for pair in pairs if pair[0] <= time)
        after = min(pair for pair in pairs if pair[0] >= time)
        around = [before[1], after[1]]
    assert min(around) - 1e-12 <= value <= max(around) + 1e-12


def test_outside_its_keys_a_curve_is_zero() -> None:
    keys = Keys.of([(1.0, 0.5), (2.0, 0.5)])
    np.testing.assert_array_equal(keys.at([0.999, 1.0, 2.0, 2.001]), [0.0, 0.5, 0.5, 0.0])


@pytest.mark.parametrize(
    ("pairs", "words"),
    [
        ([(0, 0), (0, 1)], "key 2 at 0 does not come after"),
        ([(0, 0), (2, 1), (1, 0)], "key 3 at 1 does not come after"),
        ([(0, float("nan"))], "a key is not finite"),
        ([(float("inf"), 0)], "a key is not finite"),
    ],
)
def test_keys_that_cannot_be_drawn_are_refused(
    pairs: list[tuple[float, float]], words: str
) -> None:
    with pytest.raises(InputError, match=words):
        Keys.of(pairs)


def test_times_and_values_must_be_as_many() -> None:
    with pytest.raises(InputError, match="as many values as times"):
        Keys(np.zeros(2), np.zeros(3))


def test_keys_compare_by_content() -> None:
    a, b = Keys.of([(0, 0), (1, 1)]), Keys.of([(0, 0), (1, 1)])
    assert a == b
    assert hash(a) == hash(b)
    assert a != Keys.of([(0, 0), (1, 0.5)])
    assert a != "keys"
