"""Run measures one after the other, each in a process of its own, into one JSON object.

``python -m bench`` runs all of them, ``python -m bench quality stages`` these two. What
each prints is gathered under its name; on standard error one hears which is running.
"""

import json
import subprocess
import sys
from datetime import datetime
from typing import Any

MEASURES = (
    "startup",
    "speaking",
    "stages",
    "models",
    "studio",
    "languages",
    "mandarin",
    "aligning",
    "aligning_languages",
    "by_ear",
    "robustness",
    "doubt",
    "quality",
    "held_out",
    "fitting",
    "motion",
    "motion_by_ear",
    "motion_facegood",
    "motion_search",
    "motion_joining",
    "motion_capture",
    "motion_skin",
    "neural",
    "neural_live",
    "neural_runtime",
)


def figures(name: str) -> dict[str, Any]:
    """What one measure prints: ``{what: figures}``; nothing where its recordings are absent."""
    print(f"{name} …", file=sys.stderr, flush=True)
    run = subprocess.run(
        [sys.executable, "-m", f"bench.{name}"], check=True, stdout=subprocess.PIPE, text=True
    )
    found = map(json.loads, run.stdout.splitlines())
    return {line.pop("measure"): line for line in found}


if __name__ == "__main__":
    unknown = set(sys.argv[1:]) - set(MEASURES)
    if unknown:
        sys.exit(f"no measure {', '.join(sorted(unknown))}; there are {', '.join(MEASURES)}")
    measured = {name: figures(name) for name in sys.argv[1:] or MEASURES}
    at = datetime.now().astimezone().isoformat(timespec="minutes")
    print(json.dumps({"measured": at, **measured}, indent=1))
