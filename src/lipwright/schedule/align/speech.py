"""What was heard becomes :class:`~lipwright.speech.Speech`: tiers, confidence, notes."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from lipwright.phones import SILENCE, PhoneTrack
from lipwright.schedule.align.confidence import (
    DOUBTFUL,
    is_unaccounted,
    line_confidence,
    phone_confidence,
    word_confidence,
)
from lipwright.schedule.align.heard import NO_TOKEN, Heard
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier

_SHOWN = 8


def as_speech(
    heard: Sequence[Heard],
    labels: Sequence[str],
    sound: Sound,
    *,
    text: str,
    source: str,
    notes: Sequence[str] = (),
    language: str = "en-us",
    phone_set: str = "arpabet",
) -> Speech:
    """Return the speech.

    Parameters
    ----------
    heard : sequence of Heard
        Phones and pauses in order, from 0 on.
    labels : sequence of str
        The tokens, as the user wrote them.
    phone_set : str
        Of the labels of what was heard.
    """
    return Speech(
        PhoneTrack(_phones(heard, sound.duration), phone_set),
        _words(heard, labels),
        sound,
        text,
        language,
        source,
        line_confidence(heard),
        (*notes, *_warnings(heard, labels)),
    )


def guessed_note(words: Sequence[str]) -> tuple[str, ...]:
    """Return a note that names the words whose pronunciation was guessed."""
    if not words:
        return ()
    return (f"guessed how these sound: {_list(words)}; --lexicon FILE can say it better",)


def _phones(heard: Sequence[Heard], duration: float) -> Tier:
    """Return phones without gaps from 0 to ``duration``; pauses that meet become one."""
    result: list[Interval] = []
    for index, phone in enumerate(heard):
        end = duration if index == len(heard) - 1 else min(phone.end, duration)
        start = result[-1].end if result else 0.0
        if result and phone.is_pause and result[-1].label == SILENCE:
            start = result.pop().start
        if end > start:
            confidence = None if phone.is_pause else phone_confidence(phone)
            result.append(Interval(phone.label, start, end, confidence))
    if result and result[-1].end < duration:
        result.append(Interval(SILENCE, result[-1].end, duration))
    return Tier(tuple(result))


def _words(heard: Sequence[Heard], labels: Sequence[str]) -> Tier:
    speech = [phone for phone in heard if phone.token != NO_TOKEN]
    result = []
    for token, group in groupby(speech, key=lambda phone: phone.token):
        phones = list(group)
        confidence = word_confidence(phones)
        result.append(Interval(labels[token], phones[0].start, phones[-1].end, confidence))
    return Tier(tuple(result))


def _warnings(heard: Sequence[Heard], labels: Sequence[str]) -> list[str]:
    notes = []
    sure = line_confidence(heard)
    if sure < DOUBTFUL:
        notes.append(f"confidence {sure:.2f}: the words may not be what is spoken")
    if lost := [phone for phone in heard if is_unaccounted(phone)]:
        seconds = sum(phone.end - phone.start for phone in lost)
        notes.append(f"{seconds:.1f} s of sound without words, the first at {lost[0].start:.1f} s")
    placed = {phone.token for phone in heard}
    unheard = [label for index, label in enumerate(labels) if index not in placed]
    if unheard:
        notes.append(f"not found in the sound: {_list(unheard)}")
    return notes


def _list(words: Sequence[str]) -> str:
    shown = ", ".join(words[:_SHOWN])
    return f"{shown} and {len(words) - _SHOWN} more" if len(words) > _SHOWN else shown
