"""Closures: the silence before a burst goes to the stop."""

import numpy as np

from lipwright.schedule.say.closures import begin_stops_at_closure

RATE = 1000


def edges_of(samples: list[float], labels: list[str], edges: list[int]) -> list[int]:
    return begin_stops_at_closure(
        np.array(samples, np.float32),
        RATE,
        labels,
        edges,
        is_stop=lambda label: label in ("p", "b"),
        silence="sil",
    )


def test_the_silence_at_the_end_of_a_vowel_goes_to_the_stop() -> None:
    sound = [0.5] * 100 + [0.0] * 50 + [0.3] * 30
    assert edges_of(sound, ["a", "p"], [0, 150, 180]) == [0, 100, 180]


def test_a_faint_echo_is_silence_too() -> None:
    sound = [0.5] * 100 + [0.03] * 50 + [0.3] * 30
    assert edges_of(sound, ["a", "p"], [0, 150, 180]) == [0, 100, 180]


def test_a_stop_that_is_voiced_throughout_stays_where_it_is() -> None:
    sound = [0.5] * 100 + [0.1] * 80
    assert edges_of(sound, ["a", "b"], [0, 100, 180]) == [0, 100, 180]


def test_what_is_no_stop_takes_nothing() -> None:
    sound = [0.5] * 100 + [0.0] * 50 + [0.3] * 30
    assert edges_of(sound, ["a", "s"], [0, 150, 180]) == [0, 150, 180]


def test_after_a_pause_a_stop_takes_its_end_and_never_more_than_half() -> None:
    assert edges_of([0.0] * 400 + [0.3] * 30, ["sil", "p"], [0, 400, 430]) == [0, 340, 430]
    assert edges_of([0.0] * 40 + [0.3] * 30, ["sil", "p"], [0, 40, 70]) == [0, 20, 70]


def test_a_phone_keeps_a_part_of_its_time() -> None:
    sound = [0.5] * 5 + [0.0] * 95 + [0.3] * 30
    assert edges_of(sound, ["a", "p"], [0, 100, 130]) == [0, 25, 130]
