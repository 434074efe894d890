"""ESPS xlabel files, as Festival writes them: a header up to ``#``, then ends of labels.

Each line is ``end colour label``, in seconds; a label starts where the one before ends.
Read only: nothing that we know still needs them.
"""

from __future__ import annotations

from lipwright.errors import LabelError
from lipwright.schedule.labels.rows import Parsed, Row, lines


def sniff(text: str) -> bool:
    """Tell whether a line of the head is a lone ``#``."""
    return any(line.strip() == "#" for line in text.split("\n", 30)[:30])


def parse(data: bytes, where: str) -> Parsed:
    """Return the phones.

    Raises
    ------
    LabelError
        If the header does not end, or a line is not a time, a colour and a label.
    """
    found = list(lines(data, where))
    heads = [index for index, line in enumerate(found) if line.text.strip() == "#"]
    if not heads:
        raise LabelError("a header without end", where=where, expected="a line that is '#'")
    rows: list[Row] = []
    reached = 0.0
    for line in found[heads[0] + 1 :]:
        end = line.number(0)
        line.number(1)
        label = " ".join(line.fields[2:]).partition(";")[0].strip()
        rows.append(Row(label, reached, end, line.place))
        reached = end
    return Parsed(tuple(rows))
