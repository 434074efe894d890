"""Phones: sets of labels, how one set reduces to another, and tracks of phones in time.

A phone set is a data file in ``lipwright/data/phones``: its labels, each with an
example word. A reduction is a data file beside it: what each label of one set becomes
in another (DESIGN section 3). Both are found by name, or read from a user's path.
"""

from lipwright.phones.loading import load_reduction
from lipwright.phones.reduction import Piece, Reduction, ReductionReport
from lipwright.phones.sets import SILENCE, Phone, PhoneSet, load_phone_set, phone_set_names
from lipwright.phones.track import PhoneTrack

__all__ = [
    "SILENCE",
    "Phone",
    "PhoneSet",
    "PhoneTrack",
    "Piece",
    "Reduction",
    "ReductionReport",
    "load_phone_set",
    "load_reduction",
    "phone_set_names",
]
