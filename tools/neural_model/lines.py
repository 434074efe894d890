"""What is spoken, by which voice: lines of many words, in many languages.

English words come from the acoustic model's dictionary, in no sensible order, with the
short words of every day, numbers and letters among them; other languages from the sentences
that come with Lipwright, their words mixed.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

import lipwright
from lipwright.schedule.align.model import model_folder
from tools.boundaries.lines import SHORT

LANGUAGES = Path(lipwright.__file__).parent / "data" / "languages"
ACCENTS = ("en-us", "en-us", "en-gb", "en-gb-x-rp", "en-gb-scotland", "en-029", "en-us-nyc")
_VARIANTS = """
    f1 f2 f3 f4 f5 m1 m2 m3 m4 m5 m6 m7 m8 klatt klatt2 klatt3 klatt4 klatt5 klatt6 linda steph
    steph2 steph3 edward edward2 max iven iven2 iven3 iven4 belinda antonio shelby travis adam
    Andy Alex Alicia Andrea Annie Denis Diogo Gene Gene2 Henrique Hugo Jacky Lee Marco Mario
    Michael Mike Nguyen Reed anika aunty benjamin boris caleb david ed gustave ian john
    kaukovalta marcelo michel miguel norbert pablo paul pedro quincy rob robert sandro victor
    zac
"""
VARIANTS = tuple(_VARIANTS.split())
_NUMBERS = """
    zero one two three four five six seven eight nine ten eleven twelve twenty thirty hundred
    thousand million first second third half
"""
NUMBERS = tuple(_NUMBERS.split())
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
FLITE = ("awb", "kal16", "rms", "slt")
FESTIVAL = ("kal", "ked", "slt")
_UNSPOKEN = ("he", "th")
"""Languages whose voice leaves out or misreads vowels (:mod:`lipwright.schedule.say.voices`)."""


@dataclass(frozen=True, slots=True)
class Line:
    """What a synthesiser is asked for.

    Parameters
    ----------
    text : str
    engine : str
        ``"espeak"``, ``"flite"`` or ``"festival"``.
    voice : str
        As that engine calls it.
    rate : float
        Words per minute, 175 being usual.
    pitch : float
        0..99, 50 being usual.
    """

    text: str
    engine: str
    voice: str
    rate: float
    pitch: float


def lines(rng: np.random.Generator, counts: dict[str, int]) -> list[Line]:
    """Return so many lines for each of ``english``, ``others``, ``flite``, ``festival``."""
    found = []
    for _ in range(counts.get("english", 0)):
        voice = f"{_one(rng, ACCENTS)}+{_one(rng, VARIANTS)}"
        found.append(_line(rng, english(rng), "espeak", voice))
    for _ in range(counts.get("others", 0)):
        language = _one(rng, foreign())
        voice = f"{language}+{_one(rng, VARIANTS)}"
        found.append(_line(rng, mixed(rng, language), "espeak", voice))
    for _ in range(counts.get("flite", 0)):
        voice = _one(rng, FLITE)
        found.append(_line(rng, english(rng), "flite", voice))
    for _ in range(counts.get("festival", 0)):
        voice = _one(rng, FESTIVAL)
        found.append(_line(rng, english(rng), "festival", voice))
    return found


def _line(rng: np.random.Generator, text: str, engine: str, voice: str) -> Line:
    rate, pitch = float(rng.uniform(120, 230)), float(rng.integers(20, 85))
    return Line(text, engine, voice, round(rate, 1), pitch)


def english(rng: np.random.Generator) -> str:
    """Return an English line without sense."""
    words: list[str] = []
    for _ in range(int(rng.integers(4, 11))):
        kind = rng.random()
        if kind < 0.45:
            words.append(_one(rng, _short()))
        elif kind < 0.88:
            words.append(_one(rng, dictionary()))
        else:
            words.append(_one(rng, NUMBERS if kind < 0.94 else LETTERS))
    return _punctuated(rng, words)


def mixed(rng: np.random.Generator, language: str) -> str:
    """Return words of a language's sentences in another order."""
    words = _words(language)
    if len(words) < 20:  # a script without spaces: whole sentences
        return _one(rng, words)
    chosen = [_one(rng, words) for _ in range(int(rng.integers(4, 10)))]
    return _punctuated(rng, chosen)


def _punctuated(rng: np.random.Generator, words: list[str]) -> str:
    if rng.random() < 0.3:
        words[len(words) // 2] += ","
    return " ".join(words) + _one(rng, "..?!")


def _one(rng: np.random.Generator, things: Sequence[str]) -> str:
    return things[int(rng.integers(len(things)))]


@cache
def dictionary() -> tuple[str, ...]:
    """Return the words of the acoustic model's dictionary."""
    text = (model_folder() / "en-us" / "cmudict-en-us.dict").read_text(encoding="utf-8")
    return tuple(re.findall(r"(?m)^([a-z]{2,11}) ", text))


@cache
def _short() -> tuple[str, ...]:
    return tuple(SHORT.split())


@cache
def foreign() -> tuple[str, ...]:
    """Return the languages, other than English, that there are sentences of."""
    names = sorted(path.stem for path in LANGUAGES.glob("*.txt"))
    return tuple(name for name in names if name not in ("en", *_UNSPOKEN))


@cache
def _words(language: str) -> tuple[str, ...]:
    text = (LANGUAGES / f"{language}.txt").read_text(encoding="utf-8")
    rows = [row for row in text.splitlines() if row and not row.startswith("#")]
    words = [word.strip('.,;:!?"«»„“”…।') for row in rows for word in row.split()]
    return tuple(filter(None, words)) if len(words) > 3 * len(rows) else tuple(rows)
