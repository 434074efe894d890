"""The page's pictures: Figure 3 for a stretch of speech, and the curve of hidden units.

SVG by our own hand, for light and dark.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from xml.sax.saxutils import escape

import numpy as np
from numpy.typing import NDArray

from lipwright.engines.neural.five import FIVE
from lipwright.sound import Sound
from lipwright.timeline import Tier

Floats = NDArray[np.float64]

WIDTH, LEFT, RIGHT = 900, 62, 16
WAVE, CURVE, GAP, TOP, BELOW = 84, 62, 12, 46, 48
SHOWN = ("a", "i", "o/u", "b/m/p", "open")
STYLE = """
text{fill:#1a1d21;font:12px sans-serif}.big{font-size:15px;font-weight:600}.soft{fill:#5c6670}
.back{fill:#fff}.bed{fill:#f3f5f7}.wave{stroke:#5c6670;stroke-width:1}.line{stroke:#d5dbe1}
.net,.one{fill:none;stroke:#1f66ad;stroke-width:1.8}.face{fill:#d9730d;fill-opacity:.22}
.two{fill:none;stroke:#d9730d;stroke-width:1.8}.plain{stroke-dasharray:6 4}
@media (prefers-color-scheme:dark){text{fill:#e4e7ea}.soft{fill:#9aa5b0}.back{fill:#15181c}
.bed{fill:#1e2329}.wave{stroke:#9aa5b0}.line{stroke:#363d46}.net,.one{stroke:#6db1f2}
.face{fill:#f5a046}.two{stroke:#f5a046}}
"""


def figure_3(sound: Sound, words: Tier, times: Floats, given: Floats, wanted: Floats) -> str:
    """Return a picture of sound, text and the five curves, as the publication's Figure 3.

    Parameters
    ----------
    sound : Sound
    words : Tier
    times : (T,) float64
        Seconds of the frames, on the sound's clock.
    given, wanted : (T, 5) float64
        Of the net, and of the face.
    """
    scale = (WIDTH - LEFT - RIGHT) / sound.duration
    height = TOP + WAVE + BELOW + len(SHOWN) * (CURVE + GAP) + 30
    parts = [_text(LEFT, 24, "Unseen speech: the net (line) and the face (area)", "big")]
    parts += _wave(sound, scale)
    for number, word in enumerate(words):
        x, y = LEFT + word.middle * scale, TOP + WAVE + (16 if number % 2 else 32)
        parts.append(_text(x, y, word.label, "", "middle"))
        for edge in (word.start, word.end):
            parts.append(_line(LEFT + edge * scale, TOP, TOP + WAVE + 20))
    for row, name in enumerate(SHOWN):
        top, column = TOP + WAVE + BELOW + row * (CURVE + GAP), FIVE.index(name)
        parts.append(
            f'<rect class="bed" x="{LEFT}" y="{top}" {_size(WIDTH - LEFT - RIGHT, CURVE)}/>'
        )
        parts.append(_text(LEFT - 10, top + CURVE / 2 + 4, f"/{name}/", "", "end"))
        xs = LEFT + times * scale
        area = _points(xs, top + CURVE * (1.0 - wanted[:, column]))
        foot = f"{xs[-1]:.1f},{top + CURVE} {xs[0]:.1f},{top + CURVE}"
        parts.append(f'<polygon class="face" points="{area} {foot}"/>')
        line = _points(xs, top + CURVE * (1.0 - given[:, column]))
        parts.append(f'<polyline class="net" points="{line}"/>')
    for second in range(int(sound.duration) + 1):
        parts.append(_text(LEFT + second * scale, height - 12, f"{second} s", "soft", "middle"))
    return _page(height, "Sound, text and the five outputs over time", parts)


def _wave(sound: Sound, scale: float) -> list[str]:
    """Return the sound's outline, a stroke for each pixel."""
    count = int(sound.duration * scale)
    edges = np.linspace(0, len(sound.samples), count + 1).astype(int)
    peak = float(np.abs(sound.samples).max()) or 1.0
    middle = TOP + WAVE / 2
    strokes = []
    for x in range(count):
        piece = sound.samples[edges[x] : edges[x + 1]]
        if len(piece):
            high, low = (middle - WAVE / 2 * float(v) / peak for v in (piece.max(), piece.min()))
            strokes.append(f"M{LEFT + x} {high:.1f}V{max(low, high + 0.6):.1f}")
    return [f'<path class="wave" d="{"".join(strokes)}"/>']


KINDS = ("one", "two", "one plain", "two plain")


def hidden_units(curves: Mapping[str, Mapping[int, float]]) -> str:
    """Return a picture of the error by the number of hidden units, up to four lines.

    Parameters
    ----------
    curves : mapping of str to mapping of int to float
        By its name, the error of each number of units.
    """
    top, tall, height = 74, 230, 364
    counts = sorted({count for curve in curves.values() for count in curve})
    values = [value for curve in curves.values() for value in curve.values()]
    low, high = 0.95 * min(values), 1.02 * max(values)
    step = (WIDTH - LEFT - 90) / max(len(counts) - 1, 1)
    parts = [_text(LEFT, 24, "Error on two unseen minutes, by hidden units", "big")]
    for mark in np.linspace(low, high, 5):
        y = top + tall * (1 - (mark - low) / (high - low))
        parts.append(f'<path class="line" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>')
        parts.append(_text(LEFT - 8, y + 4, f"{mark:.3f}", "soft", "end"))
    for place, count in enumerate(counts):
        parts.append(_text(LEFT + 30 + place * step, top + tall + 22, str(count), "", "middle"))
    parts.append(_text(LEFT, top + tall + 46, "hidden units; root mean square error", "soft"))
    for place, (kind, (name, curve)) in enumerate(zip(KINDS, curves.items(), strict=False)):
        xs = np.array([LEFT + 30 + counts.index(count) * step for count in curve])
        ys = np.array([top + tall * (1 - (v - low) / (high - low)) for v in curve.values()])
        parts.append(f'<polyline class="{kind}" points="{_points(xs, ys)}"/>')
        at = LEFT + place * 205
        parts.append(f'<path class="{kind}" d="M{at} 50h26"/>')
        parts.append(_text(at + 32, 54, name, ""))
    return _page(height, "Error by the number of hidden units", parts)


def _page(height: float, title: str, parts: Sequence[str]) -> str:
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height:g}" role="img">',
            f"<title>{escape(title)}</title><style>{STYLE}</style>",
            f'<rect class="back" {_size(WIDTH, height)}/>',
            *parts,
            "</svg>\n",
        ]
    )


def _text(x: float, y: float, text: str, kind: str, anchor: str = "start") -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" class="{kind}" text-anchor="{anchor}">{escape(text)}</text>'
    )


def _line(x: float, top: float, bottom: float) -> str:
    return f'<path class="line" d="M{x:.1f} {top:g}V{bottom:g}"/>'


def _size(width: float, height: float) -> str:
    return f'width="{width:g}" height="{height:g}"'


def _points(xs: Floats, ys: Floats) -> str:
    return " ".join(f"{x:.1f},{y:.1f}" for x, y in zip(xs, ys, strict=True))
