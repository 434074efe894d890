"""From units to motion: what follows a take is that take, and jumps do not show."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from lipwright.engines.motion.closures import opening_of
from lipwright.engines.motion.joining import Learnt, join, learn
from lipwright.engines.motion.rasta_plp import Features
from lipwright.engines.motion.splicing import REACH, PairTable
from lipwright.errors import InputError
from tests.engines.motion.tiny_database import CHANNELS, Tiny

OPENING = opening_of(CHANNELS)


def laid(counts: list[float], rate: float, start: float = 0.0) -> NDArray[np.float64]:
    """Spans of phones that last so many frames."""
    edges = start + np.cumsum([0.0, *counts]) / rate
    return np.stack((edges[:-1], edges[1:]), axis=1)


def test_a_path_along_a_take_is_the_take() -> None:
    data = Tiny.made()
    counts = (data.last - data.first)[:5].tolist()
    own = Features(data.features[:40], data.rate, start=0.7)
    for features in (None, own):
        found = join(data, range(5), laid(counts, 60, 0.7), 60.0, features=features)
        np.testing.assert_allclose(found.source, np.arange(40), atol=1e-6)
        np.testing.assert_allclose(found.components, data.frames[:40], atol=1e-6)
        motion = data.mean + data.frames[:40] @ data.basis
        np.testing.assert_allclose(found.motion, motion, atol=1e-6)
        assert found.motion.dtype == np.float32
        assert found.splices == ()
        assert found.start == 0.7


def test_units_begin_and_end_with_their_phones() -> None:
    data = Tiny.made()
    spans = np.array([[0.0, 0.31], [0.31, 0.402], [0.402, 0.53], [0.53, 0.8], [0.8, 0.9]])
    rng = np.random.default_rng(0)
    features = Features(rng.normal(size=(90, 9)).astype(np.float32), 100.0)
    found = join(data, range(5), spans, 1000.0, features=features)
    times = (np.arange(900) + 0.5) / 1000
    for phone, (start, end) in enumerate(spans):
        inside = (times >= start) & (times < end)
        assert set(found.unit[inside]) == {phone}
        first, last = data.spans[phone]
        assert found.source[inside][0] + 0.5 == pytest.approx(first, abs=0.3)
        assert found.source[inside][-1] + 0.5 == pytest.approx(last, abs=0.3)
    assert (np.diff(found.source) > 0).all()


def test_other_rates_show_the_same_motion() -> None:
    data = Tiny.made()
    spans = laid([9, 8, 7, 11, 6], 60)
    slow, fast = (join(data, range(5), spans, rate).components for rate in (60.0, 180.0))
    np.testing.assert_allclose(slow, fast[1::3], atol=1e-6)


@given(
    st.lists(st.integers(0, 9), min_size=1, max_size=8),
    st.integers(0, 1000),
    st.sampled_from([24.0, 60.0, 120.0]),
)
def test_random_paths_are_smooth_and_stay_in_range(
    units: list[int], seed: int, rate: float
) -> None:
    data = Tiny.made()
    rng = np.random.default_rng(seed)
    spans = laid(rng.uniform(2, 20, len(units)).tolist(), 60)
    features = Features(rng.normal(size=(200, 9)).astype(np.float32), 60.0)
    found = join(data, units, spans, rate, features=features)
    assert len(found.motion) == max(1, round((spans[-1, 1] - spans[0, 0]) * rate))
    assert np.isfinite(found.motion).all()
    low, high = data.frames.min(axis=0), data.frames.max(axis=0)
    margin = 0.2 * (high - low)
    assert (found.components >= low - margin).all()
    assert (found.components <= high + margin).all()


def test_jumps_do_not_show() -> None:
    data = Tiny.made()
    natural = np.abs(np.diff(data.frames, axis=0)).max(axis=0) * 60
    units = [0, 1, 7, 8, 3, 4]  # sil aa | p aa | iy sil
    counts = [10.0, 9, 8, 9, 10, 9]
    found = join(data, units, laid(counts, 60), 960.0)
    assert [splice.phone for splice in found.splices] == [2, 4]
    speed = np.abs(np.diff(found.components, axis=0)).max(axis=0) * 960
    assert (speed < 2 * natural).all()
    for splice in found.splices:
        at = round(splice.time * 960)
        steps = np.abs(np.diff(found.components[at - 3 : at + 3], axis=0))
        assert (steps < 2 * natural / 960).all()


def test_a_recorded_pair_shows_the_way() -> None:
    data = Tiny.made()
    # aa of the second take before p of the first: the first take has aa p.
    found = join(data, [8, 2], laid([12, 6], 60), 60.0)
    (splice,) = found.splices
    assert (splice.before, splice.after, splice.pair) == (8, 2, 1)
    at_seam = found.components[11:13]
    shown = data.frames[[data.last[1] - 1, data.first[2]]]
    np.testing.assert_allclose(at_seam[1], shown[1], atol=0.05)
    np.testing.assert_allclose(at_seam[0], shown[0], atol=0.3)
    np.testing.assert_allclose(found.components[-1], data.frames[data.last[2] - 1], atol=1e-6)


def test_without_a_pair_takes_are_carried_on_and_blended() -> None:
    data = Tiny.made()
    # p before sil occurs nowhere: units 2 and 9 carry each other over p + q frames.
    found = join(data, [2, 9], laid([6, 7], 60), 60.0)
    (splice,) = found.splices
    assert splice.pair == -1
    own = np.arange(data.first[2], data.first[2] + 13)
    other = np.arange(data.last[9] - 13, data.last[9])
    weight = ((np.arange(13) + 0.5) / 13)[:, None]
    blended = (1 - weight) * data.frames[own] + weight * data.frames[other]
    np.testing.assert_allclose(found.components, blended, atol=1e-5)


def test_a_splice_takes_little_of_a_long_silence() -> None:
    data = Tiny.made()
    found = join(data, [2, 9], laid([6, 120], 60), 60.0)
    alone = join(data, [9], laid([120], 60), 60.0)
    after = 6 + round(REACH * 60)
    np.testing.assert_allclose(found.components[after:], alone.components[after - 6 :], atol=1e-6)


def test_a_long_silence_keeps_its_pace_next_to_speech_and_all_but_holds() -> None:
    data = Tiny.made()
    found = join(data, range(5), laid([68, 9, 6, 10, 47], 60), 60.0)
    # The first rest is held before it opens, the last after it has closed.
    np.testing.assert_allclose(found.source[60:100], np.arange(40), atol=1.0)
    assert found.source[59] < 0.5
    assert found.source[100] > 38.5
    assert (np.diff(found.source) > 0).all()


def test_a_pause_holds_its_middle() -> None:
    data = Tiny.of([[("aa", 9), ("sil", 10), ("iy", 9)]])
    found = join(data, range(3), laid([9, 50, 9], 60), 60.0)
    np.testing.assert_allclose(found.source[:14], np.arange(14), atol=0.5)
    np.testing.assert_allclose(found.source[14:54], 13.5, atol=0.5)
    np.testing.assert_allclose(found.source[54:], np.arange(14, 28), atol=0.5)


def test_of_a_long_rest_as_much_is_taken_as_a_short_one_needs() -> None:
    data = Tiny.of([[("sil", 60), ("aa", 12), ("sil", 60)]])
    found = join(data, range(3), laid([30, 12, 6], 60), 60.0)
    np.testing.assert_allclose(found.source[:42], np.arange(30, 72), atol=3.5)
    # Shorter than a mouth needs to close: it closes faster.
    assert found.source[-1] == pytest.approx(72 + 60 * REACH, abs=7)


def test_a_unit_between_two_jumps_goes_over_at_both_ends() -> None:
    data = Tiny.made()
    found = join(data, [1, 7, 3], laid([9, 5, 10], 60), 1200.0)
    assert [splice.pair for splice in found.splices] == [1, 2]
    steps = np.abs(np.diff(found.components, axis=0)).max()
    assert steps < 3 * np.abs(np.diff(data.frames, axis=0)).max() / 20


def test_of_many_pairs_the_likest_is_taken() -> None:
    takes = [[("aa", 8), ("p", 6)], *[[("aa", 8), ("p", 6)]] * 5, [("iy", 5), ("p", 6)]]
    data = Tiny.of(takes)
    data.frames[28:42] = data.frames[:14]
    data.frames[36:42] = data.frames[-6:]
    found = join(data, [0, 13], laid([8, 6], 60), 60.0)
    assert found.splices[0].pair == 4


def test_pairs_are_found_by_their_labels() -> None:
    data = Tiny.made()
    pairs = PairTable(data)
    index = data.labels.index
    assert pairs(index("aa"), index("p")).tolist() == [1]
    assert pairs(index("p"), index("aa")).tolist() == [7]
    assert pairs(index("sil"), index("sil")).tolist() == []  # not over the end of a take
    assert pairs(index("f"), index("sil")).tolist() == []


def test_stand_ins_join_as_what_they_stand_for() -> None:
    data = Tiny.made()
    found = join(data, [8, 1], laid([9, 6], 60), 60.0, phones=["aa", "p"])
    assert found.splices[0].pair == 1
    unknown = join(data, [8, 1], laid([9, 6], 60), 60.0, phones=["aa", "zh"])
    assert unknown.splices[0].pair == -1


def test_of_several_paths_the_mean_is_taken() -> None:
    data = Tiny.made()
    spans = laid([9, 8, 7, 11, 6], 60)
    paths = [[0, 1, 2, 3, 4], [5, 8, 7, 6, 9]]
    alone = [join(data, path, spans, 60.0) for path in paths]
    both = join(data, np.array(paths), spans, 60.0)
    mean = 0.5 * (alone[0].components + alone[1].components)
    np.testing.assert_allclose(both.components, mean, atol=1e-9)
    np.testing.assert_array_equal(both.unit, alone[0].unit)


def test_smoothing_takes_nothing_but_what_is_too_fast() -> None:
    data = Tiny.made()
    learnt = learn(data)
    assert learnt.closing is None
    counts = (data.last - data.first)[:5].tolist()
    plain = join(data, range(5), laid(counts, 60), 60.0)
    smooth = join(data, range(5), laid(counts, 60), 60.0, learnt=learnt)
    lost = ((plain.components - smooth.components) ** 2).sum(axis=0)
    energy = ((plain.components - plain.components.mean(axis=0)) ** 2).sum(axis=0)
    assert (lost < 0.03 * energy).all()
    assert (lost > 0).all()


@pytest.mark.parametrize("rate", [24.0, 60.0, 120.0])
def test_p_is_closed_whatever_the_units_did(rate: float) -> None:
    data = Tiny.made()
    assert OPENING is not None
    learnt = learn(data, OPENING)
    assert learnt.closing is not None
    (kind,) = (kind for kind in learnt.closing.kinds if "p" in kind.labels)
    spans = laid([6, 9, 8, 10, 6], 60, start=2.0)
    spoken = ["sil", "aa", "p", "iy", "sil"]
    units = [0, 1, 8, 3, 4]  # an aa stands in for the p
    found = join(data, units, spans, rate, learnt=learnt, opening=OPENING, phones=spoken)
    assert found.pulled == 1
    times = found.start + (np.arange(len(found.motion)) + 0.5) / rate
    inside = (times >= spans[2, 0]) & (times < spans[2, 1])
    assert OPENING(found.motion[inside].astype(float)).min() <= kind.level + 1e-6


def test_what_is_learnt_goes_through_a_file() -> None:
    data = Tiny.made()
    for opening in (None, OPENING):
        learnt = learn(data, opening)
        again = Learnt.of(json.loads(json.dumps(learnt.document())))
        spans = laid([9, 9, 9, 9], 60)
        first, second = (
            join(data, [0, 1, 7, 4], spans, 60.0, learnt=one, opening=OPENING).motion
            for one in (learnt, again)
        )
        np.testing.assert_array_equal(first, second)


@pytest.mark.parametrize(
    ("units", "spans", "words"),
    [
        ([], np.zeros((0, 2)), "0 units"),
        ([1, 2], [[0, 1]], "2 units and spans of shape"),
        ([1], [[0, 0]], "without length"),
        ([1, 2], [[0, 1], [-1, 0.5]], "out of order"),
        ([1], [[0, np.inf]], "out of order"),
    ],
)
def test_bad_spans_are_refused(units: list[int], spans: object, words: str) -> None:
    with pytest.raises(InputError, match=words):
        join(Tiny.made(), units, np.asarray(spans, float), 60.0)
