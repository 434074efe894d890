"""A picture of what a database holds: units per phone, pairs of phones, variance.

SVG by our own hand, for light and dark. One list of phones serves both as the bars'
and as the rows of the matrix; what the face shows alike stands together (the Common
Phoneme Set's classes, by what makes them: vowels, lips, tongue). Bars are linear, so
that lengths compare; the shade of a pair grows with the logarithm of its count, so that
pairs that occur once are told from those that never do.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from xml.sax.saxutils import escape

from lipwright.engines.motion.database import Database
from lipwright.engines.motion.info import THIN, Info, info, lacking, pair_counts
from lipwright.errors import LabelError
from lipwright.files import format_number, write_atomically
from lipwright.phones import SILENCE, load_reduction

GROUPS: dict[str, tuple[str, ...]] = {
    "vowels": ("ih", "eh", "ah", "er", "aa", "ay", "aw", "ao", "oy", "ow"),
    "lips": ("w", "f", "bmp"),
    "tongue": ("th", "l", "r", "d", "z", "sh", "kg", "h"),
    "others": (),
    "silence": (SILENCE,),
}
"""Classes of the Common Phoneme Set in the order of the picture."""
CELL, GAP = 18, 9
EDGE, NAMES, COUNTS, BARS, LABEL = 26, 18, 52, 220, 44
LEFT = EDGE + NAMES + COUNTS + BARS + LABEL
TOP, CHART, BETWEEN = 138, 140, 74
LEAST_SHADE, DEEPEST, WIDEST, CLOSEST = 0.2, 10, 36, 44
LONGEST = 60
TICKS = (1, 3, 10, 30, 100, 300, 1000, 3000, 10_000, 30_000, 100_000)
STYLE = """
text{fill:#1a1d21;font-size:12px}.big{font-size:19px;font-weight:600}.head{font-weight:600}
.label{font-size:11.5px}.soft{fill:#5c6670}.back{fill:#fff}.bed{fill:#f3f5f7}.bar,.pair{fill:#1f66ad}
.thin{fill:#d9730d}.none{fill:none;stroke:#c8102e;stroke-width:1.5}.line{stroke:#d5dbe1}
.said{paint-order:stroke;stroke:#fff;stroke-width:4px}.sum{fill:none;stroke:#1a1d21;stroke-width:1.5}.dot{fill:#1a1d21}.pair:hover{stroke:#1a1d21}
@media (prefers-color-scheme:dark){text{fill:#e4e7ea}.soft{fill:#9aa5b0}.back{fill:#15181c}
.bed{fill:#1e2329}.bar,.pair{fill:#6db1f2}.thin{fill:#f5a046}.none{stroke:#ff6b6b}
.line{stroke:#363d46}.sum{stroke:#e4e7ea}.dot{fill:#e4e7ea}
.said{stroke:#15181c}.pair:hover{stroke:#fff}}
"""


@dataclass(frozen=True, slots=True)
class _Rows:
    """The phones in order, with the place of each, and the groups with their extent."""

    places: dict[str, int]
    groups: list[tuple[str, int, int]]

    @property
    def side(self) -> int:
        """How long all of them are."""
        return self.groups[-1][2]


def write_picture(path: str | Path, of: Database, title: str = "") -> None:
    """Write the picture of a database to an SVG file.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    write_atomically(path, picture(of, title).encode())


def picture(of: Database, title: str = "") -> str:
    """Return the picture of a database as SVG.

    Parameters
    ----------
    of : Database
    title : str
        The database's name, which stands above.
    """
    told, rows = info(of), _rows(of)
    width = LEFT + rows.side + EDGE
    height = TOP + rows.side + BETWEEN + CHART + 56
    named = _title(told, title)
    document = f"<title>{escape(named)}</title><style>{STYLE}</style>"
    body = [
        f'<rect class="back" width="{width}" height="{height}"/>',
        _text(EDGE, 40, named, "big"),
        _text(EDGE, 64, _subtitle(told), "soft"),
        *_bars(told, rows),
        *_matrix(of, rows),
        *_legend(of, rows),
        *_variance(told.variance, TOP + rows.side + BETWEEN, rows.side),
    ]
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}" font-family="Helvetica, Arial, sans-serif" role="img">'
    )
    return "\n".join((head, document, *body, "</svg>\n"))


def _title(told: Info, title: str) -> str:
    if len(title) > LONGEST:
        title = f"…{title[1 - LONGEST :]}"
    takes = f"{told.takes:,} take{'' if told.takes == 1 else 's'}"
    return f"{title}{': ' if title else ''}{takes}, {told.minutes:.1f} minutes"


def _subtitle(told: Info) -> str:
    merged = f" in {told.nodes:,} nodes" if told.nodes != told.units else ""
    pairs, threes = told.bigrams, told.trigrams
    return (
        f"{told.units:,} units{merged} of {len(told.units_per_phone)} phones; "
        f"{pairs.different:,} of {pairs.possible:,} pairs ({pairs.once:,} only once), "
        f"{threes.different:,} of {threes.possible:,} threes"
    )


def _rows(of: Database) -> _Rows:
    """Put the phones in order, those that are lacking among them."""
    groups: dict[str, list[tuple[int, str]]] = {name: [] for name in GROUPS}
    for label in (*of.labels, *lacking(of)):
        name, rank = _group(label, of.phone_set)
        groups[name].append((rank, label))
    places, extents, place = dict[str, int](), list[tuple[str, int, int]](), 0
    for name, members in groups.items():
        if not members:
            continue
        start = place = place + GAP if extents else place
        for _, label in sorted(members):
            places[label] = place
            place += CELL
        extents.append((name, start, place))
    return _Rows(places, extents)


def _group(label: str, phone_set: str) -> tuple[str, int]:
    """Return the group of a phone, and its rank there."""
    try:
        pieces, _ = load_reduction(phone_set, "common").of(label)
    except LabelError:
        return "others", 0
    found = next(name for name, classes in GROUPS.items() if pieces[0].label in classes)
    return found, GROUPS[found].index(pieces[0].label)


def _bars(told: Info, rows: _Rows) -> Iterator[str]:
    base = LEFT - LABEL
    yield _text(base, TOP - 34, "units per phone", "head", anchor="end")
    for name, start, end in rows.groups:
        if end - start > 3 * CELL:
            x, y = EDGE + 8, TOP + (start + end) // 2
            turned = _text(0, 0, name, "soft", anchor="middle")
            yield f'<g transform="translate({x} {y}) rotate(-90)">{turned}</g>'
    most = max(told.units_per_phone.values())
    for label, place in rows.places.items():
        yield _bar(label, told.units_per_phone.get(label, 0), most, TOP + place)


def _bar(label: str, count: int, most: int, y: int) -> str:
    base, long = LEFT - LABEL, max(BARS * count / most, 1.0)
    kind = "thin" if count < THIN else "bar"
    units = f"{count:,} unit{'' if count == 1 else 's'}" if count else "no unit"
    drawn = (
        f'<rect class="{kind}" x="{format_number(base - long, 1)}" y="{y + 2}" '
        f'width="{format_number(long, 1)}" height="{CELL - 4}" rx="1.5"/>'
        if count
        else _none(base - 12, y + CELL / 2)
    )
    x = base - (long if count else 18) - 5
    return (
        f'<g class="phone"><title>{escape(label)}: {units}</title>{drawn}'
        + _text(x, y + CELL / 2 + 4, f"{count:,}", "soft", anchor="end")
        + _text(LEFT - LABEL / 2, y + CELL / 2 + 4, label, "label", anchor="middle")
        + "</g>"
    )


def _none(x: float, y: float) -> str:
    return f'<path class="none" d="M{format_number(x - 4)} {format_number(y - 4)}l8 8m0-8l-8 8"/>'


def _matrix(of: Database, rows: _Rows) -> Iterator[str]:
    yield _text(LEFT, TOP - 34, "pairs: the first phone at the left, the second above", "head")
    for _, top, bottom in rows.groups:
        for _, left, right in rows.groups:
            yield (
                f'<rect class="bed" x="{LEFT + left}" y="{TOP + top}" '
                f'width="{right - left}" height="{bottom - top}"/>'
            )
    for label, place in rows.places.items():
        for y in (TOP - 7, TOP + rows.side + 15):
            yield _text(LEFT + place + CELL / 2, y, label, "label", anchor="middle")
    counts = pair_counts(of)
    most = int(counts.max())
    for first, second in zip(*counts.nonzero(), strict=True):
        one, other = of.labels[first], of.labels[second]
        count = int(counts[first, second])
        yield (
            f'<rect class="pair" x="{LEFT + rows.places[other] + 1}" '
            f'y="{TOP + rows.places[one] + 1}" width="{CELL - 2}" height="{CELL - 2}" '
            f'fill-opacity="{format_number(shade(count, most), 2)}">'
            f"<title>{escape(one)}-{escape(other)}: {count:,}</title></rect>"
        )


def shade(count: int, most: int) -> float:
    """Return how strong a pair is drawn, 0..1: by the logarithm of its count."""
    return LEAST_SHADE + (1 - LEAST_SHADE) * math.log(count) / math.log(max(most, DEEPEST))


def _legend(of: Database, rows: _Rows) -> Iterator[str]:
    """Say what the marks mean, below the bars."""
    x, y = EDGE, TOP + rows.side + BETWEEN
    mark = '<rect class="{}" x="{}" y="{}" width="14" height="14"{}/>'
    yield _text(x, y - 16, "marks", "head")
    yield mark.format("thin", x, y, "") + _text(x + 24, y + 11, f"thin: fewer than {THIN} units")
    yield _none(x + 7, y + 31) + _text(x + 24, y + 35, "no unit: the nearest phone stands in")
    yield _text(x, y + 64, "how often a pair occurs", "soft")
    most = int(pair_counts(of).max())
    for count in (*(tick for tick in TICKS if tick < 0.7 * most), most):
        wide = 32 + 7 * len(f"{count:,}")
        if x + wide > LEFT - LABEL:
            x, y = EDGE, y + 22
        depth = f' fill-opacity="{format_number(shade(max(count, 1), most), 2)}"'
        yield mark.format("bed", x, y + 74, "") + mark.format("pair", x, y + 74, depth)
        yield _text(x + 18, y + 86, f"{count:,}")
        x += wide


def _variance(shares: tuple[float, ...], top: float, side: float) -> Iterator[str]:
    """Draw each component's share of the variance as a bar, their sum as a line."""
    yield _text(LEFT, top - 16, "variance of the components, and its sum", "head")
    for percent in (0, 50, 100):
        y = top + 10 + CHART * (1 - percent / 100)
        yield f'<path class="line" d="M{LEFT} {format_number(y)}h{side}"/>'
        yield _text(LEFT - 8, y + 4, f"{percent} %", "soft", anchor="end")
    slot = side / max(len(shares), 1)
    step, wide = math.ceil(CLOSEST / slot), min(WIDEST, 0.7 * slot)
    total, points, said = 0.0, list[str](), list[str]()
    for number, share in enumerate(shares, start=1):
        total += share
        x, high = LEFT + (number - 0.5) * slot, CHART * share
        y = top + 10 + CHART * (1 - total)
        points.append(f"{format_number(x, 1)},{format_number(y, 1)}")
        yield (
            f'<rect class="bar" x="{format_number(x - wide / 2, 1)}" '
            f'y="{format_number(top + 10 + CHART - high, 1)}" width="{format_number(wide, 1)}" '
            f'height="{format_number(high, 1)}"><title>{number}: {share:.1%}</title></rect>'
        )
        last = number == len(shares)
        if last or (number % step == 1 % step and len(shares) - number >= step):
            said.append(_text(x, y - 9, f"{100 * total:.1f}", "said", anchor="middle"))
            said.append(_text(x, top + CHART + 26, f"{number}", "soft", anchor="middle"))
    yield f'<polyline class="sum" points="{" ".join(points)}"/>'
    for point in points:
        across, down = point.split(",")
        yield f'<circle class="dot" cx="{across}" cy="{down}" r="2.5"/>'
    yield from said


def _text(x: float, y: float, text: str, kind: str = "", *, anchor: str = "start") -> str:
    place = f'x="{format_number(x, 1)}" y="{format_number(y, 1)}"'
    extra = f' class="{kind}"' if kind else ""
    extra += "" if anchor == "start" else f' text-anchor="{anchor}"'
    return f"<text {place}{extra}>{escape(text)}</text>"
