"""Speech for the studio: typed, dropped in, or the example word of a pair."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

from lipwright.engines.bigram.classes import reduction_for
from lipwright.engines.bigram.model import BigramSet, Pair
from lipwright.engines.bigram.preparation import prepare
from lipwright.errors import InputError, LipwrightError
from lipwright.phones import SILENCE, load_phone_set
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.studio.messages import ExampleView, Hear, Say

LANGUAGES = {"mandarin": "cmn"}


def said(request: Say) -> Speech:
    """Return typed text as speech."""
    from lipwright import pipeline

    return pipeline.say(request.text, voice=request.voice, rate=request.speed)


def heard(request: Hear, sound: Sound, told: Callable[[float], None]) -> Speech:
    """Return a sound with its words and phones in time."""
    from lipwright import pipeline

    if request.labels:
        return _labelled(request, sound)
    if request.text:
        return pipeline.align(sound, request.text, language=request.language, progress=told)
    if request.by_ear:
        return pipeline.hear(sound, progress=told)
    return pipeline.recognise(sound, progress=told)


def _labelled(request: Hear, sound: Sound) -> Speech:
    """Labels come as a file's content: readers of labels take files."""
    from lipwright import pipeline

    name = Path(request.labels_name or "labels.TextGrid").name
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        path.write_text(request.labels, "utf-8")
        try:
            return pipeline.from_labels(path, sound)
        except LipwrightError as error:
            place = error.where.replace(str(path), name)
            raise type(error)(
                error.found, where=place, expected=error.expected, cure=error.cure
            ) from None


def example_line(of: BigramSet, pair: Pair, word: str) -> tuple[ExampleView, Speech]:
    """Return a pair's example word spoken, and when the pair sounds in it.

    The set's word is tried, then words in which its two phones sound.

    Raises
    ------
    InputError
        If the pair sounds in none of them.
    """
    voice = LANGUAGES.get(of.phone_set, "en-us")
    for text in dict.fromkeys(filter(None, [_latin(word), *_words(of, pair)])):
        speech = said(Say(text=text, voice=voice, speed=140.0))
        when = _when(of, pair, speech)
        if when is not None:
            name = f"example {'-'.join(pair)}"
            view = ExampleView(pair=pair, word=text, line=name, start=when[0], end=when[1])
            return view, speech
    raise InputError(
        f"no example of {'-'.join(pair)}: it does not sound in {word or 'any known word'!r}",
        cure="give the pair a word in which it sounds",
    )


def _latin(word: str) -> str:
    """Mandarin's words stand with their pinyin behind them: the characters are spoken."""
    return word.split(" ")[0] if any("一" <= letter <= "鿿" for letter in word) else word


def _words(of: BigramSet, pair: Pair) -> list[str]:
    phones = load_phone_set(of.phone_set)
    first, second = (phones.example(label) for label in pair)
    if pair[0] == SILENCE:
        return [second]
    return [first] if pair[1] == SILENCE else [f"{first} {second}"]


def _when(of: BigramSet, pair: Pair, speech: Speech) -> tuple[float, float] | None:
    rows, _ = reduction_for(of, speech.phones.phone_set).rows(speech.phones)
    settings = of.rules.settings
    spans = prepare(rows, settings.padding, settings.silence_reach)
    if pair not in spans.pairs:
        return None
    place = spans.pairs.index(pair)
    return float(spans.first[place]), float(spans.last[place])
