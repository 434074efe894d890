"""CTM, the time-marked tokens of NIST's sctk: ``file channel start duration label [conf]``.

Seconds; lines from ``;;`` on are comments; one that
names the phone set (``;; phone set: pinyin``) is heeded, and written where the labels
alone would be taken for another's. Kaldi's marks of a phone's place in its word
(``AH0_I``) are dropped. What is written are the phones; it loses the words.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from lipwright.errors import LabelError
from lipwright.files import format_number
from lipwright.schedule.labels.notation import has_to_be_named, is_silence
from lipwright.schedule.labels.rows import Line, Parsed, Row, decode, is_number, lines
from lipwright.speech import Speech

_NAMED = re.compile(r"^;;\s*phone set:\s*(\S+)\s*$", re.MULTILINE)
_POSITION = re.compile(r"(?<=.)_[BIES]$")


def sniff(text: str) -> bool:
    """Tell whether a text's first line has its times in the third and fourth column."""
    body = [line for line in text.split("\n", 100) if line.strip() and line[:2] != ";;"]
    fields = body[0].split() if body else []
    return len(fields) >= 5 and is_number(fields[2]) and is_number(fields[3])


def parse(data: bytes, where: str) -> Parsed:
    """Return the phones.

    Raises
    ------
    LabelError
        If a line has too few columns, or the file holds several recordings and none of
        them is called as the file is.
    """
    found = [line for line in lines(data, where) if not line.text.startswith(";;")]
    rows = _without_positions([_row(line) for line in _one_recording(found, where)])
    named = _NAMED.search("\n".join(decode(data, where).splitlines()))
    return Parsed(tuple(rows), phone_set=named[1] if named else "")


def _one_recording(found: list[Line], where: str) -> list[Line]:
    names = list(dict.fromkeys(line.fields[0] for line in found))
    own = Path(where).stem
    if len(names) > 1 and own not in names:
        raise LabelError(
            f"{len(names)} recordings ({', '.join(names[:5])}, ...)",
            where=where,
            expected=f"one, or one called {own!r}",
        )
    return [line for line in found if len(names) == 1 or line.fields[0] == own]


def _row(line: Line) -> Row:
    if len(line.fields) < 5:
        raise LabelError(
            f"{len(line.fields)} columns",
            where=line.where,
            expected="file, channel, start, duration, label",
        )
    start, duration = line.number(2), line.number(3)
    sure = line.number(5) if len(line.fields) > 5 else None
    confidence = sure if sure is not None and 0.0 <= sure <= 1.0 else None
    return Row(line.fields[4], start, start + duration, line.place, confidence)


def _without_positions(rows: Sequence[Row]) -> list[Row]:
    sounding = [row for row in rows if not is_silence(_POSITION.sub("", row.label))]
    if not all(_POSITION.search(row.label) for row in sounding):
        return list(rows)
    return [replace(row, label=_POSITION.sub("", row.label)) for row in rows]


def encode(speech: Speech) -> bytes:
    """Return the phones as CTM, of a recording called ``speech``."""
    named = has_to_be_named(speech.phones)
    written = [f";; phone set: {speech.phones.phone_set}\n"] if named else []
    for phone in speech.phones:
        start, duration = format_number(phone.start, 6), format_number(phone.duration, 6)
        sure = "" if phone.confidence is None else f" {format_number(phone.confidence)}"
        written.append(f"speech 1 {start} {duration} {phone.label}{sure}\n")
    return "".join(written).encode()
