"""Characters: from controls to what a rig has (DESIGN section 7).

:func:`load_character` takes ``"head"``, which the project's own code generates, a user's
GLB, VRM or glTF file, or a character file that names one; :meth:`Character.rig` maps an
animation onto it.
"""

from lipwright.character.character import (
    BUILT_IN,
    Character,
    file_of,
    keep_character,
    load_character,
    set_of,
)
from lipwright.character.character_file import CharacterFile

__all__ = [
    "BUILT_IN",
    "Character",
    "CharacterFile",
    "file_of",
    "keep_character",
    "load_character",
    "set_of",
]
