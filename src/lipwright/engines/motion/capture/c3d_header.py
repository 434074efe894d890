"""What a C3D file says of its own length, checked before anything else reads it.

The header's frame numbers are 16 bits: files over 65,535 frames are cut silently by some
writers and readers, so that a file at this limit is refused. A file that was cut leaves
readers waiting for the rest. (C3D user guide: header section, words 1 to 12.)
"""

from __future__ import annotations

import struct
from dataclasses import dataclass
from pathlib import Path

from lipwright.errors import FileFormatError
from lipwright.files.reading import readable

MOST_FRAMES = 65535
_BLOCK = 512
_MARK = 0x50
_BIG_ENDIAN = 86
_DEC = 85


@dataclass(frozen=True, slots=True)
class Header:
    """The first block of a C3D file.

    Parameters
    ----------
    markers : int
    frames : int
    size : int
        Bytes that the file must have.
    """

    markers: int
    frames: int
    size: int


def check_c3d(path: str | Path) -> Header:
    """Return a file's header, or refuse the file.

    Raises
    ------
    FileFormatError
        If it is no C3D file, was cut, has no markers, or is at or over 65,535 frames.
    InputError
        If it cannot be read.
    """
    where = str(path)
    with readable(path), Path(path).open("rb") as file:
        first = file.read(_BLOCK)
        if not first:
            raise FileFormatError("is empty", where=where, expected="a C3D file")
        block = first[0] - 1
        if len(first) < _BLOCK or first[1] != _MARK or block < 1:
            raise FileFormatError("is no C3D file", where=where, expected="a C3D file")
        file.seek(block * _BLOCK)
        parameters = file.read(4)
        size = file.seek(0, 2)
    processor = parameters[3] if len(parameters) == 4 else 0
    header = _header(first, processor, where)
    if header.frames >= MOST_FRAMES:
        raise FileFormatError(
            f"{header.frames} frames",
            where=where,
            expected=f"fewer than {MOST_FRAMES}: longer files lose their end unseen",
            cure="export the take in parts",
        )
    if size < header.size:
        raise FileFormatError(
            f"{size} bytes, where its header promises {header.size}: the file was cut",
            where=where,
            expected=f"{header.frames} frames",
            cure="export it again",
        )
    return header


def _header(first: bytes, processor: int, where: str) -> Header:
    order = ">" if processor == _BIG_ENDIAN else "<"
    markers, analog, start, end = struct.unpack(f"{order}4H", first[2:10])
    data = struct.unpack(f"{order}H", first[16:18])[0]
    scale = first[12:16]
    if processor == _DEC:  # its floats have the sign in the other half
        scale = scale[2:] + scale[:2]
    number = 4 if struct.unpack(f"{order}f", scale)[0] < 0 else 2
    frames = end - start + 1
    if frames < 1 or data < 1:
        raise FileFormatError(
            f"frames {start} to {end}", where=where, expected="a C3D file with at least one frame"
        )
    if not markers:
        raise FileFormatError("no markers", where=where, expected="a C3D file with facial markers")
    return Header(markers, frames, (data - 1) * _BLOCK + frames * (4 * markers + analog) * number)
