"""Festival as a second synthesiser, where it is installed; it runs as its own program.

Its voices speak in the radio phone set, which is ARPAbet with other names. It reads
Latin letters only: accents are taken off, typographic signs made plain. The text goes
into its Scheme program as a string, never as code.
"""

from __future__ import annotations

import re
import shutil
import subprocess
import tempfile
import unicodedata
import wave
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import LabelError, LipwrightError, MissingExtraError, TextError
from lipwright.phones import load_phone_set
from lipwright.schedule.say.words import TimedPhone, Utterance

_PATIENCE = 120.0  # seconds
_USUAL_RATE = 175.0  # words per minute that a stretch of 1 stands for
_LONGEST_TEXT = 5_000  # characters; it holds a whole text in memory, several times
_PREFERRED = "slt"
_SIGNS = str.maketrans(
    {"‘": "'", "’": "'", "‛": "'", "“": '"', "”": '"', "„": '"', "«": '"', "»": '"'}
    | {"–": "-", "—": "-", "‐": "-", "‑": "-", "−": "-", "…": "...", "€": "euro "}
    | {"ß": "ss", "æ": "ae", "œ": "oe", "ø": "o", "ł": "l", "đ": "d", "ð": "th", "þ": "th"}
)

_PROGRAM = r"""
(define (lw_named name voices)
  (cond ((null? voices) nil)
        ((string-matches (car voices) (string-append ".*" name ".*")) (car voices))
        (t (lw_named name (cdr voices)))))
(set! lw_voice (lw_named "@VOICE@" (voice.list)))
(set! lw_out (fopen "@OUT@" "w"))
(if (null? lw_voice)
  (mapcar (lambda (v) (format lw_out "voice %s\n" v)) (voice.list))
  (begin
    (voice.select lw_voice)
    (Parameter.set 'Duration_Stretch @STRETCH@)
    (if (boundp 'hts_engine_params)
      (set! hts_engine_params (append hts_engine_params (list (list "-r" @SPEED@)))))
    (set! utt (Utterance Text @TEXT@))
    (utt.synth utt)
    (utt.save.wave utt "@WAVE@" 'riff)
    (set! lw_token (utt.relation.first utt 'Token))
    (set! lw_number 1)
    (while lw_token
      (item.set_feat lw_token "lw" lw_number)
      (format lw_out "token %s\n" (item.name lw_token))
      (set! lw_number (+ lw_number 1))
      (set! lw_token (item.next lw_token)))
    (mapcar
      (lambda (s)
        (format lw_out "phone %s %s %s\n" (item.name s) (item.feat s "end")
          (item.feat s "R:SylStructure.parent.parent.R:Token.parent.lw")))
      (utt.relation.items utt 'Segment))))
(fclose lw_out)
"""


@dataclass(frozen=True, slots=True, eq=False)
class Spoken:
    """What Festival spoke.

    Parameters
    ----------
    samples : (N,) float32
        The sound, in -1..1.
    rate : int
        Samples per second.
    phones : tuple of TimedPhone
        ARPAbet, silences included.
    """

    samples: NDArray[np.float32]
    rate: int
    phones: tuple[TimedPhone, ...]


def speak(utterance: Utterance, voice: str, *, rate: float) -> Spoken:
    """Return the sound and phones of an utterance that :func:`plain_utterance` made.

    Raises
    ------
    MissingExtraError
        If Festival is not installed.
    TextError
        If it has no such voice, or the text is too long for it.
    LipwrightError
        If it fails.
    """
    if len(utterance.spoken) > _LONGEST_TEXT:
        raise TextError(
            f"{len(utterance.spoken):,} characters",
            where="the text",
            expected=f"at most {_LONGEST_TEXT:,} for Festival",
            cure="say it in parts, or with espeak",
        )
    if not re.fullmatch(r"\w*", voice, re.ASCII):
        raise TextError(f"no Festival voice {voice!r}", expected="a name such as 'slt'")
    with tempfile.TemporaryDirectory(prefix="lipwright-") as folder:
        sound, out = Path(folder) / "a.wav", Path(folder) / "a.txt"
        program = build_program(
            utterance.spoken, voice or _PREFERRED, stretch=_USUAL_RATE / rate, sound=sound, out=out
        )
        complaint = _run(program, Path(folder))
        report = out.read_text("latin-1") if out.exists() else ""
        if report.startswith("voice "):
            names = [line.split()[1] for line in report.splitlines()]
            raise TextError(f"no Festival voice {voice!r}", expected=f"one of {', '.join(names)}")
        if not sound.exists() or "phone " not in report:
            raise LipwrightError(f"Festival failed: {complaint or 'no word'}")
        samples, samples_per_second = _read_sound(sound)
        phones = parse_report(report, utterance.spoken, rate=samples_per_second, end=len(samples))
        return Spoken(samples, samples_per_second, phones)


def installed_voices() -> list[str]:
    """Return the names of Festival's voices; none where it is not installed."""
    if shutil.which("festival") is None:
        return []
    with tempfile.TemporaryDirectory(prefix="lipwright-") as folder:
        out = Path(folder) / "a.txt"
        nothing = build_program("", " ", stretch=1.0, sound=out.with_suffix(".wav"), out=out)
        _run(nothing, Path(folder))
        lines = out.read_text("latin-1").splitlines() if out.exists() else []
    return [line.split()[1] for line in lines]


def plain_utterance(utterance: Utterance) -> Utterance:
    """Return the utterance in plain Latin letters; the words stay as they were."""
    edges = [*utterance.starts, len(utterance.spoken)]
    parts = [_plain(utterance.spoken[start:end]) for start, end in pairwise(edges)]
    starts = [sum(map(len, parts[:index])) for index in range(len(parts))]
    return Utterance("".join(parts), utterance.words, tuple(starts))


def _plain(text: str) -> str:
    apart = unicodedata.normalize("NFKD", text.translate(_SIGNS))
    return "".join(
        character for character in apart if character in "\n£" or " " <= character <= "~"
    )


def build_program(text: str, voice: str, *, stretch: float, sound: Path, out: Path) -> str:
    """Return the Scheme program that speaks ``text`` and reports to ``out``."""
    values = {
        "VOICE": voice,
        "STRETCH": f"{stretch:.4f}",
        "SPEED": f"{1 / stretch:.4f}",  # what voices of the HTS kind obey instead
        "OUT": _escaped(str(out)),
        "WAVE": _escaped(str(sound)),
        "TEXT": f'"{_escaped(text)}"',
    }
    return re.sub(r"@([A-Z]+)@", lambda match: values[match.group(1)], _PROGRAM)


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')


def _run(program: str, folder: Path) -> str:
    """Run a program; return the last line of what Festival complains about."""
    festival = shutil.which("festival")
    if festival is None:
        raise MissingExtraError(
            "Festival is not installed",
            cure="type: apt-get install festival festvox-us-slt-hts, or leave --engine out",
        )
    path = folder / "program.scm"
    path.write_text(program, "latin-1", "replace")
    try:
        done = subprocess.run(
            [festival, "-b", str(path)],
            capture_output=True,
            timeout=_PATIENCE,
            check=False,
            stdin=subprocess.DEVNULL,
        )
    except subprocess.TimeoutExpired:
        raise LipwrightError(
            f"Festival did not answer within {_PATIENCE:g} s", cure="try a shorter text"
        ) from None
    lines = done.stderr.decode("latin-1").strip().splitlines()
    return next((line for line in lines if "ERROR" in line), lines[-1] if lines else "")


def parse_report(report: str, spoken: str, *, rate: int, end: int) -> tuple[TimedPhone, ...]:
    """Return the phones of a program's report, each with its place in the spoken text.

    Parameters
    ----------
    report : str
        Lines ``token NAME`` and ``phone NAME END TOKEN``, as the program writes them.
    spoken : str
        What was spoken.
    rate, end : int
        Samples per second, and how many there are: the last phone goes to the end.

    Raises
    ------
    LipwrightError
        If the voice speaks in phones that are not ARPAbet.
    """
    rows = [line.split() for line in report.splitlines()]
    places = _places([row[1] for row in rows if row[0] == "token" and len(row) > 1], spoken)
    segments = [row for row in rows if row[0] == "phone"]
    # Times are written as rounded floats: whole samples are meant.
    edges = [round(float(row[2]) * rate) for row in segments]
    edges[-1] = end
    phones: list[TimedPhone] = []
    start, place = 0, 0
    for row, edge in zip(segments, edges, strict=True):
        token = int(float(row[3]))
        place = places[token - 1] if token else place
        if edge > start:
            phones.append(TimedPhone(_arpabet(row[1]), start / rate, edge / rate, place))
            start = edge
    return tuple(phones)


def _arpabet(label: str) -> str:
    try:
        return load_phone_set("arpabet").normalise(label)
    except LabelError as error:
        raise LipwrightError(
            f"this voice of Festival speaks in unknown phones: {error}",
            cure="choose an American one, such as slt",
        ) from None


def _places(tokens: Sequence[str], spoken: str) -> list[int]:
    """Return where each token stands in the text; Festival keeps their spelling."""
    places: list[int] = []
    cursor = 0
    for token in tokens:
        found = spoken.find(token, cursor)
        places.append(found if found >= 0 else cursor)
        cursor = found + len(token) if found >= 0 else cursor
    return places


def _read_sound(path: Path) -> tuple[NDArray[np.float32], int]:
    with wave.open(str(path), "rb") as file:
        data = file.readframes(file.getnframes())
        rate = file.getframerate()
    return np.frombuffer(data, "<i2").astype(np.float32) / np.float32(32768), rate
