"""Characters of pictures: cut-out mouths, one drawing per mouth shape, held over time.

:func:`load_pictures` takes ``"rhubarb"``, ``"preston_blair"``, ``"fleming_dobbs"``, or a
file that names any other list; :func:`hold` chooses which shape is shown when.
"""

from lipwright.character.pictures.choosing import choose
from lipwright.character.pictures.describing import describe_pictures, inspect_pictures
from lipwright.character.pictures.holding import hold
from lipwright.character.pictures.picture_file import (
    BUILT_IN_PICTURES,
    PictureCharacter,
    Shape,
    is_pictures,
    load_pictures,
)
from lipwright.character.pictures.timing import Timing

__all__ = [
    "BUILT_IN_PICTURES",
    "PictureCharacter",
    "Shape",
    "Timing",
    "choose",
    "describe_pictures",
    "hold",
    "inspect_pictures",
    "is_pictures",
    "load_pictures",
]
