"""How recorded motion is played on a character: as it was recorded, or told in poses.

A character that knows the takes' own shapes plays them as they are; a face that markers fit
is driven by them. Every other plays the poses of a bigram set, which characters of any kind
know.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, lru_cache, partial
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from lipwright.animation import Animation
from lipwright.casting import DEFAULT_SET
from lipwright.errors import CharacterError, InputError
from lipwright.files import file_version
from lipwright.performance import RiggedModel

if TYPE_CHECKING:
    from lipwright.character import Character
    from lipwright.engines.motion.database import Database
    from lipwright.marker_faces import MarkerFace, MarkerFile, MarkerLayout
    from lipwright.speech import Speech
    from lipwright.told_in_poses import Telling

RECORDED, POSES = "recorded", "poses"
WAYS = (RECORDED, POSES)


@dataclass(frozen=True, slots=True, eq=False)
class Acting:
    """What a character is to play, and how it may be asked for.

    Parameters
    ----------
    character : str or path
    mapping : str or path, optional
        The user's own, for the character.
    controls : str, optional
        ``"recorded"`` or ``"poses"``; what the character can play, where it is not given.
    bigram_set : str or path, optional
        In whose poses; English where it is not given.
    markers : str or path, optional
        A file that says where markers lie on the character.
    """

    character: str | Path
    mapping: str | Path | None = None
    controls: str | None = None
    bigram_set: str | Path | None = None
    markers: str | Path | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Acted:
    """A motion engine's animation as a character plays it.

    Parameters
    ----------
    animation : Animation
        In controls that the character plays.
    told : function
        Returns it in poses.
    rig : function, optional
        Makes the model that is driven, where it is not the character's own controls that do.
    note : str
        What the user should know.
    """

    animation: Animation
    told: Callable[[], Animation]
    rig: Callable[[], RiggedModel] | None = None
    note: str = ""

    @classmethod
    def as_it_is(cls, animation: Animation) -> Acted:
        """Return an animation that is in poses already."""
        return cls(animation, lambda: animation)


def act(animation: Animation, speech: Speech, database: Database, how: Acting) -> Acted:
    """Return a motion engine's animation in controls that a character plays.

    Parameters
    ----------
    animation : Animation
        Of the database's channels.
    speech : Speech
        What is said.
    database : Database
    how : Acting

    Raises
    ------
    InputError
        If there are no such controls, or a set or a marker file is given that is of no use.
    CharacterError
        If the motion cannot be told in poses, or markers do not fit the character.
    """
    _check(how, database)
    told = cache(partial(_told, animation, speech, database, how))
    if how.controls == POSES or how.bigram_set is not None:
        return Acted(told(), told)
    if database.markers:
        return _driven(animation, database, how, told)
    if how.controls == RECORDED or _plays(animation, how):
        return Acted(animation, told)
    return Acted(told(), told)


def _check(how: Acting, database: Database) -> None:
    if how.controls not in (None, *WAYS):
        raise InputError(f"no controls {how.controls!r}", expected=" or ".join(WAYS))
    if how.controls == RECORDED and how.bigram_set is not None:
        raise InputError("a set, for recorded controls", cure="ask for poses, or leave it out")
    if how.markers is not None and not database.markers:
        raise InputError(
            "a marker file, for a database without markers",
            where=str(how.markers),
            cure="leave it out",
        )


def _plays(animation: Animation, how: Acting) -> bool:
    """Tell whether a character knows what was recorded."""
    from lipwright.character import keep_character
    from lipwright.character.pictures import choose, is_pictures

    try:
        if is_pictures(how.character):
            choose(how.character).check_controls(animation.controls)
        else:
            keep_character(how.character, how.mapping).check(animation.controls)
    except CharacterError:
        return False
    return True


def _driven(
    animation: Animation, database: Database, how: Acting, told: Callable[[], Animation]
) -> Acted:
    """Let markers drive a face that they fit; another is told in poses what they do."""
    from lipwright.character import keep_character
    from lipwright.character.pictures import is_pictures

    if is_pictures(how.character):
        if how.controls == RECORDED:
            raise CharacterError(
                "markers, for a character of pictures", cure="leave --controls recorded out"
            )
        return Acted(told(), told)
    try:
        actor = keep_character(how.character, how.mapping)
        face = _marker_face(database, actor, *_file(how))
    except CharacterError:
        if how.controls == RECORDED or how.markers is not None:
            raise
        return Acted(told(), told)
    return Acted(animation, told, partial(_rig, face, database, animation), face.note)


def _rig(face: MarkerFace, database: Database, animation: Animation) -> RiggedModel:
    moved = np.asarray(animation.values, np.float64) - database.rest
    channels = replace(
        animation, controls=face.targets, values=face.weights_of(moved), keys={}, report={}
    )
    return RiggedModel(face.name, face.model.to_glb(), channels)


def _told(animation: Animation, speech: Speech, database: Database, how: Acting) -> Animation:
    from lipwright.engines.bigram import load_set
    from lipwright.told_in_poses import AsPoses, by_shapes, in_poses

    of = load_set(str(how.bigram_set or DEFAULT_SET))
    names = of.rules.names
    known = [name for name in animation.controls if name in names]
    telling: Telling
    if database.markers:
        telling = _by_markers(database, how, names)
    elif 2 * len(known) > len(animation.controls):
        columns = [animation.controls.index(name) for name in known]
        telling = AsPoses(tuple(known), columns)
    else:
        telling = by_shapes(database, names)
    return in_poses(animation, speech, of, telling)


def _by_markers(database: Database, how: Acting, poses: tuple[str, ...]) -> Telling:
    """Return how markers are told: on the character's own face, else on the built-in head."""
    from lipwright.character import keep_character
    from lipwright.character.pictures import is_pictures

    if not is_pictures(how.character):
        try:
            actor = keep_character(how.character, how.mapping)
            return marker_telling(database, actor, poses, *_file(how))
        except CharacterError:
            if how.markers is not None:
                raise
    return marker_telling(database, keep_character("head"), poses, "", None)


def _file(how: Acting) -> tuple[str, object]:
    """Return a marker file's path, and what tells its states apart."""
    path = str(how.markers) if how.markers is not None else ""
    return path, file_version(path) if path else None


@lru_cache(maxsize=4)
def _marker_face(database: Database, actor: Character, file: str, version: object) -> MarkerFace:
    from lipwright.marker_faces import marker_face

    return marker_face(actor, layout_of(database), file or None)


@lru_cache(maxsize=4)
def marker_telling(
    database: Database, actor: Character, poses: tuple[str, ...], file: str, version: object
) -> Telling:
    """Return how a database's markers are told in poses of a character; kept.

    Parameters
    ----------
    database : Database
        Of markers.
    actor : Character
    poses : tuple of str
    file : str
        A marker file; nothing where there is none.
    version : object
        What tells the states of that file apart.
    """
    from lipwright.marker_faces import bind, by_markers, read_face_mesh, read_marker_file
    from lipwright.told_in_poses import rest_of

    face = read_face_mesh(actor)
    binding = bind(layout_of(database), face, read_marker_file(file) if file else None)
    rest = np.asarray(database.rest, np.float64) + rest_of(database)
    return by_markers(actor, face, binding, rest, poses)


def layout_of(database: Database) -> MarkerLayout:
    """Return where a database's markers lie, and how they move."""
    from lipwright.marker_faces import MarkerLayout

    return MarkerLayout.of(
        database.channels,
        np.asarray(database.rest, np.float64),
        np.asarray(database.mean, np.float64),
        np.asarray(database.basis, np.float64),
        np.asarray(database.variance, np.float64),
        str(database.folder),
    )


@dataclass(frozen=True, slots=True, eq=False)
class BoundMarkers:
    """A marker file, and what to say of how the markers lie."""

    file: MarkerFile
    note: str


def bind_markers(
    database: str | Path, character: str | Path, pins: str | Path | None = None
) -> BoundMarkers:
    """Lay the markers of a database onto a character's face, as a file to change.

    Parameters
    ----------
    database : path
    character : str or path
    pins : path, optional
        A marker file, whose places go before what is found.

    Raises
    ------
    InputError
        If the database has no markers, or a file cannot be used.
    CharacterError
        If the character has no mouth, or the markers do not fit its face.
    """
    from lipwright.character import keep_character
    from lipwright.engines.motion.database import open_database
    from lipwright.marker_faces import bind, read_face_mesh, read_marker_file

    held = open_database(database)
    if not held.markers:
        raise InputError(
            f"no markers, but channels such as {held.channels[0]!r}",
            where=str(database),
            expected="a database that was built from C3D",
        )
    face = read_face_mesh(keep_character(character))
    given = read_marker_file(pins) if pins is not None else None
    binding = bind(layout_of(held), face, given)
    return BoundMarkers(binding.to_file(face, given.pins if given else None), binding.note())
