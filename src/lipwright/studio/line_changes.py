"""What changes do to a line: boundaries that are dragged, edits that hang on its phones."""

from __future__ import annotations

import msgspec

from lipwright.engines.bigram.edits import Edit, same_place
from lipwright.errors import InputError, LabelError
from lipwright.studio.changes import LineData, Row

SHORTEST = 0.005
TOUCH = 1e-6
DIGITS = 4


def with_boundary(line: LineData, phone: int, time: float) -> LineData:
    """Return a line with the end of a phone, and the start of the next, at another time.

    Both keep at least 5 ms. What touched goes along: the next phone, and words' edges.

    Raises
    ------
    InputError
        If there is no such phone, or no room to move.
    """
    phones = list(line.phones)
    if not -1 <= phone < len(phones):
        raise InputError(f"no boundary {phone}", expected=f"-1 to {len(phones) - 1}")
    old = phones[phone][2] if phone >= 0 else phones[0][1]
    least, most = _room(line, phone)
    if least > most:
        raise LabelError(
            f"the phones beside {old:.3f} s are too short to move it", cure="move others first"
        )
    new = round(min(max(time, least), most), DIGITS)
    for number, (label, start, end) in enumerate(phones[max(phone, 0) : phone + 2], max(phone, 0)):
        if number == phone:
            phones[number] = (label, start, new)
        elif abs(start - old) < TOUCH:
            phones[number] = (label, new, end)
    words = _with_edges(line.words, old, new)
    return msgspec.structs.replace(line, phones=tuple(phones), words=words)


def _room(line: LineData, phone: int) -> tuple[float, float]:
    """Between which times a boundary may lie."""
    rows = line.phones
    least = rows[phone][1] + SHORTEST if phone >= 0 else 0.0
    if phone + 1 == len(rows):
        return least, max(line.sound.duration if line.sound else 0.0, rows[-1][2])
    following = rows[phone + 1]
    touches = phone < 0 or following[1] - rows[phone][2] < TOUCH
    return least, (following[2] - SHORTEST if touches else following[1])


def _with_edges(words: tuple[Row, ...], old: float, new: float) -> tuple[Row, ...]:
    """Move the edges of words that lie at a boundary, unless that would turn a word round."""
    moved = list(words)
    for number, (label, start, end) in enumerate(words):
        if abs(start - old) < TOUCH or abs(end - old) < TOUCH:
            start, end = (new if abs(edge - old) < TOUCH else edge for edge in (start, end))
            moved[number] = (label, start, end)
            if start >= end:
                return words
    return tuple(moved)


def with_edit(line: LineData, edit: Edit) -> LineData:
    """Return a line with an edit, in place of one of the same phone and pose."""
    edit = _tidy(edit)
    edits = list(line.edits)
    place = next((n for n, one in enumerate(edits) if same_place(one, edit)), None)
    if place is None:
        edits.append(edit)
    else:
        edits[place] = edit
    return msgspec.structs.replace(line, edits=tuple(edits))


def _tidy(edit: Edit) -> Edit:
    """Return an edit as a file would hold it."""
    return msgspec.structs.replace(
        edit,
        gain=round(edit.gain, DIGITS),
        level=None if edit.level is None else round(edit.level, DIGITS),
        hold=round(edit.hold, DIGITS),
        keys=edit.keys and tuple((round(t, DIGITS), round(v, DIGITS)) for t, v in edit.keys),
    )


def without_edit(line: LineData, edit: Edit) -> LineData:
    """Return a line without an edit.

    Raises
    ------
    InputError
        If it has none like it.
    """
    left = tuple(one for one in line.edits if one != edit)
    if len(left) == len(line.edits):
        raise InputError(f"no edit {edit.name}", where=line.title)
    return msgspec.structs.replace(line, edits=left)
