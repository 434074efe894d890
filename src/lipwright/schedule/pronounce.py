"""How words sound that no dictionary holds: espeak-ng's guess, in ARPAbet.

The aligner asks for what its dictionary lacks: names, new words, words of others. One
child program serves all words of a call (extra ``tts``).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from lipwright.errors import LabelError, TextError
from lipwright.phones import SILENCE, Reduction, load_reduction
from lipwright.schedule.align.acoustics import sounds_like
from lipwright.schedule.say import espeak
from lipwright.schedule.say.spelling import plain_labels
from lipwright.schedule.say.voices import (
    as_voices,
    check_script,
    library_name,
    resolve,
    unknown_voice,
)


def pronounce(words: Iterable[str], language: str = "en-us") -> dict[str, tuple[str, ...]]:
    """Return how words sound, in the 39 phones of the CMU dictionary, lower case.

    Parameters
    ----------
    words : iterable of str
        As people write them.
    language : str
        The voice that reads them.

    Returns
    -------
    dict of str to tuple of str
        Words of which nothing usable comes are left out.

    Raises
    ------
    TextError
        If there is no such voice.
    MissingExtraError
        If there is no synthesiser.

    Examples
    --------
    >>> pronounce(["lipwright"])
    {'lipwright': ('l', 'ih', 'p', 'r', 'ay', 't')}
    """
    wanted = [word for word in dict.fromkeys(words) if _can_be_read(word, language)]
    if not wanted:
        return {}
    reduction = load_reduction("ipa", "arpabet")
    spelled = language.lower().replace("_", "-")
    spoken = zip(wanted, _ask(wanted, language), strict=True)
    found = {word: _arpabet(labels, spelled, reduction) for word, labels in spoken}
    return {word: phones for word, phones in found.items() if phones}


def _can_be_read(word: str, language: str) -> bool:
    try:
        check_script(word, language)
    except TextError:
        return False
    return any(map(str.isalnum, word))


def _ask(words: list[str], language: str) -> list[list[str]]:
    plain = [word.replace("\0", "") for word in words]
    try:
        return espeak.pronounce(plain, library_name(language))
    except espeak.UnknownVoiceError as unknown:
        installed = as_voices(unknown.voices)
        file, _ = resolve(language, installed)
        if file == language:
            raise unknown_voice(language, installed, unknown.variants) from None
    return espeak.pronounce(plain, file)


def _arpabet(labels: Sequence[str], language: str, reduction: Reduction) -> tuple[str, ...]:
    """Return the phones; a sound that English lacks is the one nearest to the ear."""
    phones: list[str] = []
    for label in plain_labels(labels, language):
        if label in ("", SILENCE):
            continue
        try:
            phones += [piece.label for piece in reduction.of(label)[0]]
        except LabelError:
            phones += sounds_like(label, language)[0]
    return tuple(phones)
