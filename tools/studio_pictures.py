"""Pictures of the studio for ``docs/``: ``python -m tools.studio_pictures [NAME…]``.

A fixed line on the English set, in Chromium, each view as an animator comes to it. What is
seen depends on the machine's fonts; nothing else does. The studio's files lie in a folder
that is thrown away.
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Callable
from contextlib import chdir
from io import BytesIO
from pathlib import Path

from PIL import Image
from playwright.sync_api import Browser
from tests.chromium import chromium
from tests.studio.live import live
from tests.studio.tab import Tab, tab

from lipwright.engines.bigram import load_set
from lipwright.engines.bigram.edits import Edit
from lipwright.engines.bigram.set_text import set_bytes
from lipwright.studio.changes import DrawCurve, PutEdit
from lipwright.studio.opening import Given
from lipwright.studio.running import open_session
from lipwright.studio.session import Session

PICTURES = Path(__file__).parents[1] / "docs" / "pictures"
LINE = "Papa said the fat cat is low on the mat."
LOW = ((0.0, 0.0), (0.3, 0.35), (0.55, 0.95), (1.0, 0.0))
STAGES = ("placed", "stitched", "smoothed", "constrained", "limited")


def seek_word(page: Tab, session: Session, word: str, share: float = 0.6) -> float:
    """Go to a place in a word; return the time."""
    found = next(row for row in session.state.lines["1"].words if row[0] == word)
    time = found[1] + share * (found[2] - found[1])
    page.ask(f"studio.seek({time})")
    page.settle()
    return time


def whole(page: Tab, session: Session) -> None:
    """The pair, the line and the face."""
    page.pair("l", "ow")
    page.pose("W")
    seek_word(page, session, "low")


def stages(page: Tab, session: Session) -> None:
    """The stages one above the other, and why."""
    page.pair("bmp", "ah")
    time = seek_word(page, session, "mat", 0.42)
    for name in STAGES:
        page.page.locator(f"#stages button:has-text('{name}')").click()
    for _ in range(4):
        page.page.keyboard.press("+")
    page.settle()
    place = page.ask(f"studio.curveAt('open', {time})")
    page.page.mouse.click(place["x"], place["y"])
    page.page.locator("#why .chain li").first.wait_for()


def edits(page: Tab, session: Session) -> None:
    """Corrections of the line, one of them lost."""
    session.edit(PutEdit("1", Edit("low", 2, "open", level=0.5, label="oʊ")))
    session.edit(PutEdit("1", Edit("Papa", 1, "PBM", hold=0.04)))
    session.edit(PutEdit("1", Edit("hat", 2, "open", gain=1.5)))
    page.page.reload()
    page.ask("studio.ready")
    page.settle()
    page.page.locator("#tab-edits").click()
    seek_word(page, session, "low")


def conflict(page: Tab, session: Session) -> None:
    """A file that somebody else changed meanwhile."""
    page.pair("f", "ah")
    page.pose("open")
    page.drag_key("open", 2, 0, -50)
    path = Path("mine.json")
    text = path.read_text("utf-8")
    path.write_text(text.replace('"word": "low"', '"word": "slow"', 1), "utf-8")
    page.page.locator("#save").click()
    page.page.locator("#conflict").wait_for()


def compare(page: Tab, session: Session) -> None:
    """Before and after, side by side."""
    page.pair("l", "ow")
    page.pose("open")
    session.edit(DrawCurve("set", ("l", "ow"), "open", LOW))
    page.page.reload()
    page.ask("studio.ready")
    page.settle()
    page.pair("l", "ow")
    page.pose("open")
    page.page.locator("#ab button:nth-child(3)").click()
    seek_word(page, session, "low", 0.4)


VIEWS: dict[str, tuple[Callable[[Tab, Session], None], str]] = {
    "studio": (whole, "dark"),
    "studio-light": (whole, "light"),
    "studio-stages": (stages, "dark"),
    "studio-edits": (edits, "dark"),
    "studio-conflict": (conflict, "dark"),
    "studio-compare": (compare, "dark"),
}


def draw(browser: Browser, name: str) -> None:
    """Draw one view, from files of its own."""
    view, scheme = VIEWS[name]
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        os.environ["LIPWRIGHT_STATE"] = str(Path(folder) / "state")
        Path("mine.json").write_bytes(set_bytes(load_set("english")))
        session = open_session(Given(("mine.json",), say=LINE))
        with live(session) as where, tab(browser, where, color_scheme=scheme) as page:
            page.ask("studio.setIdle(false)")
            view(page, session)
            page.settle()
            shot = Image.open(BytesIO(page.page.screenshot())).convert("RGB")
            shot.save(PICTURES / f"{name}.png", optimize=True)
            for complaint in page.complaints:
                print(f"{name}: {complaint}", file=sys.stderr)


def main(names: list[str]) -> None:
    """Draw the views that are named, or all."""
    with chromium() as browser:
        for name in names or VIEWS:
            draw(browser, name)


if __name__ == "__main__":
    main(sys.argv[1:])
