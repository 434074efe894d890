"""HTK labels: ``start end label [score] [word]``, a line for each phone.

Times are whole numbers of 100 ns (HTK Book, section 6.2); with a decimal point they are
taken as seconds, as many tools write them. A word stands beside its first phone. What
is written keeps times to 100 ns and words without their ends.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from lipwright.errors import LabelError
from lipwright.schedule.labels.notation import is_silence
from lipwright.schedule.labels.rows import Line, Parsed, Row, is_number, lines
from lipwright.speech import Speech

TICKS = 10_000_000


def sniff(text: str) -> bool:
    """Tell whether a text's first line is two times and a label."""
    fields = text.strip().split("\n", 1)[0].split()
    return len(fields) >= 3 and is_number(fields[0]) and is_number(fields[1])


def parse(data: bytes, where: str) -> Parsed:
    """Return the phones, and the words where they stand beside them.

    Raises
    ------
    LabelError
        If a line is not two times and a label.
    """
    found = list(lines(data, where))
    rows = [_row(line) for line in found]
    in_ticks = all(re.fullmatch(r"-?\d+", text) for line in found for text in line.fields[:2])
    names = [_word(line) for line in found]
    return Parsed(tuple(rows), tuple(_words(rows, names)), "100 ns" if in_ticks else "seconds")


def _row(line: Line) -> Row:
    start, end = line.number(0), line.number(1)
    if len(line.fields) < 3:
        raise LabelError("a line without a label", where=line.where, expected="start end label")
    score = line.fields[3] if len(line.fields) > 3 else ""
    # Aligners put log likelihoods here; only what can be one is taken as a confidence.
    sure = float(score) if is_number(score) and 0.0 <= float(score) <= 1.0 else None
    return Row(line.fields[2], start, end, line.place, sure)


def _word(line: Line) -> str:
    # Numbers in this place are scores; a word such as 1984 stands in quotes.
    rest = line.text.split(maxsplit=3)[3] if len(line.fields) > 3 else ""
    score, _, after = rest.partition(" ")
    name = (after if is_number(score) else rest).strip()
    return name[1:-1] if len(name) > 1 and name[0] == name[-1] == '"' else name


def _words(rows: Sequence[Row], names: Sequence[str]) -> list[Row]:
    words: list[Row] = []
    is_open = False
    for row, name in zip(rows, names, strict=True):
        if name and not is_silence(name):
            words.append(replace(row, label=name, confidence=None))
            is_open = True
        elif name or is_silence(row.label):
            is_open = False
        elif is_open:
            words[-1] = replace(words[-1], end=row.end)
    return words


def encode(speech: Speech) -> bytes:
    """Return HTK labels of the phones, each word beside the phone that it starts in."""
    first: dict[int, str] = {}
    for word in speech.words:
        index = speech.phones.tier.index_at(word.start)
        if index is not None:
            first.setdefault(index, word.label)
    written = []
    for index, phone in enumerate(speech.phones):
        fields = [str(round(phone.start * TICKS)), str(round(phone.end * TICKS)), phone.label]
        if phone.confidence is not None:
            fields.append(f"{phone.confidence:.4f}")
        if index in first:
            name = " ".join(first[index].split())
            fields.append(f'"{name}"' if is_number(name) or " " in name else name)
        written.append(" ".join(fields))
    return ("\n".join(written) + "\n").encode()
