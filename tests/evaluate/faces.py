"""Synthetic mouths whose likeness is known, and files of them."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from lipwright.evaluate import Curve, Pair, Recording
from lipwright.phones import PhoneTrack
from lipwright.timeline import Tier

Floats = NDArray[np.float64]
FRAME = 0.04
PHONES = PhoneTrack(
    Tier.of(
        ("sil", 0, 1), ("b", 1, 1.1), ("aa", 1.1, 1.4), ("m", 1.4, 1.5), ("iy", 1.5, 1.8),
        ("f", 1.8, 1.9), ("ow", 1.9, 2.2), ("sil", 2.2, 3),
    )
)  # fmt: skip
CLOSED = (1.05, 1.45, 1.85)


def mouth(times: Floats, closed: tuple[float, ...] = CLOSED) -> Floats:
    """A mouth that is open from 1 s to 2.2 s, 0..1, but for 0.1 s around each closure."""
    opening = np.interp(times, [0, 0.9, 1.0, 2.2, 2.4, 3], [0, 0, 1, 1, 0, 0])
    for middle in closed:
        opening *= np.clip((np.abs(times - middle) - 0.03) / 0.06, 0, 1)
    return opening


def frames(rate: float = 1 / FRAME) -> Floats:
    """Instants from 0 to 3 s."""
    return np.asarray((np.arange(round(3 * rate)) + 0.5) / rate, dtype=np.float64)


def recording(
    closed: tuple[float, ...] = CLOSED, later: float = 0.0, rate: float = 1 / FRAME
) -> Recording:
    """The mouth as a camera saw it."""
    times = frames(rate)
    opening = Curve(times, 0.01 + 0.13 * mouth(times - later, closed))
    return Recording(opening, Curve(times, 0.6 - 0.05 * np.sin(4 * (times - later))))


def pair(
    closed: tuple[float, ...] = CLOSED,
    seen: Recording | None = None,
    phones: PhoneTrack = PHONES,
) -> Pair:
    """The mouth as it was animated, in metres, beside a recording."""
    times = frames(200)
    breadth = Curve(times, 0.05 - 0.01 * np.sin(4 * times))
    opening = Curve(times, 0.02 * mouth(times, closed))
    return Pair(opening, breadth, seen or recording(rate=200), phones)


def write_recording(path: Path, gap: Floats, width: Floats) -> Path:
    """Write a measured face, a frame of 40 ms in each row."""
    rows = ["time,headYaw,lipGapInner,lipWidth"]
    rows += [
        f"{FRAME * k:.4f},0.5,{a:.6f},{b:.6f}"
        for k, (a, b) in enumerate(zip(gap, width, strict=True))
    ]
    path.write_text("\n".join(rows) + "\n")
    return path
