"""Numbers and strings as short, stable text."""

from __future__ import annotations

import json
from collections.abc import Sequence


def format_number(value: float, digits: int = 4) -> str:
    """Return a number as short text: at most ``digits`` decimals, no trailing zeros.

    Examples
    --------
    >>> format_number(0.25), format_number(1.0), format_number(-0.00001)
    ('0.25', '1', '0')
    """
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".") if digits else f"{value:.0f}"
    return "0" if text in ("-0", "") else text


def format_row(values: Sequence[float], digits: int = 4) -> str:
    """Return numbers as one JSON list on one line.

    Examples
    --------
    >>> format_row([0, 0.5, 1])
    '[0, 0.5, 1]'
    """
    return "[" + ", ".join(format_number(value, digits) for value in values) + "]"


def quote(text: str) -> str:
    """Return text as a JSON string, letters kept as they are."""
    return json.dumps(text, ensure_ascii=False)
