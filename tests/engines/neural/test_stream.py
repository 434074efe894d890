"""Sound in pieces gives the frames that the whole gives, and bad pieces lose nothing."""

from __future__ import annotations

import math
import tracemalloc
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lipwright.engines.neural import Frames, Stream
from lipwright.engines.neural.live_model import FRAME, LiveModel
from lipwright.engines.neural.stream import hear_all, joined
from lipwright.errors import InputError, SoundError
from tests.engines.neural.tiny import tiny, voice, without_closing

MODEL = tiny()


def pushed(model: LiveModel, pieces: list[np.ndarray], rate: int = 16000) -> Frames:
    stream = Stream(model, rate)
    found = [stream.push(piece) for piece in pieces]
    return joined([*found, stream.finish()], stream.finish())


@given(st.lists(st.integers(0, 6000), max_size=12), st.sampled_from([8000, 16000, 22050, 48000]))
@settings(max_examples=40, deadline=None)
def test_pieces_of_any_size_give_the_same_bits(cuts: list[int], rate: int) -> None:
    sound = voice(0.7, rate)
    whole = hear_all(sound, rate, MODEL)
    parts = pushed(MODEL, np.split(sound, np.minimum(np.cumsum(cuts), len(sound))), rate)
    assert parts.values.tobytes() == whole.values.tobytes()
    assert parts.doubt.tobytes() == whole.doubt.tobytes()
    assert parts.first == 0
    assert len(whole) == int(len(sound) / rate / FRAME + 1e-9) + 1


def test_frames_come_as_soon_as_they_are_due_and_in_their_order() -> None:
    stream, sound, due = Stream(MODEL), voice(1.0), 0
    for sample in range(0, len(sound), 80):
        frames = stream.push(sound[sample : sample + 80])
        assert frames.first == due or not len(frames)
        due += len(frames)
        heard = (sample + 80) / 16000
        assert due == max(math.floor((heard - MODEL.latency) / FRAME + 1e-9) + 1, 0)
    assert stream.latency == pytest.approx(MODEL.latency + FRAME)
    assert stream.finish().first == due


def test_what_comes_later_does_not_change_a_frame() -> None:
    one, other = voice(1.0), voice(1.0)
    other[8000:] = 0.3
    due = int((0.5 - MODEL.latency) / FRAME) + 1
    a, b = (hear_all(sound, 16000, MODEL) for sound in (one, other))
    assert np.array_equal(a.values[:due], b.values[:due])
    assert np.array_equal(a.doubt[:due], b.doubt[:due])
    assert not np.array_equal(a.doubt[due:], b.doubt[due:])


def test_a_quieter_copy_is_the_same_sound_once_it_was_loud() -> None:
    sound = voice(2.0)
    loud, quiet = (hear_all(np.r_[s, s], 16000, MODEL) for s in (sound, 0.2 * sound))
    assert np.abs(loud.values[-40:] - quiet.values[-40:]).max() < 0.02


def test_whole_numbers_and_channels() -> None:
    sound = np.rint(voice(0.5) * 32768).astype(np.int16)
    floats = hear_all((sound / 32768).astype(np.float32), 16000, MODEL)
    assert np.array_equal(pushed(MODEL, [sound]).values, floats.values)
    both = np.stack([sound, sound], axis=1)
    assert np.array_equal(pushed(MODEL, [both]).values, floats.values)
    assert np.array_equal(pushed(MODEL, [np.zeros((0, 2)), both]).values, floats.values)


def test_an_offset_is_not_heard() -> None:
    sound = voice(1.0)
    plain, moved = (hear_all(one, 16000, MODEL).values for one in (sound, sound + np.float32(0.3)))
    assert np.abs(moved - plain).max() < 0.01


BAD: dict[str, tuple[Any, str]] = {
    "NaN": (np.array([0.0, np.nan]), "sample 1: a piece that holds samples that are not numbers"),
    "infinite": (np.array([np.inf]), "sample 0: a piece that holds samples that are not numbers"),
    "whole numbers as floats": (np.array([2000.0]), "a sample of 2000; expected -1..1"),
    "text": (np.array(["a"]), "a piece of shape (1,) and type <U1; expected samples"),
    "complex": (np.zeros(3, complex), "type complex128"),
    "three axes": (np.zeros((1, 2, 3)), "a piece of shape (1, 2, 3)"),
    "a number": (np.float64(0.5), "a piece of shape ()"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_piece_is_refused_and_nothing_is_lost(name: str) -> None:
    piece, words = BAD[name]
    sound, stream = voice(0.6), Stream(MODEL)
    found = [stream.push(sound[:5000])]
    with pytest.raises(SoundError) as caught:
        stream.push(piece)
    assert words in str(caught.value)
    found += [stream.push(sound[5000:]), stream.finish()]
    together = np.concatenate([frames.values for frames in found])
    assert np.array_equal(together, hear_all(sound, 16000, MODEL).values)


def test_a_finished_stream_takes_no_more() -> None:
    stream = Stream(MODEL)
    stream.push(voice(0.1))
    assert len(stream.finish()) > 0
    assert len(stream.finish()) == 0
    with pytest.raises(InputError, match="the stream is finished"):
        stream.push(voice(0.1))


@pytest.mark.parametrize("samples", [0, 1, 159, 320, 401])
def test_very_short_sounds(samples: int) -> None:
    frames = pushed(MODEL, [voice(1.0)[:samples]])
    assert len(frames) == samples // 320 + 1
    assert np.isfinite(frames.values).all()


@pytest.mark.parametrize("rate", [0, 4000, 16000.5, 10**7, True])
def test_rates_that_no_microphone_has(rate: float) -> None:
    with pytest.raises(InputError, match="samples per second"):
        Stream(MODEL, rate)  # type: ignore[arg-type]


def test_models_that_cannot_stream_are_refused() -> None:
    with pytest.raises(InputError, match="hears whole recordings cannot stream"):
        Stream(tiny(both_ways=True))


def test_memory_does_not_grow() -> None:
    stream, piece = Stream(MODEL, 48000), voice(1.0, 48000)
    tracemalloc.start()
    for _ in range(5):
        stream.push(piece)
    before = tracemalloc.get_traced_memory()[0]
    for _ in range(60):
        stream.push(piece)
    grown = tracemalloc.get_traced_memory()[0] - before
    tracemalloc.stop()
    assert grown < 50_000  # a minute of sound is 11 MB


def test_a_recording_heard_both_ways_knows_its_loudness_from_the_start() -> None:
    late = np.r_[0.05 * voice(0.5), voice(1.0)]
    model = replace(tiny(3), both_ways=True)
    quiet = hear_all(late, 16000, model).doubt[:20]
    alone = hear_all(late[:8000], 16000, model).doubt[:20]
    assert not np.array_equal(quiet, alone)
    long = np.tile(late, 60)  # more than is gone through at once
    frames = hear_all(long, 16000, model)
    assert len(frames) == int(len(long) / 320) + 1


def test_a_likely_closure_closes() -> None:
    sound = voice(1.0)
    plain, shut = (hear_all(sound, 16000, m).values for m in (without_closing(MODEL), MODEL))
    closer = shut[:, 1] > plain[:, 1] + 1e-6
    assert closer.any()
    assert (shut[closer, 0] < plain[closer, 0]).all()
    assert (shut[:, 1] >= plain[:, 1]).all()


def test_a_model_hears_as_deep_below_the_loudest_as_it_says() -> None:
    soft = 1e-5 * voice(0.5)  # 100 dB below what follows
    for depth, heard in ((60.0, False), (120.0, True)):
        model = replace(tiny(3), both_ways=True, depth=depth)
        there, not_there = (
            hear_all(np.r_[quiet, voice(1.0)], 16000, model).values[:20]
            for quiet in (soft, np.zeros_like(soft))
        )
        assert np.array_equal(there, not_there) is not heard
