"""Which mouth shapes a performance holds, and how, as a user asks for it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from lipwright.character.pictures.picture_file import (
    PictureCharacter,
    is_pictures,
    load_pictures,
)
from lipwright.errors import CharacterError

USUAL = "rhubarb"
"""The list for a character that has a model and no pictures of its own."""


def choose(
    character: str | Path,
    pictures: str | Path | None = None,
    mapping: str | Path | None = None,
    *,
    without: Sequence[str] = (),
    fps: float | None = None,
    on: int | None = None,
    hold: str | None = None,
) -> PictureCharacter:
    """Return the shapes that are held: the character's own, or those chosen for it.

    Parameters
    ----------
    character : str or Path
        A character of pictures, or one with a model.
    pictures, mapping : str or Path, optional
        What only a character with a model takes: the list to use, and its mapping.
    without : sequence of str
        Shapes that are not drawn.
    fps, on, hold : float, int, str, optional
        What is not as the shapes' file says: see :class:`~.timing.Timing`.

    Raises
    ------
    InputError
        If a part of it is unknown or broken, or does not fit the character.
    """
    flat = is_pictures(character)
    for name, given in (("mapping", mapping), ("pictures", pictures)):
        if flat and given is not None:
            raise CharacterError(
                f"a character of pictures takes no {name}",
                where=str(character),
                cure="leave it out",
            )
    found = load_pictures(character if flat else pictures or USUAL).without(without)
    timing = found.timing
    if fps is not None:
        timing = replace(timing, fps=fps)
    if on is not None:
        timing = replace(timing, on=on)
    if hold is not None:
        timing = replace(timing, minimum_hold=hold)
    return replace(found, timing=timing)
