"""Speech: a sound with its words and phones, what schedules make and engines take."""

from __future__ import annotations

from dataclasses import dataclass, field

from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.timeline import Tier


@dataclass(frozen=True, slots=True, eq=False)
class Speech:
    """A stretch of speech: what is known of it.

    Parameters
    ----------
    phones : PhoneTrack
        When each phone sounds; seconds on the sound's clock.
    words : Tier
        When each word sounds; empty where unknown.
    sound : Sound or None
        The sound itself, where there is one.
    text : str
        What is said, as the user wrote it.
    language : str
        As the schedule names it (``"en-us"``).
    source : str
        Which schedule made it: ``"say"``, ``"align"``, ``"recognise"``, ``"ear"``,
        ``"labels"``.
    confidence : float or None
        How sure the schedule is of the whole line, 0..1.
    notes : tuple of str
        What the user should know: words that were guessed, words that do not fit.
    """

    phones: PhoneTrack
    words: Tier = field(default_factory=Tier)
    sound: Sound | None = None
    text: str = ""
    language: str = ""
    source: str = ""
    confidence: float | None = None
    notes: tuple[str, ...] = ()

    @property
    def duration(self) -> float:
        """Length of the sound, or of the phones where there is no sound, in seconds."""
        return self.sound.duration if self.sound is not None else self.phones.tier.end
