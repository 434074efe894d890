"""A picture of coverage: first phones as rows, second phones as columns, shade by share.

SVG by our own hand, with a tooltip on every cell. The shade grows with the square root
of the share, so that rare pairs are told from those that never occur. What the set lacks
is marked.
"""

from __future__ import annotations

from pathlib import Path
from xml.sax.saxutils import escape

from lipwright.engines.bigram.coverage import Coverage, State
from lipwright.engines.bigram.model import Pair
from lipwright.files import format_number, write_atomically
from lipwright.phones import SILENCE

CELL, LEFT, TOP, RIGHT, BOTTOM = 24, 86, 118, 190, 22
SHADES = ((236, 243, 250), (86, 150, 205), (8, 38, 92))
PLAIN = 0.3
MARK, NEAR, LINE = "#c8102e", "#e69f00", "#d9dee4"
TICKS = (0.0005, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0)
STATES: dict[State, str] = {
    "drawn": "drawn",
    "stand-in": "made from single curves",
    "no curve": "a phone without any curve",
}


def write_picture(path: str | Path, of: Coverage, title: str = "") -> None:
    """Write the picture of a coverage to an SVG file."""
    write_atomically(path, picture(of, title).encode())


def picture(of: Coverage, title: str = "") -> str:
    """Return the picture of a coverage as SVG.

    Parameters
    ----------
    of : Coverage
    title : str
        Stands above it.
    """
    classes = [label for label in of.classes if of.silence or label != SILENCE]
    side = len(classes) * CELL
    width, height = LEFT + side + RIGHT, TOP + max(side, 300) + BOTTOM
    body = [
        f'<rect width="{width}" height="{height}" fill="#fff"/>',
        _text(LEFT, 28, title, size=16, weight="600"),
        _text(LEFT, 50, _subtitle(of), fill="#555"),
        *_axes(classes, side),
        *_cells(of, classes),
        *_legend(of, LEFT + side + 28),
    ]
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" font-family="Helvetica, Arial, sans-serif" font-size="13" role="img">'
    )
    return "\n".join((head, f"<title>{escape(title)}</title>", *body, "</svg>\n"))


def _subtitle(of: Coverage) -> str:
    scope = "within words" if of.within_words else "across words"
    silence = "with silence" if of.silence else "silence left out"
    if not of.lines:
        return f"{len(of.needed)} pairs, {silence}"
    amount = f"{of.total:,.0f} s" if of.by == "time" else f"{of.total:,.0f} pairs"
    return f"{amount}, {len(of.needed)} of {len(of.possible)} kinds; {scope}, {silence}"


def _axes(classes: list[str], side: int) -> list[str]:
    middle = side / 2
    lines = [
        _text(LEFT + middle, TOP - 38, "second phone", anchor="middle", fill="#555"),
        f'<g transform="translate({LEFT - 56} {format_number(TOP + middle)}) rotate(-90)">'
        + _text(0, 0, "first phone", anchor="middle", fill="#555")
        + "</g>",
    ]
    for index, label in enumerate(classes):
        place = (index + 0.5) * CELL
        lines.append(_text(LEFT - 8, TOP + place + 4.5, label, anchor="end"))
        x, y = format_number(LEFT + place + 4), TOP - 8
        lines.append(f'<g transform="translate({x} {y}) rotate(-60)">{_text(0, 0, label)}</g>')
    return lines


def _cells(of: Coverage, classes: list[str]) -> list[str]:
    total, most = of.total, max(of.needed.values(), default=0.0)
    even = min(of.needed.values(), default=0.0) == most
    found = []
    for row, first in enumerate(classes):
        for column, second in enumerate(classes):
            x, y, pair = LEFT + column * CELL, TOP + row * CELL, (first, second)
            amount = of.needed.get(pair, 0)
            depth = PLAIN if even else (amount / most) ** 0.5
            fill = shade(depth) if amount else "#fff"
            name = escape(_tooltip(of, pair, amount, total))
            found.append(
                f'<g class="cell"><title>{name}</title><rect x="{x}" y="{y}" width="{CELL}" '
                f'height="{CELL}" fill="{fill}" stroke="{LINE}"/>{_marks(of, pair, x, y)}</g>'
            )
    return found


def _tooltip(of: Coverage, pair: Pair, amount: float, total: float) -> str:
    name = "-".join(pair)
    if pair == (SILENCE, SILENCE):
        return f"{name}: no pair"
    if not amount:
        return f"{name}: never; {STATES[of.state(pair)]}"
    counted = f"{amount:.2f} s" if of.by == "time" else f"{amount:,}"
    word = f", as in {of.words[pair]}" if pair in of.words else ""
    return f"{name}{word}: {counted}, {amount / total:.2%}; {STATES[of.state(pair)]}"


def _marks(of: Coverage, pair: Pair, x: float, y: float) -> str:
    if pair == (SILENCE, SILENCE):
        return f'<path d="M{x} {y + CELL}l{CELL} -{CELL}" stroke="{LINE}"/>'
    amount, state = of.needed.get(pair, 0), of.state(pair)
    marks = ""
    if amount and of.nearest.get(pair, 0) >= 0.5 * amount:
        marks += _near(x, y)
    if state != "drawn":
        marks += _missing(state, x, y, needed=bool(amount))
    return marks


def _near(x: float, y: float) -> str:
    return f'<path d="M{x + CELL - 9} {y}h9v9z" fill="{NEAR}"/>'


def _missing(state: State, x: float, y: float, *, needed: bool) -> str:
    cx, cy = x + CELL / 2, y + CELL / 2
    if not needed:
        return f'<circle cx="{format_number(cx)}" cy="{format_number(cy)}" r="1.6" fill="{MARK}"/>'
    if state == "stand-in":
        return "".join(
            f'<circle cx="{format_number(cx)}" cy="{format_number(cy)}" r="5.5" fill="none" '
            f'stroke="{color}" stroke-width="{width}"/>'
            for color, width in (("#fff", 5), (MARK, 2.5))
        )
    cross = f"M{cx - 5} {cy - 5}l10 10m0 -10l-10 10"
    return "".join(
        f'<path d="{cross}" fill="none" stroke="{color}" stroke-width="{width}"/>'
        for color, width in (("#fff", 5.5), (MARK, 3))
    )


def _legend(of: Coverage, x: float) -> list[str]:
    rows: list[tuple[str, str]] = []
    lines: list[str] = []
    y = float(TOP)
    if of.needed and min(of.needed.values()) != max(of.needed.values()):
        lines, y = _bar(max(of.needed.values()) / of.total, x, y)
    if of.undrawn:
        drawn = f'<rect x="{x}" y="0" width="{CELL}" height="{CELL}" fill="{shade(PLAIN)}"/>'
        rows = [
            (drawn, "drawn in the set"),
            (_missing("stand-in", x, 0, needed=True), "from single curves"),
            (_missing("no curve", x, 0, needed=True), "no curve at all"),
            (_missing("stand-in", x, 0, needed=False), "lacking, not needed"),
        ]
    if any(of.nearest.values()):
        rows.append((_near(x, 0), "nearest class only"))
    frame = f'<rect x="{x}" y="0" width="{CELL}" height="{CELL}" fill="none" stroke="{LINE}"/>'
    for mark, text in rows:
        label = _text(x + CELL + 10, CELL / 2 + 4.5, text)
        lines.append(f'<g transform="translate(0 {format_number(y)})">{frame}{mark}{label}</g>')
        y += CELL + 10
    return lines


def _bar(most: float, x: float, y: float) -> tuple[list[str], float]:
    """Draw what each shade means; return it and where the next thing may stand."""
    steps, length = 40, 150.0
    lines = [_text(x, y + 4, "share of pairs", fill="#555")]
    y += 16
    for step in range(steps):
        depth, top = 1 - (step + 0.5) / steps, y + step * length / steps
        lines.append(
            f'<rect x="{x}" y="{format_number(top)}" width="{CELL}" '
            f'height="{format_number(length / steps + 0.4)}" fill="{shade(depth)}"/>'
        )
    for share in _ticks(most):
        place = y + length * (1 - (share / most) ** 0.5)
        lines.append(
            f'<path d="M{x + CELL} {format_number(place)}h5" stroke="#555"/>'
            + _text(x + CELL + 10, place + 4.5, f"{format_number(100 * share, 2)} %")
        )
    y += length
    lines.append(
        f'<rect x="{x}" y="{format_number(y + 12)}" width="{CELL}" height="{CELL}" fill="#fff" '
        f'stroke="{LINE}"/>' + _text(x + CELL + 10, y + 12 + CELL / 2 + 4.5, "never")
    )
    return lines, y + 12 + CELL + 10


def _ticks(most: float) -> list[float]:
    """Return round shares up to the greatest, far enough apart to be read."""
    chosen: list[float] = []
    for share in (most, *reversed([tick for tick in TICKS if tick < most])):
        if not chosen or (chosen[-1] / most) ** 0.5 - (share / most) ** 0.5 > 0.1:
            chosen.append(share)
    return chosen


def shade(depth: float) -> str:
    """Return the colour of 0..1, from light to dark."""
    place = min(max(depth, 0.0), 1.0) * (len(SHADES) - 1)
    low = min(int(place), len(SHADES) - 2)
    mixed = [a + (b - a) * (place - low) for a, b in zip(SHADES[low], SHADES[low + 1], strict=True)]
    return "#" + "".join(f"{round(part):02x}" for part in mixed)


def _text(
    x: float,
    y: float,
    text: str,
    *,
    anchor: str = "start",
    fill: str = "#111",
    size: int = 13,
    weight: str = "400",
) -> str:
    place = f'x="{format_number(x)}" y="{format_number(y)}"'
    extra = "" if size == 13 else f' font-size="{size}"'
    extra += "" if weight == "400" else f' font-weight="{weight}"'
    extra += "" if anchor == "start" else f' text-anchor="{anchor}"'
    return f'<text {place}{extra} fill="{fill}">{escape(text)}</text>'
