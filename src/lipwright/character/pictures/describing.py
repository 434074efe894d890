"""What a character of pictures is made of: ``lipwright character inspect rhubarb``."""

from __future__ import annotations

import textwrap
from typing import Any

from lipwright.character.pictures.picture_file import PictureCharacter, Shape
from lipwright.files import format_number

_WIDTH = 80


def inspect_pictures(of: PictureCharacter) -> dict[str, Any]:
    """Return what a character of pictures is made of, as JSON values.

    Returns
    -------
    dict
        ``name``; ``shapes`` (of each its ``label``, where it lies (``at``), the sounds it is
        kept for (``only``), its ``picture``'s file or nothing, and ``about``); ``rest``;
        ``reach``; ``missing``, with what stands in for each; ``relax``; ``timing``.
    """
    timing = of.timing
    return {
        "name": of.name,
        "shapes": [
            {
                "label": shape.label,
                "at": shape.at,
                "only": shape.only,
                "picture": shape.picture,
                "about": shape.about,
            }
            for shape in of.shapes
        ],
        "rest": of.rest,
        "reach": of.reach,
        "missing": {label: of.shown_for(label) for label in of.missing},
        "relax": of.relax,
        "timing": {
            "fps": timing.fps,
            "on": timing.on,
            "minimum_hold": timing.minimum_hold,
            "lead": timing.lead,
            "rest_after": timing.rest_after,
        },
    }


def describe_pictures(of: PictureCharacter) -> str:
    """Return what a character of pictures is made of, as a table of at most 80 columns."""
    timing = of.timing
    lines = [
        f"{of.name}: {len(of.shapes)} mouth shapes, {of.rest} at rest",
        f"held: at least {timing.minimum_hold}, at {timing.fps:g} frames per second on "
        f"{_ON.get(timing.on, f'every {timing.on}th')}, {timing.lead} before the sound",
        "",
    ]
    width = max(map(len, of.labels))
    for shape in of.shapes:
        head = f"  {shape.label.ljust(width)}  "
        lines += _wrapped(head, shape.about or _points(shape))
        remarks = "; ".join(_remarks(of, shape))
        lines += _wrapped(" " * len(head), f"({remarks})") if remarks else []
    return "\n".join(lines) + "\n"


_ON = {1: "ones", 2: "twos", 3: "threes", 4: "fours"}


def _remarks(of: PictureCharacter, shape: Shape) -> list[str]:
    must = [sound for sound, label in of.reach.items() if label == shape.label]
    found = [f"every {' '.join(must)} must show it"] if must else []
    if shape.only and shape.only != must:
        found.append(f"only for {' '.join(shape.only)}")
    if shape.label in of.missing:
        found.append(f"not drawn: {of.shown_for(shape.label)} stands in")
    elif shape.picture:
        found.append(shape.picture)
    return found


def _points(shape: Shape) -> str:
    """Return where a shape lies: ``0.3 open + 0.5 W; 1 FV``."""
    rows = (
        " + ".join(f"{format_number(weight)} {control}" for control, weight in point.items())
        for point in shape.at
    )
    return "; ".join(row or "rest" for row in rows)


def _wrapped(head: str, text: str) -> list[str]:
    return textwrap.wrap(
        text, _WIDTH, initial_indent=head, subsequent_indent=" " * len(head),
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip
