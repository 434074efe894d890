"""WAV: the sound of the line, 16 bits, one channel. It holds no animation."""

from __future__ import annotations

from lipwright.errors import InputError
from lipwright.performance import Performance


def encode(performance: Performance) -> bytes:
    """Return the sound as a WAV file.

    Raises
    ------
    InputError
        If the speech was made without a sound.
    """
    sound = performance.speech.sound
    if sound is None:
        raise InputError(
            "there is no sound to write as WAV",
            expected="speech with its sound",
            cure="give the recording, or leave the .wav output out",
        )
    return sound.wav_bytes()
