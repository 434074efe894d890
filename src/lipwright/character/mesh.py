"""Meshes of a character: what every model maker hands to every model writer.

A :class:`Part` is one surface with one :class:`Material` and its morph targets (targets
are displacements, so that weights add; DESIGN 7). Normals are not kept here: whoever
writes or draws a part computes them from its shared vertices. It reads and writes no files.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True)
class Material:
    """How a surface answers light (the metallic-roughness model of glTF 2.0).

    Parameters
    ----------
    name : str
        The material's name.
    color : tuple of 4 float
        Linear red, green, blue and opacity, each 0..1.
    roughness, metallic : float
        0..1.
    double_sided : bool
        Whether the surface is seen from behind, too.
    """

    name: str
    color: tuple[float, float, float, float]
    roughness: float = 0.6
    metallic: float = 0.0
    double_sided: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """One mesh of a character.

    Parameters
    ----------
    name : str
        The part's name.
    positions : (V, 3) float32, metres
        +y is up, +z points out of the face, x > 0 is the character's left.
    triangles : (F, 3) uint32
        Vertex numbers, counter-clockwise seen from outside.
    material : Material
        How the part looks.
    morphs : dict of str to (V, 3) float32, metres
        Displacement of each vertex at weight 1; only targets that move this part.
    colors : (V, 3) float32, 0..1, optional
        Linear vertex colours, multiplied with the material's.
    """

    name: str
    positions: NDArray[np.float32]
    triangles: NDArray[np.uint32]
    material: Material
    morphs: dict[str, NDArray[np.float32]]
    colors: NDArray[np.float32] | None
