"""Known vocabularies: sets of mouth shapes that many rigs share, as data files.

FaceFX (the nine poses themselves, our built-in head), ARKit's 52, the 15 visemes of
Oculus, the vowels of VRM 1 and 0, Character Creator's shapes and visemes, and the mouth
shapes of Rhubarb, Preston Blair, and Fleming and Dobbs. Each file in ``data/mappings`` is
a mapping in the vocabulary's own names. A further one is a further file. Of its own kind
is ``jaw``: what is left to do where a rig has a jaw joint and nothing else.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

from lipwright.character.mapping import Mapping, read_mapping

DATA = Path(__file__).parent.parent / "data" / "mappings"
POSES = ("open", "W", "ShCh", "PBM", "FV", "wide", "tBack", "tRoof", "tTeeth")
"""The canonical poses (DESIGN section 3)."""

_PREFERENCE = ("facefx", "arkit", "oculus15", "vrm1", "vrm0")
_JAW = "jaw"


@cache
def vocabularies() -> tuple[Mapping, ...]:
    """Return the known vocabularies; of two that fit a rig equally, the first is taken."""
    names = {path.stem for path in DATA.glob("*.json")} - {_JAW}
    order = [*(n for n in _PREFERENCE if n in names), *sorted(names - set(_PREFERENCE))]
    return tuple(read_mapping(DATA / f"{name}.json") for name in order)


@cache
def jaw_alone() -> Mapping:
    """Return how a jaw speaks without any mouth shape; its one channel is ``jaw``."""
    return read_mapping(DATA / f"{_JAW}.json")
