"""How recorded motion is played on a character: as it was recorded, or told in poses.

A character that knows the takes' own shapes plays them as they are. Every other plays the
poses of a bigram set, which a character of any kind knows.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from lipwright.errors import CharacterError, InputError

if TYPE_CHECKING:
    from lipwright.animation import Animation
    from lipwright.engines.motion.database import Database
    from lipwright.speech import Speech

RECORDED, POSES = "recorded", "poses"
WAYS = (RECORDED, POSES)
DEFAULT_SET = "english"


def act(
    animation: Animation,
    speech: Speech,
    database: Database,
    character: str | Path,
    mapping: str | Path | None = None,
    controls: str | None = None,
    bigram_set: str | Path | None = None,
) -> Animation:
    """Return a motion engine's animation in controls that a character plays.

    Parameters
    ----------
    animation : Animation
        Of the database's channels.
    speech : Speech
        What is said.
    database : Database
    character : str or path
    mapping : str or path, optional
        The user's own, for the character.
    controls : str, optional
        ``"recorded"`` or ``"poses"``; what the character can play, where it is not given.
    bigram_set : str or path, optional
        In whose poses; English where it is not given.

    Raises
    ------
    InputError
        If there are no such controls, or a set is given and no poses are asked for.
    CharacterError
        If the motion cannot be told in poses.
    """
    if controls not in (None, *WAYS):
        raise InputError(f"no controls {controls!r}", expected=" or ".join(WAYS))
    if controls == RECORDED and bigram_set is not None:
        raise InputError("a set, for recorded controls", cure="ask for poses, or leave it out")
    told = controls == POSES or bigram_set is not None
    if not told and (controls == RECORDED or _plays(animation, character, mapping)):
        return animation
    return _told(animation, speech, database, bigram_set or DEFAULT_SET)


def _plays(animation: Animation, character: str | Path, mapping: str | Path | None) -> bool:
    """Tell whether a character knows what was recorded."""
    from lipwright.character import keep_character
    from lipwright.character.pictures import choose, is_pictures

    try:
        if is_pictures(character):
            choose(character).check_controls(animation.controls)
        else:
            keep_character(character, mapping).check(animation.controls)
    except CharacterError:
        return False
    return True


def _told(
    animation: Animation, speech: Speech, database: Database, bigram_set: str | Path
) -> Animation:
    from lipwright.engines.bigram import load_set
    from lipwright.told_in_poses import AsPoses, by_shapes, in_poses

    of = load_set(str(bigram_set))
    known = [name for name in animation.controls if name in of.rules.names]
    if 2 * len(known) > len(animation.controls):
        columns = [animation.controls.index(name) for name in known]
        return in_poses(animation, speech, of, AsPoses(tuple(known), columns))
    return in_poses(animation, speech, of, by_shapes(database, of.rules.names))
