"""Pictures of mouth shapes: the artist's own files, else mouths drawn by code as SVG.

A drawn mouth follows from where its shape lies among the nine canonical poses: lips, teeth
and tongue as a cartoon shows them, larger than life. What other controls do is not drawn.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from lipwright.character.pictures.picture_file import DATA, MEDIA, PictureCharacter, Point
from lipwright.files import read_bytes
from lipwright.performance import Picture

LIPS, LINE, INSIDE, TEETH, TONGUE = "#d9726b", "#6b2430", "#581722", "#fffdf6", "#e98a8b"


def pictures_of(of: PictureCharacter) -> dict[str, Picture]:
    """Return the picture of each drawn shape.

    Raises
    ------
    InputError
        If a picture's file cannot be read.
    """
    folder = DATA if not Path(of.where).suffix else Path(of.where).parent
    found = {}
    for shape in of.shapes:
        if shape.label not in of.drawn:
            continue
        if shape.picture:
            media = MEDIA[Path(shape.picture).suffix.lower()]
            found[shape.label] = Picture(media, read_bytes(folder / shape.picture))
        else:
            drawn = draw_mouth(shape.at[0]).encode()
            found[shape.label] = Picture("image/svg+xml", drawn, drawn_by_code=True)
    return found


@dataclass(frozen=True, slots=True)
class _Mouth:
    """The measures of a mouth, in units of a picture that is 240 wide and 180 high."""

    half: float
    """From the middle to a corner of the opening."""
    up: float
    down: float
    """From the corners' height to the upper and the lower lip's inner edge."""
    upper: float
    lower: float
    """How thick the lips are."""
    smile: float
    """How much higher the corners are than the middle."""

    @classmethod
    def of(cls, at: Point) -> _Mouth:
        opened, rounded, wide = (max(at.get(name, 0.0), 0.0) for name in ("open", "W", "wide"))
        pressed, teeth, forward = (max(at.get(name, 0.0), 0.0) for name in ("PBM", "FV", "ShCh"))
        gap = 150 * opened**1.1 + 14 * rounded**2 + 9 * forward
        gap = max(gap * (1 - pressed), 16 * teeth)
        return cls(
            half=max(68 + 34 * wide - 62 * rounded - 14 * forward - 12 * opened - 4 * pressed, 14),
            up=0.36 * gap + 3 * teeth,
            down=0.64 * gap - 5 * teeth,
            upper=(11 + 5 * rounded + 3 * forward) * (1 - 0.4 * pressed),
            lower=(14 + 5 * rounded + 4 * forward) * (1 - 0.4 * pressed) * (1 - 0.25 * teeth),
            smile=max(0.0, 9 - 12 * opened - 16 * rounded - 9 * pressed - 9 * teeth),
        )


def draw_mouth(at: Point) -> str:
    """Return a mouth as an SVG document.

    Parameters
    ----------
    at : dict of str to float
        Weights of the canonical poses.
    """
    mouth = _Mouth.of(at)
    inner = _opening(mouth)
    parts = [_lips(mouth, inner)]
    if mouth.up + mouth.down > 4:
        parts.append(f'<path d="{inner}" fill="{INSIDE}"/>')
        biting = at.get("FV", 0) > 0.5
        behind = "" if biting else _teeth(mouth, at) + _tongue(mouth, at)
        parts.append(f'<g clip-path="url(#in)">{behind}</g>{_edge(inner)}')
        parts.append(_biting(mouth) if biting else "")
    else:
        parts.append(_closed(mouth))
    return (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-120 -76 240 180">'
        f'<defs><clipPath id="in"><path d="{inner}"/></clipPath></defs>' + "".join(parts) + "</svg>"
    )


def _opening(m: _Mouth) -> str:
    """The inner edge of the lips, from the left corner over the upper lip and back."""
    near = (0.62 if m.half > 40 else 0.85) * m.half
    return (
        f"M{-m.half:.1f} {-m.smile:.1f}"
        f"C{-near:.1f} {-1.25 * m.up:.1f} {near:.1f} {-1.25 * m.up:.1f} {m.half:.1f} {-m.smile:.1f}"
        f"C{near:.1f} {1.3 * m.down + 2:.1f} {-near:.1f} {1.3 * m.down + 2:.1f}"
        f" {-m.half:.1f} {-m.smile:.1f}Z"
    )


def _lips(m: _Mouth, inner: str) -> str:
    """Both lips in one shape, with a bow above; the opening is laid over it."""
    narrow = max(0.0, 1 - m.half / 50)
    side, top = m.half + (0.55 + 0.35 * narrow) * m.lower, -0.94 * m.up - m.upper
    bottom = 0.98 * m.down + 2 + m.lower
    bow, belly = min(0.28 * m.half, 16), 0.74 + 0.12 * narrow
    edge = (
        f"M{-side:.1f} {-m.smile:.1f}"
        f"C{-0.75 * side:.1f} {top * 0.75:.1f} {-1.9 * bow:.1f} {top - 3:.1f} {-bow:.1f} {top:.1f}"
        f"Q0 {top + 5:.1f} {bow:.1f} {top:.1f}"
        f"C{1.9 * bow:.1f} {top - 3:.1f} {0.75 * side:.1f} {top * 0.75:.1f} "
        f"{side:.1f} {-m.smile:.1f}"
        f"C{belly * side:.1f} {bottom * 1.04:.1f} {0.36 * side:.1f} {bottom:.1f} 0 {bottom:.1f}"
        f"C{-0.36 * side:.1f} {bottom:.1f} {-belly * side:.1f} {bottom * 1.04:.1f} "
        f"{-side:.1f} {-m.smile:.1f}Z"
    )
    light = bottom - 0.45 * m.lower
    shine = (
        f'<path d="M{-0.3 * side:.1f} {light:.1f}Q0 {light + 4:.1f} {0.3 * side:.1f} {light:.1f}" '
        'fill="none" stroke="#fff" stroke-opacity=".35" stroke-width="3.5" stroke-linecap="round"/>'
    )
    stroke = f'stroke="{LINE}" stroke-width="3" stroke-linejoin="round"'
    return f'<path d="{edge}" fill="{LIPS}" {stroke}/>{shine}'


def _edge(inner: str) -> str:
    return f'<path d="{inner}" fill="none" stroke="{LINE}" stroke-width="2.6"/>'


def _closed(m: _Mouth) -> str:
    """The line where closed lips meet."""
    side = m.half + 4
    return (
        f'<path d="M{-side:.1f} {-m.smile - 1:.1f}Q{-0.5 * side:.1f} {0.4 * m.smile + 1:.1f} 0 1'
        f'Q{0.5 * side:.1f} {0.4 * m.smile + 1:.1f} {side:.1f} {-m.smile - 1:.1f}" fill="none" '
        f'stroke="{LINE}" stroke-width="3.4" stroke-linecap="round"/>'
    )


def _teeth(m: _Mouth, at: Point) -> str:
    """Upper teeth always; lower ones where the jaw is nearly shut; none behind round lips."""
    rounded = at.get("W", 0) - 0.3 * at.get("ShCh", 0)
    if rounded > 0.55:
        return ""
    gap, top = m.up + m.down, -0.98 * m.up - 3
    tongue = max(at.get("tTeeth", 0), at.get("tBack", 0))
    if at.get("open", 0) < 0.27 and rounded < 0.3 and tongue < 0.4:
        return _row(top, 0.58 * gap + 3, m) + _row(top + 0.58 * gap + 3, 0.5 * gap + 6, m)
    share = 0.34 if rounded < 0.4 else 0.14
    return _row(top, min(share * gap + 5, 21) + 3, m)


def _row(top: float, height: float, m: _Mouth) -> str:
    half = m.half + 4
    corner = min(6.0, 0.4 * height)
    return (
        f'<rect x="{-half:.1f}" y="{top:.1f}" width="{2 * half:.1f}" height="{height:.1f}" '
        f'rx="{corner:.1f}" fill="{TEETH}" stroke="{LINE}" stroke-opacity=".55" '
        'stroke-width="1.6"/>'
    )


def _tongue(m: _Mouth, at: Point) -> str:
    gap, bottom = m.up + m.down, m.down + 3
    if at.get("tTeeth", 0) > 0.4:  # the tip between the teeth
        return _blob(0.5 * m.half, bottom - 0.62 * gap, bottom)
    if at.get("tRoof", 0) > 0.4 and at.get("open", 0) > 0.15:  # the tip behind the upper teeth
        return _blob(0.42 * m.half, -0.98 * m.up + min(0.2 * gap + 4, 14), bottom)
    if at.get("tBack", 0) > 0.4:  # its back raised
        return _blob(0.7 * m.half, bottom - 0.6 * gap, bottom)
    if at.get("open", 0) < 0.27 or at.get("W", 0) > 0.6:
        return ""
    return _blob(0.66 * m.half, bottom - 0.34 * gap, bottom)


def _blob(half: float, top: float, bottom: float) -> str:
    return (
        f'<path d="M{-half:.1f} {bottom + 8:.1f}C{-half:.1f} {top:.1f} {-0.6 * half:.1f} {top:.1f} '
        f"0 {top + 1.5:.1f}C{0.6 * half:.1f} {top:.1f} {half:.1f} {top:.1f} {half:.1f} "
        f'{bottom + 8:.1f}Z" fill="{TONGUE}" stroke="{LINE}" stroke-width="1.8"/>'
    )


def _biting(m: _Mouth) -> str:
    """Upper teeth over the lower lip."""
    half, top = 0.66 * m.half, -0.72 * m.up
    height = m.down + 0.72 * m.up + 6
    middle = f'<path d="M0 {top:.1f}v{height - 1:.1f}" stroke="{LINE}" stroke-opacity=".35"/>'
    return (
        f'<rect x="{-half:.1f}" y="{top:.1f}" width="{2 * half:.1f}" height="{height:.1f}" rx="5" '
        f'fill="{TEETH}" stroke="{LINE}" stroke-width="2"/>{middle}'
    )
