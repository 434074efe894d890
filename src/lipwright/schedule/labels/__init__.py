"""Labels that others made: which phone sounds when, read from their files.

A format is a plain module with up to three functions: ``sniff(text) -> bool`` where its
suffix is not its own, ``parse(data, where) -> Parsed``, and ``encode(speech) -> bytes``
where it is written too. To add one, copy ``audacity.py`` and name it in the tables here.
Whatever the format, :mod:`.timing` and :mod:`.notation` make the tiers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from importlib import import_module
from pathlib import Path
from typing import Any

from lipwright.errors import InputError, LabelError
from lipwright.files import read_bytes
from lipwright.phones import SILENCE, PhoneTrack
from lipwright.schedule.labels import notation, timing
from lipwright.schedule.labels.rows import Parsed, Row, decode
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Tier

READERS = {
    ".textgrid": ("textgrid",),
    ".lab": ("esps", "htk"),
    ".xlabel": ("esps",),
    ".ctm": ("ctm",),
    ".phn": ("timit",),
    ".wrd": ("timit",),
    ".json": ("speech_json",),
    ".txt": ("audacity",),
}
"""Each suffix and the formats it may hold; the content decides between them."""

WRITERS = {
    ".textgrid": "textgrid",
    ".lab": "htk",
    ".ctm": "ctm",
    ".phn": "timit",
    ".json": "speech_json",
    ".txt": "audacity",
}
"""Each suffix and the format that is written."""

_BINARY_TEXTGRID = b"ooBinaryFile"
_SNIFFED = ("textgrid", "speech_json", "esps", "audacity", "ctm", "htk")
_LANGUAGES = {"pinyin": "cmn"}  # of phone sets that belong to a single one
_BESIDE = {".phn": ".wrd", ".wrd": ".phn"}


@dataclass(frozen=True, slots=True)
class Labels:
    """What a label file says.

    Parameters
    ----------
    words : Tier
        Where the file has them; seconds.
    phones : PhoneTrack
        In the spelling of their phone set; silence is ``sil``.
    text, language : str
        Where the file has them.
    confidence : float or None
        Of the whole line, where the file has it.
    """

    words: Tier
    phones: PhoneTrack
    text: str = ""
    language: str = ""
    confidence: float | None = None


def read_labels(
    path: str | Path, *, phone_set: str | None = None, rate: int | None = None
) -> Labels:
    """Return the words and phones in a label file.

    Parameters
    ----------
    path : str or Path
        A file of any format in :data:`READERS`, under any name.
    phone_set : str, optional
        The labels' phone set, by name or path; guessed from the labels where absent.
    rate : int, optional
        Samples per second, where the file counts samples; 16000 for ``.phn``.

    Raises
    ------
    LabelError
        If the file is broken, its times make no sense, or labels are unknown.
    InputError
        If it cannot be read.
    """
    where = str(path)
    parsed = _with_companion(Path(path), _parse(Path(path)))
    phones = timing.in_seconds(parsed.phones, parsed.unit, rate, where)
    words = timing.in_seconds(parsed.words, parsed.unit, rate, where)
    spelled, name = notation.normalised(phones, phone_set or parsed.phone_set, where)
    track = PhoneTrack(timing.tier(spelled, where), name)
    if all(phone.label == SILENCE for phone in track):
        raise LabelError("no phones but silence", where=where, expected="phones with times")
    spoken = [word for word in words if not notation.is_silence(word.label)]
    # Hands let words share a sound ("just saw"): nothing hangs on where one ends.
    said = timing.tier(spoken, where, overlap=math.inf)
    return Labels(said, track, parsed.text, parsed.language, parsed.confidence)


def _parse(path: Path) -> Parsed:
    data, where = read_bytes(path), str(path)
    if data.startswith(_BINARY_TEXTGRID):
        return _parsed(_format("textgrid"), data, where)
    text = decode(data, where)
    own = READERS.get(path.suffix.lower(), ())
    for name in (*own, *_SNIFFED):
        module = _format(name)
        if not hasattr(module, "sniff") or module.sniff(text):
            return _parsed(module, data, where)
    if own:
        return _parsed(_format(own[-1]), data, where)
    raise LabelError(
        "no label format fits",
        where=where,
        expected=f"the content of a file in {' '.join(READERS)}",
    )


def _format(name: str) -> Any:
    return import_module(f"{__name__}.{name}")


def _parsed(module: Any, data: bytes, where: str) -> Parsed:
    parsed: Parsed = module.parse(data, where)
    return parsed


def _with_companion(path: Path, parsed: Parsed) -> Parsed:
    """Return TIMIT's phones together with the words in the file beside them."""
    suffix = _BESIDE.get(path.suffix.lower())
    if suffix is None or parsed.words:
        return parsed
    beside = path.with_suffix(suffix.upper() if path.suffix.isupper() else suffix)
    found = _parse(beside).phones if beside.is_file() else ()
    rows = tuple(replace(row, place=f"{row.place} of {beside.name}") for row in found)
    if path.suffix.lower() == ".phn":
        return replace(parsed, words=rows)
    if not rows:
        raise LabelError(
            "holds words only", where=str(path), expected=f"{beside.name} with its phones beside it"
        )
    return replace(parsed, phones=rows, words=parsed.phones)


def speech_from_labels(
    path: str | Path,
    sound: Sound | None = None,
    *,
    phone_set: str | None = None,
    rate: int | None = None,
) -> Speech:
    """Return speech whose phones are those of a label file.

    Parameters
    ----------
    path : str or Path
        The label file.
    sound : Sound, optional
        What the labels belong to.
    phone_set, rate
        As in :func:`read_labels`.

    Raises
    ------
    LabelError
        As :func:`read_labels`; and if the labels do not fit the sound.
    """
    labels = read_labels(path, phone_set=phone_set, rate=rate)
    if sound is not None:
        timing.check_against(labels.phones.tier, sound.duration, sound.rate, str(path))
    return Speech(
        labels.phones,
        labels.words,
        sound,
        labels.text or " ".join(labels.words.labels),
        labels.language or _LANGUAGES.get(labels.phones.phone_set, ""),
        "labels",
        labels.confidence,
        sound.notes if sound is not None else (),
    )


def write_labels(speech: Speech, suffix: str) -> bytes:
    """Return the schedule of a speech as a label file.

    Parameters
    ----------
    speech : Speech
        What to write.
    suffix : str
        Names the format, such as ``".TextGrid"``: one of :data:`WRITERS`.

    Raises
    ------
    InputError
        If the suffix names no label format.
    """
    name = WRITERS.get(suffix.lower())
    if name is None:
        raise InputError(
            f"the suffix {suffix!r} names no label format", expected=f"one of {' '.join(WRITERS)}"
        )
    encoded: bytes = _format(name).encode(speech)
    return encoded


__all__ = [
    "READERS",
    "WRITERS",
    "Labels",
    "Parsed",
    "Row",
    "read_labels",
    "speech_from_labels",
    "write_labels",
]
