"""Faces for plain meshes: a model without morph targets learns to speak.

A face file (:mod:`.face_file`) says which clusters of vertices a model has (:mod:`.regions`)
and how they move in each expression, in the terms of the published face model
(:mod:`lipwright.character.face_model`); :mod:`.build` makes morph targets of it, with
in-betweens where a straight line would lose too much of a rotation.
"""

from lipwright.character.plain.build import BuiltFace, Loss, build_face
from lipwright.character.plain.face_file import FaceFile, read_face

__all__ = ["BuiltFace", "FaceFile", "Loss", "build_face", "read_face"]
