"""Mandarin from espeak-ng: what it is given to speak, and what it spoke in phones of pinyin.

It is given a syllable at a time, in pinyin, since its own reading of characters errs
(it takes 兄 for an English word, and every heteronym in its commonest reading). Each of
its phones then says which syllable it belongs to, and the syllable says which phones
these are (:mod:`lipwright.schedule.mandarin.lay`).
"""

from __future__ import annotations

from bisect import bisect_right
from dataclasses import dataclass, replace

from lipwright.phones import SILENCE, PhoneTrack
from lipwright.schedule.mandarin.lay import lay
from lipwright.schedule.mandarin.pinyin import Syllable
from lipwright.schedule.mandarin.reading import Pause, read
from lipwright.schedule.mandarin.sounds import for_espeak
from lipwright.schedule.say import espeak
from lipwright.schedule.say.assemble import timed
from lipwright.schedule.say.words import TimedPhone, nothing_to_say
from lipwright.speech import Speech
from lipwright.timeline import Interval, Tier

_SHORTEST_PAUSE = 0.1  # seconds; shorter ones are joints between syllables
_STOPS = ("p", "t", "k")  # affricates among them


@dataclass(frozen=True, slots=True)
class Line:
    """A text made ready to speak.

    Parameters
    ----------
    spoken : str
        What espeak-ng gets.
    syllables : tuple of Syllable
    starts : tuple of int
        Where in ``spoken`` each syllable begins.
    words : tuple of (str, int)
        The user's words, and how many syllables each has.
    """

    spoken: str
    syllables: tuple[Syllable, ...]
    starts: tuple[int, ...]
    words: tuple[tuple[str, int], ...]


def prepare(text: str) -> Line:
    """Return what espeak-ng is given to speak a text.

    Raises
    ------
    TextError
        If there is no word in it, or one of unknown reading.
    MissingExtraError
        If the extra ``mandarin`` is not installed, and needed.

    Examples
    --------
    >>> prepare("ni3 hao3, xiong1!").spoken
    "ni3 hao3, [[S;j'ong55]]!"
    """
    spoken = ""
    syllables: list[Syllable] = []
    starts: list[int] = []
    words: list[tuple[str, int]] = []
    for part in read(text):
        if isinstance(part, Pause):
            if spoken and spoken[-1] not in ",.!?":
                spoken += part.mark
            continue
        words.append((part.text, len(part.syllables)))
        for syllable in part.syllables:
            spoken += " " if spoken else ""
            starts.append(len(spoken))
            syllables.append(syllable)
            spoken += syllable.text if syllable.is_foreign else for_espeak(syllable)
    if not syllables:
        raise nothing_to_say()
    return Line(spoken, tuple(syllables), tuple(starts), tuple(words))


def from_espeak(
    spoken: espeak.Spoken, line: Line, *, text: str, notes: tuple[str, ...] = ()
) -> Speech:
    """Return the speech that a line became.

    Raises
    ------
    TextError
        If not a single phone was spoken.
    """
    sound, phones = timed(spoken)
    heard, pauses = _by_syllable(without_joints(phones, _SHORTEST_PAUSE), line)
    laid = [
        lay(syllable, [(p.label, p.start, p.end) for p in own]) if own else []
        for syllable, own in zip(line.syllables, heard, strict=True)
    ]
    placed = sorted(
        [*(phone for syllable in laid for phone in syllable), *pauses], key=lambda each: each.start
    )
    return Speech(
        phones=PhoneTrack(Tier(tuple(placed)), "pinyin"),
        words=_words(line, laid),
        sound=sound,
        text=text,
        language=spoken.language,
        source="say",
        notes=notes,
    )


def without_joints(phones: list[TimedPhone], shortest: float) -> list[TimedPhone]:
    """Return phones whose shortest silences went to a neighbour.

    espeak-ng leaves some hundredths of a second between words, and each syllable is a word
    to it. A stop takes them as its closure; else they belong to the sound before.
    """
    result: list[TimedPhone] = []
    closure: float | None = None
    for index, phone in enumerate(phones):
        inside = 0 < index < len(phones) - 1
        if phone.label == SILENCE and inside and phone.end - phone.start < shortest:
            if phones[index + 1].label.startswith(_STOPS):
                closure = phone.start
            else:
                result[-1] = replace(result[-1], end=phone.end)
            continue
        result.append(phone if closure is None else replace(phone, start=closure))
        closure = None
    return result


def _by_syllable(
    phones: list[TimedPhone], line: Line
) -> tuple[list[list[TimedPhone]], list[Interval]]:
    """Return the phones of each syllable, and the pauses."""
    heard: list[list[TimedPhone]] = [[] for _ in line.syllables]
    pauses: list[Interval] = []
    latest = 0
    for phone in phones:
        if phone.label == SILENCE:
            pauses.append(Interval(SILENCE, phone.start, phone.end))
            continue
        # A position never goes back; where the synthesiser says so it means this syllable.
        latest = max(latest, bisect_right(line.starts, phone.position) - 1)
        heard[latest].append(phone)
    return heard, pauses


def _words(line: Line, laid: list[list[Interval]]) -> Tier:
    words: list[Interval] = []
    at = 0
    for text, count in line.words:
        phones = [phone for syllable in laid[at : at + count] for phone in syllable]
        at += count
        if phones:
            words.append(Interval(text, phones[0].start, phones[-1].end))
    return Tier(tuple(words))
