"""The publication's net from end to end: speech, its animation, a model, a line without words."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import soundfile

from lipwright import pipeline
from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.errors import InputError
from lipwright.neural_takes import read_animation, train_model
from lipwright.speech import Speech
from tests.cli.test_bad_input import fails
from tests.engines.motion.takes import LINES, shapes

TAUGHT = " ".join(LINES.values())


@pytest.fixture(scope="module")
def taught(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Some 15 s of speech with the bigram engine's animation, and a model of it."""
    folder = tmp_path_factory.mktemp("taught here")
    performance = pipeline.animate(pipeline.say(TAUGHT), rate=30)
    pipeline.save(performance, *(folder / f"line.{suffix}" for suffix in ("json", "csv", "wav")))
    sound = str(folder / "line.wav")
    teach = ["neural", "train", sound, str(folder / "line.json"), "--hears", "published"]
    assert main([*teach, "-o", str(folder / "m")]) == 0
    return folder


@pytest.fixture(scope="module")
def unseen(tmp_path_factory: pytest.TempPathFactory) -> Path:
    speech = pipeline.say("We may meet the boat before coffee.")
    path = tmp_path_factory.mktemp("unseen") / "line.wav"
    assert speech.sound is not None
    path.write_bytes(speech.sound.wav_bytes())
    return path


def test_a_line_without_words_is_animated_as_it_was_taught(
    taught: Path, unseen: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    made = tmp_path / "made.json"
    how = ["--engine", "neural", "--model", str(taught / "m")]
    outputs = [
        arg for suffix in ("html", "glb", "tsv", "csv") for arg in ("-o", f"{made}.{suffix}")
    ]
    assert main(["animate", str(unseen), *how, "-o", str(made), *outputs]) == 0
    told = capsys.readouterr()
    assert "0 words, 0 phones" in told.out
    assert told.err == ""
    found = Animation.load(made)
    assert (found.engine, len(found.phones)) == ("neural", 0)
    assert found.report["model"] == "m"
    assert found.keys["open"].values.max() > 0.2
    drawn = pipeline.animate(pipeline.say("We may meet the boat before coffee.")).animation
    for name, least in {"open": 0.6, "W": 0.5}.items():
        wanted = drawn.at(found.times)[:, drawn.controls.index(name)]
        assert np.corrcoef(found.control(name), wanted)[0, 1] > least, name


def test_words_are_kept_where_they_are_known(taught: Path, spoken: Speech) -> None:
    made = pipeline.animate(spoken, engine="neural", model=taught / "m", rate=24).animation
    assert len(made.phones) == len(spoken.phones)
    assert made.rate == 24


def test_a_table_teaches_what_the_lossless_file_does(taught: Path) -> None:
    exact, _ = read_animation(taught / "line.json")
    table, _ = read_animation(taught / "line.csv")
    assert table.controls == exact.controls
    times = np.arange(0, 5, 0.04)
    assert np.abs(table.at(times) - exact.at(times)).max() < 1e-3


def test_the_same_files_give_the_same_model(taught: Path, tmp_path: Path) -> None:
    files = [str(taught / "line.wav"), str(taught / "line.json")]
    published = ["--hears", "published"]
    assert main(["neural", "train", *files, *published, "-o", str(tmp_path / "again")]) == 0
    assert (tmp_path / "again").read_bytes() == (taught / "m").read_bytes()


def test_the_five_are_learnt_from_a_face_and_played_by_any_character(
    taught: Path, unseen: Path, tmp_path: Path
) -> None:
    drawn = Animation.load(taught / "line.json")
    face = shapes(drawn)
    values = np.stack(list(face.values()), axis=1)
    Animation(tuple(face), values, drawn.rate, drawn.start).save(tmp_path / "face.json")
    pair = (taught / "line.wav", tmp_path / "face.json")
    model = train_model([pair], hears="published", five=True, hidden=(8,))
    model.save(tmp_path / "five")
    assert model.controls == ("a", "i", "o/u", "b/m/p", "open")
    speech = pipeline.sound_alone(unseen)
    for character in ("head", "crab", "rhubarb"):
        made = pipeline.animate(
            speech, engine="neural", model=tmp_path / "five", character=character
        ).animation
        assert made.controls == ("open", "wide", "W", "PBM")
        assert np.ptp(made.control("open")) > 0.2
        assert made.report["outputs"] == list(model.controls)


def test_info(taught: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["neural", "info", str(taught / "m")]) == 0
    told = capsys.readouterr().out
    assert "243-18-9, 25 frames per second" in told
    assert "112 ms: 9 segments of 32 ms, 27 areas" in told
    assert main(["neural", "info", str(taught / "m"), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["net"] == [243, 18, 9]


def test_a_model_is_read_anew_when_its_file_changes(taught: Path, tmp_path: Path) -> None:
    path = tmp_path / "m"
    path.write_bytes((taught / "m").read_bytes())
    sound = pipeline.sound_alone(taught / "line.wav")
    assert pipeline.animate(sound, engine="neural", model=path).animation.controls[0] == "open"
    pair = (taught / "line.wav", taught / "line.json")
    train_model([pair], hears="published", hidden=(2,)).save(path)
    report = pipeline.animate(sound, engine="neural", model=path).animation.report
    assert report["net"] == "243-2-9"


# ---- sounds that are unusual and must work ------------------------------------------------


def loud_music(count: int, rate: int) -> np.ndarray:
    times = np.arange(count) / rate
    chords = [220, 277, 330, 440, 554, 659, 880, 1109]
    beat = np.exp(-8 * (times % 0.5))
    tones: np.ndarray = np.sum([np.sin(2 * np.pi * f * times + f) for f in chords], axis=0)
    return tones * beat * 0.1


UNUSUAL: dict[str, Callable[[np.ndarray, int], np.ndarray]] = {
    "clipped": lambda s, rate: np.clip(9 * s, -1, 1),
    "offset": lambda s, rate: 0.5 * s + 0.4,
    "quiet": lambda s, rate: 0.003 * s,
    "music": lambda s, rate: loud_music(len(s), rate),
    "noise": lambda s, rate: np.random.default_rng(0).normal(0, 0.1, len(s)),
    "112 ms": lambda s, rate: s[rate // 2 :][: int(0.112 * rate) + 1],
    "a hole": lambda s, rate: np.r_[s, np.zeros(rate), s],
}


@pytest.mark.parametrize("name", UNUSUAL)
def test_unusual_sounds_are_animated(
    name: str, taught: Path, unseen: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    samples, rate = soundfile.read(unseen)
    soundfile.write(tmp_path / "odd.wav", UNUSUAL[name](samples, rate), rate, subtype="FLOAT")
    how = ["--engine", "neural", "--model", str(taught / "m"), "-o", str(tmp_path / "odd.json")]
    assert main(["animate", str(tmp_path / "odd.wav"), *how]) == 0
    found = Animation.load(tmp_path / "odd.json")
    assert 0 <= found.values.min() <= found.values.max() <= 1
    warned = "sounds like nothing in the model's training" in capsys.readouterr().err
    assert warned == (name == "noise")
    if name in ("offset", "quiet"):
        plain = pipeline.animate(
            pipeline.sound_alone(unseen), engine="neural", model=taught / "m"
        ).animation
        assert np.abs(found.values - plain.values).mean() < 0.02


def test_8_khz_keeps_the_mouth_in_step(taught: Path, unseen: Path) -> None:
    speech = pipeline.sound_alone(unseen)
    assert speech.sound is not None
    low = pipeline.sound_alone(speech.sound.resampled(8000))
    made, other = (
        pipeline.animate(one, engine="neural", model=taught / "m").animation.control("open")
        for one in (speech, low)
    )
    count = min(len(made), len(other))
    assert np.corrcoef(made[:count], other[:count])[0, 1] > 0.6


# ---- what cannot be used --------------------------------------------------------------------

BAD_SOUNDS = {
    "one sample": (np.ones(1), "1 samples (0 ms); expected 112 ms or more"),
    "no samples": (np.zeros(0), "0 samples"),
    "silence": (np.zeros(16000), "silent"),
    "NaN": (np.r_[np.ones(8000), np.nan, np.ones(8000)], "is nan"),
}


@pytest.mark.parametrize("name", BAD_SOUNDS)
def test_sounds_that_cannot_be_used(
    name: str, taught: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    samples, words = BAD_SOUNDS[name]
    sound = tmp_path / "bad.wav"
    soundfile.write(sound, samples, 16000, subtype="FLOAT")
    how = ("--engine", "neural", "--model", taught / "m", "-o", tmp_path / "a.json")
    for message in (
        fails(capsys, tmp_path, "animate", sound, *how),
        fails(
            capsys, tmp_path, "neural", "train", sound, taught / "line.json", "-o", tmp_path / "x"
        ),
    ):
        assert words in message
        assert "bad.wav" in message


def lines(path: Path, text: str) -> Path:
    path.write_text(text, "utf-8")
    return path


def rows(count: int, value: str = "0.{}") -> str:
    return "time,open\n" + "".join(f"{k * 0.04:.2f},{value.format(k % 7)}\n" for k in range(count))


def test_training_that_cannot_be_used(
    taught: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sound, exact, model = taught / "line.wav", taught / "line.json", tmp_path / "x"
    count = int(soundfile.info(sound).duration * 25)
    table = tmp_path / "table.csv"
    bad = {
        "table.csv: no control moves": rows(count, "0.3"),
        "s of sound; expected the two to agree within 0.5 s": rows(count // 2),
        "'nan'": rows(count).replace("0.3", "nan", 1),
    }
    for words, text in bad.items():
        lines(table, text)
        assert words in fails(capsys, tmp_path, "neural", "train", sound, table, "-o", model)
    lines(table, rows(count))
    both = (sound, exact, sound, table)
    assert "has the controls" in fails(capsys, tmp_path, "neural", "train", *both, "-o", model)
    five = ("neural", "train", sound, exact, "--five", "-o", model)
    assert "no jawOpen" in fails(capsys, tmp_path, *five)
    picture = ("neural", "train", sound, taught / "line.wav", "-o", model)
    assert "expected an animation in .json or .csv" in fails(capsys, tmp_path, *picture)
    fails(capsys, tmp_path, "neural", "train", sound, "-o", model, status=2)
    over = ("neural", "train", sound, table, "-o", table)
    assert "over its own input" in fails(capsys, tmp_path, *over)


def test_three_seconds_are_learnt_from_and_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    performance = pipeline.animate(pipeline.say("Peter bought a big map of the town."))
    pipeline.save(performance, tmp_path / "s.json", tmp_path / "s.wav")
    files = [str(tmp_path / "s.wav"), str(tmp_path / "s.json")]
    assert main(["neural", "train", *files, "-o", str(tmp_path / "m")]) == 0
    assert "s to learn from: the publication's net had 20" in capsys.readouterr().err


def test_models_that_do_not_fit(
    taught: Path, unseen: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = ("-o", tmp_path / "a.json")
    data = (taught / "m").read_bytes()
    bad = {
        "broken JSON": data[: len(data) // 2],
        "newer Lipwright": data.replace(b'"version": 1', b'"version": 2'),
        "expected a file of format 'lipwright/neural-model'": (taught / "line.json").read_bytes(),
        "is empty": b"",
    }
    for words, content in bad.items():
        (tmp_path / "m").write_bytes(content)
        how = ("--engine", "neural", "--model", tmp_path / "m")
        message = fails(capsys, tmp_path, "animate", unseen, *how, *out)
        assert words in message
        assert str(tmp_path / "m") in message
        assert words in fails(capsys, tmp_path, "neural", "info", tmp_path / "m")
    how = ("--engine", "neural", "--model", tmp_path / "none")
    assert "no such file" in fails(capsys, tmp_path, "animate", unseen, *how, *out)


def test_controls_that_the_character_lacks(
    taught: Path, unseen: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    strange = tmp_path / "strange"
    strange.write_bytes(
        (taught / "m")
        .read_bytes()
        .replace(
            b'["open", "W", "wide", "ShCh", "FV", "PBM", "tBack", "tRoof", "tTeeth"]',
            json.dumps([f"x{k}" for k in range(9)]).encode(),
        )
    )
    how = ("--engine", "neural", "--model", strange)
    message = fails(capsys, tmp_path, "animate", unseen, *how, "-o", tmp_path / "a.json")
    assert "none of the controls (x0, x1" in message


def test_options_that_do_not_go_together(
    taught: Path, unseen: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, out = ("--model", taught / "m"), ("-o", tmp_path / "a.json")
    neural = ("animate", unseen, "--engine", "neural")
    assert "a motion database" in fails(capsys, tmp_path, *neural, *model, "--database", "d", *out)
    assert "a set, overrides" in fails(capsys, tmp_path, *neural, *model, "--set", "crab", *out)
    auto = ("animate", unseen, "--engine", "auto")
    assert "a motion database" in fails(capsys, tmp_path, *auto, "--database", "d", *out)
    assert "Choose the neural engine" in fails(capsys, tmp_path, "say", "Hi", *model, *out)
    over = (*neural, "--model", tmp_path / "a.json", *out)
    (tmp_path / "a.json").write_bytes((taught / "m").read_bytes())
    assert "over its own input" in fails(capsys, tmp_path, *over)


def test_without_a_sound_there_is_nothing_to_hear(taught: Path, spoken: Speech) -> None:
    from dataclasses import replace

    with pytest.raises(InputError, match="no sound: the neural engine hears"):
        pipeline.animate(replace(spoken, sound=None), engine="neural", model=taught / "m")
