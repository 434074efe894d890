"""The bigram engine (Xu et al. 2013; DESIGN section 4).

:func:`load_set` reads what an animator drew; :class:`BigramEngine` turns phones into
animation with it; :func:`why` says which curve put a value there; :func:`coverage` says
which pairs a text needs.
"""

from lipwright.engines.bigram.edits import Edit, read_edits
from lipwright.engines.bigram.engine import BigramEngine
from lipwright.engines.bigram.model import Bigram, BigramSet
from lipwright.engines.bigram.overrides import read_overrides, with_character
from lipwright.engines.bigram.set_file import load_set, read_set

__all__ = [
    "Bigram",
    "BigramEngine",
    "BigramSet",
    "Edit",
    "load_set",
    "read_edits",
    "read_overrides",
    "read_set",
    "with_character",
]
