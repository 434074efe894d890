"""Speech sounds as a tool that draws bigram sets knows them: targets, and when they are reached.

Each class of the Common Phoneme Set has one or two *targets* (two for diphthongs: where
the vowel begins and where it goes). A target is the level of each pose in that sound when
nothing disturbs it. Consonants besides say how far they let their neighbours show through.
Which levels, each language and character knows for itself.
"""

from __future__ import annotations

from dataclasses import dataclass, field

Levels = dict[str, float]

# When a target is reached and left, as shares of the sound's time. The mouth of a vowel is
# widest a little after its middle: the jaw follows the voice. A consonant holds its shape.
VOWEL_AT = (0.54, 0.66)
DIPHTHONG_AT = (0.37, 0.78)
CONSONANT_AT = (0.42, 0.64)


@dataclass(frozen=True)
class Sound:
    """One class of sounds.

    Parameters
    ----------
    kind : str
        ``"vowel"``, ``"consonant"``, ``"closure"`` or ``"silence"``.
    first : dict of str to float
        Target levels, at the beginning for a diphthong.
    second : dict of str to float, optional
        Where a diphthong goes.
    at : tuple of two float
        When the first and the last target are reached, as shares of the sound's time.
    lets_through : dict of str to float
        Share of a neighbour's level that shows in this sound, for each pose: the share of
        the following sound (anticipation).
    keeps : dict of str to float
        The same of the sound before (carry-over): lips lag less than they anticipate.
    """

    kind: str
    first: Levels
    second: Levels | None = None
    at: tuple[float, float] = VOWEL_AT
    lets_through: Levels = field(default_factory=dict)
    keeps: Levels = field(default_factory=dict)

    @property
    def last(self) -> Levels:
        """The target that the sound ends with."""
        return self.first if self.second is None else self.second


def vowel(at: tuple[float, float] = VOWEL_AT, **levels: float) -> Sound:
    """Return a vowel that holds one shape."""
    return Sound("vowel", levels, at=at)


def diphthong(first: Levels, second: Levels, at: tuple[float, float] = DIPHTHONG_AT) -> Sound:
    """Return a vowel that moves from one shape to another."""
    return Sound("vowel", first, second, at)
