"""CSV: a row per frame, its time and the controls, for spreadsheets and plots.

It loses the keys, phones and words, the report, and what is beyond 6 decimals. Lines
and quotes are those of RFC 4180; the text is UTF-8.
"""

from __future__ import annotations

import csv
import io

from lipwright.files import format_number
from lipwright.performance import Performance

DIGITS = 6


def encode(performance: Performance) -> bytes:
    """Return the table: a header ``time,<controls>``, then seconds and weights."""
    animation = performance.animation
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\r\n")
    writer.writerow(("time", *animation.controls))
    for time, row in zip(animation.times.tolist(), animation.values.tolist(), strict=True):
        writer.writerow([format_number(value, DIGITS) for value in (time, *row)])
    return text.getvalue().encode()
