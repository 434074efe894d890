"""``python -m tools.synthetic_motion``: writes ``src/lipwright/data/motion/synthetic`` anew.

It needs espeak-ng (extra ``tts``). The same version of it gives the same bytes.
"""

from __future__ import annotations

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # the order of sums must not depend on the machine

import shutil
from pathlib import Path

from lipwright.engines.motion.synthetic import FOLDER
from tools.synthetic_motion.making import make


def main(folder: Path = FOLDER) -> None:
    """Speak, move, build."""
    folder.parent.mkdir(exist_ok=True)
    # Arrays are numbered from one build to the next: a new folder has the same names each time.
    shutil.rmtree(folder, ignore_errors=True)
    made = make(folder)
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    seconds = len(made.frames) / made.rate
    print(f"{folder.name}: {len(made.take_start)} takes, {seconds:.0f} s, {size / 1e3:.0f} kB")


if __name__ == "__main__":
    main()
