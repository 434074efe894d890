"""The first bytes of sound files: what kind they are, and WAV headers that are wrong.

A program that pipes a WAV cannot go back to write its length: it leaves 0 or the
greatest number there. A file that was cut promises more than it holds. libsndfile
reads all of these but a length of 0, and says nothing; so the header is read here too.
The layout is that of "Multimedia Programming Interface and Data Specifications 1.0"
(IBM and Microsoft 1991), chapter 2.
"""

from __future__ import annotations

import io
import os
import struct
from dataclasses import dataclass
from typing import IO

UNKNOWN = 0x7FFF0000
"""Lengths from here on stand for "until the end" (sox 0x7FFFF000, others 0xFFFFFFFF)."""

_MEDIA = (b"\x1a\x45\xdf\xa3", b"\x30\x26\xb2\x75", b"\xff\xf1", b"\xff\xf9")


def looks_like_media(head: bytes) -> bool:
    """Tell whether a file's first 16 bytes are of a kind that only ``av`` decodes.

    m4a, mp4 and mov; Matroska and WebM; ASF (wma); raw AAC.
    """
    return head[4:8] == b"ftyp" or head.startswith(_MEDIA)


@dataclass(frozen=True, slots=True)
class WavData:
    """The ``data`` chunk of a WAV file.

    Parameters
    ----------
    at : int
        Where its samples start, in bytes.
    declared : int or None
        Their length in bytes by the header; None where the header leaves it open.
    present : int
        How many bytes follow.
    """

    at: int
    declared: int | None
    present: int


def wav_data(file: IO[bytes]) -> WavData | None:
    """Find the samples in a WAV file; None if it is none, or has no samples yet."""
    length = file.seek(0, os.SEEK_END)
    file.seek(0)
    head = file.read(12)
    if len(head) < 12 or head[:4] != b"RIFF" or head[8:] != b"WAVE":
        return None
    (riff,) = struct.unpack("<I", head[4:8])
    while len(chunk := file.read(8)) == 8:
        name, size = struct.unpack("<4sI", chunk)
        if name == b"data":
            at = file.tell()
            streamed = size == 0 and (riff in (0, 0xFFFFFFFF) or length > riff + 8)
            is_open = size >= UNKNOWN or streamed
            return WavData(at, None if is_open else size, length - at)
        file.seek(size + size % 2, os.SEEK_CUR)
    return None


def mended(file: IO[bytes], data: WavData) -> IO[bytes]:
    """Return a view of a WAV file of open length that libsndfile reads to its end."""
    return io.BufferedReader(_Overlay(file, data.at - 4, b"\xff\xff\xff\xff"))


class _Overlay(io.RawIOBase):
    """A file in which a few bytes read differently; nothing is written or copied."""

    def __init__(self, file: IO[bytes], at: int, patch: bytes) -> None:
        super().__init__()
        self._file, self._at, self._patch = file, at, patch

    def readable(self) -> bool:
        return True

    def seekable(self) -> bool:
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET, /) -> int:
        return self._file.seek(offset, whence)

    def tell(self) -> int:
        return self._file.tell()

    def readinto(self, buffer: memoryview, /) -> int:  # type: ignore[override]
        position = self._file.tell()
        read = self._file.read(len(buffer))
        buffer[: len(read)] = read
        for index, byte in enumerate(self._patch, start=self._at - position):
            if 0 <= index < len(read):
                buffer[index] = byte
        return len(read)
