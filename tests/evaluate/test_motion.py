"""Measures of motion, held to mouths whose likeness is known."""

from dataclasses import asdict, replace

import numpy as np
import pytest

from lipwright.errors import InputError
from lipwright.evaluate import Curve, Recording, compare
from lipwright.phones import PhoneTrack
from lipwright.timeline import Tier
from tests.evaluate.faces import PHONES, frames, mouth, pair, recording


def test_the_same_motion_in_other_units_is_wholly_alike() -> None:
    report = compare([pair()])
    assert report.lag_ms == 0
    assert report.opening.correlation == pytest.approx(1)
    assert report.opening.rms == pytest.approx(0, abs=1e-6)
    assert report.rounding.correlation == pytest.approx(1)
    assert report.pucker is None
    assert report.turns.animation == report.turns.recording
    assert report.silence is not None
    assert report.silence.animation == pytest.approx(report.silence.recording, abs=1e-6)
    for kind, count in (("p b m", 2), ("f v", 1)):
        found = report.closures[kind]
        assert (found.phones, found.recorded, found.met) == (count, count, 1)
        assert found.median_ms == pytest.approx(0, abs=0.01)
        assert found.within_40_ms == 1


@pytest.mark.parametrize("later", [-0.04, -0.02, 0.015, 0.04])
def test_one_lag_is_found_and_taken_out(later: float) -> None:
    seen = recording(later=later, rate=200)
    report = compare([pair(seen=seen), pair(seen=seen)])
    assert report.lag_ms == pytest.approx(1e3 * later)
    assert report.opening.correlation == pytest.approx(1)
    assert report.closures["p b m"].median_ms == pytest.approx(0, abs=0.01)


def test_the_lag_is_common_and_no_greater_than_a_frame() -> None:
    report = compare([pair(seen=recording(later=0.2, rate=200))])
    assert report.lag_ms == 40
    one_each_way = compare([pair(seen=recording(later=later, rate=200)) for later in (-0.03, 0.03)])
    assert abs(one_each_way.lag_ms) <= 30
    assert one_each_way.opening.correlation < 0.99


def test_video_sees_what_happens_between_its_frames() -> None:
    report = compare([pair(seen=recording())])
    assert report.opening.correlation > 0.97
    assert report.closures["p b m"].met == 1
    assert report.closures["p b m"].median_ms == pytest.approx(0, abs=12)


def test_correlation_is_taken_within_each_pair() -> None:
    still = Curve(frames(), np.full(75, 0.3))
    flat = replace(pair(), opening=still)
    report = compare([pair(), flat])
    assert report.opening.correlation == pytest.approx(0.5)  # a mouth that rests has 0


def test_rms_is_a_share_of_the_recordings_range() -> None:
    times = np.arange(4000) / 100
    face = np.where(np.arange(4000) % 2, 1.0, 0.0)
    noise = np.where(np.arange(4000) // 2 % 2, 0.1, -0.1)  # knows nothing of the face
    clean, noisy = Curve(times, face), Curve(times, face + noise)
    one = replace(pair(), opening=clean, recording=Recording(noisy, recording().breadth))
    report = compare([one])
    assert report.opening.rms == pytest.approx(0.1 / 1.2, rel=0.01)


def test_a_closure_that_is_left_out_is_seen() -> None:
    report = compare([pair(closed=(1.05, 1.85))])  # no m
    assert report.closures["p b m"].recorded == 2
    assert report.closures["p b m"].met == 0.5
    assert report.closures["f v"].met == 1


def test_what_the_face_leaves_open_is_not_asked_for() -> None:
    report = compare([pair(seen=recording(closed=(1.05, 1.85), rate=200))])
    assert report.closures["p b m"].phones == 2
    assert report.closures["p b m"].recorded == 1
    assert report.closures["p b m"].met == 1
    assert report.closures["p b m"].own == 2  # of which the face has one
    assert report.closures["p b m"].own_met == 0.5


def test_time_between_closures() -> None:
    report = compare([pair(closed=(1.05, 1.48, 1.82))])
    assert report.lag_ms == 0
    pbm, fv = report.closures["p b m"], report.closures["f v"]
    assert pbm.median_ms == pytest.approx(15, abs=1)  # 0 and 30 ms late
    assert pbm.later_ms == pytest.approx(15, abs=1)
    assert fv.median_ms == pytest.approx(30, abs=1)
    assert fv.later_ms == pytest.approx(-30, abs=1)


def test_a_closure_after_silence_is_timed_by_its_release() -> None:
    phones = PhoneTrack(Tier.of(("sil", 0, 1), ("p", 1, 1.1), ("aa", 1.1, 2.2), ("sil", 2.2, 3)))
    times = frames(200)

    def released(at: float) -> Curve:
        return Curve(times, np.interp(times, [at, at + 0.1, 2.2, 2.4], [0.0, 1, 1, 0]))

    breadth = recording(rate=200).breadth
    one = replace(
        pair(phones=phones), opening=released(1.09), recording=Recording(released(1.07), breadth)
    )
    wrapped = [one] + [pair()] * 9  # others fix the lag at 0
    assert compare(wrapped).lag_ms == 0
    alone = compare([replace(one, recording=Recording(released(1.09), breadth))])
    assert alone.closures["p b m"].median_ms == pytest.approx(0, abs=0.01)
    found = compare([one])
    assert found.closures["p b m"].median_ms is not None
    assert found.lag_ms <= 0
    expected = abs(20 + found.lag_ms)  # what the lag has not taken out
    assert found.closures["p b m"].median_ms == pytest.approx(expected, abs=1)


def test_changes_of_direction_count_from_the_threshold() -> None:
    times = frames()
    swing = 0.5 - 0.5 * np.cos(2 * np.pi * 2 * times)  # 2 Hz: four turns per second
    tremble = swing + 0.03 * np.where(np.arange(len(times)) % 2, 1, -1)
    seen = Recording(Curve(times, swing), recording().breadth)
    for values in (swing, tremble):
        report = compare([replace(pair(), opening=Curve(times, values), recording=seen)])
        assert report.turns.animation == report.turns.recording == pytest.approx(4, abs=0.4)
        assert report.turn_share == 0.1
    shaking = swing + 0.4 * np.where(np.arange(len(times)) % 4 < 2, 1, -1)  # 12.5 per second
    report = compare([replace(pair(), opening=Curve(times, shaking), recording=seen)])
    assert report.turns.animation > 10


def test_peaks_are_matched_in_time() -> None:
    times = frames(100)

    def bumps(*middles: float) -> Curve:
        return Curve(times, np.max([np.exp(-(((times - m) / 0.06) ** 2)) for m in middles], axis=0))

    seen = Recording(bumps(0.5, 1.0, 1.5, 2.0), recording().breadth)
    report = compare([replace(pair(), opening=bumps(0.5, 1.03, 1.47), recording=seen)])
    assert report.peaks.recorded == 4
    assert report.peaks.met == 0.75
    assert report.peaks.median_ms == pytest.approx(30, abs=6)


def test_motion_in_silence_is_seen() -> None:
    times = frames(200)
    restless = mouth(times) + 0.2 * (times < 0.8) * np.abs(np.sin(20 * times))
    report = compare([replace(pair(), opening=Curve(times, restless))])
    assert report.silence is not None
    assert report.silence.animation > report.silence.recording + 0.5


def test_without_phones_there_are_no_closures_and_no_silence() -> None:
    report = compare([pair(phones=PhoneTrack(Tier()))])
    assert report.closures == {}
    assert report.silence is None
    assert report.opening.correlation == pytest.approx(1)


def test_the_report_is_plain_data() -> None:
    facts = asdict(compare([pair()]))
    assert set(facts["closures"]) == {"p b m", "f v"}
    assert facts["opening"]["correlation"] == pytest.approx(1)


def test_a_recording_that_does_not_move_is_refused() -> None:
    times = frames()
    still = Recording(Curve(times, np.zeros(75)), Curve(times, np.zeros(75)))
    with pytest.raises(InputError, match="does not move"):
        compare([pair(seen=still)])
    with pytest.raises(InputError, match="nothing to compare"):
        compare([])


def test_phones_of_all_kinds_are_in_the_synthetic_line() -> None:
    assert {"b", "m", "f", "sil"} <= {phone.label for phone in PHONES}
