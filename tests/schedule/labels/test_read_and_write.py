"""Every format: what is written is read again, whatever the file is called."""

import json
from pathlib import Path

import numpy as np
import pytest
from praatio import textgrid as praat

from lipwright.animation import Animation
from lipwright.errors import FileFormatError, InputError, LabelError
from lipwright.phones import SILENCE
from lipwright.schedule.labels import WRITERS, read_labels, speech_from_labels, write_labels
from lipwright.sound import Sound
from tests.schedule.labels.speeches import PHONES, SPEECH, WORDS, plain

KEEPS_WORDS = (".textgrid", ".lab", ".json")


@pytest.mark.parametrize("suffix", WRITERS)
def test_what_is_written_is_read_again(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"ein Löwe{suffix}"
    path.write_bytes(write_labels(SPEECH, suffix))
    labels = read_labels(path)
    assert labels.phones.phone_set == "arpabet"
    silent = suffix == ".txt"
    kept = [row for row in plain(PHONES) if not (silent and row[0] == SILENCE)]
    assert plain(labels.phones.tier) == kept
    assert plain(labels.words) == (plain(WORDS) if suffix in KEEPS_WORDS else [])


@pytest.mark.parametrize("suffix", [".lab", ".ctm", ".json"])
def test_confidences_come_back_where_the_format_has_them(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"a{suffix}"
    path.write_bytes(write_labels(SPEECH, suffix))
    assert [i.confidence for i in read_labels(path).phones] == [i.confidence for i in PHONES]


def test_our_json_keeps_everything_to_the_last_bit(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_bytes(write_labels(SPEECH, ".json"))
    speech = speech_from_labels(tmp_path / "a.json")
    for name in ("phones", "words", "text", "language", "confidence"):
        assert getattr(speech, name) == getattr(SPEECH, name), name
    assert speech.source == "labels"


def test_the_phones_inside_an_animation_are_labels(tmp_path: Path) -> None:
    animation = Animation(
        ("open",), np.zeros((2, 1), np.float32), 25.0, phones=SPEECH.phones, words=SPEECH.words
    )
    animation.save(tmp_path / "a.json")
    labels = read_labels(tmp_path / "a.json")
    assert labels.phones == SPEECH.phones
    assert labels.words == SPEECH.words


@pytest.mark.parametrize("suffix", [".TextGrid", ".json", ".ctm", ".lab"])
@pytest.mark.parametrize("name", ["a.txt", "a", "a.wav"])
def test_the_content_decides_where_the_suffix_does_not(
    suffix: str, name: str, tmp_path: Path
) -> None:
    (tmp_path / name).write_bytes(write_labels(SPEECH, suffix))
    assert plain(read_labels(tmp_path / name).phones.tier) == plain(PHONES)


def test_praat_reads_our_textgrid_as_we_do(tmp_path: Path) -> None:
    path = tmp_path / "a.TextGrid"
    path.write_bytes(write_labels(SPEECH, ".TextGrid"))
    read = praat.openTextgrid(str(path), includeEmptyIntervals=True)
    assert read.tierNames == ("words", "phones")
    assert [
        (label or SILENCE, start, end) for start, end, label in read.getTier("phones").entries
    ] == plain(PHONES)


@pytest.mark.parametrize("kind", ["long_textgrid", "short_textgrid"])
def test_we_read_what_praatio_writes(kind: str, tmp_path: Path) -> None:
    path = tmp_path / "a.TextGrid"
    made = praat.Textgrid()
    for name, tier in (("words", WORDS), ("phones", PHONES)):
        entries = [(start, end, label) for label, start, end in plain(tier)]
        made.addTier(praat.IntervalTier(name, entries, 0, 1))
    made.save(str(path), format=kind, includeBlankSpaces=True)
    labels = read_labels(path)
    assert plain(labels.phones.tier) == plain(PHONES)
    assert plain(labels.words) == plain(WORDS)


def test_an_unknown_suffix_is_not_written() -> None:
    with pytest.raises(InputError, match=r"'\.srt' names no label format; expected one of \.text"):
        write_labels(SPEECH, ".srt")


BROKEN = {
    "empty": (b" \n", r"a\.lab: is empty; expected a label file"),
    "bytes": (bytes(range(256)), r"a\.lab: is not text"),
    "prose": (b"Hello there, this is no label file.\n", r"line 1 column 1: 'Hello' is not a time"),
    "only silence": (b"0.0 1.0 sil\n", r"a\.lab: no phones but silence"),
    "unknown": (
        b"0.0 0.1 aa\n0.1 0.2 xx\n0.2 0.3 yyy\n0.3 0.4 xx\n",
        r"a\.lab: 'xx', 'yyy': not phones of 'arpabet'\. Check their spelling, or name the phone",
    ),
    "words": (
        b"0.0 0.3 hello\n0.3 0.6 there\n0.6 0.9 friend\n",
        r"not phones of.*These look like words: give the words as text",
    ),
    "unsorted": (
        b"0.5 0.9 aa\n0.1 0.5 p\n",
        r"a\.lab, line 2: 'p' \(0\.1 to 0\.5 s\) starts before 'aa' \(0\.5 to 0\.9 s\)",
    ),
    "overlap": (
        b"0.0 0.2 p\n0.15 0.4 aa\n",
        r"a\.lab, line 2: 'aa' \(0\.15 to 0\.4 s\) overlaps 'p' \(0 to 0\.2 s\)",
    ),
    "zero length": (
        b"0.0 0.2 p\n0.2 0.2 aa\n",
        r"a\.lab, line 2: 'aa' runs from 0\.2 to 0\.2 s; expected an end after its start",
    ),
    "negative": (b"-3.0 0.2 p\n", r"a\.lab, line 1: 'p' starts at -3 s; expected times from 0"),
    "comma": (b"0.0 0,2 p\n", r"line 1 column 5: '0,2' is not a time.*Write decimals with a point"),
    "nan": (b"0.0 nan p\n", r"'nan' is not a time"),
    "samples": (b"0 2000 p\n2000 5000 aa\n", r"that end at 5000; .*If these are samples, give"),
    "no label": (b"0.0 0.2\n", r"a\.lab, line 1: a line without a label"),
    "one column": (b"0.0\n", r"a\.lab, line 1: 1 columns; expected at least 3"),
}


@pytest.mark.parametrize(("data", "words"), BROKEN.values(), ids=BROKEN)
def test_a_broken_file_says_what_and_where(data: bytes, words: str, tmp_path: Path) -> None:
    (tmp_path / "a.lab").write_bytes(data)
    with pytest.raises(LabelError, match=words):
        read_labels(tmp_path / "a.lab")


def test_what_fits_no_format_names_the_formats(tmp_path: Path) -> None:
    (tmp_path / "notes.md").write_text("Hello there, this is no label file.")
    with pytest.raises(LabelError, match=r"no label format fits; expected .*\.textgrid \.lab"):
        read_labels(tmp_path / "notes.md")


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"a\.lab: no such file"):
        read_labels(tmp_path / "a.lab")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"version": 2}, r"a\.json: lipwright/speech version 2; .*newer Lipwright"),
        ({"format": "lipwright/bigram-set"}, "a file of format 'lipwright/bigram-set'"),
        ({"phonez": []}, "unknown field `phonez`"),
        ({"phones": [["aa", 0, 1], ["b", 1]]}, r"a\.json, at phones\[1\]: the row \['b', 1"),
        ({"phones": [["aa", 1, 0]]}, r"a\.json, at phones\[0\]: 'aa' runs from 1 to 0 s"),
        (
            {"phones": [["aa", 0, 1], ["b", 0.5, 2]]},
            r"a\.json, at phones\[1\]: 'b' \(0\.5 to 2 s\) overlaps 'aa'",
        ),
        ({"phones": [["xx", 0, 1]]}, "'xx': not phones of 'arpabet'"),
        ({"phone_set": "klingon"}, "no phone set 'klingon'"),
    ],
)
def test_our_broken_json_names_its_place(
    change: dict[str, object], words: str, tmp_path: Path
) -> None:
    path = tmp_path / "a.json"
    path.write_text(json.dumps({**json.loads(write_labels(SPEECH, ".json")), **change}))
    with pytest.raises((LabelError, FileFormatError), match=words):
        read_labels(path)


# Beside a sound


def sound(seconds: float, rate: int = 16000) -> Sound:
    return Sound(np.zeros(round(seconds * rate), np.float32), rate, ("a note",))


def test_labels_and_their_sound_are_speech(tmp_path: Path) -> None:
    (tmp_path / "a.lab").write_bytes(write_labels(SPEECH, ".lab"))
    speech = speech_from_labels(tmp_path / "a.lab", sound(1.0))
    assert speech.sound is not None
    assert speech.text == "pa 1984"
    assert speech.notes == ("a note",)
    assert plain(speech.phones.tier) == plain(PHONES)


@pytest.mark.parametrize(
    ("scale", "seconds", "rate", "words"),
    [
        (1.0, 0.95, 16000, None),
        (
            1.0,
            0.85,
            16000,
            r"the labels end at 1 s, the sound at 0\.85 s.*Check that they belong together",
        ),
        (1000.0, 1.0, 16000, "The times look like milliseconds: divide them by 1000"),
        (16000.0, 1.0, 44100, "The times look like samples: give their rate"),
        (44100.0, 1.0, 44100, "The times look like samples: give their rate"),
        (0.0048, 1.0, 48000, "The times look like samples: give their rate"),
        (44100 / 16000, 1.0, 44100, "The samples may be counted at another rate: give it"),
        (1.0, 100.0, 16000, "Check that they belong together"),
    ],
)
def test_times_that_do_not_fit_the_sound_are_refused_with_a_guess(
    scale: float, seconds: float, rate: int, words: str | None, tmp_path: Path
) -> None:
    path = tmp_path / "a.lab"
    path.write_text(f"0.0 {0.5 * scale!r} p\n{0.5 * scale!r} {scale!r} aa\n")
    if words is None:
        assert speech_from_labels(path, sound(seconds, rate)).phones.tier.end == 1.0
    else:
        with pytest.raises(LabelError, match=words):
            speech_from_labels(path, sound(seconds, rate))
