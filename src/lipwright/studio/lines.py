"""Lines: from speech to what is kept of it, and back; where their sounds lie."""

from __future__ import annotations

from collections import OrderedDict
from functools import lru_cache
from hashlib import sha256
from pathlib import Path

from lipwright.errors import InputError
from lipwright.files import read_bytes
from lipwright.phones import PhoneTrack
from lipwright.sound import Sound
from lipwright.speech import Speech
from lipwright.studio.changes import LineData, Row, SoundRef
from lipwright.studio.drafts import Draft
from lipwright.timeline import Interval, Tier

LOWEST_RATE, HIGHEST_RATE = 8_000, 48_000
KEPT = 16
TITLE = 60


class Sounds:
    """The sounds of a studio: WAV files in the draft's folder, a few of them in memory.

    Parameters
    ----------
    draft : Draft
    """

    def __init__(self, draft: Draft) -> None:
        self._draft = draft
        self._loaded: OrderedDict[str, Sound] = OrderedDict()

    def add(self, sound: Sound) -> SoundRef:
        """Keep a sound as browsers play it."""
        playable = sound.resampled(min(max(sound.rate, LOWEST_RATE), HIGHEST_RATE))
        data = playable.wav_bytes()
        key = sha256(data).hexdigest()[:24]
        self._draft.keep("sounds", f"{key}.wav", data)
        self._remember(key, sound)
        return SoundRef(key, sound.duration)

    def path(self, key: str) -> Path:
        """Return a sound's file.

        Raises
        ------
        InputError
            If there is none of that key.
        """
        path = self._draft.folder / "sounds" / f"{key}.wav"
        if not key.isalnum() or not path.is_file():
            raise InputError(f"no sound {key!r}", expected="one that was sent")
        return path

    def load(self, key: str) -> Sound:
        """Return a sound."""
        if key not in self._loaded:
            from lipwright.sound_files import read_sound

            self._remember(key, read_sound(self.path(key)))
        self._loaded.move_to_end(key)
        return self._loaded[key]

    def wav(self, key: str) -> bytes:
        """Return the content of a sound's file."""
        return read_bytes(self.path(key))

    def _remember(self, key: str, sound: Sound) -> None:
        self._loaded[key] = sound
        while len(self._loaded) > KEPT:
            self._loaded.popitem(last=False)


def line_of(speech: Speech, sounds: Sounds, name: str, title: str = "") -> LineData:
    """Return what is kept of speech."""
    text = speech.text or " ".join(speech.words.labels)
    shown = title or text or name
    return LineData(
        name,
        shown if len(shown) <= TITLE else shown[: TITLE - 1] + "…",
        _rows(speech.phones.tier),
        _rows(speech.words),
        speech.phones.phone_set,
        text,
        speech.language,
        speech.source,
        sounds.add(speech.sound) if speech.sound is not None else None,
        speech.notes,
    )


def speech_of(line: LineData, sounds: Sounds) -> Speech:
    """Return a line as engines take it."""
    return Speech(
        PhoneTrack(tier_of(line.phones), line.phone_set),
        tier_of(line.words),
        sounds.load(line.sound.key) if line.sound else None,
        line.text,
        line.language,
        line.source,
        notes=line.notes,
    )


def duration_of(line: LineData) -> float:
    """Return how long a line is, seconds."""
    return line.sound.duration if line.sound else (line.phones[-1][2] if line.phones else 0.0)


def _rows(tier: Tier) -> tuple[Row, ...]:
    return tuple((one.label, one.start, one.end) for one in tier)


@lru_cache(maxsize=64)
def tier_of(rows: tuple[Row, ...]) -> Tier:
    """Return rows as a tier."""
    return Tier(tuple(Interval(*row) for row in rows))
