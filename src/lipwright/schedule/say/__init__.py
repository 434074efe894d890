"""Say a text: speech from a synthesiser, with the words and phones that it spoke.

The synthesiser is espeak-ng (extra ``tts``), or Festival where that is installed. Both
run as programs of their own. Phones are exact to the sample, since who speaks knows
when; a stop's closure is counted in the stop (DESIGN section 10).
"""

from __future__ import annotations

from lipwright.errors import InputError, MissingExtraError, TextError
from lipwright.schedule.say import espeak, festival
from lipwright.schedule.say.assemble import from_espeak, from_festival
from lipwright.schedule.say.voices import (
    Voice,
    as_voices,
    check_script,
    is_mandarin,
    library_name,
    resolve,
    script_notes,
    unknown_voice,
)
from lipwright.schedule.say.words import Utterance, prepare
from lipwright.speech import Speech

__all__ = ["Voice", "say", "voices"]

_LONGEST_TEXT = 100_000  # characters, about two hours of speech
_LONGEST_WORD = 150  # characters; espeak-ng drops the rest
_RATES = (80, 450)
_PITCHES = (0, 99)
_ENGINES = ("espeak", "festival")


def say(
    text: str,
    *,
    voice: str = "en-us",
    rate: float = 175.0,
    pitch: float | None = None,
    engine: str = "espeak",
) -> Speech:
    """Speak a text.

    Parameters
    ----------
    text : str
        What to say, as people write it. Markup is read out as it stands.
    voice : str
        A language (``"en-us"``, ``"de"``), a voice's name, either with ``+variant``
        (``"en-us+f3"``), or ``"festival"``, ``"festival:slt"``; see :func:`voices`.
    rate : float
        Words per minute, 80 to 450.
    pitch : float, optional
        0 to 99; the voice's own (about 50) where it is not given.
    engine : str
        ``"espeak"`` or ``"festival"``.

    Returns
    -------
    Speech
        With sound, words, and phones in the set ``"ipa"`` (``"pinyin"`` for Mandarin,
        ``"arpabet"`` from Festival). The phones cover the sound from 0 to its end.

    Raises
    ------
    TextError
        If there is nothing to say, the voice is unknown, or it cannot read the text.
    InputError
        If rate, pitch or engine are out of range.
    MissingExtraError
        If there is no synthesiser, or what reads Chinese characters is missing.
    """
    _check_number("rate", rate, _RATES, "words per minute")
    if pitch is not None:
        _check_number("pitch", pitch, _PITCHES, "from low to high")
    if len(text) > _LONGEST_TEXT:
        raise TextError(
            f"{len(text):,} characters",
            where="the text",
            expected=f"at most {_LONGEST_TEXT:,}",
            cure="say it in parts",
        )
    if engine not in _ENGINES:
        raise InputError(f"no speech engine {engine!r}", expected=" or ".join(_ENGINES))
    utterance = prepare(text)
    if engine == "espeak" and is_mandarin(voice):
        return _say_in_mandarin(utterance.spoken, text, voice, rate, pitch)
    if engine == "festival" or voice.split(":")[0] == "festival":
        return _say_with_festival(utterance, text, voice, rate, pitch)
    spoken, notes = _speak(utterance.spoken, voice, round(rate), pitch)
    notes += script_notes(utterance.spoken, spoken.language) + _notes(utterance)
    return from_espeak(spoken, utterance, text=text, notes=notes)


def voices() -> list[Voice]:
    """Return the voices that are installed: espeak-ng's by language, then Festival's.

    Raises
    ------
    MissingExtraError
        If there is no synthesiser at all.
    """
    others = [
        Voice(name=name, language=f"festival:{name}", engine="festival", languages=("en-us",))
        for name in festival.installed_voices()
    ]
    try:
        listed, _ = espeak.installed_voices()
    except MissingExtraError:
        if not others:
            raise
        listed = []
    return sorted(as_voices(listed), key=lambda voice: voice.language) + others


def _say_with_festival(
    utterance: Utterance, text: str, voice: str, rate: float, pitch: float | None
) -> Speech:
    if pitch is not None:
        raise InputError(
            f"pitch {pitch:g} for a voice of Festival",
            expected="no pitch",
            cure="leave --pitch out, or use espeak",
        )
    check_script(utterance.spoken, "en-us")
    name = "" if voice in ("festival", "en-us") else voice.removeprefix("festival:")
    plain = festival.plain_utterance(utterance)
    return from_festival(festival.speak(plain, name, rate=rate), plain, text=text)


def _say_in_mandarin(plain: str, text: str, voice: str, rate: float, pitch: float | None) -> Speech:
    from lipwright.schedule.say import mandarin  # its tables are needed for no other voice

    line = mandarin.prepare(plain)
    spoken, notes = _speak(line.spoken, voice, round(rate), pitch, mnemonics=True)
    return mandarin.from_espeak(spoken, line, text=text, notes=notes)


def _check_number(name: str, value: float, bounds: tuple[int, int], unit: str) -> None:
    low, high = bounds
    if not low <= value <= high:  # NaN fails as well
        raise InputError(f"{name} {value:g}", expected=f"{low} to {high} {unit}")


def _speak(
    text: str, voice: str, rate: int, pitch: float | None, *, mnemonics: bool = False
) -> tuple[espeak.Spoken, tuple[str, ...]]:
    """Speak with the voice of that name, or with its language's where the region has none."""

    def speak(name: str) -> espeak.Spoken:
        return espeak.speak(
            text,
            name,
            rate=rate,
            pitch=None if pitch is None else round(pitch),
            accept=lambda language: check_script(text, language),
            mnemonics=mnemonics,
        )

    try:
        return speak(library_name(voice)), ()
    except espeak.UnknownVoiceError as unknown:
        installed, variants = as_voices(unknown.voices), unknown.variants
    file, exact = resolve(voice, installed)
    try:
        spoken = speak(file)
    except espeak.UnknownVoiceError:
        raise unknown_voice(voice, installed, variants) from None
    notes = () if exact else (f"there is no voice {voice!r}: spoken by {spoken.language!r}",)
    return spoken, notes


def _notes(utterance: Utterance) -> tuple[str, ...]:
    long = [word for word in utterance.words if len(word) > _LONGEST_WORD]
    return tuple(f"only the beginning of {word[:20]!r}… was spoken" for word in long)
