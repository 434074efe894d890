"""From what espeak-ng spoke to a Speech: labels made plain, edges, words."""

from __future__ import annotations

import unicodedata

import numpy as np

from lipwright.phones import SILENCE, PhoneTrack
from lipwright.schedule.say.closures import begin_stops_at_closure
from lipwright.schedule.say.espeak import Spoken
from lipwright.schedule.say.words import Script, TimedPhone, nothing_to_say, time_words
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier

_LEAD_IN = 0.2  # seconds of silence before the first sound, for the mouth to open in
_SHORTEST_PAUSE = 0.03  # seconds; shorter ones are joints inside a phrase
_STOPS = tuple("pbtdkɡgcɟqɢʈɖʔɓɗɠʄʛʡ")
_MARKS = str.maketrans("", "", "ˈˌ-.' ")


def assemble(spoken: Spoken, script: Script, *, text: str, notes: tuple[str, ...] = ()) -> Speech:
    """Return the speech that a script became.

    Raises
    ------
    TextError
        If not a single phone was spoken.
    """
    lead = round(_LEAD_IN * spoken.rate)
    samples = np.concatenate([np.zeros(lead, np.float32), spoken.samples])
    labels, edges, positions = _plain(spoken, lead)
    if all(label == SILENCE for label in labels):
        raise nothing_to_say()
    edges = begin_stops_at_closure(
        samples, spoken.rate, labels, edges, is_stop=_is_stop, silence=SILENCE
    )
    times = [edge / spoken.rate for edge in edges]
    phones = [
        TimedPhone(label, start, end, position)
        for label, start, end, position in zip(
            labels, times[:-1], times[1:], positions, strict=True
        )
    ]
    track = Tier(tuple(Interval(phone.label, phone.start, phone.end) for phone in phones))
    return Speech(
        phones=PhoneTrack(track, "ipa"),
        words=time_words(script, [phone for phone in phones if phone.label != SILENCE]),
        sound=Sound(samples, spoken.rate),
        text=text,
        language=spoken.language,
        source="say",
        notes=notes,
    )


def plain_label(label: str) -> str:
    """Return a label of espeak-ng without stress and joints: IPA, or ``sil``.

    Examples
    --------
    >>> plain_label("ˈɑː"), plain_label("")
    ('ɑː', 'sil')
    """
    return unicodedata.normalize("NFC", label).translate(_MARKS) or SILENCE


def _plain(spoken: Spoken, lead: int) -> tuple[list[str], list[int], list[int]]:
    """Return labels, their edges (one more) and text positions: no gap, no empty phone."""
    labels, starts, positions = [SILENCE], [0], [0]
    ends = [start for _, start, _ in spoken.phones[1:]] + [len(spoken.samples)]
    for (label, start, position), end in zip(spoken.phones, ends, strict=True):
        plain = plain_label(label)
        switch = label.startswith("(")  # "(en)": from here on in another language
        pause = plain == SILENCE
        joint = pause and end - start < _SHORTEST_PAUSE * spoken.rate
        if end <= start or switch or joint or (pause and labels[-1] == SILENCE):
            continue  # its time, if any, goes to the phone before
        labels.append(plain)
        starts.append(start + lead)
        positions.append(position)
    return labels, [*starts, len(spoken.samples) + lead], positions


def _is_stop(label: str) -> bool:
    return label.startswith(_STOPS)
