"""Text files of any size, a block at a time."""

from __future__ import annotations

import codecs
from collections.abc import Iterator
from pathlib import Path

from lipwright.errors import FileFormatError
from lipwright.files.reading import readable

BLOCK = 65536


def text_blocks(path: str | Path) -> Iterator[str]:
    """Yield the text of a UTF-8 file in blocks, so that its size does not matter.

    Raises
    ------
    InputError
        If it cannot be read.
    FileFormatError
        If it is not UTF-8: the byte is named.
    """
    decoder = codecs.getincrementaldecoder("utf-8-sig")()
    fed = 0
    with readable(path), Path(path).open("rb") as file:
        while True:
            block = file.read(BLOCK)
            held = len(decoder.getstate()[0])
            try:
                text = decoder.decode(block, final=not block)
            except UnicodeDecodeError as error:
                raise FileFormatError(
                    f"byte {fed - held + error.start} is not UTF-8 text",
                    where=str(path),
                    expected="a text in UTF-8",
                ) from None
            fed += len(block)
            if text:
                yield text
            if not block:
                return
