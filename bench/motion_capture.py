"""Markers made on a known face, spoilt as recordings are, written as C3D, and recovered.

109 vertices of the human head beside the project are driven by recorded ARKit curves at
120 Hz; then come head motion, 0.1 mm of noise, 2 % gaps, spikes and swapped neighbours.
"""

import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from tests.engines.motion.capture.made import RATE, error_mm, spoil, spread, write_c3d

from bench.measure import say
from bench.recordings import DATA
from lipwright.engines.motion.capture import CleaningReport, clean, find_takes, read_motion
from lipwright.gltf import morph_meshes, read_accessor, read_gltf

Floats = NDArray[np.float64]
HEAD = DATA.parent / "characters" / "ict_head.glb"
MARKERS, TAKES, SWAPS = 109, 24, 4


def face(path: Path) -> tuple[Floats, dict[str, Floats]]:
    """The largest mesh of a model: its vertices, metres, and its morph targets."""
    model = read_gltf(path)
    meshes = {mesh.index: mesh for mesh in morph_meshes(model)}
    best: tuple[Floats, dict[str, Floats]] = np.zeros((0, 3)), {}
    for index, mesh in meshes.items():
        primitive = model.items("meshes")[index]["primitives"][0]
        points = read_accessor(model, primitive["attributes"]["POSITION"]).astype(np.float64)
        if len(points) > len(best[0]):
            moves = {
                name: read_accessor(model, target["POSITION"]).astype(np.float64)
                for name, target in zip(mesh.targets, primitive["targets"], strict=True)
            }
            best = points, moves
    return best


def on_face(points: Floats, moves: dict[str, Floats]) -> list[int]:
    """Vertices for markers: half of them where the mouth moves, the rest over the face."""
    reach = sum(np.linalg.norm(moves[n], axis=1) for n in moves if n.startswith(("jaw", "mouth")))
    front = np.flatnonzero(points[:, 2] > np.quantile(points[:, 2], 0.6))
    mouth = front[np.asarray(reach)[front] > np.quantile(np.asarray(reach)[front], 0.7)]
    chosen: list[int] = mouth[spread(points[mouth], MARKERS // 2, 0)].tolist()
    rest = [int(i) for i in front[spread(points[front], MARKERS, 0)] if i not in chosen]
    return chosen + rest[: MARKERS - len(chosen)]


def at_rate(values: Floats, rate: float) -> Floats:
    """Curves at 120 Hz, smooth between their frames."""
    at = np.arange(int(len(values) * RATE / rate)) / RATE * rate
    lines = np.stack([np.interp(at, np.arange(len(values)), c) for c in values.T], axis=1)
    kernel = np.hanning(int(RATE / rate) + 2)
    padded = np.pad(lines, ((len(kernel) // 2, len(kernel) - 1 - len(kernel) // 2), (0, 0)), "edge")
    return np.stack([np.convolve(c, kernel / kernel.sum(), "valid") for c in padded.T], axis=1)


def recovered(folder: Path, takes: int) -> Iterator[tuple[Floats, CleaningReport, int]]:
    """Errors (T, M) in mm of takes that were spoilt and cleaned, what was mended, and
    how many of the swaps were found with their labels and frames."""
    points, moves = face(HEAD)
    chosen = on_face(points, moves)
    labels = [f"m{i:03}" for i in range(MARKERS)]
    every = find_takes(DATA / "grid")
    for seed, take in enumerate(every[:: len(every) // takes][:takes]):
        curves = read_motion(take.motion)
        weights = at_rate(curves.values.astype(np.float64), curves.rate)
        shapes = np.stack([moves[name][chosen] for name in curves.channels])
        true = points[chosen] + np.einsum("tc,cmi->tmi", weights, shapes)
        spoilt = spoil(true, seed, swaps=SWAPS)
        path = write_c3d(folder / f"{take.name}.c3d", spoilt.points, labels)
        cleaned, report = clean(read_motion(path))
        made = [
            f"{labels[min(a, b)]} and {labels[max(a, b)]} {i / RATE:.2f} to {j / RATE:.2f} s"
            for a, b, i, j in spoilt.swaps
        ]
        right = sum(swap in report.swaps for swap in made)
        yield error_mm(cleaned, report.rest.points, true), report, right


def measure() -> None:
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        found = list(recovered(Path(folder), TAKES))
    wall = time.perf_counter() - start
    for _, report, _ in found:
        print(report, file=sys.stderr)
    errors = np.concatenate([error for error, _, _ in found])
    say(
        "motion_capture",
        takes=TAKES,
        seconds=round(len(errors) / RATE, 1),
        rms_mm=round(float(np.sqrt(np.mean(errors**2))), 4),
        worst_take_rms_mm=round(max(float(np.sqrt(np.mean(e**2))) for e, _, _ in found), 4),
        worst_mm=round(float(errors.max()), 3),
        share_over_1mm=round(float(np.mean(errors > 1)), 6),
        swapped=TAKES * SWAPS,
        mended=sum(right for _, _, right in found),
        made_and_cleaned_share_of_length=round(wall / (len(errors) / RATE), 3),
    )


if __name__ == "__main__":
    if HEAD.is_file():
        measure()
