"""``python -m tools.boundaries``: writes ``src/lipwright/data/boundaries/english.npz`` anew.

It needs espeak-ng (extra ``tts``) and Festival with its voice ``slt``, and takes some
minutes. The same versions of both give the same bytes.
"""

from __future__ import annotations

import os

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # the order of sums must not depend on the machine

import numpy as np

from lipwright.files import write_atomically
from lipwright.phones import load_phone_set
from lipwright.schedule.align.bands import bands, contexts
from lipwright.schedule.align.boundaries import DATA, FRAME, REACH, as_bytes
from tools.boundaries.learn import Examples, learnt
from tools.boundaries.lines import Line, requests, speak_all
from tools.boundaries.worsen import worsened

ESPEAK, FESTIVAL = 300, 160  # lines
TAKES = {"espeak": 2, "festival": 3}  # how often each is made worse anew
_ERROR = 0.02  # s by which the decoder's boundaries are off, about
_FURTHEST = 0.04
_PEAK = 0.006  # s, width of the target
PHONES = tuple(label for label in load_phone_set("arpabet").labels if label != "ax")


def examples(lines: list[Line], rng: np.random.Generator) -> Examples:
    """Return every boundary of the lines, each about where a decoder might put it."""
    around, left, right, targets = [], [], [], []
    for line in lines:
        samples, faster = worsened(line.samples, line.rate, rng)
        near = contexts(bands(samples))
        for before, after, time in line.boundaries:
            true = time / faster
            guess = true + float(np.clip(rng.normal(0, _ERROR), -_FURTHEST, _FURTHEST))
            instants = round(guess / FRAME) + np.arange(-REACH, REACH + 1)
            if instants[0] < 0 or instants[-1] >= len(near):
                continue
            peak = np.exp(-0.5 * ((true - instants * FRAME) / _PEAK) ** 2) + 1e-9
            around.append(near[instants])
            left.append(PHONES.index(before))
            right.append(PHONES.index(after))
            targets.append((peak / peak.sum()).astype(np.float32))
    return Examples(np.array(around), np.array(left), np.array(right), np.array(targets))


def main() -> None:
    """Speak, learn, write."""
    rng = np.random.default_rng(0)
    wanted = requests(rng, ESPEAK, FESTIVAL)
    lines = speak_all(wanted)
    repeated = [
        line
        for line, request in zip(lines, wanted, strict=True)
        for _ in range(TAKES["festival" if request.voice == "festival" else "espeak"])
    ]
    found = examples(repeated, rng)
    DATA.parent.mkdir(exist_ok=True)
    write_atomically(DATA, as_bytes(learnt(PHONES, found, rng)))
    print(f"{DATA.name}: learnt from {len(found.left)} boundaries of {len(lines)} lines")


if __name__ == "__main__":
    main()
