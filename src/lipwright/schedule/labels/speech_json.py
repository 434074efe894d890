"""Our own labels as JSON, lossless: ``"format": "lipwright/speech"``.

The phones and words inside an animation (``lipwright/animation``) are read too.
"""

from __future__ import annotations

import json
from collections.abc import Iterable

import msgspec

from lipwright.animation import Animation, interval_from_row, interval_row
from lipwright.errors import LabelError, LipwrightError
from lipwright.files import check_document, convert, parse_json, quote
from lipwright.schedule.labels.rows import Parsed, Row
from lipwright.speech import Speech
from lipwright.timeline import Interval

FORMAT = "lipwright/speech"
VERSION = 1

Rows = list[list[str | float | None]]


class _Document(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    version: int
    phones: Rows
    phone_set: str = "arpabet"
    words: Rows = []
    text: str = ""
    language: str = ""
    source: str = ""
    confidence: float | None = None
    notes: list[str] = []


def sniff(text: str) -> bool:
    """Tell whether a text looks like a JSON object."""
    return text.lstrip().startswith("{")


def parse(data: bytes, where: str) -> Parsed:
    """Return the phones and words of a speech or animation file.

    Raises
    ------
    FileFormatError
        If the file is broken, or neither.
    LabelError
        If a row makes no sense.
    """
    value = parse_json(data, where)
    if isinstance(value, dict) and value.get("format") == "lipwright/animation":
        animation = Animation.from_bytes(data, where)
        phones, words = (_from_tier(tier) for tier in (animation.phones, animation.words))
        return Parsed(phones, words, phone_set=animation.phones.phone_set)
    read = convert(check_document(value, where, format=FORMAT, version=VERSION), _Document, where)
    return Parsed(
        _from_rows(read.phones, "phones", where),
        _from_rows(read.words, "words", where),
        phone_set=read.phone_set,
        text=read.text,
        language=read.language,
        confidence=read.confidence,
    )


def _from_tier(tier: Iterable[Interval]) -> tuple[Row, ...]:
    return tuple(
        Row(i.label, i.start, i.end, f"interval {index}", i.confidence)
        for index, i in enumerate(tier, start=1)
    )


def _from_rows(rows: Rows, name: str, where: str) -> tuple[Row, ...]:
    result = []
    for index, row in enumerate(rows):
        place = f"at {name}[{index}]"
        try:
            interval = interval_from_row(row)
        except LipwrightError as error:
            raise error.at(f"{where}, {place}") from None
        result.append(Row(interval.label, interval.start, interval.end, place, interval.confidence))
    return tuple(result)


def encode(speech: Speech) -> bytes:
    """Return the speech without its sound."""
    if not len(speech.phones):
        raise LabelError("no phones to write", expected="speech with phones")
    fields = {
        "format": quote(FORMAT),
        "version": str(VERSION),
        "phone_set": quote(speech.phones.phone_set),
        "language": quote(speech.language),
        "text": quote(speech.text),
        "source": quote(speech.source),
        "confidence": json.dumps(speech.confidence),
        "notes": json.dumps(speech.notes, ensure_ascii=False),
        "phones": _lines(speech.phones),
        "words": _lines(speech.words),
    }
    body = ",\n ".join(f"{quote(name)}: {value}" for name, value in fields.items())
    return ("{\n " + body + "\n}\n").encode()


def _lines(intervals: Iterable[Interval]) -> str:
    rows = ",\n  ".join(map(interval_row, intervals))
    return f"[\n  {rows}\n ]" if rows else "[]"
