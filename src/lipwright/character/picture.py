"""A picture of the mouth as it was found: which vertices are lips and corners, in some poses.

SVG, drawn from the triangles: from the front, without perspective, those behind first
(painter's algorithm). Textures are not drawn, only each material's own colour, shaded.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from lipwright.character.calibration import Calibration
from lipwright.character.fitting import Fitting
from lipwright.character.mouth import Mouth
from lipwright.character.surfaces import Surfaces
from lipwright.errors import CharacterError

Floats = NDArray[np.float64]

POSES: tuple[tuple[str, dict[str, float]], ...] = (
    ("rest", {}),
    ("open 0.5", {"open": 0.5}),
    ("PBM 1", {"PBM": 1.0}),
    ("W 1", {"W": 1.0}),
)
_SIZE, _EDGE, _HEAD, _FOOT = 330, 14, 34, 62
_SEEN = 0.85
"""Half the side of what is shown, of the mouth's width."""
_UPPER, _LOWER, _CORNER = "#e8590c", "#1c7ed6", "#2b8a3e"
_HOLLOW = "#3d2423"
_LIGHT = np.array([-0.35, 0.5, 0.79])
_DULL = 0.35
_FINE = 10
_STEPS = 6
_POINTS = (
    np.array([(i, j, _STEPS - i - j) for i in range(_STEPS + 1) for j in range(_STEPS + 1 - i)])
    * (0.94 / _STEPS)
    + 0.02
)
"""Points all over a triangle, as shares of its corners."""


def mouth_picture(name: str, fitting: Fitting, calibration: Calibration) -> str:
    """Return the picture as SVG.

    Parameters
    ----------
    name : str
        The character's name.
    fitting : Fitting
        With the gains to show.
    calibration : Calibration
        What was found on the mesh.

    Raises
    ------
    CharacterError
        If no mouth was found.
    """
    mouth, face = calibration.mouth, calibration.face
    if mouth is None or face is None:
        raise CharacterError(f"no mouth to draw: {calibration.reason}", where=name)
    poses = [(title, made) for title, made in POSES if made.keys() <= fitting.controls.keys()]
    width = len(poses) * (_SIZE + _EDGE) + _EDGE
    height = _HEAD + _SIZE + _FOOT
    rows = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="13">',
        f"<title>The mouth of {_text(name)}</title>",
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
    ]
    for number, (title, weights) in enumerate(poses):
        left = _EDGE + number * (_SIZE + _EDGE)
        rows += _panel(left, title, fitting.values(weights), mouth, face)
    rows += [*_legend(mouth, height - 14), "</svg>"]
    return "\n".join(rows) + "\n"


def _panel(
    left: float, title: str, values: dict[str, float], mouth: Mouth, face: Surfaces
) -> list[str]:
    rest, points = face.positions({}), face.positions(values)
    line = (rest[mouth.upper] + rest[mouth.lower]) / 2
    centre = np.array([line[:, 0].mean(), line[:, 1].mean() - 0.15 * mouth.width])
    scale = _SIZE / (2 * _SEEN * mouth.width)

    def on_page(where: Floats) -> Floats:
        flat = (where[..., :2] - centre) * (scale, -scale)
        return np.asarray(np.add(flat, (left + _SIZE / 2, _HEAD + _SIZE / 2)))

    stance = mouth.stand(values)
    said = f"gap {max(stance.gap, 0.0):.1%} of the width, width {stance.width:.0%}"
    clip = f"at{round(left)}"
    box = f'x="{left}" y="{_HEAD}" width="{_SIZE}" height="{_SIZE}"'
    rows = [
        f'<clipPath id="{clip}"><rect {box}/></clipPath>',
        f'<text x="{left}" y="{_HEAD - 10}" font-weight="bold">{title}</text>',
        f'<text x="{left}" y="{_HEAD + _SIZE + 18}" fill="#495057">{said}</text>',
        f'<g clip-path="url(#{clip})"><rect {box} fill="#dee2e6"/>',
        _inside(mouth, on_page(points)),
        f'<g transform="scale({1 / _FINE:g})" fill="currentColor" stroke="currentColor" '
        f'stroke-width="{0.6 * _FINE:g}" stroke-linejoin="round">',
    ]
    rows += _triangles(face, points, centre, mouth.width, on_page)
    rows += ["</g>", *_marks(mouth, on_page(points)), "</g>"]
    return rows


def _triangles(
    face: Surfaces,
    points: Floats,
    centre: Floats,
    width: float,
    on_page: Callable[[Floats], Floats],
) -> list[str]:
    """Return the triangles about the mouth that are seen, those behind first."""
    triangles = face.triangles
    moved = points[triangles]
    offset = moved[:, :, :2] - centre
    near = (offset.min(axis=1) < _SEEN * width).all(axis=1)
    near &= (offset.max(axis=1) > -_SEEN * width).all(axis=1)
    near &= np.ptp(moved, axis=1).max(axis=1) < 2 * width
    front = moved[near][:, :, 2].max() if near.any() else 0.0
    near &= moved[:, :, 2].max(axis=1) > front - 1.6 * width
    triangles, moved = triangles[near], moved[near]
    normals = _normals(moved)
    order = np.argsort(moved[:, :, 2].mean(axis=1), kind="stable")
    order = order[normals[order, 2] > 0]
    order = order[_seen(on_page(moved[order]), moved[order, :, 2], 0.02 * width)]
    triangles, moved, normals = triangles[order], moved[order], normals[order]
    colors = _colors(face, triangles, normals)
    flat = np.round(_FINE * on_page(moved)).astype(int).tolist()
    return [
        f'<path d="M{a} {b}l{c - a} {d - b} {e - c} {f - d}z" color="{color}"/>'
        for ((a, b), (c, d), (e, f)), color in zip(flat, colors, strict=True)
    ]


def _seen(corners: Floats, depths: Floats, near: float) -> NDArray[np.bool_]:
    """Return which triangles are not hidden whole: looked at in points, on a grid of pixels.

    ``corners`` (F, 3, 2) are in pixels, ``depths`` (F, 3) rise to the front; what lies less
    than ``near`` behind another is still seen.
    """
    if not len(corners):
        return np.zeros(0, np.bool_)
    places = np.floor(_POINTS @ corners).astype(np.intp)
    places -= places.min(axis=(0, 1))
    pixel = places[..., 0] * (places[..., 1].max() + 1) + places[..., 1]
    depth = depths @ _POINTS.T
    front = np.full(pixel.max() + 1, -np.inf)
    np.maximum.at(front, pixel.ravel(), depth.ravel())
    return np.asarray((depth >= front[pixel] - near).any(axis=1))


def _normals(corners: Floats) -> Floats:
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    return np.asarray(normals / np.where(lengths > 0, lengths, 1.0)[:, None])


def _colors(face: Surfaces, triangles: NDArray[np.intp], normals: Floats) -> list[str]:
    """Return the colour of each triangle: its material's, darker where it turns from the light."""
    shade = _DULL + (1 - _DULL) * np.clip(normals @ _LIGHT, 0.0, 1.0)
    own = np.array([part.color for part in face.parts])[face.part_of[triangles[:, 0]]]
    levels = np.clip(own * shade[:, None], 0, 1) ** (1 / 2.2)
    bytes_ = np.round(255 * levels).astype(int)
    return [f"#{r:02x}{g:02x}{b:02x}" for r, g, b in bytes_.tolist()]


def _inside(mouth: Mouth, places: Floats) -> str:
    """Return what is between the lips, dark, in case the model has nothing there."""
    around = np.concatenate([places[mouth.upper], places[mouth.lower][::-1]]).round(1)
    points = " ".join(f"{x:g},{y:g}" for x, y in around.tolist())
    return f'<polygon points="{points}" fill="{_HOLLOW}"/>'


def _marks(mouth: Mouth, places: Floats) -> list[str]:
    rows = []
    for vertices, color in ((mouth.upper, _UPPER), (mouth.lower, _LOWER)):
        for x, y in np.round(places[vertices], 1).tolist():
            rows.append(_dot(x, y, color))
    for x, y in np.round(places[list(mouth.corners)], 1).tolist():
        rows.append(
            f'<path d="M{x - 7:g} {y:g}h14M{x:g} {y - 7:g}v14" stroke="{_CORNER}" '
            'stroke-width="2.5" fill="none"/>'
        )
    return rows


def _dot(x: float, y: float, color: str) -> str:
    return (
        f'<circle cx="{x:g}" cy="{y:g}" r="2.6" fill="{color}" stroke="#fff" stroke-width="0.7"/>'
    )


def _legend(mouth: Mouth, y: float) -> list[str]:
    words = [
        (_UPPER, f"upper inner lip, {len(mouth.upper)} vertices"),
        (_LOWER, f"lower inner lip, {len(mouth.lower)} vertices"),
        (_CORNER, "corners of the mouth"),
    ]
    rows, x = [], float(_EDGE)
    for color, said in words:
        rows += [_dot(x + 4, y - 4, color), f'<text x="{x + 13:g}" y="{y}">{said}</text>']
        x += 30 + 6.8 * len(said)
    return rows


def _text(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
