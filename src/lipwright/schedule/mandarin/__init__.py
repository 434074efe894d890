"""Mandarin: characters, pinyin, numbers and Latin words as syllables and phones.

The way: text → what is said of it (:mod:`.text`, :mod:`.numbers`) → syllables
(:mod:`.reading`, :mod:`.pinyin`) → phones of the set ``pinyin`` (:mod:`.sounds`), laid on
a synthesiser's times (:mod:`.lay`) or given to the aligner (:mod:`.ways`). The set and
its reductions are data: ``pinyin.json`` and ``pinyin-to-….json`` in ``data/phones``
(Xu et al. 2013, section 5.4). Characters need the extra ``mandarin``.
"""

from lipwright.schedule.mandarin.pinyin import Syllable, legal_syllables, read_syllable
from lipwright.schedule.mandarin.reading import Pause, Word, read, syllables
from lipwright.schedule.mandarin.sounds import sounds
from lipwright.schedule.mandarin.ways import Pronounced, pronounce

__all__ = [
    "Pause",
    "Pronounced",
    "Syllable",
    "Word",
    "legal_syllables",
    "pronounce",
    "read",
    "read_syllable",
    "sounds",
    "syllables",
]
