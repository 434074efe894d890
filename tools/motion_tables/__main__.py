"""``python -m tools.motion_tables RECORDINGS``: writes ``docs/motion-tables.md`` anew.

RECORDINGS is a folder of takes, as ``lipwright motion build`` reads it. Every ninth take is
left out of the database, sixty at most, and is what the searches are asked for.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
from datetime import datetime
from pathlib import Path

from lipwright import pipeline
from lipwright.engines.motion.capture import TakeFiles, find_takes
from lipwright.engines.motion.database import Database, open_database
from lipwright.errors import InputError, LipwrightError
from lipwright.files import write_all
from lipwright.motion_takes import build_motion
from tools.motion_tables.figure import one_after_the_other, row
from tools.motion_tables.lines import line
from tools.motion_tables.published import MINUTES, TAKES, UNITS
from tools.motion_tables.tables import clustered, every_take, searches

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "motion-tables.md"
PICTURE = DOCS / "pictures" / "motion-utterance.png"
TEMPLATE = Path(__file__).with_name("page.md")
EVERY, MOST, SHOWN = 9, 60, 2
LONG = 38


def say(what: str) -> None:
    """Tell what is being measured."""
    print(f"{what} …", file=sys.stderr, flush=True)


def built(takes: list[TakeFiles], place: Path) -> Database:
    """Build a database of some takes, copied into a folder of their own."""
    folder = place / "takes"
    folder.mkdir(parents=True)
    rows = ["name,text"]
    for take in takes:
        for file in (take.motion, take.sound):
            if file is not None:
                shutil.copy(file, folder / f"{take.name}{file.suffix}")
        rows.append(f"{take.name},{take.text or ''}")
    (folder / "text.csv").write_text("\n".join(rows), "utf-8")
    build_motion(folder, place / "database")
    return open_database(place / "database")


def make(recordings: Path, place: Path) -> dict[Path, bytes]:
    """Return what each file must hold."""
    every = [take for take in find_takes(recordings) if take.sound and take.text]
    out = every[4::EVERY][:MOST]
    if not out:
        raise InputError("too few takes", where=str(recordings), expected="five or more, with text")
    say(f"building from {len(every) - len(out)} takes")
    database = built([take for take in every if take not in out], place / "learnt")
    left_out = built(out, place / "left-out")
    tables = searches(database, left_out, say)
    minutes = len(database.frames) / database.rate / 60
    values = {
        "DATE": f"{datetime.now():%-d %B %Y}",
        "TAKES": f"{len(database.take_start)}",
        "MINUTES": f"{minutes:.0f}",
        "UNITS": f"{len(database.label):,}",
        "COMPONENTS": f"{len(database.basis)}",
        "LEFT": f"{len(out)}",
        "THEIRS": f"{TAKES} sentences, {MINUTES} minutes, {UNITS:,} units",
        "TABLE1": clustered(database, place, line(left_out, 0, LONG), say),
        "TABLE2": tables[22],
        "TABLE3": tables[38],
        "TABLE4": tables[37],
        "ALL": every_take(database, left_out, say),
    }
    text = TEMPLATE.read_text(encoding="utf-8")
    for name, value in values.items():
        text = text.replace(f"<{name}>", value)
    say("figure 4")
    lines = [
        pipeline.align(take.sound, take.text) for take in out[:SHOWN] if take.sound and take.text
    ]
    performance = pipeline.animate(
        one_after_the_other(lines), engine="motion", database=database.folder, search="greedy"
    )
    return {PAGE: text.encode(), PICTURE: row(performance)}


def main() -> int:
    """Read the command line; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m tools.motion_tables", description=__doc__)
    parser.add_argument("recordings", type=Path, metavar="RECORDINGS")
    given = parser.parse_args()
    try:
        with tempfile.TemporaryDirectory() as folder:
            made = make(given.recordings, Path(folder))
        write_all(made.items())
    except LipwrightError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
