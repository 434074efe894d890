"""The page draws curves as the engine samples them: both read one file of cases.

The page's own test (``web/tests``) reads the same file.
"""

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lipwright.engines.bigram.model import Pose
from lipwright.engines.bigram.polyline import Axis
from lipwright.engines.bigram.softening import sample

CASES = Path(__file__).parents[2] / "web" / "tests" / "sampling.json"
COUNT, RATE = 81, 20.0
KINDS = ("soften", "bspline", "pchip", "linear")


def made() -> list[dict[str, Any]]:
    """Lines with keys anywhere, sampled from 0 to 4 s."""
    rng = np.random.default_rng(7)
    cases = []
    for number in range(6):
        times = np.concatenate(([0.0], np.sort(rng.uniform(0.3, 3.6, 3 + number)), [4.05]))
        values = rng.uniform(0, 1, len(times)).round(4)
        times = times.round(4)
        values[[0, -1]] = 0
        for kind in KINDS:
            for softness in (0.0, 0.012, 0.1) if kind == "soften" else (0.0,):
                pose = Pose("open", 1, softness=softness)
                axis = Axis(0.0, 4.05 + 1e-6, 1)
                sampled = sample((times, values), axis, (pose,), 0.0, COUNT, RATE, kind)[0]
                keys = [[float(t), float(v)] for t, v in zip(times, values, strict=True)]
                cases.append(
                    {
                        "kind": kind,
                        "softness": softness,
                        "keys": keys,
                        "rate": RATE,
                        "values": sampled.round(9).tolist(),
                    }
                )
    return cases


def text() -> str:
    return "[\n" + ",\n".join(json.dumps(case) for case in made()) + "\n]\n"


def test_the_cases_are_what_the_engine_samples() -> None:
    if os.environ.get("LIPWRIGHT_RENEW"):
        CASES.write_text(text(), "utf-8")
    stored = json.loads(CASES.read_text("utf-8"))
    now = made()
    assert [case["keys"] for case in stored] == [case["keys"] for case in now]
    for known, case in zip(stored, now, strict=True):
        assert known["values"] == pytest.approx(case["values"], abs=1e-8)
