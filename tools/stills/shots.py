"""What the HTML page shows of a character at given instants, as a browser draws it."""

from __future__ import annotations

import base64
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image
from playwright.sync_api import Browser
from tests.chromium import Opened, opened

from lipwright import pipeline
from lipwright.performance import Performance

WINDOW = {"width": 1240, "height": 1180}
GROUND = (236, 237, 239)
DRAWN = """(seconds) => {
    lipwright.seek(seconds);
    return document.getElementById("head").toDataURL("image/png").split(",")[1];
}"""
"""Read in the same breath as it is drawn: afterwards the browser may have cleared it."""


@dataclass(frozen=True, slots=True)
class Crop:
    """A part of the page's picture of a character; all in shares of its height.

    Parameters
    ----------
    view : str
        The page's view.
    top : float
        Where the part begins.
    height : float
        How high it is. It lies about the picture's middle, as broad as it is to be shown.
    """

    view: str
    top: float
    height: float


@dataclass(frozen=True, slots=True)
class Crops:
    """What is shown of a character: its face, and below it its mouth."""

    face: Crop = Crop("front", 0.24, 0.74)
    mouth: Crop = Crop("mouth", 0.26, 0.56)


HUMAN = Crops()
CRAB = Crops(Crop("front", 0.03, 0.88), Crop("mouth", 0.26, 0.58))


def pictures(
    browser: Browser,
    performance: Performance,
    instants: Sequence[float],
    crops: Crops,
    width: int,
    heights: tuple[int, int],
) -> list[tuple[Image.Image, Image.Image]]:
    """Return the face and the mouth at each instant, of the same width each."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "line.html"
        pipeline.save(performance, path)
        with opened(browser, path, viewport=WINDOW) as page:
            page.ask("lipwright.ready")
            page.ask("lipwright.setIdle(false)")
            rows = [
                [cut(each, crop, width, height) for each in seen(page, crop.view, instants)]
                for crop, height in zip((crops.face, crops.mouth), heights, strict=True)
            ]
    return list(zip(*rows, strict=True))


def seen(page: Opened, view: str, instants: Sequence[float]) -> list[Image.Image]:
    """Return the whole picture at each instant, on the common ground."""
    page.ask(f"lipwright.setView({view!r})")
    found = []
    for seconds in instants:
        data = base64.b64decode(page.page.evaluate(DRAWN, seconds))
        drawn = Image.open(io.BytesIO(data)).convert("RGBA")
        ground = Image.new("RGBA", drawn.size, GROUND)
        found.append(Image.alpha_composite(ground, drawn).convert("RGB"))
    return found


def cut(picture: Image.Image, crop: Crop, width: int, height: int) -> Image.Image:
    """Return a part of a picture at the given size; what lies beside it is ground."""
    high = crop.height * picture.height
    wide = high * width / height
    left, top = (picture.width - wide) / 2, crop.top * picture.height
    box = tuple(round(edge) for edge in (left, top, left + wide, top + high))
    ground = Image.new("RGB", (box[2] - box[0], box[3] - box[1]), GROUND)
    ground.paste(picture, (-box[0], -box[1]))
    return ground.resize((width, height), Image.Resampling.LANCZOS)
