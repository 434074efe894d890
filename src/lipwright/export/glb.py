"""GLB: the character's model with the animation of its mouth beside what it holds.

One animation is added (glTF 2.0, section 3.11): for each node that shows a mesh with a
driven morph target, a channel of weights, linear between keys; for each driven joint, a
channel of rotations: the rotation at rest, then the turn. Morph targets that are not
driven keep their weight at rest. Nothing else in the file changes, but that a driven joint
which is placed by a matrix is placed by its parts instead. What is lost: the
control curves, and the sound, which glTF has no place for; words, phones and the frame
rate go into ``extras.lipwright``. glTF knows no time before 0: if the mouth moves before
the sound starts, all is later by that, and ``extras.lipwright.sound_start`` says when the
sound starts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lipwright.animation import Animation
from lipwright.errors import CharacterError, InputError
from lipwright.gltf import GltfWriter, MorphMesh, after_rest, morph_meshes, parse_glb, rest_rotation
from lipwright.performance import JointTurn, Performance
from lipwright.timeline import Tier

SUFFIXES = (".glb",)


def encode(performance: Performance) -> bytes:
    """Return a performance as the bytes of a GLB file.

    Raises
    ------
    CharacterError
        If the model has none of the morph targets that the performance moves.
    InputError
        If the animation has no frames.
    """
    rigged = performance.rig()
    model = parse_glb(rigged.glb, rigged.name)
    channels = rigged.channels
    if not len(channels):
        raise InputError("no frames", where=rigged.name, expected="an animation to write")
    moved = [
        mesh
        for mesh in morph_meshes(model)
        if mesh.nodes and set(mesh.targets) & set(channels.controls)
    ]
    turns = {n: turn for n, turn in rigged.joints.items() if n in channels.controls}
    if not moved and not turns:
        raise CharacterError(
            f"no morph target or joint of it is moved by {', '.join(channels.controls[:8])}",
            where=rigged.name,
        )
    writer = GltfWriter(model)
    _add_animation(writer, moved, channels, turns)
    return writer.finish().to_glb()


def _add_animation(
    writer: GltfWriter,
    moved: Sequence[MorphMesh],
    channels: Animation,
    turns: Mapping[str, JointTurn],
) -> None:
    frames = _needed(channels.values)
    sound_start = max(0.0, -channels.start)
    times = (channels.times[frames] + sound_start).astype(np.float32)
    clock = writer.accessor(times, limits=True)
    samplers: list[dict[str, Any]] = []
    targets: list[dict[str, Any]] = []
    for mesh in moved:
        for node, rest in zip(mesh.nodes, mesh.weights, strict=True):
            output = writer.accessor(_weights(mesh, rest, channels)[frames].ravel())
            targets.append({"sampler": len(samplers), "target": {"node": node, "path": "weights"}})
            samplers.append({"input": clock, "interpolation": "LINEAR", "output": output})
    for node, rotations in _rotations(writer, channels, turns).items():
        output = writer.accessor(rotations[frames])
        targets.append({"sampler": len(samplers), "target": {"node": node, "path": "rotation"}})
        samplers.append({"input": clock, "interpolation": "LINEAR", "output": output})
    animation = {"name": "Lipwright", "channels": targets, "samplers": samplers}
    extras = {"lipwright": _extras(channels, sound_start)}
    writer.add("animations", {**animation, "extras": extras})


def _rotations(
    writer: GltfWriter, channels: Animation, turns: Mapping[str, JointTurn]
) -> dict[int, NDArray[np.float32]]:
    """Return the rotation of each driven joint in every frame, (T, 4), x y z w."""
    angles: dict[int, NDArray[np.float64]] = {}
    for name, turn in turns.items():
        values = channels.control(name).astype(np.float64)
        turned = np.radians(turn.degrees) * values[:, None] * np.array(turn.axis)
        angles[turn.node] = angles.get(turn.node, 0.0) + turned
    found = {}
    for node, vectors in angles.items():
        rest = np.array(rest_rotation(writer.json["nodes"][node]))
        found[node] = after_rest(rest, vectors).astype(np.float32)
    return found


def _needed(values: NDArray[np.float32]) -> NDArray[np.intp]:
    """Return the frames without those inside a stretch where nothing changes."""
    moves = (np.diff(values, axis=0) != 0).any(axis=1)
    kept = np.concatenate(([True], moves)) | np.concatenate((moves, [True]))
    return np.flatnonzero(kept)


def _weights(mesh: MorphMesh, rest: tuple[float, ...], channels: Animation) -> NDArray[np.float32]:
    """Return the weight of every target of a mesh in every frame, (T, targets)."""
    weights = np.tile(np.array(rest, np.float32), (len(channels), 1))
    place = {name: index for index, name in enumerate(channels.controls)}
    for column, name in enumerate(mesh.targets):
        if name in place:
            weights[:, column] = channels.values[:, place[name]]
    return weights


def _extras(channels: Animation, sound_start: float) -> dict[str, Any]:
    return {
        "rate": channels.rate,
        "sound_start": sound_start,
        "engine": channels.engine,
        "words": _rows(channels.words, sound_start),
        "phone_set": channels.phones.phone_set,
        "phones": _rows(channels.phones.tier, sound_start),
    }


def _rows(tier: Tier, later: float) -> list[list[Any]]:
    return [[i.label, round(i.start + later, 6), round(i.end + later, 6)] for i in tier]
