"""From markers on a face to morph targets: the mean, the components, and lips parted.

Skin follows the markers by radial basis functions (:mod:`lipwright.engines.motion.skin`).
Lower teeth and tongue follow the chin as the model's own jaw does, and go aside with it. What
lies close to the skin (brows, lashes, the lining of the mouth) goes with it; hair, eyes, clothes
and upper teeth stay. A target is what one standard deviation of its component does.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.motion.skin import Skin, bind_skin, smooth
from lipwright.gltf import Gltf
from lipwright.marker_faces.binding import Binding, bind
from lipwright.marker_faces.contact import APART, Contact, contact, parting
from lipwright.marker_faces.face_mesh import FaceMesh, read_face_mesh
from lipwright.marker_faces.layout import MarkerLayout
from lipwright.marker_faces.marker_file import read_marker_file
from lipwright.marker_faces.writing import with_targets

if TYPE_CHECKING:
    from lipwright.character import Character

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

MEAN = "markers mean"
_STEP = "markers {}"
_TIGHT, _LOOSE = 0.02, 0.15
"""Of the mouth's width: what is nearer to the skin goes with it, what is farther does not."""
_BELOW = 0.2
_CORNER = 0.1
_OWN_WAY = 0.3
_AT_ONCE = 512


@dataclass(frozen=True, slots=True, eq=False)
class MarkerFace:
    """A model that markers drive.

    Parameters
    ----------
    name : str
        The character's.
    model : Gltf
        With the targets added to what it had.
    targets : tuple of str
        Their names: what an animation of it has as controls. First the mean, then the
        components, last what keeps the lips from crossing.
    steps : (1 + K, M, 3) float64, metres
        What each does to the markers, in the layout's axes.
    deviations : (K,) float64
        What of a component's coefficient is 1 of its target.
    skin : Skin
        How the skin follows the markers.
    contact : Contact
        When the lips cross.
    note : str
        How well the markers lie on the face.
    """

    name: str
    model: Gltf
    targets: tuple[str, ...]
    steps: Floats
    deviations: Floats
    skin: Skin
    contact: Contact
    note: str = ""

    def weights(self, coefficients: NDArray[np.floating]) -> NDArray[np.float32]:
        """Return the targets' weights (T, 2 + K) for coefficients (T, K) of the components."""
        mean = np.ones((len(coefficients), 1))
        return self._whole(np.concatenate([mean, coefficients / self.deviations], axis=1))

    def weights_of(self, displacements: NDArray[np.floating]) -> NDArray[np.float32]:
        """Return the weights (T, 2 + K) for displacements (T, M, 3) or (T, 3 M) in metres.

        Those that come nearest; exact where the displacements are made of the mean and the
        components.
        """
        flat = np.asarray(displacements, np.float64).reshape(len(displacements), -1)
        steps = self.steps.reshape(len(self.steps), -1)
        parts = np.linalg.lstsq(steps[1:].T, (flat - steps[0]).T, rcond=None)[0].T
        return self._whole(np.concatenate([np.ones((len(flat), 1)), parts], axis=1))

    def _whole(self, weights: Floats) -> NDArray[np.float32]:
        parted = self.contact.weights(weights)
        return np.column_stack([weights, parted]).astype(np.float32)


def marker_face(
    character: Character, layout: MarkerLayout, file: str | Path | None = None
) -> MarkerFace:
    """Return a character as a layout of markers drives it.

    Parameters
    ----------
    character : Character
    layout : MarkerLayout
    file : path, optional
        A marker file, which goes before what is found.

    Raises
    ------
    CharacterError
        If no mouth can be found on the character, or the markers do not fit its face.
    InputError
        If the file cannot be used.
    """
    face = read_face_mesh(character)
    given = read_marker_file(file) if file is not None else None
    return drive(layout, face, bind(layout, face, given))


def drive(layout: MarkerLayout, face: FaceMesh, binding: Binding) -> MarkerFace:
    """Give a model the morph targets by which markers drive it.

    Parameters
    ----------
    layout : MarkerLayout
    face : FaceMesh
    binding : Binding
        Of this layout to this face.

    Raises
    ------
    CharacterError
        If the model has such targets already.
    """
    deviations = np.sqrt(np.maximum(layout.variance, 1e-18))
    steps = np.concatenate([layout.mean[None], deviations[:, None, None] * layout.basis])
    moves = binding.alignment.moved(steps)
    rows = np.flatnonzero(face.skin)
    sides = marker_sides(face, binding)
    skin = bind_skin(face.points[rows], face.sides[rows], binding.points, sides, face.line)
    parted = parting(face)
    inner = _inner(face, binding.points, sides, moves)
    inner = np.concatenate([inner, np.zeros_like(parted)[None]])
    whole = np.where(face.still[:, None], 0.0, inner)
    whole[:-1, rows], whole[-1, rows] = skin.targets(moves), parted[rows]
    loose = np.flatnonzero(~(face.skin | face.still | face.inside))
    nearest, share = _close(face, loose, rows)
    beside = share[:, None] * whole[:, nearest] + (1 - share[:, None]) * inner[:, loose]
    whole[:, loose] = beside
    components = (_STEP.format(number + 1) for number in range(len(layout.basis)))
    names = (MEAN, *components, APART)
    return MarkerFace(
        face.name,
        with_targets(face, names, whole),
        names,
        steps,
        deviations,
        skin,
        contact(face, whole[:-1], parted),
        binding.note(),
    )


def marker_sides(face: FaceMesh, binding: Binding) -> Floats:
    """Return the side (M,) of each marker; that on a corner of the mouth belongs to both."""
    sides = np.array([each.shares @ face.sides[each.corners] for each in binding.placed])
    for corner in face.mouth.corners:
        far = np.linalg.norm(binding.points - face.points[corner], axis=1)
        if far.min() < _CORNER * face.width:
            sides[far.argmin()] = 0.5
    return sides


def _inner(face: FaceMesh, markers: Floats, sides: Floats, moves: Floats) -> Floats:
    """Return how what lies inside the mouth moves, (K, N, 3): with the jaw, as the chin says.

    The model knows how its jaw opens; how far, and how far aside, is fitted to the chin.
    """
    chin = _chin(face, markers, sides)
    if not len(chin):
        return np.zeros((len(moves), *face.points.shape))
    outer = np.flatnonzero(face.outward)
    near = [int(outer[_squares(face.points[outer], point).argmin()]) for point in markers[chin]]
    own = face.opening[near]
    way = own.mean(axis=0)
    size = float(np.linalg.norm(way)) or 1.0
    across = np.linalg.svd(way[None] / size)[2][1:]
    system = np.zeros((3 * len(chin), 3))
    system[:, 0] = own.ravel()
    system[:, 1:] = np.tile(across.T, (len(chin), 1))
    parts = np.linalg.lstsq(system, moves[:, chin].reshape(len(moves), -1).T, rcond=None)[0].T
    carried = smooth(np.linalg.norm(face.opening, axis=1) / (_OWN_WAY * size))
    aside = parts[:, 1:] @ across
    return np.asarray(parts[:, 0, None, None] * face.opening + carried[:, None] * aside[:, None, :])


def _chin(face: FaceMesh, markers: Floats, sides: Floats) -> Indices:
    """Return the markers of the chin: of the lower side, below the lips and about the middle."""
    line = face.line
    low = line[:, 1].min() - _BELOW * face.width
    middle = np.abs(markers[:, 0] - line[:, 0].mean()) < 0.5 * face.width
    lower = sides < 0.5
    chin = np.flatnonzero(lower & middle & (markers[:, 1] < low))
    return chin if len(chin) else np.flatnonzero(lower & middle)


def _squares(points: Floats, point: Floats) -> Floats:
    return np.asarray(((points - point) ** 2).sum(axis=1))


def _close(face: FaceMesh, loose: Indices, rows: Indices) -> tuple[Indices, Floats]:
    """Return for vertices the nearest of the skin, and how much they go with it, 0..1."""
    nearest, far = np.zeros(len(loose), np.intp), np.zeros(len(loose))
    skin = face.points[rows]
    length = (skin**2).sum(axis=1)
    for at in range(0, len(loose), _AT_ONCE):
        part = face.points[loose[at : at + _AT_ONCE]]
        found = (length - 2 * part @ skin.T).argmin(axis=1)
        nearest[at : at + _AT_ONCE] = rows[found]
        far[at : at + _AT_ONCE] = np.linalg.norm(part - skin[found], axis=1)
    share = (far / face.width - _TIGHT) / (_LOOSE - _TIGHT)
    return nearest, 1.0 - smooth(share)
