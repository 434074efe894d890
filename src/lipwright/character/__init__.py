"""Characters: from controls to what a rig has (DESIGN section 7).

:func:`load_character` takes ``"head"``, which the project's own code generates, or a
user's GLB, VRM or glTF file; :meth:`Character.rig` maps an animation onto it.
"""

from lipwright.character.character import BUILT_IN, Character, load_character
from lipwright.character.inspect import describe_character, inspect_character

__all__ = ["BUILT_IN", "Character", "describe_character", "inspect_character", "load_character"]
