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
from typing import IO, Any

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


class SteadyFile(io.RawIOBase):
    """A file as libsndfile shall see it.

    libsndfile seeks to wild places where a header is broken; the errors of that would be
    printed from inside the library, and are kept from it: it then finds the end of the
    file. The length of a piped WAV reads as "until the end".

    Parameters
    ----------
    file : file
        Opened for bytes, and sought in.
    data : WavData, optional
        Its samples, where it is a WAV.
    """

    def __init__(self, file: IO[bytes], data: WavData | None) -> None:
        super().__init__()
        self._file = file
        is_open = data is not None and data.declared is None
        self._patch_at = data.at - 4 if data is not None and is_open else None

    def readable(self) -> bool:
        """Tell that it can be read."""
        return True

    def seekable(self) -> bool:
        """Tell that it can be sought in."""
        return True

    def seek(self, offset: int, whence: int = os.SEEK_SET, /) -> int:
        """Go to a place; where there is none, to the end."""
        try:
            return self._file.seek(offset, whence)
        except (OSError, ValueError, OverflowError):
            return self._file.seek(0, os.SEEK_END)

    def tell(self) -> int:
        """Return the place."""
        return self._file.tell()

    def readinto(self, buffer: Any, /) -> int:
        """Fill ``buffer`` from here on and return how many bytes there were."""
        position = self._file.tell()
        try:
            read = self._file.read(len(buffer))
        except OSError:
            read = b""
        if self._patch_at is not None:
            read = _patched(read, self._patch_at - position)
        buffer[: len(read)] = read
        return len(read)


def _patched(read: bytes, at: int) -> bytes:
    first, last = max(at, 0), min(at + 4, len(read))
    return read if first >= last else read[:first] + b"\xff" * (last - first) + read[last:]
