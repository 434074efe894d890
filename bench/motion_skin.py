"""A face that markers drive, beside the same face as it truly moves.

109 markers as a capture of speech has them lie on the human head beside the project: a ring
of 20 on the borders of the lips, 36 about the mouth, the rest over the face. Recorded
ARKit curves move the head; its markers, exact ones and such as come out of a spoilt and
cleaned recording, move it once more through radial basis functions.
"""

import time
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from tests.engines.motion.capture.made import motion, spoil
from tests.marker_layouts import layout_on

from bench.measure import milliseconds, say
from bench.motion_capture import HEAD, MARKERS, at_rate
from bench.recordings import DATA
from lipwright.character import load_character
from lipwright.engines.motion.capture import clean, find_takes, read_motion
from lipwright.engines.motion.components import components
from lipwright.engines.motion.skin import bind_skin
from lipwright.marker_faces import FaceMesh, MarkerLayout, bind, drive, read_face_mesh

Floats = NDArray[np.float64]
TAKES, STEP = 12, 12
LIPS, FACE = 0.009, 0.13


def regions(face: FaceMesh) -> dict[str, NDArray[np.intp]]:
    """Vertices of the lips as one sees them, and of the face about them."""
    line, points = face.line, face.points
    apart = np.linalg.norm(points[:, None] - line[None], axis=2).min(axis=1)
    lips = face.outward & (apart < LIPS)
    about = face.outward & (np.linalg.norm(points - line.mean(axis=0), axis=1) < FACE)
    return {"lips": np.flatnonzero(lips), "face": np.flatnonzero(about & ~lips)}


def recordings(face: FaceMesh) -> Iterator[tuple[Floats, Floats]]:
    """For each take the weights (T, S) of shapes, and what each shape does (S, N, 3)."""
    kept: dict[str, Floats] = {}
    every = find_takes(DATA / "grid")
    for take in every[:: len(every) // TAKES][:TAKES]:
        curves = read_motion(take.motion)
        for name in curves.channels:
            if name not in kept:
                kept[name] = face.surfaces.positions({name: 1.0}) - face.points
        weights = at_rate(curves.values.astype(np.float64), curves.rate)
        yield weights, np.stack([kept[name] for name in curves.channels])


def recovered(true: Floats, rest: Floats, seed: int) -> Floats:
    """Displacements (T, M, 3) of markers that were spoilt and cleaned, as the face stands."""
    cleaned, report = clean(motion(spoil(true, seed).points))
    found = report.rest.points
    middle, goal = found.mean(axis=0), rest.mean(axis=0)
    u, _, v = np.linalg.svd((found - middle).T @ (rest - goal))
    u[:, 2] *= np.sign(np.linalg.det(u @ v))
    return np.asarray((cleaned.points + found - middle) @ (u @ v) + goal - rest)


def figures(errors: list[Floats]) -> dict[str, float]:
    """Root mean square, 95th percentile and greatest of errors, mm."""
    found = 1e3 * np.concatenate([error.ravel() for error in errors])
    return {
        "rms_mm": round(float(np.sqrt(np.mean(found**2))), 3),
        "p95_mm": round(float(np.quantile(found, 0.95)), 3),
        "max_mm": round(float(found.max()), 2),
    }


def measure() -> None:
    start = time.perf_counter()
    face = read_face_mesh(load_character(HEAD))
    read = time.perf_counter() - start
    chosen, seen = layout_on(face), regions(face)
    rest = face.points[chosen]
    start = time.perf_counter()
    skin = bind_skin(face.points, face.sides, rest, face.sides[chosen], face.line)
    bound = time.perf_counter() - start
    errors: dict[tuple[str, str], list[Floats]] = {}
    moved: list[Floats] = []
    for seed, (weights, shapes) in enumerate(recordings(face)):
        exact = np.einsum("ts,smi->tmi", weights, shapes[:, chosen])
        moved.append(exact[::STEP])
        for kind, markers in (
            ("exact", exact),
            ("cleaned", recovered(rest + exact, rest, seed)),
        ):
            for name, rows in seen.items():
                true = np.einsum("ts,svi->tvi", weights[::STEP], shapes[:, rows])
                made = np.einsum("vm,tmi->tvi", skin.weights[rows], markers[::STEP])
                errors.setdefault((kind, name), []).append(np.linalg.norm(made - true, axis=2))
    say(
        "motion_skin",
        markers=len(chosen),
        takes=TAKES,
        **{f"{name}_{kind}": figures(found) for (kind, name), found in errors.items()},
        **binding(face, chosen, np.concatenate(moved)),
        face_s=round(read, 2),
        weights_s=round(bound, 2),
        frame=frame_time(),
    )


def binding(face: FaceMesh, chosen: list[int], moves: Floats) -> dict[str, object]:
    """How far from their vertices the markers are put by one who knows nothing of them."""
    rng = np.random.default_rng(0)
    turn = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    rest = face.points[chosen] @ turn.T + rng.normal(size=3)
    found = components([(moves @ turn.T).reshape(len(moves), -1).astype(np.float32)], keep=0.99)
    mean, basis = found.mean.reshape(-1, 3), found.basis.reshape(len(found.basis), -1, 3)
    labels = tuple(f"m{number:03}" for number in range(len(rest)))
    layout = MarkerLayout(labels, rest, mean, basis, found.variance)
    start = time.perf_counter()
    bound = bind(layout, face)
    took = time.perf_counter() - start
    off = np.linalg.norm(bound.points - face.points[chosen], axis=1)
    other = bind(layout, read_face_mesh(load_character("head")))
    start = time.perf_counter()
    made = drive(layout, face, bound)
    return {
        "placed": figures([off]),
        "binding_s": round(took, 2),
        "beside_another_face_mm": round(1e3 * other.residual, 2),
        "targets": len(made.targets),
        "targets_s": round(time.perf_counter() - start, 2),
    }


def frame_time() -> dict[str, float]:
    """One frame of 10,000 vertices by 109 markers."""
    rng = np.random.default_rng(0)
    points, markers = rng.normal(size=(10_000, 3)), rng.normal(size=(MARKERS, 3))
    skin = bind_skin(points, np.ones(len(points)), markers, np.full(MARKERS, 0.5))
    moves = rng.normal(size=(MARKERS, 3)).astype(np.float32)
    return milliseconds(lambda: skin.moved(moves), runs=200)


if __name__ == "__main__":
    if HEAD.is_file():
        measure()
