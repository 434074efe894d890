"""A plain mesh with two lips that lie on each other, and a face file for it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from lipwright.character.builtin import to_gltf
from lipwright.character.mesh import Material, Part
from lipwright.gltf import Gltf

SIDE = np.linspace(-3.0, 3.0, 7)
HEIGHTS = np.linspace(0.0, 3.0, 4)
SKIN = Material("skin", (0.7, 0.5, 0.4, 1.0))


def lip(name: str, up: float) -> Part:
    """A sheet that ends on the line y = 0, above it or below it; in centimetres."""
    x, y = np.meshgrid(SIDE, up * HEIGHTS)
    points = np.stack((x.ravel(), y.ravel(), np.zeros(x.size)), axis=1)
    columns = len(SIDE)
    triangles = []
    for row in range(len(HEIGHTS) - 1):
        for column in range(columns - 1):
            a = row * columns + column
            b, c, d = a + 1, a + columns, a + columns + 1
            triangles += [(a, b, d), (a, d, c)] if up > 0 else [(a, d, b), (a, c, d)]
    return Part(name, points.astype(np.float32), np.array(triangles, np.uint32), SKIN, {}, None)


def face(**changes: Any) -> dict[str, Any]:
    """A face file's content: a jaw that turns, lips that narrow; changed at the top."""
    return {
        "format": "lipwright/face",
        "version": 1,
        "name": "Two lips",
        "model": "lips.obj",
        "unit": 0.01,
        "clusters": {
            "jaw": [{"along": {"point": [0, -2, 0], "radius": 9, "core": 0.9}}],
            "mouth": [{"sphere": {"center": [0, 0, 0], "radius": 6}}],
        },
        "expressions": {
            "open": [
                {
                    "cluster": "jaw",
                    "turn": {"degrees": 30, "axis": [2, 0, 0], "pivot": [0, 0, -6]},
                }
            ],
            "W": [
                {
                    "cluster": "mouth",
                    "scale": {"center": [0, 0, 0], "factors": [0.5, 1, 1]},
                    "shift": [0, 0, 1],
                }
            ],
        },
        "mixtures": {"oo": {"W": 0.8, "open": 0.2}},
        "between": {"open": [0.5]},
        **changes,
    }


def obj() -> str:
    """The two lips as one OBJ, every vertex of its own."""
    lines, first = ["mtllib lips.mtl"], 1
    for part in (lip("upper", 1.0), lip("lower", -1.0)):
        lines += [f"o {part.name}", "usemtl skin"]
        lines += ["v {:.4f} {:.4f} {:.4f}".format(*point) for point in part.positions]
        lines += ["f {} {} {}".format(*(corners + first)) for corners in part.triangles]
        first += len(part.positions)
    return "\n".join(lines) + "\n"


def glb(scale: float = 0.01) -> Gltf:
    """The same as glTF, in metres."""
    parts = [lip("upper", 1.0), lip("lower", -1.0)]
    return to_gltf(
        [
            Part(p.name, p.positions * np.float32(scale), p.triangles, p.material, {}, None)
            for p in parts
        ],
        "Lips",
    )


def written(folder: Path, content: dict[str, Any] | None = None) -> Path:
    """Write mesh and face file; return the face file."""
    (folder / "lips.obj").write_text(obj(), encoding="utf-8")
    path = folder / "face.json"
    path.write_text(json.dumps(content or face()), encoding="utf-8")
    return path
