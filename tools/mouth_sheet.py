"""``python -m tools.mouth_sheet``: the mouths drawn for the built-in lists, as a picture.

It writes ``docs/pictures/mouths.svg``.
"""

from __future__ import annotations

from pathlib import Path

from lipwright.character.pictures import BUILT_IN_PICTURES, load_pictures
from lipwright.character.pictures.drawing import pictures_of
from lipwright.files import write_atomically

TARGET = Path(__file__).parents[1] / "docs" / "pictures" / "mouths.svg"
WIDTH, HEIGHT, TITLE = 96, 92, 26
STYLE = "font-family='system-ui, sans-serif' text-anchor='middle' fill='#333'"


def sheet() -> str:
    """Return all mouths with their labels, a row for each list."""
    columns = max(len(load_pictures(name).drawn) for name in BUILT_IN_PICTURES)
    parts = []
    for row, name in enumerate(BUILT_IN_PICTURES):
        top = row * (HEIGHT + TITLE)
        parts.append(f"<text x='8' y='{top + 18}' style='text-anchor:start'>{name}</text>")
        for column, (label, picture) in enumerate(pictures_of(load_pictures(name)).items()):
            own = f"in{row}-{column}"
            mouth = picture.data.decode().replace('id="in"', f'id="{own}"')
            mouth = mouth.replace("url(#in)", f"url(#{own})")
            place = f'<svg x="{column * WIDTH}" y="{top + TITLE - 4}" width="{WIDTH}" height="72" '
            parts.append(mouth.replace("<svg ", place, 1))
            middle = (column + 0.5) * WIDTH
            parts.append(f"<text x='{middle:g}' y='{top + TITLE + 80}'>{label}</text>")
    size = f"0 0 {columns * WIDTH} {len(BUILT_IN_PICTURES) * (HEIGHT + TITLE)}"
    ground = "<rect width='100%' height='100%' fill='#f7e3d0'/>"
    return (
        f"<svg xmlns='http://www.w3.org/2000/svg' viewBox='{size}' font-size='13'>"
        f"{ground}<g {STYLE}>{''.join(parts)}</g></svg>\n"
    )


if __name__ == "__main__":
    write_atomically(TARGET, sheet().encode())
