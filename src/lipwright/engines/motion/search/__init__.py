"""Searches for the units that speak some phones: one signature, ``search(graph, wanted, costs)``.

``greedy`` is the publication's Algorithm 2, ``pq`` its Algorithm 1, ``optimal`` finds
what both look for: the fewest jumps and, among those, the least cost (DESIGN section 5).
``several`` is ours: it gives several paths whose mean is taken.
"""

from lipwright.engines.motion.search.costs import Costs, wanted_sound
from lipwright.engines.motion.search.greedy import greedy
from lipwright.engines.motion.search.optimal import optimal
from lipwright.engines.motion.search.path import (
    Path,
    Search,
    StandIn,
    find,
    find_several,
    label_indices,
    path_of,
)
from lipwright.engines.motion.search.pq import pq
from lipwright.engines.motion.search.several import PATHS, several

__all__ = [
    "PATHS",
    "Costs",
    "Path",
    "Search",
    "StandIn",
    "find",
    "find_several",
    "greedy",
    "label_indices",
    "optimal",
    "path_of",
    "pq",
    "several",
    "wanted_sound",
]
