"""What ``motion info`` says: a database's figures, and its units per phone as bars."""

from __future__ import annotations

import sys
from itertools import accumulate

import click

from lipwright.engines.motion.database import Database
from lipwright.engines.motion.info import THIN, Info, lacking

COLUMNS, BETWEEN, WIDTH = 3, 3, 79
FULL, PARTS, PLAIN = "█", " ▏▎▍▌▋▊▉", "#"


def told(name: str, database: Database, found: Info) -> str:
    """Return what is said of a database, its lines no wider than a terminal.

    Parameters
    ----------
    name : str
        As the user called it.
    database : Database
    found : Info
        What :func:`lipwright.engines.motion.info.info` counted in it.
    """
    kept = [f"{100 * share:.1f}" for share in accumulate(found.variance)]
    pairs, threes = found.bigrams, found.trigrams
    lines = [
        f"{name}: {found.takes} takes ({found.takes_with_sound} with sound), "
        f"{found.minutes:.1f} minutes, {found.frames} frames",
        f"units: {found.units} of {len(found.units_per_phone)} phones, "
        f"{found.nodes} nodes in the graph",
        *_bars(found.units_per_phone),
        f"pairs of phones: {pairs.different} of {pairs.possible}; "
        f"threes: {threes.different} of {threes.possible}",
        *_wrapped(f"variance that the first 1 to {len(kept)} components keep (%):", kept),
    ]
    if found.thin:
        lines += _wrapped(f"thin (fewer than {THIN} units):", found.thin)
    if lacks := lacking(database):
        lines += _wrapped("no unit of:", lacks)
    return "\n".join(lines)


def _wrapped(head: str, words: tuple[str, ...] | list[str]) -> list[str]:
    """Return words behind a head, on as many lines as they need."""
    lines = [head]
    for word in words:
        if len(lines[-1]) + 1 + len(word) > WIDTH:
            lines.append(" ")
        lines[-1] += f" {word}"
    return lines


def _bars(counts: dict[str, int]) -> list[str]:
    """Return a bar for each phone, the most frequent first, down the columns."""
    most = max(counts.values())
    names, digits = max(map(len, counts)), len(str(most))
    column = (WIDTH - BETWEEN * (COLUMNS - 1)) // COLUMNS
    long = max(column - names - digits - 4, 4)
    cells = [
        f"  {label:<{names}} {count:>{digits}} {_bar(count, most, long)}"
        for label, count in counts.items()
    ]
    rows = -(-len(cells) // COLUMNS)
    between = " " * BETWEEN
    return [between.join(cells[row::rows]).rstrip() for row in range(rows)]


def _bar(count: int, most: int, long: int) -> str:
    """Return a bar of blocks, an eighth of a letter exact; of ``#`` where there are none."""
    eighths = max(round(8 * long * count / most), 1)
    bar = FULL * (eighths // 8) + PARTS[eighths % 8].strip()
    if not _blocks():
        bar = PLAIN * max(round(eighths / 8), 1)
    return click.style(bar, fg="yellow" if count < THIN else "blue") + " " * (long - len(bar))


def _blocks() -> bool:
    """Whether standard output can show blocks."""
    try:
        (FULL + PARTS).encode(getattr(sys.stdout, "encoding", None) or "ascii")
    except (UnicodeEncodeError, LookupError):
        return False
    return True
