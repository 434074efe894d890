"""glTF 2.0 files: read, read from, and added to, without touching what else is in them.

A model is kept as its JSON and its binary chunk. New data go behind the old bytes and
new objects behind the old ones, so that every index, extension and sparse accessor of
the file stays as it was. Follows the glTF 2.0 specification (Khronos, ISO/IEC 12113).
It draws nothing and checks only what it reads.
"""

from lipwright.gltf.accessors import read_accessor
from lipwright.gltf.container import Gltf, parse_glb, parse_gltf, read_gltf, structure
from lipwright.gltf.morphs import MorphMesh, morph_meshes
from lipwright.gltf.pruning import keep_morphs
from lipwright.gltf.rotations import after_rest, rest_rotation
from lipwright.gltf.writer import TRIANGLES, VERTICES, GltfWriter

__all__ = [
    "TRIANGLES",
    "VERTICES",
    "Gltf",
    "GltfWriter",
    "MorphMesh",
    "after_rest",
    "keep_morphs",
    "morph_meshes",
    "parse_glb",
    "parse_gltf",
    "read_accessor",
    "read_gltf",
    "rest_rotation",
    "structure",
]
