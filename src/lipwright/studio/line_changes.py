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
    rows = list(line.phones)
    if not -1 <= phone < len(rows):
        raise InputError(f"no boundary {phone}", expected=f"-1 to {len(rows) - 1}")
    old = rows[phone][2] if phone >= 0 else rows[0][1]
    least, most = _room(line, phone)
    if least > most:
        raise LabelError(
            f"the phones beside {old:.3f} s are too short to move it", cure="move others first"
        )
    new = round(min(max(time, least), most), DIGITS)
    phones = tuple(_moved(row, old, new, touching(rows, phone, n)) for n, row in enumerate(rows))
    words = tuple(_moved(row, old, new, (True, True)) for row in line.words)
    return msgspec.structs.replace(line, phones=phones, words=_kept_apart(words, line.words))


def _room(line: LineData, phone: int) -> tuple[float, float]:
    """Between which times a boundary may lie."""
    rows = line.phones
    least = rows[phone][1] + SHORTEST if phone >= 0 else 0.0
    if phone + 1 == len(rows):
        return least, max(line.sound.duration if line.sound else 0.0, rows[-1][2])
    following = rows[phone + 1]
    touches = phone < 0 or following[1] - rows[phone][2] < TOUCH
    return least, (following[2] - SHORTEST if touches else following[1])


def touching(rows: list[Row], phone: int, number: int) -> tuple[bool, bool]:
    """Whether the start, and the end, of a phone are at a boundary."""
    if phone < 0:
        return number == 0, False
    joined = phone + 1 < len(rows) and rows[phone + 1][1] - rows[phone][2] < TOUCH
    return joined and number == phone + 1, number == phone


def _moved(row: Row, old: float, new: float, edges: tuple[bool, bool]) -> Row:
    label, start, end = row
    if edges[0] and abs(start - old) < TOUCH:
        start = new
    if edges[1] and abs(end - old) < TOUCH:
        end = new
    return (label, start, end)


def _kept_apart(words: tuple[Row, ...], before: tuple[Row, ...]) -> tuple[Row, ...]:
    """Keep words as they were where moving would turn one round."""
    return words if all(start < end for _, start, end in words) else before


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
