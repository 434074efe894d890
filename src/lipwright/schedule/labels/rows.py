"""What label files have in common: text, lines, columns, and rows with their places.

A format's ``parse`` returns :class:`Parsed`: rows as the file has them, in its own unit
of time and its own spelling. :mod:`.notation` and :mod:`.timing` make tiers of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from lipwright.errors import LabelError

Unit = Literal["seconds", "100 ns", "samples"]


@dataclass(frozen=True, slots=True)
class Row:
    """One label of a file.

    Parameters
    ----------
    label : str
        As the file spells it.
    start, end : float
        In the file's unit.
    place : str
        Where in the file it stands, for errors: ``"line 3"``.
    confidence : float or None
        0..1, where the file gives one.
    """

    label: str
    start: float
    end: float
    place: str
    confidence: float | None = None


@dataclass(frozen=True, slots=True)
class Parsed:
    """A label file as it stands.

    Parameters
    ----------
    phones, words : tuple of Row
        In the order of the file.
    unit : str
        What the times count.
    phone_set : str
        The notation, where the file names it.
    text, language : str
        Where the file holds them.
    confidence : float or None
        Of the whole line, where the file holds it.
    """

    phones: tuple[Row, ...]
    words: tuple[Row, ...] = ()
    unit: Unit = "seconds"
    phone_set: str = ""
    text: str = ""
    language: str = ""
    confidence: float | None = None


@dataclass(frozen=True, slots=True)
class Line:
    """One line that is not blank, cut at white space.

    Parameters
    ----------
    text : str
        The whole line.
    fields : tuple of str
        Its columns.
    where : str
        The file and the line's number.
    """

    text: str
    fields: tuple[str, ...]
    where: str

    @property
    def place(self) -> str:
        """The line without the file: ``"line 3"``."""
        return self.where.rpartition(", ")[2]

    def number(self, index: int) -> float:
        """Return a column as a number.

        Raises
        ------
        LabelError
            If there is no such column or it is no number: it names line and column.
        """
        if index >= len(self.fields):
            raise LabelError(
                f"{len(self.fields)} columns", where=self.where, expected=f"at least {index + 2}"
            )
        text = self.fields[index]
        if is_number(text):
            return float(text)
        column = [match.start() for match in re.finditer(r"\S+", self.text)][index] + 1
        raise LabelError(
            f"{text!r} is not a time",
            where=f"{self.where} column {column}",
            expected="a number",
            cure="write decimals with a point" if is_number(text.replace(",", ".")) else "",
        )


def is_number(text: str) -> bool:
    """Tell whether ``text`` is a plain decimal number: no ``nan``, no ``1_000``.

    Examples
    --------
    >>> is_number("-0.5e-3"), is_number("nan"), is_number("0,5")
    (True, False, False)
    """
    return re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d{1,2})?", text, re.ASCII) is not None


def decode(data: bytes, where: str) -> str:
    r"""Return the text of a label file: UTF-8, UTF-16 with or without mark, or Latin-1.

    Raises
    ------
    LabelError
        If it is empty or no text.

    Examples
    --------
    >>> decode("a ɑ".encode("utf-16-be"), "x.lab")
    'a ɑ'
    """
    if not data.strip():
        raise LabelError("is empty", where=where, expected="a label file")
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        text = data.decode("utf-16", errors="replace")
    elif b"\0" in data[:2]:
        text = data.decode("utf-16-le" if data[1] == 0 else "utf-16-be", errors="replace")
    else:
        try:
            text = data.decode("utf-8-sig")
        except UnicodeDecodeError:
            text = data.decode("latin-1")  # what Praat and Festival wrote before Unicode
    if re.search("[\0-\x08\x0e-\x1f\x7f\ufffd]", text):
        raise LabelError("is not text", where=where, expected="a label file")
    return text


def lines(data: bytes, where: str) -> Iterator[Line]:
    """Yield the lines that are not blank."""
    for number, text in enumerate(re.split(r"\r\n|\r|\n", decode(data, where)), start=1):
        if text.strip():
            yield Line(text, tuple(text.split()), f"{where}, line {number}")
