"""Bad input: each row an input, the exit status, and words of the one line that is printed.

Nothing is half-written and nothing is lost: where a command fails, the folder is as it was.
"""

import json
import os
import struct
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile

import lipwright
from lipwright.animation import Animation
from lipwright.cli import main
from lipwright.engines.bigram.set_file import DATA
from lipwright.speech import Speech
from tests.conftest import LINE

RATE = 16000
SOURCE = Path(lipwright.__file__).parents[1]
SECOND = np.zeros(RATE)


@pytest.fixture(scope="module")
def samples(spoken: Speech) -> np.ndarray:
    """The sentence at 16 kHz."""
    assert spoken.sound is not None
    return spoken.sound.resampled(RATE).samples.astype(np.float64)


def fails(
    capsys: pytest.CaptureFixture[str], folder: Path, *arguments: object, status: int = 1
) -> str:
    """Run a command that must fail; return its one line. The folder must stay as it was."""
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert main([str(argument) for argument in arguments]) == status
    captured = capsys.readouterr()
    assert captured.out == ""
    after = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    assert after == before
    if status == 1:
        assert captured.err.count("\n") == 1, captured.err
        assert captured.err.startswith("lipwright: ")
    return captured.err


# ---- sounds that cannot be used -----------------------------------------------------------


def write_bytes(data: bytes) -> Callable[[Path], object]:
    return lambda path: path.write_bytes(data)


def write_sound(sound: np.ndarray, rate: int = RATE, **how: Any) -> Callable[[Path], object]:
    return lambda path: soundfile.write(path, sound, rate, **how)


NOISE = np.random.default_rng(1).normal(0, 0.1, RATE // 20)
BAD_SOUNDS: dict[str, tuple[Callable[[Path], object], str]] = {
    "missing": (Path.exists, "no such file"),
    "empty": (write_bytes(b""), "empty"),
    "text": (write_bytes(b"Dear reader, this is no sound.\n" * 9), "sound"),
    "folder": (lambda path: path.mkdir(), "folder"),
    "no samples": (write_sound(SECOND[:0]), "0 samples"),
    "50 ms": (write_sound(NOISE), "line.wav"),
    "silence": (write_sound(SECOND), "silen"),
}


@pytest.mark.parametrize("name", BAD_SOUNDS)
@pytest.mark.parametrize("way", [("--text", "she had your dark suit"), ()])
def test_sounds_that_cannot_be_used(
    name: str, way: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    make, words = BAD_SOUNDS[name]
    sound = tmp_path / "line.wav"
    make(sound)
    message = fails(capsys, tmp_path, "animate", sound, *way, "-o", tmp_path / "a.json")
    assert words in message
    assert "line.wav" in message


# ---- sounds that are unusual and must work ------------------------------------------------


def header_of_unknown_length(samples: np.ndarray) -> bytes:
    data = (samples * 32767).astype("<i2").tobytes()
    head = b"RIFF" + struct.pack("<I", 0xFFFFFFFF) + b"WAVEfmt "
    head += struct.pack("<IHHIIHH", 16, 1, 1, RATE, 2 * RATE, 2, 16)
    return head + b"data" + struct.pack("<I", 0xFFFFFFFF) + data


def cut_short(path: Path, samples: np.ndarray) -> None:
    soundfile.write(path, np.concatenate((samples, SECOND, samples)), RATE)
    data = path.read_bytes()
    path.write_bytes(data[: 44 + 2 * (len(samples) + RATE // 2)])


def resampled(samples: np.ndarray, rate: int) -> np.ndarray:
    from lipwright.sound import Sound

    sound = Sound(samples.astype(np.float32), RATE).resampled(rate)
    return sound.samples.astype(np.float64)


GOOD_SOUNDS: dict[str, Callable[[Path, np.ndarray], object]] = {
    "8 kHz": lambda p, s: soundfile.write(p, resampled(s, 8000), 8000),
    "96 kHz, 24 bit": lambda p, s: soundfile.write(p, resampled(s, 96000), 96000, subtype="PCM_24"),
    "stereo": lambda p, s: soundfile.write(p, np.stack((s, 0.5 * s), axis=1), RATE),
    "float": lambda p, s: soundfile.write(p, s, RATE, subtype="FLOAT"),
    "float, too loud": lambda p, s: soundfile.write(p, 3 * s, RATE, subtype="FLOAT"),
    "quiet": lambda p, s: soundfile.write(p, 0.01 * s, RATE),
    "piped": lambda p, s: p.write_bytes(header_of_unknown_length(s)),
    "cut": cut_short,
    "mp3 named wav": lambda p, s: soundfile.write(p, s, RATE, format="MP3"),
    "flac named wav": lambda p, s: soundfile.write(p, s, RATE, format="FLAC"),
}


@pytest.mark.parametrize("name", GOOD_SOUNDS)
def test_unusual_sounds_work(
    name: str, samples: np.ndarray, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sound = tmp_path / "une ligne à moi.wav"
    GOOD_SOUNDS[name](sound, samples)
    output = tmp_path / "a.json"
    assert main(["animate", str(sound), "--text", LINE, "-o", str(output)]) == 0
    animation = Animation.load(output)
    assert animation.words.labels[-1] == "year"
    # Whatever the file, the words are where they were spoken: within 0.08 s.
    expected = animation_of(samples, tmp_path)
    for word, same in zip(animation.words, expected.words, strict=True):
        assert word.start == pytest.approx(same.start, abs=0.08), word.label


def animation_of(samples: np.ndarray, folder: Path) -> Animation:
    plain = folder / "plain.wav"
    soundfile.write(plain, samples, RATE)
    assert main(["animate", str(plain), "--text", LINE, "-o", str(folder / "plain.json")]) == 0
    return Animation.load(folder / "plain.json")


def test_half_an_hour_with_its_labels(samples: np.ndarray, tmp_path: Path) -> None:
    line = resampled(samples, 8000)
    count = int(1800 * 8000 / len(line))
    sound = tmp_path / "long.wav"
    soundfile.write(sound, np.tile(line, count), 8000)
    length = len(line) / 8000
    rows = [(i * length, length) for i in range(count)]
    labels = "".join(f"{s:.4f}\t{s + 0.5 * d:.4f}\taa\n" for s, d in rows)
    (tmp_path / "long.txt").write_text(labels)
    arguments = ["animate", str(sound), "--labels", str(tmp_path / "long.txt"), "--rate", "30"]
    assert main([*arguments, "-o", str(tmp_path / "a.json")]) == 0
    animation = Animation.load(tmp_path / "a.json")
    assert animation.duration == pytest.approx(count * length, abs=0.5)
    assert animation.at([rows[-1][0] + 0.25 * length])[0, 0] > 0.3


def test_minutes_are_aligned_piece_by_piece(samples: np.ndarray, tmp_path: Path) -> None:
    """Half an hour takes the same way: ``python -m bench aligning`` measures it."""
    count = 30
    sound = tmp_path / "minutes.wav"
    soundfile.write(sound, np.tile(samples, count), RATE)
    arguments = ["animate", str(sound), "--text", " ".join([LINE] * count), "-o"]
    assert main([*arguments, str(tmp_path / "a.json")]) == 0
    animation = Animation.load(tmp_path / "a.json")
    length = len(samples) / RATE
    first = [word.start for word in animation.words][:: len(LINE.split())]
    assert len(animation.words) == count * len(LINE.split())
    assert np.diff(first) == pytest.approx(length, abs=0.1)


def test_sound_comes_through_a_pipe(samples: np.ndarray, tmp_path: Path) -> None:
    command = [sys.executable, "-m", "lipwright", "animate", "-", "--text", LINE, "-o", "-"]
    run = subprocess.run(command, input=header_of_unknown_length(samples), capture_output=True)
    assert run.returncode == 0
    assert Animation.from_bytes(run.stdout).control("open").max() > 0.2


# ---- words ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "said", "aligned"),
    [
        ("", "nothing to say", "text is empty"),
        ("   \n", "nothing to say", "text is empty"),
        ("?! …", "nothing to say", "no words in"),
        ("你好，世界", "你", "你"),
        ("Привет, мир", "П", "П"),
    ],
)
def test_texts_that_cannot_be_spoken(
    text: str,
    said: str,
    aligned: str,
    line_wav: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    output = tmp_path / "a.json"
    assert said in fails(capsys, tmp_path, "say", text, "-o", output)
    message = fails(capsys, tmp_path, "animate", line_wav, "--text", text, "-o", output)
    assert aligned in message


def test_control_characters_are_dropped(line_wav: Path, tmp_path: Path) -> None:
    text = LINE.replace(" dark", "\x07 dark\x00\x1b").replace(" all", "\u200b\n\tall")
    for command in (["say", text], ["animate", str(line_wav), "--text", text]):
        assert main([*command, "-o", str(tmp_path / "a.json")]) == 0
        words = Animation.load(tmp_path / "a.json").words.labels
        assert [word.strip(".").lower() for word in words] == LINE.lower().strip(".").split()


def test_words_that_are_not_spoken_are_told(
    line_wav: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wrong = "Seven thousand purple elephants vacuum my cousin's kitchen floor"
    notes = []
    for text in (LINE, wrong):
        assert main(["animate", str(line_wav), "--text", text, "-o", str(tmp_path / "a.json")]) == 0
        notes.append(capsys.readouterr().err)
    assert notes[0] == ""
    assert "words" in notes[1]


def test_noise_with_words_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    noise = np.random.default_rng(2).normal(0, 0.1, 3 * RATE)
    soundfile.write(tmp_path / "noise.wav", noise, RATE)
    arguments = ["animate", str(tmp_path / "noise.wav"), "--text", LINE, "-o"]
    status = main([*arguments, str(tmp_path / "a.json")])
    told = capsys.readouterr().err
    assert status in (0, 1)
    assert told.count("\n") == 1
    assert "noise.wav" in told if status else "words" in told


def test_unknown_voice_and_silly_speed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "a.json"
    assert "voice" in fails(capsys, tmp_path, "say", "Hi", "--voice", "atlantean", "-o", output)
    assert "80 to 450" in fails(capsys, tmp_path, "say", "Hi", "--speed", "9000", "-o", output)
    assert "frames" in fails(capsys, tmp_path, "say", "Hi", "--rate", "0", "-o", output)


BAD_LANGUAGES = {
    "unknown": ("xyz", "Hallo", "no language 'xyz'"),
    "another script": ("de", "Привет мир", "Choose one that does: --language ru"),
    "mixed scripts": ("ar", "مرحبا Привет", "does not read Cyrillic"),
    "nothing to say": ("fr", "…", "nothing to say"),
    "too long a text": ("it", "parole " * 200, "too short for 200 words"),
}


@pytest.mark.parametrize("name", BAD_LANGUAGES)
def test_languages_that_do_not_go_with_the_text(
    name: str, line_wav: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    language, text, words = BAD_LANGUAGES[name]
    given = ("--text", text, "--language", language, "-o", tmp_path / "a.json")
    assert words in fails(capsys, tmp_path, "animate", line_wav, *given)


# ---- outputs ---------------------------------------------------------------------------------


def test_outputs_that_cannot_be_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def say(*outputs: object) -> str:
        arguments = [part for output in outputs for part in ("-o", output)]
        return fails(capsys, tmp_path, "say", "Hi", *arguments)

    assert "nowhere" in say(tmp_path / "nowhere" / "a.json")
    assert "'.xyz'" in say(tmp_path / "a.xyz")
    assert ".json" in say(tmp_path / "a")
    assert "twice" in say(tmp_path / "a.json", tmp_path / "." / "a.json")
    (tmp_path / "old.json").write_text("precious")
    (tmp_path / "old.json").chmod(0o444)
    assert "read-only" in say(tmp_path / "old.json", tmp_path / "new.csv")
    assert "suffix" in say(tmp_path)

    def full(descriptor: int) -> None:
        raise OSError(28, os.strerror(28))

    monkeypatch.setattr(os, "fsync", full)
    assert "disk is full" in say(tmp_path / "a.json")


def test_wrong_usage_is_status_2(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for arguments in (
        ("say", "Hi"),
        ("say", "Hi", "-o", tmp_path / "a.json", "--colour", "red"),
        ("speek", "Hi"),
        ("animate", "a.wav", "--text", "a", "--labels", "b.lab", "-o", tmp_path / "a.json"),
        ("say", "Hi", "-o", tmp_path / "a.json", "--engine", "steam"),
        ("animate", "a.wav", "--language", "de", "-o", tmp_path / "a.json"),
        ("phones", "a.wav", "--labels", "b.lab", "--language", "de", "-o", tmp_path / "a.lab"),
    ):
        assert "Error" in fails(capsys, tmp_path, *arguments, status=2)


def test_nobodys_sound_is_written_over(
    line_wav: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    actor = tmp_path / "take.wav"
    actor.write_bytes(line_wav.read_bytes())
    message = fails(capsys, tmp_path, "say", "Hi", "-o", tmp_path / "take.json")
    assert "take.wav" in message
    assert "not a sound that Lipwright made" in message
    arguments = ("animate", actor, "--text", LINE, "-o", actor)
    assert "over its own input" in fails(capsys, tmp_path, *arguments)
    # What say made itself is made anew without a word.
    for _ in range(2):
        assert main(["say", "Hi", "-o", str(tmp_path / "other.json")]) == 0


def test_several_outputs_are_all_or_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.json").write_text("old")
    sync, count = os.fsync, [0]

    def full_at_the_third(descriptor: int) -> None:
        count[0] += 1
        if count[0] == 3:
            raise OSError(28, os.strerror(28))
        sync(descriptor)

    monkeypatch.setattr(os, "fsync", full_at_the_third)
    outputs = [part for name in ("a.json", "b.csv", "c.glb") for part in ("-o", tmp_path / name)]
    assert "disk is full" in fails(capsys, tmp_path, "say", "Hi", *outputs)


def shell(
    command: str, data: bytes = b"", **environment: str
) -> subprocess.CompletedProcess[bytes]:
    line = command.replace("lipwright", f'"{sys.executable}" -m lipwright')
    where = {**os.environ, **environment}
    return subprocess.run(line, shell=True, input=data, capture_output=True, env=where)


@pytest.mark.parametrize(
    ("command", "status", "words"),
    [
        ("lipwright set show f-ah", 0, b""),
        ("lipwright set show f-ah >&-", 0, b""),
        ("lipwright set coverage --json >/dev/full", 1, b"No space left"),
        ("lipwright --help >/dev/full", 1, b"No space left"),
        ("lipwright say - -o - <&-", 1, b"standard input"),
        ("lipwright animate - --text a -o - <&-", 1, b"standard input"),
        ("cd gone && rmdir ../gone && lipwright say hi -o x.json", 1, b"lipwright: "),
    ],
)
def test_streams_that_fail_are_one_line(
    command: str, status: int, words: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path)
    run = shell(command, PYTHONIOENCODING="cp1252", PYTHONPATH=str(SOURCE))
    assert run.returncode == status
    assert words in run.stderr
    assert run.stderr.count(b"\n") == (1 if status else 0)


def test_piped_text_must_be_text(tmp_path: Path) -> None:
    run = shell(f'lipwright say - -o "{tmp_path / "a.json"}"', b"caf\xe9 hello")
    assert run.returncode == 1
    assert b"standard input: byte 3 is not UTF-8" in run.stderr


def test_what_was_mended_in_a_sound_is_told(
    samples: np.ndarray, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sound = tmp_path / "cut.wav"
    cut_short(sound, samples)
    assert main(["animate", str(sound), "--text", LINE, "-o", str(tmp_path / "a.json")]) == 0
    assert "the file was cut" in capsys.readouterr().err


def test_a_silly_sample_rate_is_refused(
    samples: np.ndarray, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sound = tmp_path / "slow.wav"
    soundfile.write(sound, samples, 1)
    message = fails(capsys, tmp_path, "animate", sound, "--text", "a", "-o", tmp_path / "a.json")
    assert "1 samples per second" in message


# ---- sets and characters ---------------------------------------------------------------------


def english() -> dict[str, Any]:
    content: dict[str, Any] = json.loads((DATA / "english.json").read_bytes())
    return content


def nan_key(content: dict[str, Any]) -> None:
    content["bigrams"][0]["curves"]["open"][1][1] = float("nan")


def twice(content: dict[str, Any]) -> None:
    content["bigrams"].append(content["bigrams"][7])


def no_curves(content: dict[str, Any]) -> None:
    content["bigrams"] = []
    content["phones"] = {}


def unknown_pose(content: dict[str, Any]) -> None:
    content["bigrams"][0]["curves"]["smirk"] = [[0, 0], [0.5, 1], [1, 0]]


def future(content: dict[str, Any]) -> None:
    content["version"] = 99


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (nan_key, "the number NaN"),
        (twice, "twice"),
        (unknown_pose, "unknown pose 'smirk'"),
        (future, "newer Lipwright"),
    ],
)
def test_sets_that_are_broken(
    change: Callable[[dict[str, Any]], None],
    words: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    content = english()
    change(content)
    path = tmp_path / "my set.json"
    path.write_text(json.dumps(content))
    message = fails(capsys, tmp_path, "say", "Hi", "--set", path, "-o", tmp_path / "a.json")
    assert words in message
    assert "my set.json" in message


def test_a_set_without_curves_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    content = english()
    no_curves(content)
    path = tmp_path / "empty.json"
    path.write_text(json.dumps(content))
    assert main(["say", "Pa", "--set", str(path), "-o", str(tmp_path / "a.json")]) == 0
    assert "no curve at all for aa bmp" in capsys.readouterr().err


def test_a_copied_set_of_the_same_name_is_not_taken_for_the_other(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    content = english()
    content["bigrams"] = [b for b in content["bigrams"] if "bmp" not in b["pair"]]
    path = tmp_path / "copy.json"
    path.write_text(json.dumps(content))
    line = tmp_path / "a.json"
    assert main(["say", "Papa", "--set", str(path), "-o", str(line)]) == 0
    capsys.readouterr()
    assert "--set" in fails(capsys, tmp_path, "set", "why", line, "--time", "0.3")
    assert "outside" in fails(capsys, tmp_path, "set", "why", line, "--time", "nan", "--set", path)
    assert main(["set", "why", str(line), "--time", "0.3", "--set", str(path)]) == 0
    assert "stand-in" in capsys.readouterr().out


def glb(content: dict[str, Any]) -> bytes:
    text = json.dumps(content).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text


PLAIN = {"asset": {"version": "2.0"}, "meshes": [{"primitives": [{"attributes": {}}]}]}


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (glb(PLAIN), "morph"),
        (glb(PLAIN)[:-30], "model.glb"),
        (b"glTF", "model.glb"),
        (b"", "empty"),
        (b"not a model at all", "model.glb"),
    ],
)
def test_models_that_cannot_speak(
    data: bytes, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = tmp_path / "model.glb"
    model.write_bytes(data)
    output = tmp_path / "a.glb"
    assert words in fails(capsys, tmp_path, "say", "Hi", "--character", model, "-o", output)
    assert words in fails(capsys, tmp_path, "character", "inspect", model)


def test_animations_that_why_cannot_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "line.json"
    path.write_text('{"format": "lipwright/animation", "version": 7}')
    assert "newer" in fails(capsys, tmp_path, "set", "why", path, "--time", "0")
    path.write_text('{"format": "lipwright/animation", "ver')
    assert "broken JSON" in fails(capsys, tmp_path, "set", "why", path, "--time", "0")
    assert "'f-zz'" in fails(capsys, tmp_path, "set", "show", "f-zz")
