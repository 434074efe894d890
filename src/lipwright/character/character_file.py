"""Character files: what makes one character differ (DESIGN sections 7 and 8).

A file names only what differs from its ``base``: another character file, or a built-in
character. What it says to the engine (overrides of bigrams, settings of the stages) is
kept as it stands, with its place: the engine reads it, and they meet in the pipeline.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from lipwright.character.mapping import Mapping
from lipwright.files import Version
from lipwright.speech import Speech

RATES = (80.0, 450.0)
"""Words per minute that a synthesiser can speak."""
FEWEST_WORDS, LENIENCE = 4, 1.05
"""How many words say how fast a recording is, and what is not worth a note."""

OWN_PLACES = ("at mapping", "at gains", "at limits")
"""How the places of mappings end that stand in a character file itself."""

Versions = tuple[tuple[str, Version | None], ...]


@dataclass(frozen=True, slots=True, eq=False)
class CharacterLayer:
    """What one character file says.

    Parameters
    ----------
    name, about : str
    path : str
        The file.
    base : str
        What it is layered on: a path, a built-in character's name, or nothing.
    model : str
        A path, a built-in model's name, or nothing where the base has it.
    bigram_set : str
        A path, the name of a set that comes with Lipwright, or nothing.
    mappings : tuple of (Mapping, str)
        Its mappings in order, each with its place; gains and limits come last.
    overrides : tuple of str or dict
        Paths of override files, and overrides as they stand in the file.
    settings : dict
        Settings of the stages as they stand in the file.
    rate : tuple of float, optional
        The slowest and fastest speech, words per minute.
    files : tuple of (str, Version)
        All files that were read.
    digest : str
        Tells their content from any other.
    """

    name: str
    path: str
    about: str = ""
    base: str = ""
    model: str = ""
    bigram_set: str = ""
    mappings: tuple[tuple[Mapping, str], ...] = ()
    overrides: tuple[str | dict[str, Any], ...] = ()
    settings: dict[str, Any] = field(default_factory=dict)
    rate: tuple[float, float] | None = None
    files: Versions = ()
    digest: str = ""


@dataclass(frozen=True, slots=True, eq=False)
class CharacterFile:
    """A character file with all that it is layered on.

    Parameters
    ----------
    layers : tuple of CharacterLayer
        The lowest base first, the file itself last.
    built_in : str
        The built-in character beneath them, if there is one.
    """

    layers: tuple[CharacterLayer, ...]
    built_in: str = ""

    @property
    def name(self) -> str:
        """The character's name."""
        return self.layers[-1].name

    @property
    def path(self) -> str:
        """The file."""
        return self.layers[-1].path

    @property
    def files(self) -> Versions:
        """All files that were read, in the state they were in."""
        return tuple(version for layer in self.layers for version in layer.files)

    @property
    def digest(self) -> str:
        """Tells what the files said from any other content."""
        whole = " ".join((self.built_in, *(layer.digest for layer in self.layers)))
        return hashlib.sha256(whole.encode()).hexdigest()[:12]

    @property
    def model(self) -> tuple[str, str]:
        """Model, and the file that names it; the built-in character's where none does."""
        return self._given(lambda layer: layer.model) or (self.built_in, self.layers[0].path)

    @property
    def bigram_set(self) -> tuple[str, str]:
        """Bigram set, and the file that names it; nothing where none does."""
        return self._given(lambda layer: layer.bigram_set) or ("", "")

    @property
    def rate(self) -> tuple[float, float] | None:
        """The slowest and fastest speech, words per minute."""
        return next((layer.rate for layer in self.layers[::-1] if layer.rate), None)

    def _given(self, what: Callable[[CharacterLayer], str]) -> tuple[str, str] | None:
        named = ((what(layer), layer.path) for layer in self.layers[::-1])
        return next((found for found in named if found[0]), None)

    def speakable(self, rate: float) -> tuple[float, str]:
        """Return the rate nearest to one that the character can speak, and what to say of it.

        Parameters
        ----------
        rate : float
            Words per minute; one that no voice can speak is left as it is.
        """
        if self.rate is None or not RATES[0] <= rate <= RATES[1]:
            return rate, ""
        low, high = self.rate
        can = min(max(rate, low), high)
        if can == rate:
            return rate, ""
        return (
            can,
            f"{self.name} speaks {low:g} to {high:g} words per minute: {can:g}, not {rate:g}",
        )

    def too_fast(self, speech: Speech) -> str:
        """Return what to say of a line that is spoken faster than the character can."""
        words = speech.words.intervals
        if self.rate is None or speech.source == "say" or len(words) < FEWEST_WORDS:
            return ""
        rate = 60 * len(words) / (words[-1].end - words[0].start)
        if rate <= self.rate[1] * LENIENCE:
            return ""
        return (
            f"the line is spoken at {rate:.0f} words per minute, {self.name} can {self.rate[1]:g}: "
            f"its speed limits leave out what is too fast"
        )
