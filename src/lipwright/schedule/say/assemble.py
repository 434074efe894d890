"""From what a synthesiser spoke to a Speech: plain labels, edges, words.

Each line begins and ends with enough silence for the mouth to open in and to close in.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from lipwright.phones import SILENCE, PhoneTrack
from lipwright.schedule.say import espeak, festival
from lipwright.schedule.say.closures import begin_stops_at_closure
from lipwright.schedule.say.spelling import plain_labels
from lipwright.schedule.say.words import TimedPhone, Utterance, nothing_to_say, time_words
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier

_SILENCE_AROUND = 0.2  # seconds, the least before and after the speech
_SHORTEST_PAUSE = 0.03  # seconds; shorter ones are joints inside a phrase
_SHORTEST_STOP = 0.02  # seconds
_STOPS = tuple("pbtdkɡgcɟqɢʈɖʔɓɗɠʄʛʡ")


def from_espeak(
    spoken: espeak.Spoken, utterance: Utterance, *, text: str, notes: tuple[str, ...] = ()
) -> Speech:
    """Return the speech that an utterance became.

    Raises
    ------
    TextError
        If not a single phone was spoken.
    """
    sound, phones = timed(spoken)
    return Speech(
        phones=_track(phones, "ipa"),
        words=_words(utterance, phones),
        sound=sound,
        text=text,
        language=spoken.language,
        source="say",
        notes=notes,
    )


def timed(spoken: espeak.Spoken) -> tuple[Sound, list[TimedPhone]]:
    """Return what was spoken with silence around it, and its phones as IPA in time.

    Raises
    ------
    TextError
        If not a single phone was spoken.
    """
    labels, edges, positions = _plain(spoken)
    phones = _timed(labels, edges, positions, spoken.rate)
    sound, phones = _with_silence(Sound(spoken.samples, spoken.rate), phones)
    return sound, _with_closures(sound, phones)


def from_festival(spoken: festival.Spoken, utterance: Utterance, *, text: str) -> Speech:
    """Return the speech that an utterance became.

    Raises
    ------
    TextError
        If not a single phone was spoken.
    """
    sound, phones = _with_silence(Sound(spoken.samples, spoken.rate), list(spoken.phones))
    return Speech(
        phones=_track(phones, "arpabet"),
        words=_words(utterance, phones),
        sound=sound,
        text=text,
        language="en-us",
        source="say",
    )


def _timed(
    labels: list[str], edges: list[int], positions: list[int], rate: int
) -> list[TimedPhone]:
    times = [edge / rate for edge in edges]
    return [
        TimedPhone(label, start, end, position)
        for label, (start, end), position in zip(labels, pairwise(times), positions, strict=True)
    ]


def _with_closures(sound: Sound, phones: list[TimedPhone]) -> list[TimedPhone]:
    labels = [phone.label for phone in phones]
    edges = [round(phone.start * sound.rate) for phone in phones] + [len(sound.samples)]
    moved = begin_stops_at_closure(
        sound.samples, sound.rate, labels, edges, is_stop=_is_stop, silence=SILENCE
    )
    return _timed(labels, moved, [phone.position for phone in phones], sound.rate)


def _track(phones: list[TimedPhone], phone_set: str) -> PhoneTrack:
    intervals = [Interval(phone.label, phone.start, phone.end) for phone in phones]
    return PhoneTrack(Tier(tuple(intervals)), phone_set)


def _words(utterance: Utterance, phones: list[TimedPhone]) -> Tier:
    return time_words(utterance, [phone for phone in phones if phone.label != SILENCE])


def _with_silence(sound: Sound, phones: list[TimedPhone]) -> tuple[Sound, list[TimedPhone]]:
    """Return both with enough silence before and after."""
    spoken = [phone for phone in phones if phone.label != SILENCE]
    if not spoken:
        raise nothing_to_say()
    rate, total = sound.rate, len(sound.samples)
    wanted = round(_SILENCE_AROUND * rate)
    first, last = round(spoken[0].start * rate), round(spoken[-1].end * rate)
    before, after = max(0, wanted - first), max(0, wanted - (total - last))
    samples = np.pad(sound.samples, (before, after))
    moved = [
        TimedPhone(
            phone.label,
            (round(phone.start * rate) + before) / rate,
            (round(phone.end * rate) + before) / rate,
            phone.position,
        )
        for phone in phones[phones.index(spoken[0]) : phones.index(spoken[-1]) + 1]
    ]
    begin = TimedPhone(SILENCE, 0.0, moved[0].start, spoken[0].position)
    end = TimedPhone(SILENCE, moved[-1].end, len(samples) / rate, spoken[-1].position)
    return Sound(samples, rate), [begin, *moved, end]


def _plain(spoken: espeak.Spoken) -> tuple[list[str], list[int], list[int]]:
    """Return labels, their edges (one more) and text positions: no gap, no empty phone."""
    labels, starts, positions = [SILENCE], [0], [0]
    ends = [start for _, start, _ in spoken.phones[1:]] + [len(spoken.samples)]
    spelled = plain_labels([label for label, _, _ in spoken.phones], spoken.language)
    for plain, (_, start, position), end in zip(spelled, spoken.phones, ends, strict=True):
        pause = plain == SILENCE
        joint = pause and end - start < _SHORTEST_PAUSE * spoken.rate
        if end == start > starts[-1] and _is_stop(plain):
            # Some voices give a stop no time at all (Vietnamese đ): it has its closure.
            start -= min(round(_SHORTEST_STOP * spoken.rate), (start - starts[-1]) // 2)
        if end <= start or not plain or joint or (pause and labels[-1] == SILENCE):
            continue  # its time, if any, goes to the phone before
        if start == 0:
            labels, starts, positions = [], [], []
        labels.append(plain)
        starts.append(start)
        positions.append(position)
    return labels, [*starts, len(spoken.samples)], positions


def _is_stop(label: str) -> bool:
    return label.startswith(_STOPS)
