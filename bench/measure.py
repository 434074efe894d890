"""How the measures measure: medians of several runs, memory at its peak, one JSON line."""

import json
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from typing import Any


def milliseconds(work: Callable[[], object], runs: int = 20, warm: int = 2) -> dict[str, float]:
    """Time ``work``: median, fastest and slowest of several runs on the wall clock."""
    for _ in range(warm):
        work()
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        work()
        times.append(1e3 * (time.perf_counter() - start))
    return spread(times)


def spread(times: list[float]) -> dict[str, float]:
    """Median, least and greatest of some times, rounded."""
    return {
        "median_ms": round(statistics.median(times), 3),
        "least_ms": round(min(times), 3),
        "greatest_ms": round(max(times), 3),
    }


def command(arguments: list[str], runs: int = 7) -> dict[str, float]:
    """Time a whole command, its start included."""

    def run() -> None:
        subprocess.run(arguments, check=True, capture_output=True)

    return milliseconds(run, runs=runs, warm=1)


def lipwright(*arguments: str) -> list[str]:
    """The command line under the Python that runs this."""
    return [sys.executable, "-m", "lipwright", *arguments]


def peak_mb(code: str) -> float:
    """Greatest memory of a fresh Python that runs ``code``, in MB."""
    tail = (
        "\nimport resource, sys\n"
        "peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss\n"
        "print(peak / (1024 if sys.platform != 'darwin' else 1024 * 1024))"
    )
    run = subprocess.run(
        [sys.executable, "-c", code + tail], check=True, capture_output=True, text=True
    )
    return round(float(run.stdout.split()[-1]), 1)


def say(measure: str, **figures: Any) -> None:
    """Print one JSON line."""
    print(json.dumps({"measure": measure, **figures}), flush=True)
