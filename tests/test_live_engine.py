"""The models that come with Lipwright: a recording without words speaks at once, in any format."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import soundfile

from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.engines.neural import LIVE, WHOLE, Stream, load_model
from lipwright.engines.neural.engine import NeuralEngine
from lipwright.engines.neural.live_model import LiveModel
from lipwright.engines.neural.stream import hear_all
from lipwright.hearing import choose_engine
from lipwright.neural_takes import Hears, train_model
from lipwright.sound import Sound
from lipwright.speech import Speech
from tests.cli.test_bad_input import fails
from tests.engines.motion.takes import LINES

MODELS = (WHOLE, LIVE)
UNSEEN = "We may meet the boat before coffee."


@pytest.fixture(scope="module")
def line() -> Speech:
    """A line that no model has heard, with its phones."""
    return pipeline.say(UNSEEN, voice="en-us")


@pytest.fixture(scope="module")
def recording(line: Speech, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("a recording") / "speech.wav"
    assert line.sound is not None
    path.write_bytes(line.sound.wav_bytes())
    return path


@pytest.fixture(scope="module")
def taught(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A short line with its animation, in two formats."""
    folder = tmp_path_factory.mktemp("taught live")
    performance = pipeline.animate(pipeline.say(" ".join(list(LINES.values())[:3])), rate=30)
    pipeline.save(performance, *(folder / f"line.{suffix}" for suffix in ("json", "wav")))
    return folder


def test_a_recording_needs_neither_words_nor_a_model(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    made = [f"{tmp_path / 'x'}.{suffix}" for suffix in ("json", "html", "glb", "csv", "tsv")]
    outputs = [arg for path in made for arg in ("-o", path)]
    assert main(["animate", str(recording), "--engine", "neural", *outputs]) == 0
    assert "0 words, 0 phones" in capsys.readouterr().out
    found = Animation.load(made[0])
    assert (found.engine, found.report["model"], found.rate) == ("neural", WHOLE, 60)
    assert 0 <= found.report["confidence"] <= 1
    assert 0.5 < found.report["speaks"] <= 1


@pytest.mark.parametrize("model", MODELS)
def test_the_mouth_follows_the_voice(model: str, line: Speech) -> None:
    assert line.sound is not None
    alone = pipeline.sound_alone(line.sound)
    made = pipeline.animate(alone, engine="neural", model=model).animation
    drawn = pipeline.animate(line).animation.at(made.times)
    for name, least in {"open": 0.55, "W": 0.6, "PBM": 0.6}.items():
        column = list(made.controls).index(name)
        later = 1 if model == LIVE else 0
        wanted = np.roll(drawn[:, column], later)
        assert np.corrcoef(made.control(name), wanted)[0, 1] > least, name


@pytest.mark.parametrize("model", MODELS)
def test_lips_close_on_p_b_and_m(model: str, line: Speech) -> None:
    assert line.sound is not None
    alone = pipeline.sound_alone(line.sound)
    made = pipeline.animate(alone, engine="neural", model=model).animation
    closing = [phone for phone in line.phones if phone.label in ("p", "b", "m")]
    assert len(closing) == 4
    shut = 0
    for phone in closing:
        near = (made.times > phone.start - 0.04) & (made.times < phone.end + 0.06)
        assert made.control("open")[near].min() < 0.12, phone
        shut += bool(made.control("PBM")[near].max() > 0.8)
    assert shut >= 3


@pytest.mark.parametrize("model", MODELS)
def test_teeth_meet_the_lip_on_f_and_v(model: str) -> None:
    line = pipeline.say("Five of the four men found a fever.", voice="en-us")
    assert line.sound is not None
    alone = pipeline.sound_alone(line.sound)
    made = pipeline.animate(alone, engine="neural", model=model).animation
    shown, times = made.control("FV"), made.times
    spoken = [phone for phone in line.phones if phone.label in ("f", "v")]
    assert len(spoken) >= 5
    tops = [
        float(shown[(times > one.start - 0.02) & (times < one.end + 0.06)].max()) for one in spoken
    ]
    assert np.median(tops) > 0.6
    away = np.ones(len(times), bool)
    for one in spoken:
        away &= (times < one.start - 0.15) | (times > one.end + 0.15)
    assert shown[away].max() < 0.6


@pytest.mark.parametrize("model", MODELS)
def test_without_a_voice_the_mouth_rests(model: str) -> None:
    rng = np.random.default_rng(0)
    times = np.arange(5 * 16000) / 16000
    chords = sum(
        np.sin(2 * np.pi * f * times) * np.exp(-6 * (times % 0.5)) for f in (220, 277, 330)
    )
    for name, sound in {
        "hiss": rng.normal(0, 0.1, len(times)),
        "fan": 0.06 * np.sin(2 * np.pi * 100 * times) + 0.06 * rng.normal(0, 1, len(times)),
        "chords": 0.1 * np.asarray(chords),
    }.items():
        alone = pipeline.sound_alone(Sound(np.asarray(sound, np.float32), 16000))
        performance = pipeline.animate(alone, engine="neural", model=model)
        assert np.abs(performance.animation.values).mean() < 0.02, name
        assert any("is it speech?" in note for note in performance.speech.notes), name


@pytest.mark.parametrize(
    "spoil",
    [
        lambda s: np.clip(6 * s, -1, 1),
        lambda s: 0.5 * s + 0.3,
        lambda s: 0.03 * s,
        lambda s: s + np.random.default_rng(0).normal(0, 0.003, len(s)),
    ],
    ids=["clipped", "offset", "quiet", "hiss"],
)
def test_worse_recordings_give_nearly_the_same_mouth(
    spoil: object, line: Speech, tmp_path: Path
) -> None:
    assert line.sound is not None
    assert callable(spoil)
    soundfile.write(tmp_path / "a.wav", spoil(line.sound.samples), line.sound.rate, subtype="FLOAT")
    clean, worse = (
        pipeline.animate(pipeline.sound_alone(sound), engine="neural").animation.control("open")
        for sound in (line.sound, tmp_path / "a.wav")
    )
    assert np.corrcoef(clean, worse)[0, 1] > 0.9


def test_8_khz(line: Speech) -> None:
    assert line.sound is not None
    clean, low = (
        pipeline.animate(pipeline.sound_alone(sound), engine="neural").animation.control("open")
        for sound in (line.sound, line.sound.resampled(8000))
    )
    count = min(len(clean), len(low))
    assert np.corrcoef(clean[:count], low[:count])[0, 1] > 0.7


def test_the_engine_gives_what_a_stream_gives(line: Speech) -> None:
    assert line.sound is not None
    sound = line.sound
    stream = Stream(rate=sound.rate)
    pieces = [stream.push(piece) for piece in np.array_split(sound.samples, 37)]
    streamed = np.concatenate([frames.values for frames in (*pieces, stream.finish())])
    alone = pipeline.sound_alone(sound)
    made = pipeline.animate(alone, engine="neural", model=LIVE, rate=50).animation.values
    assert np.array_equal(made, streamed[: len(made)])


def test_a_listener_waits_no_more_than_40_ms() -> None:
    assert Stream().latency <= 0.040


@pytest.mark.parametrize("model", MODELS)
def test_info_of_what_comes_with_lipwright(model: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["neural", "info", model]) == 0
    told = capsys.readouterr().out
    assert "from 8800 sounds, each spoilt 2 times; it comes with Lipwright" in told
    assert ("655 ms after it" in told) == (model == WHOLE)
    assert main(["neural", "info", model, "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["seed"] == 1


# ---- which engine ---------------------------------------------------------------------------


def test_auto_says_what_it_chose_and_why(line: Speech, recording: Path, tmp_path: Path) -> None:
    known = pipeline.animate(line, engine="auto")
    assert known.animation.engine == "bigram"
    assert any("the phones are known" in note for note in known.speech.notes)
    out = tmp_path / "a.json"
    assert main(["animate", str(recording), "--engine", "auto", "-o", str(out)]) == 0
    assert Animation.load(out).engine == "neural"


def test_auto_asks_the_recogniser_where_the_net_is_unsure(
    line: Speech, monkeypatch: pytest.MonkeyPatch
) -> None:
    from lipwright import hearing

    assert line.sound is not None
    alone = pipeline.sound_alone(line.sound)
    assert choose_engine(alone).engine == "neural"
    monkeypatch.setattr(hearing, "DOUBTED", 1.1)
    monkeypatch.setattr(hearing, "SURE", 0.0)
    found = choose_engine(alone)
    assert (found.engine, len(found.speech.words) > 2) == ("bigram", True)
    assert "the net is not sure" in found.why
    monkeypatch.setattr(hearing, "SURE", 1.1)
    found = choose_engine(alone)
    assert (found.engine, len(found.speech.words)) == ("neural", 0)
    assert "no words are recognised either" in found.why


# ---- what a speaker teaches -------------------------------------------------------------------


@pytest.mark.parametrize("hears", MODELS)
def test_any_controls_are_learnt_on_top(
    hears: str, taught: Path, recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = [str(taught / "line.wav"), str(taught / "line.json")]
    model = str(tmp_path / "own")
    teach = ["neural", "train", *files, "--hears", hears, "--hidden", "8", "-o", model]
    assert main(teach) == 0
    assert "off by" in capsys.readouterr().out
    assert main(["neural", "info", model, "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert facts["frames_per_second"] == 50
    assert facts["error"] < 0.12
    made = tmp_path / "made.json"
    how = ["--engine", "neural", "--model", model, "-o", str(made)]
    assert main(["animate", str(recording), *how]) == 0
    drawn = pipeline.animate(pipeline.say(UNSEEN)).animation
    found = Animation.load(made)
    wanted = drawn.at(found.times)[:, 0]
    assert np.corrcoef(found.control("open"), wanted)[0, 1] > 0.45
    assert main([*teach[:-1], model + "2"]) == 0
    assert Path(model).read_bytes() == Path(model + "2").read_bytes()


def test_what_was_learnt_live_streams_to_the_bit(taught: Path, line: Speech) -> None:
    pair = (taught / "line.wav", taught / "line.json")
    model = train_model([pair], hears="live", hidden=(4, 3))
    assert isinstance(model, LiveModel)
    assert line.sound is not None
    sound = line.sound.resampled(16000).samples
    stream = Stream(model)
    pieces = [stream.push(piece) for piece in np.array_split(sound, 50)]
    parts = np.concatenate([frames.values for frames in (*pieces, stream.finish())])
    again = Stream(model)
    whole = np.concatenate([again.push(sound).values, again.finish().values])
    assert parts.tobytes() == whole.tobytes()
    assert stream.latency <= 0.040


@pytest.mark.parametrize("hears", MODELS)
def test_what_was_learnt_doubts_where_the_built_in_net_does(
    hears: Hears, taught: Path, line: Speech
) -> None:
    model = train_model([(taught / "line.wav", taught / "line.json")], hears=hears, hidden=(4,))
    ears = load_model(hears)
    assert isinstance(model, LiveModel)
    assert isinstance(ears, LiveModel)
    assert line.sound is not None
    sound = line.sound.resampled(16000).samples
    own, its = (hear_all(sound, 16000, one) for one in (model, ears))
    assert own.first == its.first
    # Only what comes after the end of the sound may differ: one hears farther.
    assert np.array_equal(own.doubt[:-70], its.doubt[:-70])
    assert np.ptp(own.doubt[:-70]) > 0.01


@pytest.mark.parametrize("hears", MODELS)
def test_what_was_learnt_moves_as_far_as_what_was_shown(hears: Hears, taught: Path) -> None:
    model = train_model([(taught / "line.wav", taught / "line.json")], hears=hears, hidden=(16,))
    heard = NeuralEngine(model).animate(pipeline.sound_alone(taught / "line.wav"))
    shown = Animation.load(taught / "line.json").at(heard.times)
    broad, moved = heard.values.std(axis=0), shown.std(axis=0)
    seen = [heard.controls.index(name) for name in ("open", "W", "wide", "PBM")]
    assert (broad[seen] > 0.9 * moved[seen]).all()
    assert (broad[seen] < 1.1 * moved[seen]).all()


def test_the_five_are_learnt_on_top_too(taught: Path) -> None:
    from tests.engines.motion.takes import shapes

    drawn = Animation.load(taught / "line.json")
    face = shapes(drawn)
    table = Animation(tuple(face), np.stack(list(face.values()), 1), drawn.rate, drawn.start)
    table.save(taught / "face.json")
    model = train_model([(taught / "line.wav", taught / "face.json")], five=True, hidden=(4,))
    assert model.controls == ("a", "i", "o/u", "b/m/p", "open")


# ---- what cannot be used ------------------------------------------------------------------------


def test_models_that_do_not_fit(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, out = tmp_path / "m", ("-o", tmp_path / "a.json")
    data = load_model(WHOLE)
    assert isinstance(data, LiveModel)
    content = data.to_bytes()
    bad = {
        "broken JSON": content[: len(content) // 2],
        "newer Lipwright": content.replace(b'"version": 1', b'"version": 2'),
        "another number of ranges": content.replace(b'"open", "W", ', b'"open", '),
    }
    for words, broken in bad.items():
        model.write_bytes(broken)
        how = ("--engine", "neural", "--model", model)
        message = fails(capsys, tmp_path, "animate", recording, *how, *out)
        assert words in message
        assert str(model) in message
    strange = replace(data, controls=tuple(f"x{k}" for k in range(9)), closing=None, closed=None)
    strange.save(model)
    message = fails(capsys, tmp_path, "animate", recording, *how, *out)
    assert "none of the controls (x0, x1" in message
    missing = ("--engine", "neural", "--model", "hole")
    assert "no such file" in fails(capsys, tmp_path, "animate", recording, *missing, *out)
