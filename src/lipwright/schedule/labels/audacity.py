"""Audacity's label tracks: ``start<tab>end<tab>label`` in seconds.

The lines that start with a backslash hold frequencies, and are passed over.
"""

from __future__ import annotations

from lipwright.errors import LabelError
from lipwright.phones import SILENCE
from lipwright.schedule.labels.rows import Parsed, Row, is_number, lines
from lipwright.speech import Speech


def sniff(text: str) -> bool:
    """Tell whether a text's first line has two times with a point, and tabs between."""
    fields = text.split("\n", 1)[0].split("\t")
    return len(fields) == 3 and all(is_number(field) and "." in field for field in fields[:2])


def parse(data: bytes, where: str) -> Parsed:
    """Return the labels as phones.

    Raises
    ------
    LabelError
        If a line has no two times.
    """
    rows = []
    for line in lines(data, where):
        if line.text.startswith("\\"):
            continue
        columns = line.text.split("\t")
        if len(columns) < 2:
            raise LabelError(
                "a line without tabs", where=line.where, expected="start, end and label"
            )
        label = columns[2].strip() if len(columns) > 2 else ""
        rows.append(Row(label, line.number(0), line.number(1), line.place))
    return Parsed(tuple(rows))


def encode(speech: Speech) -> bytes:
    """Return the phones as a label track; silence is left out."""
    rows = [
        f"{phone.start:.6f}\t{phone.end:.6f}\t{phone.label}\n"
        for phone in speech.phones
        if phone.label != SILENCE
    ]
    return "".join(rows).encode()
