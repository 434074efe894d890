"""``python -m tools.stills [MODEL …] [-o stills.png]``: characters that say the same line.

The head, the crab and any models given say one line, each with its own set; the page that
``lipwright say … -o line.html`` writes is opened in Chromium at the instants where /p/, /aa/,
/uw/ and /f/ are fullest.
"""

from __future__ import annotations

import argparse
import shutil
import sys
from pathlib import Path

from tests.chromium import NAMES, chromium

from lipwright import pipeline
from lipwright.errors import InputError, LipwrightError, OutputError
from lipwright.files import write_atomically
from tools.stills.instants import LINE, SHOWN, fullest
from tools.stills.sheet import CELL, FACE, MOUTH, sheet
from tools.stills.shots import CRAB, HUMAN, pictures

TARGET = Path(__file__).parents[2] / "docs" / "pictures" / "stills.png"


def make(models: list[str], target: Path) -> None:
    """Write the sheet of the built-in characters and of models.

    Raises
    ------
    InputError
        If a model cannot be used, or the target is no PNG.
    OutputError
        If there is no Chromium, or the sheet cannot be written.
    """
    if target.suffix.lower() != ".png":
        raise InputError(
            f"{target.suffix!r} is not a picture's", where=str(target), expected=".png"
        )
    if not any(map(shutil.which, NAMES)):
        raise OutputError(
            "no Chromium is on this machine", cure=f"install one of {', '.join(NAMES)}"
        )
    speech = pipeline.say(LINE)
    acts = {who: pipeline.animate(speech, character=who) for who in ("head", "crab", *models)}
    rows = []
    with chromium() as browser:
        for who, performance in acts.items():
            found = [fullest(performance.animation, shown) for shown in SHOWN]
            for shown, instant in zip(SHOWN, found, strict=True):
                print(f"{Path(who).stem} {shown.name} {instant.seconds:.3f} s {instant.level:.2f}")
            crops = CRAB if who == "crab" else HUMAN
            times = [instant.seconds for instant in found]
            seen = pictures(browser, performance, times, crops, CELL, (FACE, MOUTH))
            rows.append((Path(who).stem, seen))
    write_atomically(target, sheet(rows, [(shown.name, shown.word) for shown in SHOWN]))


def main() -> int:
    """Read the command line; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m tools.stills", description=__doc__)
    parser.add_argument("models", nargs="*", metavar="MODEL", help="a GLB, VRM or glTF file")
    parser.add_argument("-o", dest="target", type=Path, default=TARGET, metavar="stills.png")
    given = parser.parse_args()
    try:
        make(given.models, given.target)
    except LipwrightError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
