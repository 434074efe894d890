"""Sound files: every kind that people have, and every way in which one is broken."""

import io
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from lipwright.errors import InputError, LipwrightError, MissingExtraError, SoundError
from lipwright.sound_files import read_sound

RATE = 16000


def tone(rate: int = RATE, seconds: float = 1.0) -> NDArray[np.float64]:
    return 0.5 * np.sin(2 * np.pi * 440 * np.arange(round(rate * seconds)) / rate)


def encoded(
    samples: NDArray[Any], rate: int = RATE, kind: str = "WAV", subtype: str | None = None
) -> bytes:
    written = io.BytesIO()
    soundfile.write(written, samples, rate, format=kind, subtype=subtype)
    return written.getvalue()


def with_lengths(riff: int, data: int) -> bytes:
    """Return a piped WAV: a good one with other lengths in its header."""
    good = encoded(tone())
    lengths = [length.to_bytes(4, "little") for length in (riff, data)]
    return good[:4] + lengths[0] + good[8:40] + lengths[1] + good[44:]


GOOD = {
    "8 kHz": lambda: encoded(tone(8000), 8000),
    "24 bits": lambda: encoded(tone(), subtype="PCM_24"),
    "8 bits": lambda: encoded(tone(), subtype="PCM_U8"),
    "32-bit float": lambda: encoded(tone(), subtype="FLOAT"),
    "64-bit float": lambda: encoded(tone(), subtype="DOUBLE"),
    "mu-law": lambda: encoded(tone(), subtype="ULAW"),
    "stereo": lambda: encoded(np.stack([tone(), tone()], axis=1)),
    "FLAC": lambda: encoded(tone(), kind="FLAC"),
    "Ogg Vorbis": lambda: encoded(tone(), kind="OGG"),
    "Opus": lambda: encoded(tone(), kind="OGG", subtype="OPUS"),
    "MP3": lambda: encoded(tone(), kind="MP3"),
    "AIFF": lambda: encoded(tone(), kind="AIFF"),
    "RF64": lambda: encoded(tone(), kind="RF64"),
    "piped, 0xFFFFFFFF": lambda: with_lengths(0xFFFFFFFF, 0xFFFFFFFF),
    "piped, 0x7FFFFFFF": lambda: with_lengths(0x7FFFFFFF, 0x7FFFFFFF),
    "piped, sox": lambda: with_lengths(0x7FFFF024, 0x7FFFF000),
    "piped, 0": lambda: with_lengths(0, 0),
    "piped, data 0": lambda: with_lengths(36, 0),
}


@pytest.mark.parametrize("make", GOOD.values(), ids=GOOD)
def test_the_content_decides_and_never_the_name(make: Callable[[], bytes], tmp_path: Path) -> None:
    path = tmp_path / "Müllers Satz 1.wav"
    path.write_bytes(make())
    sound = read_sound(path)
    assert sound.samples.dtype == np.float32
    assert sound.samples.ndim == 1
    wanted = tone(sound.rate)
    assert len(sound.samples) == len(wanted)
    assert np.corrcoef(sound.samples, wanted)[0, 1] > 0.99
    assert sound.notes == ()


def test_high_rates_come_down_while_reading(tmp_path: Path) -> None:
    path = tmp_path / "studio.wav"
    path.write_bytes(encoded(np.stack([tone(96000)] * 2, axis=1), 96000, subtype="PCM_24"))
    sound = read_sound(path)
    assert sound.rate == 48000
    assert abs(len(sound.samples) - 48000) <= 1
    inner = slice(500, 47500)
    assert np.abs(sound.samples[inner] - tone(48000)[inner]).max() < 0.001
    assert read_sound(path, highest_rate=96000).rate == 96000


def test_channels_are_mixed_to_their_mean(tmp_path: Path) -> None:
    path = tmp_path / "a.wav"
    path.write_bytes(encoded(np.stack([tone(), 0 * tone()], axis=1), subtype="FLOAT"))
    np.testing.assert_allclose(read_sound(path).samples, 0.5 * tone(), atol=1e-6)


def test_mp3_has_no_seams_between_blocks(tmp_path: Path) -> None:
    path = tmp_path / "a.mp3"
    path.write_bytes(encoded(tone(seconds=4.0), kind="MP3"))
    whole, _ = soundfile.read(path, dtype="float32")
    np.testing.assert_allclose(read_sound(path).samples, whole, atol=1e-4)


@pytest.mark.parametrize("samples", [np.zeros(8000), np.full(8000, 0.3), tone(seconds=0.05)])
def test_silence_a_constant_and_a_blink_are_sound(
    samples: NDArray[np.float64], tmp_path: Path
) -> None:
    path = tmp_path / "a.wav"
    path.write_bytes(encoded(samples, subtype="FLOAT"))
    np.testing.assert_allclose(read_sound(path).samples, samples, atol=1e-6)


def test_floats_beyond_one_are_scaled_as_a_whole_and_said(tmp_path: Path) -> None:
    path = tmp_path / "a.wav"
    path.write_bytes(encoded(tone() * 65536, subtype="FLOAT"))
    sound = read_sound(path)
    np.testing.assert_allclose(sound.samples, tone() / np.abs(tone()).max(), atol=1e-6)
    assert sound.notes == ("its samples reach 3.277e+04: scaled as a whole to fit -1..1",)


def noise() -> NDArray[np.float64]:
    return np.random.default_rng(1).normal(0, 0.1, 5 * RATE)


CUT = {
    "WAV": (lambda: encoded(noise())[: RATE * 2 + 44], 1.0, "it holds 20% of what its header says"),
    "odd byte": (lambda: encoded(noise())[: RATE * 2 + 45], 1.0, "it holds 20%"),
    "FLAC": (lambda: encoded(noise(), kind="FLAC")[:80_000], 2.0, "could be read"),
    "MP3": (lambda: encoded(noise(), kind="MP3")[:10_000], 1.0, "could be read"),
}


@pytest.mark.parametrize(("make", "least", "words"), CUT.values(), ids=CUT)
def test_a_cut_file_gives_what_it_has_and_says_so(
    make: Callable[[], bytes], least: float, words: str, tmp_path: Path
) -> None:
    path = tmp_path / "cut.wav"
    path.write_bytes(make())
    sound = read_sound(path)
    assert least <= sound.duration < 5.0
    assert len(sound.notes) == 1
    assert "was cut" in sound.notes[0]
    assert words in sound.notes[0]


def with_sample(value: float) -> bytes:
    samples = tone()
    samples[8000] = value
    return encoded(samples, subtype="FLOAT")


BAD = {
    "empty": (lambda: b"", r"a\.wav: is empty; expected a sound file"),
    "text": (lambda: b"Hello, world.\n", r"a\.wav: is text, not sound; expected WAV, FLAC, Ogg"),
    "accents": (lambda: "Grüße\n".encode() * 99, "is text, not sound"),
    "bytes": (lambda: bytes(range(256)) * 4, "is not a sound file that can be read"),
    "header only": (lambda: encoded(tone())[:44], "0 samples; expected a file with sound in it"),
    "half a header": (lambda: encoded(tone())[:30], "is broken: its header is not whole"),
    "0 samples": (lambda: encoded(np.zeros(0)), "0 samples"),
    "0 samples and a tag": (
        lambda: (
            encoded(np.zeros(0))[:4]
            + b"\x30\0\0\0"
            + encoded(np.zeros(0))[8:]
            + b"LIST\4\0\0\0INFO"
        ),
        "0 samples",
    ),
    "NaN": (lambda: with_sample(np.nan), r"the sample at 0\.5000 s is nan; expected finite"),
    "infinity": (lambda: with_sample(-np.inf), r"the sample at 0\.5000 s is -inf"),
}


@pytest.mark.parametrize(("make", "words"), BAD.values(), ids=BAD)
def test_what_is_no_sound_says_what_it_is(
    make: Callable[[], bytes], words: str, tmp_path: Path
) -> None:
    (tmp_path / "a.wav").write_bytes(make())
    with pytest.raises(SoundError, match=words):
        read_sound(tmp_path / "a.wav")


def test_a_wild_header_prints_nothing_of_its_own(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    header = bytearray(encoded(tone(), kind="AIFF"))
    header[38] = 0xF0  # the length of a chunk: libsndfile seeks to before the file
    (tmp_path / "a.aiff").write_bytes(header)
    with pytest.raises(SoundError, match=r"a\.aiff: "):
        read_sound(tmp_path / "a.aiff")
    assert capfd.readouterr() == ("", "")


def test_raw_samples_are_refused_under_their_own_suffix_too(tmp_path: Path) -> None:
    (tmp_path / "a.raw").write_bytes(bytes(range(256)) * 4)
    with pytest.raises(SoundError, match="is not a sound file that can be read"):
        read_sound(tmp_path / "a.raw")


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("missing.wav", r"missing\.wav: no such file\. Check the path"),
        (".", "is a folder; expected a sound file"),
        ("a\0.wav", "null byte"),
    ],
)
def test_what_is_not_there_says_so(tmp_path: Path, name: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_sound(tmp_path / name)


@pytest.mark.parametrize("make", [GOOD["MP3"], GOOD["piped, 0"], GOOD["32-bit float"]])
def test_a_dash_reads_standard_input(make: Callable[[], bytes]) -> None:
    done = subprocess.run(
        [
            sys.executable,
            "-c",
            "from lipwright.sound_files import read_sound; print(read_sound('-').duration)",
        ],
        input=make(),
        capture_output=True,
        check=True,
    )
    assert float(done.stdout) == 1.0


def test_nothing_on_standard_input_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO()))
    with pytest.raises(SoundError, match="standard input: is empty"):
        read_sound("-")


# Media that only the extra decodes. Their encoder is GPL too: it runs beside, as ours does.

MAKE_MEDIA = """
import sys, av, numpy as np
tone = 0.5 * np.sin(2 * np.pi * 440 * np.arange(88200) / 44100)
with av.open(sys.argv[1], "w") as container:
    stream = container.add_stream("aac", rate=44100, layout="stereo")
    frame = av.AudioFrame.from_ndarray(np.stack([tone] * 2).astype("f4"), "fltp", "stereo")
    frame.rate, frame.pts = 44100, 0
    container.mux([*stream.encode(frame), *stream.encode(None)])
"""


@pytest.fixture(scope="session")
def media(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    made = {}
    for suffix in (".m4a", ".mkv"):
        path = tmp_path_factory.mktemp("media") / f"a{suffix}"
        subprocess.run([sys.executable, "-c", MAKE_MEDIA, str(path)], check=True)
        made[suffix] = path.read_bytes()
    return made


@pytest.mark.parametrize("suffix", [".m4a", ".mkv"])
def test_media_are_decoded_beside_under_any_name(
    media: dict[str, bytes], suffix: str, tmp_path: Path
) -> None:
    path = tmp_path / "ein Löwe.wav"
    path.write_bytes(media[suffix])
    sound = read_sound(path)
    assert sound.rate == 44100
    assert sound.duration == pytest.approx(2.0, abs=0.05)
    wanted = 0.5 * np.sin(2 * np.pi * 440 * np.arange(88200) / 44100)
    assert np.corrcoef(sound.samples[4410:80000], wanted[4410:80000])[0, 1] > 0.99
    assert "av" not in sys.modules


def test_cut_media_gives_what_it_has_or_one_line(media: dict[str, bytes], tmp_path: Path) -> None:
    (tmp_path / "cut.mkv").write_bytes(media[".mkv"][: len(media[".mkv"]) // 2])
    assert 0.5 < read_sound(tmp_path / "cut.mkv").duration < 1.5
    (tmp_path / "cut.m4a").write_bytes(media[".m4a"][: len(media[".m4a"]) // 2])
    with pytest.raises(SoundError, match=r"cut\.m4a: cannot be decoded \(Invalid data found"):
        read_sound(tmp_path / "cut.m4a")


def test_without_the_extra_the_line_to_type_is_named(
    media: dict[str, bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.m4a").write_bytes(media[".m4a"])
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(MissingExtraError, match=r"pip install 'lipwright\[av\]'") as caught:
        read_sound(tmp_path / "a.m4a")
    assert isinstance(caught.value, LipwrightError)
