"""Sound: one channel of samples in memory.

:mod:`lipwright.sound_files` reads it from files. Resampling is soxr's, imported when
first used.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import SoundError

# The RIFF chunk that names the software a sound was made with.
_MARK = b"LIST\x16\0\0\0INFOISFT\x0a\0\0\0Lipwright\0"


def is_own_wav(data: bytes) -> bool:
    """Whether a WAV file was made by :meth:`Sound.wav_bytes`, and may be made anew."""
    return data[:4] == b"RIFF" and data.endswith(_MARK)


@dataclass(frozen=True, slots=True, eq=False)
class Sound:
    """One channel of sound.

    Parameters
    ----------
    samples : (N,) float32
        In -1..1.
    rate : int
        Samples per second.
    notes : tuple of str
        What the user should know of the file it came from: that it was cut, or scaled.

    Raises
    ------
    SoundError
        If the samples are not one channel, or the rate is not positive.
    """

    samples: NDArray[np.float32]
    rate: int
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.samples.ndim != 1:
            raise SoundError(f"samples of shape {self.samples.shape}", expected="one channel")
        if self.rate <= 0:
            raise SoundError(f"{self.rate} samples per second", expected="a positive rate")

    @property
    def duration(self) -> float:
        """Length in seconds."""
        return len(self.samples) / self.rate

    def resampled(self, rate: int) -> Sound:
        """Return the sound at ``rate`` samples per second; itself where that is its own."""
        if rate == self.rate:
            return self
        import soxr  # late: most lines need it, `--help` does not

        samples: NDArray[np.float32] = soxr.resample(self.samples, self.rate, rate)
        np.clip(samples, -1.0, 1.0, out=samples)
        return Sound(samples, rate, self.notes)

    def wav_bytes(self) -> bytes:
        """Return the sound as a 16-bit WAV file; what is beyond -1..1 is clipped.

        Examples
        --------
        >>> is_own_wav(Sound(np.zeros(8, np.float32), 16000).wav_bytes())
        True
        """
        import io
        import wave

        clipped = np.clip(self.samples, -1.0, 1.0)
        written = io.BytesIO()
        with wave.open(written, "wb") as file:
            file.setnchannels(1)
            file.setsampwidth(2)
            file.setframerate(self.rate)
            file.writeframes(np.rint(clipped * 32767.0).astype("<i2").tobytes())
        data = written.getvalue() + _MARK
        return data[:4] + (len(data) - 8).to_bytes(4, "little") + data[8:]
