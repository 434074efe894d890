"""Tables of numbers in text: comma, semicolon or tab; every bad cell named by its place.

A row whose channels are all blank is a frame that the camera lost; it is left to
:mod:`.timing`. Decimal commas are understood where the columns part at semicolons.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lipwright.engines.motion.capture.motion import Floats
from lipwright.errors import FileFormatError
from lipwright.files import decode_text, read_bytes

_KIND = "a CSV file: a line of column names, then a line per frame"


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """A table as it stands.

    Parameters
    ----------
    header : tuple of str
    rows : list of list of str
        As long as the header each.
    lines : list of int
        The line of the file in which each row ends.
    where : str
        The file.
    """

    header: tuple[str, ...]
    rows: list[list[str]]
    lines: list[int]
    where: str

    def place(self, row: int, column: int) -> str:
        """Return where a cell stands, for messages."""
        return f"{self.where}, line {self.lines[row]}, column {self.header[column]!r}"

    def without(self, rows: set[int]) -> Table:
        """Return it without some rows."""
        kept = [row for row in range(len(self.rows)) if row not in rows]
        return Table(
            self.header, [self.rows[i] for i in kept], [self.lines[i] for i in kept], self.where
        )

    def blank(self, columns: Sequence[int]) -> set[int]:
        """Return the rows in which all of these columns are blank."""
        return {
            number
            for number, row in enumerate(self.rows)
            if not any(row[column].strip() for column in columns)
        }

    def numbers(self, columns: Sequence[int]) -> Floats:
        """Return columns as numbers, (rows, columns) float64.

        Raises
        ------
        FileFormatError
            If a cell is no finite number: it names line and column.
        """
        try:
            values = np.array([[float(row[c]) for c in columns] for row in self.rows])
            if np.isfinite(values).all():
                return values.reshape(len(self.rows), len(columns))
        except ValueError:
            pass
        return np.array(
            [[self._number(i, c) for c in columns] for i in range(len(self.rows))]
        ).reshape(len(self.rows), len(columns))

    def _number(self, row: int, column: int) -> float:
        cell = self.rows[row][column]
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise FileFormatError(
                f"{cell.strip()[:40]!r}" if cell.strip() else "an empty cell",
                where=self.place(row, column),
                expected="a finite number",
            )
        return value


def read_table(path: str | Path) -> Table:
    """Read a table.

    Raises
    ------
    FileFormatError
        If it is no text, has no column names, names a column twice, or a row has another
        number of cells.
    InputError
        If the file cannot be read.
    """
    where = str(path)
    data = read_bytes(path)
    if b"\0" in data[:4096]:
        raise FileFormatError("is not text", where=where, expected=_KIND)
    text = decode_text(data, where)
    first = text.lstrip("\r\n").partition("\n")[0]
    delimiter = max(",;\t", key=first.count)
    reader = csv.reader(text.splitlines(keepends=True), delimiter=delimiter)
    try:
        found = [(reader.line_num, row) for row in reader if any(cell.strip() for cell in row)]
    except csv.Error as error:
        raise FileFormatError(str(error), where=f"{where}, line {reader.line_num}") from None
    if not found:
        raise FileFormatError("is empty", where=where, expected=_KIND)
    header = tuple(cell.strip() for cell in found[0][1])
    _check_header(header, where)
    rows = [_whole(row, len(header), line, where) for line, row in found[1:]]
    if delimiter == ";":
        rows = [[cell.replace(",", ".") for cell in row] for row in rows]
    return Table(header, rows, [line for line, _ in found[1:]], where)


def _whole(row: list[str], count: int, line: int, where: str) -> list[str]:
    extra = row[count:]
    if any(cell.strip() for cell in extra) or len(row) < count:
        raise FileFormatError(
            f"{len(row)} cells", where=f"{where}, line {line}", expected=f"{count}, as in line 1"
        )
    return row[:count]


def _check_header(header: tuple[str, ...], where: str) -> None:
    named = [name for name in header if name]
    if all(_is_number(name) for name in named):
        raise FileFormatError("no line of column names", where=f"{where}, line 1", expected=_KIND)
    twice = sorted({name for name in named if named.count(name) > 1})
    if twice:
        raise FileFormatError(
            f"the column {twice[0]!r} twice",
            where=f"{where}, line 1",
            expected="each channel once",
        )


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
