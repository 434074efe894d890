"""Lines for the synthesisers to speak, and what comes of them: sound and phones.

Words come from the acoustic model's dictionary, those of them that espeak-ng sounds as
the dictionary does; lines are random words and have no sense.
"""

from __future__ import annotations

import os
import re
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from lipwright.phones import load_reduction
from lipwright.schedule.align.model import model_folder
from lipwright.schedule.pronounce import pronounce
from lipwright.schedule.say import say
from lipwright.speech import Speech

_TRIED = 8000  # words of the dictionary
SHORT = """
    the a of to and in is you that it he was for on are as with his they at be this have
    from or had by not but what all were we when your can said there an each which she
    do how their if will up other about out many then them these so some her would make
    like him into time has look two more write go see no way could people my than first
    been call who its now find long down day did get come made may part
"""
# Those with breath (f2, f3, f5) are left out: its noise is another one in every run.
_VARIANTS = """
    +f1 +f4 +m1 +m2 +m3 +m4 +m5 +m6 +m7 +klatt +klatt2 +klatt3 +klatt4 +linda
    +steph +edward +max +iven +belinda +antonio +shelby +travis +adam +Andy
"""
VOICES = ("en-us",) * 4 + tuple(f"en-us{variant}" for variant in _VARIANTS.split())


@dataclass(frozen=True, slots=True, eq=False)
class Line:
    """Synthesised speech: its sound, and boundaries as (phone before, phone after, s)."""

    samples: NDArray[np.float32]
    rate: int
    boundaries: tuple[tuple[str, str, float], ...]


@dataclass(frozen=True, slots=True)
class Request:
    """What a synthesiser is asked for."""

    text: str
    voice: str
    rate: float
    pitch: float | None


def requests(rng: np.random.Generator, espeak: int, festival: int) -> list[Request]:
    """Return so many random lines for each synthesiser."""
    words = agreed_words(rng)
    result = []
    for index in range(espeak + festival):
        text, rate = _text(rng, words), float(rng.uniform(140, 220))
        if index < espeak:
            voice, pitch = str(rng.choice(VOICES)), float(rng.integers(25, 80))
            result.append(Request(text, voice, rate, pitch))
        else:
            result.append(Request(text, "festival", rate, None))
    return result


def agreed_words(rng: np.random.Generator) -> list[str]:
    """Return words that espeak-ng sounds as the dictionary does."""
    text = (model_folder() / "en-us" / "cmudict-en-us.dict").read_text(encoding="utf-8")
    rows = [row.split() for row in text.splitlines() if re.match(r"[a-z]{2,9} ", row)]
    chosen = [rows[i] for i in sorted(rng.choice(len(rows), _TRIED, replace=False))]
    spoken = pronounce([word for word, *_ in chosen])
    return [
        word
        for word, *phones in chosen
        if [_full(label) for label in spoken.get(word, ())] == [p.lower() for p in phones]
    ]


def speak_all(wanted: list[Request]) -> list[Line]:
    """Speak every line; the synthesisers are programs that run beside each other."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(_spoken, wanted))


def _spoken(request: Request) -> Line:
    speech = say(request.text, voice=request.voice, rate=request.rate, pitch=request.pitch)
    assert speech.sound is not None
    return Line(speech.sound.samples, speech.sound.rate, tuple(_boundaries(speech)))


def _text(rng: np.random.Generator, words: list[str]) -> str:
    chosen = []
    for _ in range(int(rng.integers(5, 9))):
        if rng.random() < 0.45:
            chosen.append(str(rng.choice(SHORT.split())))
        chosen.append(str(rng.choice(words)))
    if rng.random() < 0.3:
        chosen[len(chosen) // 2] += ","
    return " ".join(chosen) + "."


def _boundaries(speech: Speech) -> list[tuple[str, str, float]]:
    """Return those whose time is known: none inside what espeak-ng speaks as one."""
    reduction = load_reduction(speech.phones.phone_set, "arpabet")
    pieces = [
        [_full(piece.label) for piece in reduction.of(phone.label)[0]] for phone in speech.phones
    ]
    times = [phone.start for phone in speech.phones][1:]
    return [
        (before[-1], after[0], time)
        for (before, after), time in zip(pairwise(pieces), times, strict=True)
    ]


def _full(label: str) -> str:
    return "ah" if label == "ax" else label
