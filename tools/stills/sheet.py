"""The sheet: a row for each character, a column for each sound."""

from __future__ import annotations

import io
from collections.abc import Sequence

from PIL import Image, ImageDraw, ImageFont

Pair = tuple[Image.Image, Image.Image]
CELL, FACE, MOUTH = 320, 290, 190
"""Width of a cell; height of the face and of the mouth below it."""
LEFT, TOP, GAP, SEAM = 120, 76, 12, 3
INK, FAINT = (32, 34, 38), (104, 108, 116)
COLOURS = 256


def sheet(rows: Sequence[tuple[str, Sequence[Pair]]], columns: Sequence[tuple[str, str]]) -> bytes:
    """Return the sheet as a PNG file.

    Parameters
    ----------
    rows : sequence of (name, pictures)
        For each character its name, and for each sound its face and its mouth.
    columns : sequence of (sound, word)
        What stands above each column.
    """
    high = FACE + SEAM + MOUTH
    size = (LEFT + len(columns) * (CELL + GAP), TOP + len(rows) * (high + GAP))
    page = Image.new("RGB", size, "white")
    pen = ImageDraw.Draw(page)
    large, small = ImageFont.load_default(30), ImageFont.load_default(20)
    for number, (sound, word) in enumerate(columns):
        middle = LEFT + number * (CELL + GAP) + CELL // 2
        pen.text((middle, 26), sound, INK, large, anchor="mm")
        pen.text((middle, 57), word, FAINT, small, anchor="mm")
    for number, (name, pictures) in enumerate(rows):
        top = TOP + number * (high + GAP)
        pen.text((LEFT - 16, top + FACE // 2), name, INK, small, anchor="rm")
        for column, (face, mouth) in enumerate(pictures):
            left = LEFT + column * (CELL + GAP)
            page.paste(face, (left, top))
            page.paste(mouth, (left, top + FACE + SEAM))
    packed = io.BytesIO()
    palette = page.quantize(COLOURS, Image.Quantize.MEDIANCUT, kmeans=3)
    few = page.quantize(palette=palette, dither=Image.Dither.FLOYDSTEINBERG)
    few.save(packed, "PNG", optimize=True)
    return packed.getvalue()
