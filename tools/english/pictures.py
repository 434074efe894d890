"""``python -m tools.english.pictures BEFORE.json TARGET.svg``: ten bigrams, before and now.

Draws the curves of ten well-known pairs of an older set file beside those of the set as it
is, one small chart each, so that a change to the set can be looked at.
"""

from __future__ import annotations

import sys
from pathlib import Path

from lipwright.curves import Keys
from lipwright.engines.bigram import Bigram, load_set, read_set

PAIRS = (
    ("f", "ah"), ("l", "ow"), ("bmp", "ay"), ("ih", "bmp"), ("d", "w"),
    ("th", "ih"), ("sh", "ih"), ("z", "ow"), ("w", "aa"), ("kg", "ah"),
)  # fmt: skip
COLORS = {
    "open": "#d55e00", "W": "#0072b2", "wide": "#009e73", "ShCh": "#cc79a7", "FV": "#7b61ff",
    "PBM": "#8a4fa3", "tBack": "#8c564b", "tRoof": "#56616f", "tTeeth": "#b8860b",
}  # fmt: skip
WIDTH, HEIGHT, GAP, TOP = 240, 90, 26, 46


def chart(bigram: Bigram, x: float, y: float) -> list[str]:
    """Return one pair's curves as SVG elements."""
    middle = x + bigram.boundary * WIDTH
    lines = [
        f'<rect x="{x}" y="{y}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#bbb"/>',
        f'<path d="M{middle} {y}v{HEIGHT}" stroke="#ccc" stroke-dasharray="3 3"/>',
    ]
    for pose, keys in bigram.curves.items():
        color = COLORS.get(pose, "#000")
        lines.append(
            f'<polyline points="{points(keys, x, y)}" fill="none" stroke="{color}" '
            f'stroke-width="2"><title>{pose}</title></polyline>'
        )
    return lines


def points(keys: Keys, x: float, y: float) -> str:
    """Return keys as the points of a polyline."""
    return " ".join(f"{x + t * WIDTH:.1f},{y + HEIGHT - v * HEIGHT:.1f}" for t, v in keys.pairs())


def legend() -> list[str]:
    """Return the names of the poses in their colours."""
    step = (2 * WIDTH + 3 * GAP) / len(COLORS)
    return [
        f'<text x="{GAP + i * step:.0f}" y="18" fill="{color}" font-weight="bold">{pose}</text>'
        for i, (pose, color) in enumerate(COLORS.items())
    ]


def picture(before: Path) -> str:
    """Return the whole picture as SVG."""
    old, new = read_set(before), load_set("english")
    height = TOP + len(PAIRS) * (HEIGHT + GAP)
    width = 2 * WIDTH + 3 * GAP
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" '
        'font-family="sans-serif" font-size="12">',
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
        *legend(),
    ]
    for row, pair in enumerate(PAIRS):
        y = TOP + row * (HEIGHT + GAP)
        word = new.bigrams[pair].word
        lines.append(f'<text x="{GAP}" y="{y - 6}">{"-".join(pair)}, {word}: first draft</text>')
        lines.append(f'<text x="{2 * GAP + WIDTH}" y="{y - 6}">now</text>')
        lines += chart(old.bigrams[pair], GAP, y) + chart(new.bigrams[pair], 2 * GAP + WIDTH, y)
    return "\n".join([*lines, "</svg>"]) + "\n"


if __name__ == "__main__":
    Path(sys.argv[2]).write_text(picture(Path(sys.argv[1])), encoding="utf-8")
