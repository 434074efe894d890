"""Tables 1 to 4 on recordings, beside what was printed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from lipwright.engines.motion.building import build, takes_of
from lipwright.engines.motion.database import Database, Settings
from lipwright.engines.motion.engine import ALIKE as PATHS_ALIKE
from lipwright.engines.motion.graph import graph_of
from lipwright.engines.motion.learnt import keep_learnt, learnt_of
from lipwright.engines.motion.search import PATHS, greedy, optimal, pq
from lipwright.engines.motion.splicing import PairTable
from tools.motion_tables.lines import (
    Base,
    Finding,
    Line,
    Result,
    alike,
    by_cost,
    line,
    one_path,
    tried,
)
from tools.motion_tables.published import CLUSTERED, SEARCHES

CAP = 30.0
"""Seconds for one search by PQ-Matching; the publication's took up to 650."""
RUNS = 20
ALIKE = PATHS_ALIKE["optimal"]
Say = Callable[[str], None]


def base_of(database: Database) -> Base:
    """Return a database with what its engine keeps at hand."""
    pairs = PairTable(database)
    return Base(database, graph_of(database), pairs, learnt_of(database))


def windows(heights: Sequence[int]) -> dict[str, Finding]:
    """Return PQ-Matching for some lengths of its sub-sequences, as printed: one step on."""
    return {f"pq({h})": one_path(pq(h, seconds=CAP)) for h in heights}


def ours() -> dict[str, Finding]:
    """Return the searches that the publication has not."""
    return {
        "optimal": one_path(optimal),
        f"optimal, {ALIKE} paths": alike(optimal, ALIKE),
        "cheapest": by_cost(1),
        "several": by_cost(PATHS),
    }


def clustered(database: Database, folder: Path, said: Line, say: Say) -> str:
    """Return Table 1: times of two searches on graphs of fewer and fewer nodes."""
    rows = [
        "| clusters | PQ(4), s | greedy, s | ratio | printed: PQ(4) | greedy | ratio |",
        "|---|---|---|---|---|---|---|",
    ]
    for count, (theirs, quick) in CLUSTERED.items():
        say(f"table 1, {count or 'no'} clusters")
        held = database if not count else _merged(database, folder, count)
        base = base_of(held)
        slow = tried(base, said, windows([4])["pq(4)"], runs=1).seconds
        fast = tried(base, said, one_path(greedy), RUNS).seconds
        own = [f"{slow:.3g}", f"{fast:.5f}", f"{slow / fast:,.0f}"]
        printed = [f"{theirs:.2f}", f"{quick:.3f}", f"{theirs / quick:,.0f}"]
        rows.append(f"| {' | '.join([str(count or 'none'), *own, *printed])} |")
    return "\n".join(rows)


def _merged(database: Database, folder: Path, count: int) -> Database:
    settings = Settings(clusters=count)
    made = build(folder / f"clusters-{count}", takes_of(database), settings)
    keep_learnt(made)
    return made


def searches(database: Database, left_out: Database, say: Say) -> dict[int, str]:
    """Return Tables 2 to 4: time, jumps and distance for sequences of their lengths."""
    base, tables = base_of(database), {}
    for count, printed in SEARCHES.items():
        said = line(left_out, 0, count)
        rows = [
            "| search | time, s | jumps | RMS | printed: time | jumps | RMS |",
            "|---|---|---|---|---|---|---|",
        ]
        every = {"greedy": one_path(greedy), **windows([3, 4, 5, 6]), **ours()}
        for name, find in every.items():
            say(f"{count} phones, {name}")
            found = tried(base, said, find, 1 if name.startswith("pq") else RUNS)
            theirs = printed.get(name)
            beside = (
                [f"{theirs[0]:.2f}", str(theirs[1]), f"{theirs[2]:.2f}"] if theirs else [""] * 3
            )
            rows.append(f"| {' | '.join([name, *_cells(found), *beside])} |")
        tables[count] = "\n".join(rows)
    return tables


def _cells(found: Result) -> list[str]:
    capped = " (stopped)" if not found.complete else ""
    return [f"{found.seconds:.4g}{capped}", str(found.jumps), f"{found.rms:.3f}"]


def _printed(row: tuple[float, int, float] | None) -> list[str]:
    return [f"{row[0]:.2f}", str(row[1]), f"{row[2]:.2f}"] if row else [""] * 3


def every_take(database: Database, left_out: Database, say: Say) -> str:
    """Return the means over all takes left out, each by itself."""
    base = base_of(database)
    bounds = left_out.take_unit.tolist()
    lines = [line(left_out, a, b - a) for a, b in pairwise(bounds)]
    rows = ["| search | time, ms | jumps | RMS |", "|---|---|---|---|"]
    for name, find in {"greedy": one_path(greedy), **windows([3, 4]), **ours()}.items():
        say(f"all takes left out, {name}")
        found = [tried(base, said, find) for said in lines]
        time, jumps, rms = (
            float(np.mean([getattr(one, field) for one in found]))
            for field in ("seconds", "jumps", "rms")
        )
        rows.append(f"| {name} | {1e3 * time:.2f} | {jumps:.2f} | {rms:.3f} |")
    return "\n".join(rows)
