"""Markers that drive a character: recorded points, bound to the mesh of any face.

A layout of markers is laid onto the face (:mod:`.aligning`), each marker is put on its skin
(:mod:`.placing`), and what the markers do becomes morph targets (:mod:`.driving`): a mesh that
radial basis functions drive is linear in its markers, so that the targets lose nothing.
Where markers lie is a file that an artist may edit (:mod:`.marker_file`).
"""

from lipwright.marker_faces.binding import Binding, bind
from lipwright.marker_faces.driving import MarkerFace, drive, marker_face
from lipwright.marker_faces.face_mesh import FaceMesh, read_face_mesh
from lipwright.marker_faces.layout import MarkerLayout
from lipwright.marker_faces.marker_file import MarkerFile, read_marker_file
from lipwright.marker_faces.telling import ByMarkers, by_markers

__all__ = [
    "Binding",
    "ByMarkers",
    "FaceMesh",
    "MarkerFace",
    "MarkerFile",
    "MarkerLayout",
    "bind",
    "by_markers",
    "drive",
    "marker_face",
    "read_face_mesh",
    "read_marker_file",
]
