"""Figure 2 of Xu et al. 2013 anew: pairs by rank, and what the first ones cover together."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import accumulate
from typing import NamedTuple

from lipwright.engines.bigram.coverage import Coverage
from lipwright.files import format_number
from tools.coverage.published import FIRST, FIRST_SHARE, KINDS, NEVER, TABLE

WIDTH, HEIGHT, LEFT, TOP, GAP = 330, 250, 58, 64, 92
OURS, WRITTEN, THEIRS = "#0b5fa5", "#d55e00", "#111"
INK, GRID = "#333", "#e3e6ea"


class Panel(NamedTuple):
    """A diagram: where it stands, and what its axes span."""

    x: float
    right: float
    top: float

    def at(self, across: float, up: float) -> tuple[str, str]:
        """Return where a value stands in the picture."""
        x = self.x + WIDTH * across / self.right
        y = TOP + HEIGHT * (1 - up / self.top)
        return format_number(x, 2), format_number(y, 2)

    def curve(self, values: Iterable[tuple[float, float]], color: str, dashes: str = "") -> str:
        """Return a line through values."""
        points = " ".join(",".join(self.at(a, b)) for a, b in values)
        extra = f' stroke-dasharray="{dashes}"' if dashes else ""
        return (
            f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.8"{extra}/>'
        )

    def dot(self, across: float, up: float) -> str:
        """Return a mark of a published value."""
        x, y = self.at(across, up)
        return (
            f'<circle cx="{x}" cy="{y}" r="2.4" fill="#fff" stroke="{THEIRS}" stroke-width="1.2"/>'
        )

    def frame(
        self, title: str, ticks: Sequence[float], rows: Sequence[float], up: Callable[[float], str]
    ) -> list[str]:
        """Return axes, grid and labels."""
        lines = [text(self.x, TOP - 16, title, weight="600")]
        for value in rows:
            x, y = self.at(0, value)
            lines.append(f'<path d="M{x} {y}h{WIDTH}" stroke="{GRID}"/>')
            lines.append(text(float(x) - 8, float(y) + 4, up(value), anchor="end"))
        for value in ticks:
            x, y = self.at(value, 0)
            lines.append(f'<path d="M{x} {y}v5" stroke="{INK}"/>')
            lines.append(text(float(x), float(y) + 19, f"{value:g}", anchor="middle"))
        x, y = self.at(0, 0)
        lines.append(f'<path d="M{x} {TOP}V{y}h{WIDTH}" fill="none" stroke="{INK}"/>')
        below = TOP + HEIGHT + 38
        lines.append(text(self.x + WIDTH / 2, below, "pairs by rank", anchor="middle"))
        return lines


def text(x: float, y: float, words: str, *, anchor: str = "start", weight: str = "400") -> str:
    """Return a label."""
    extra = "" if anchor == "start" else f' text-anchor="{anchor}"'
    extra += "" if weight == "400" else f' font-weight="{weight}"'
    place = f'x="{format_number(x, 1)}" y="{format_number(y, 1)}"'
    return f'<text {place}{extra} fill="{INK}">{words}</text>'


def shares(of: Coverage) -> list[float]:
    """Return the share of every possible pair in percent, the most frequent first."""
    found = [100 * need.share for need in of.needs()]
    return found + [0.0] * (KINDS - len(found))


def figure(spoken: Coverage, written: Coverage) -> str:
    """Return the whole picture as SVG."""
    width, height = LEFT + 2 * WIDTH + GAP + 30, TOP + HEIGHT + 92
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" font-family="Helvetica, Arial, sans-serif" font-size="12">'
    )
    title = "<title>Share of each pair of phones by rank, and of the first ones together</title>"
    back = f'<rect width="{width}" height="{height}" fill="#fff"/>'
    body = [*_each(spoken, written), *_together(spoken, written), *_legend(height - 22)]
    return "\n".join((head, title, back, *body, "</svg>\n"))


def _each(spoken: Coverage, written: Coverage) -> list[str]:
    panel = Panel(LEFT, KINDS, 5.0)
    lines = panel.frame(
        "share of each pair", range(0, 401, 100), range(6), lambda value: f"{value:g} %"
    )
    for of, color, dashes in ((spoken, OURS, ""), (written, WRITTEN, "5 3")):
        lines.append(panel.curve(enumerate(shares(of), 1), color, dashes))
    return lines + [panel.dot(rank, row[2]) for rank, row in enumerate(TABLE, 1)]


def _together(spoken: Coverage, written: Coverage) -> list[str]:
    panel = Panel(LEFT + WIDTH + GAP, KINDS, 100.0)
    lines = panel.frame(
        "share of the first pairs together",
        range(0, 401, 100),
        range(0, 101, 20),
        lambda value: f"{value:g} %",
    )
    for of, color, dashes in ((spoken, OURS, ""), (written, WRITTEN, "5 3")):
        sums = accumulate(shares(of), initial=0.0)
        lines.append(panel.curve(enumerate(sums), color, dashes))
    known = accumulate(row[2] for row in TABLE)
    lines += [panel.dot(rank, share) for rank, share in enumerate(known, 1)]
    lines += [panel.dot(FIRST, 100 * FIRST_SHARE), panel.dot(KINDS - NEVER, 100)]
    x, y = panel.at(FIRST, 100 * FIRST_SHARE)
    lines.append(f'<path d="M{x} {float(y) + 4:g}v20" stroke="{INK}"/>')
    lines.append(text(float(x), float(y) + 36, f"{FIRST}: {FIRST_SHARE:.1%}", anchor="middle"))
    x, y = panel.at(KINDS - NEVER, 100)
    lines.append(text(float(x) + 4, float(y) + 18, f"{KINDS - NEVER}: all", anchor="middle"))
    return lines


def _legend(y: float) -> list[str]:
    lines, x = [], float(LEFT)
    for color, dashes, words in (
        (OURS, "", "200 utterances, espeak-ng"),
        (WRITTEN, "5 3", "the same, CMU dictionary"),
    ):
        extra = f' stroke-dasharray="{dashes}"' if dashes else ""
        lines.append(f'<path d="M{x} {y}h30" stroke="{color}" stroke-width="1.8"{extra}/>')
        lines.append(text(x + 38, y + 4, words))
        x += 230
    lines.append(
        f'<circle cx="{x}" cy="{y}" r="2.4" fill="#fff" stroke="{THEIRS}" stroke-width="1.2"/>'
    )
    lines.append(text(x + 12, y + 4, "published: Table 2, and the text beside Figure 2"))
    return lines
