"""Sentences spoken by the synthesiser in many voices: sound, words and phones.

The phones are the synthesiser's own, exact to the sample: the motion is made from them, so
that a unit holds the motion of its phone and of no other. Aligning the sound again would
only add an aligner's errors.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lipwright.phones import SILENCE, PhoneTrack, load_reduction
from lipwright.schedule.say import say
from lipwright.sound import Sound
from lipwright.timeline import Interval, Tier

SENTENCES = Path(__file__).with_name("sentences.txt")
# Those with breath (f2, f3, f5) are left out: its noise is another one in every run.
VARIANTS = """
    +f1 +f4 +m1 +m2 +m3 +m4 +m5 +m6 +m7 +linda +steph +edward +max +iven +belinda
    +antonio +shelby +travis +adam +Andy
"""
VOICES = ("en-us", "en-us", *(f"en-us{variant}" for variant in VARIANTS.split()))
RATES = (145.0, 205.0)
"""Words per minute."""
PITCHES = (25, 80)
REST = 0.2
"""Seconds of silence that are kept before and after: as long as a mouth moves there."""
LONG_REST = 0.5
EVERY = 8
"""Each eighth take rests for longer, so that the database knows how a face stays still."""


@dataclass(frozen=True, slots=True, eq=False)
class Spoken:
    """A sentence as it was spoken.

    Parameters
    ----------
    name : str
        The take's: its number and the voice.
    text : str
    phones : PhoneTrack
        ARPAbet; starts and ends with silence.
    words : Tier
    sound : Sound
    """

    name: str
    text: str
    phones: PhoneTrack
    words: Tier
    sound: Sound

    @property
    def seconds(self) -> float:
        """How long the take is."""
        return self.phones.tier.end

    @property
    def said(self) -> float:
        """Seconds without the rests around the line."""
        return self.phones.tier[-1].start - self.phones.tier[0].end


def sentences() -> list[str]:
    """Return the tool's own sentences."""
    return SENTENCES.read_text("utf-8").splitlines()


def spoken(number: int, text: str, rng: np.random.Generator) -> Spoken:
    """Speak a sentence in a voice, at a rate and a pitch, drawn at random."""
    voice = VOICES[int(rng.integers(len(VOICES)))]
    rate, pitch = float(rng.uniform(*RATES)), float(rng.integers(*PITCHES))
    speech = say(text, voice=voice, rate=rate, pitch=pitch)
    assert speech.sound is not None
    rest = REST if number % EVERY else LONG_REST
    rows, _ = load_reduction(speech.phones.phone_set, "arpabet").rows(speech.phones)
    said = [Interval(*row) for row in rows if row[0] != SILENCE or rows[0] != row != rows[-1]]
    # The line as it is, with just so much silence around it.
    later = rest - said[0].start
    track = Tier(
        (
            Interval(SILENCE, 0.0, rest),
            *(Interval(one.label, one.start + later, one.end + later) for one in said),
            Interval(SILENCE, said[-1].end + later, said[-1].end + later + rest),
        )
    )
    words = Tier(
        tuple(Interval(one.label, one.start + later, one.end + later) for one in speech.words)
    )
    return Spoken(
        f"synthetic {number:02} ({voice})",
        text,
        PhoneTrack(track, "arpabet"),
        words,
        _moved(speech.sound, later, track.end),
    )


def _moved(sound: Sound, later: float, end: float) -> Sound:
    """Return a sound that starts so much later, or earlier, and ends when it should."""
    first, count = round(later * sound.rate), round(end * sound.rate)
    samples = np.pad(sound.samples, (max(first, 0), max(count - first - len(sound.samples), 0)))
    return Sound(np.ascontiguousarray(samples[max(-first, 0) :][:count]), sound.rate)
