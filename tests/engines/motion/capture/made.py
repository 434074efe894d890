"""Captures made by code: markers on a face that is known, then spoilt as recordings are."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import ezc3d
import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.capture.motion import Motion
from lipwright.markers import marker_channels

Floats = NDArray[np.float64]
RATE = 120.0


@dataclass(frozen=True, slots=True, eq=False)
class Spoilt:
    """What a camera would have given, and what was done."""

    points: Floats  # (T, M, 3), metres
    swaps: tuple[tuple[int, int, int, int], ...]  # one marker, the other, first, last frame
    spikes: int


def spread(points: Floats, count: int, first: int) -> list[int]:
    """Indices of points that lie far from one another, as markers do."""
    chosen = [first]
    near = np.linalg.norm(points - points[first], axis=1)
    while len(chosen) < count:
        chosen.append(int(np.argmax(near)))
        near = np.minimum(near, np.linalg.norm(points - points[chosen[-1]], axis=1))
    return chosen


def moving_head(count: int, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """Turns (T, 3, 3) and shifts (T, 3): nods of some 10°, and steps of some 40 mm."""
    at = np.arange(count) / RATE
    sway = np.stack(
        [
            sum(
                rng.normal() * np.sin(2 * np.pi * f * at + rng.uniform(0, 6)) / (1 + k)
                for k, f in enumerate((0.2, 0.5, 1.1))
            )
            for _ in range(6)
        ],
        axis=1,
    )
    x, y, z = 0.12 * sway[:, :3].T
    turns = np.empty((count, 3, 3))
    for axis, angle in enumerate((x, y, z)):
        one = np.tile(np.eye(3), (count, 1, 1))
        a, b = (axis + 1) % 3, (axis + 2) % 3
        one[:, a, a] = one[:, b, b] = np.cos(angle)
        one[:, a, b], one[:, b, a] = np.sin(angle), -np.sin(angle)
        turns = one if axis == 0 else turns @ one
    return turns, 0.03 * sway[:, 3:] + [0.1, 1.5, 0.3]


def spoil(
    true: Floats,
    seed: int,
    *,
    noise: float = 1e-4,
    gaps: float = 0.02,
    swaps: int = 4,
    spikes: int = 10,
    longest: float = 0.4,
) -> Spoilt:
    """Let the head move, and add noise, gaps, spikes and swapped neighbours."""
    rng = np.random.default_rng(seed)
    frames, markers = true.shape[:2]
    turns, shifts = moving_head(frames, rng)
    points = true @ turns + shifts[:, None] + rng.normal(scale=noise, size=true.shape)
    for _ in range(spikes):
        points[rng.integers(frames), rng.integers(markers)] += rng.normal(scale=0.02, size=3)
    apart = np.linalg.norm(true[0][:, None] - true[0][None], axis=2)
    np.fill_diagonal(apart, np.inf)
    done = []
    for one in rng.permutation(markers)[:swaps].tolist():
        other = int(np.argmin(apart[one]))
        first = int(rng.integers(10, frames * 2 // 3))
        last = first + int(rng.integers(12, max(13, min(frames // 4, 120))))
        points[first:last, [one, other]] = points[first:last, [other, one]]
        done.append((one, other, first, last))
    lost = np.zeros((frames, markers), dtype=bool)
    while lost.mean() < gaps:
        first = int(rng.integers(frames))
        lost[
            first : first + int(rng.integers(1, int(longest * RATE))), int(rng.integers(markers))
        ] = True
    points[lost] = np.nan
    return Spoilt(points, tuple(done), spikes)


def motion(points: Floats, labels: Sequence[str] = (), rate: float = RATE) -> Motion:
    """Markers as :func:`read_c3d` would give them."""
    names = tuple(labels) or tuple(f"m{i:03}" for i in range(points.shape[1]))
    values = points.reshape(len(points), -1).astype(np.float32)
    return Motion(marker_channels(names), values, rate, 0.0, (), "markers", "made.c3d")


def write_c3d(
    path: Path,
    points: Floats,
    labels: Sequence[str],
    *,
    unit: str = "mm",
    scale: float = 1e3,
    rate: float = RATE,
) -> Path:
    """Write markers in metres as a C3D file; NaN as it is."""
    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [rate]
    file["parameters"]["POINT"]["UNITS"]["value"] = [unit]
    file["parameters"]["POINT"]["LABELS"]["value"] = list(labels)
    data = np.ones((4, points.shape[1], points.shape[0]))
    data[:3] = scale * points.transpose(2, 1, 0)
    file["data"]["points"] = data
    file.write(str(path))
    return path


def error_mm(cleaned: Motion, rest: Floats, true: Floats) -> Floats:
    """Distances (T, M) in mm between cleaned markers and the truth, laid on one another."""
    found = cleaned.points + rest
    face, goal = found.mean(axis=0), true.mean(axis=0)
    middle, target = face.mean(axis=0), goal.mean(axis=0)
    u, _, v = np.linalg.svd((face - middle).T @ (goal - target))
    u[:, 2] *= np.sign(np.linalg.det(u @ v))
    laid = (found - middle) @ (u @ v) + target
    return np.asarray(1e3 * np.linalg.norm(laid - true, axis=2))
