"""Files that people edit: read whole or refused, written whole or not at all.

Every such file is JSON with a ``format`` and an integer ``version``. Reading goes
bytes → text → JSON (no duplicate keys, no NaN) → upgrade, one step per version →
a checked structure. Writing goes beside the target first and is renamed onto it.
This is the only place that replaces files on disk.
"""

from lipwright.files.blocks import text_blocks
from lipwright.files.keeping import Kept
from lipwright.files.pictures import check_picture
from lipwright.files.reading import (
    Version,
    check_document,
    convert,
    decode_text,
    file_version,
    parse_json,
    read_bytes,
    read_document,
    read_standard_input,
)
from lipwright.files.text import format_number, format_row, quote
from lipwright.files.writing import (
    STANDARD_STREAM,
    check_target,
    write_all,
    write_atomically,
    write_output,
)

__all__ = [
    "STANDARD_STREAM",
    "Kept",
    "Version",
    "check_document",
    "check_picture",
    "check_target",
    "convert",
    "decode_text",
    "file_version",
    "format_number",
    "format_row",
    "parse_json",
    "quote",
    "read_bytes",
    "read_document",
    "read_standard_input",
    "text_blocks",
    "write_all",
    "write_atomically",
    "write_output",
]
