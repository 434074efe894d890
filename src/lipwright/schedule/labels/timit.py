"""TIMIT's ``.phn`` and ``.wrd``: ``start end label`` in samples at 16 kHz.

Both name the same recording: one is found beside the other. What is written are the
phones, to the nearest sample at 16 kHz.
"""

from __future__ import annotations

from lipwright.errors import LabelError
from lipwright.phones import SILENCE
from lipwright.schedule.labels.rows import Line, Parsed, Row, lines
from lipwright.schedule.labels.timing import TIMIT_RATE
from lipwright.speech import Speech


def parse(data: bytes, where: str) -> Parsed:
    """Return the rows as phones; of a ``.wrd`` file they are words.

    Raises
    ------
    LabelError
        If a line is not two times and a label.
    """
    return Parsed(tuple(_row(line) for line in lines(data, where)), unit="samples")


def _row(line: Line) -> Row:
    start, end = line.number(0), line.number(1)
    if len(line.fields) < 3:
        raise LabelError("a line without a label", where=line.where, expected="start end label")
    return Row(" ".join(line.fields[2:]), start, end, line.place)


def encode(speech: Speech) -> bytes:
    """Return the phones; silence is ``h#`` at both ends and ``pau`` between."""
    last = len(speech.phones) - 1
    written = []
    for index, phone in enumerate(speech.phones):
        silence = "h#" if index in (0, last) else "pau"
        label = silence if phone.label == SILENCE else phone.label
        start, end = round(phone.start * TIMIT_RATE), round(phone.end * TIMIT_RATE)
        written.append(f"{start} {end} {label}\n")
    return "".join(written).encode()
