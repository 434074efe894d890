"""The page of a character of pictures, opened in a browser."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from lipwright import export
from lipwright.performance import Cues, Picture
from tests.chromium import Opened, chromium, opened
from tests.export.performances import performance

SVG = (
    b'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><rect width="9" height="9"/></svg>'
)
CUES = Cues(
    "duck", ("X", "</script>", "X"), (0, 3, 6), 12, 24.0, "X",
    lambda: dict.fromkeys(("X", "</script>"), Picture("image/svg+xml", SVG)),
)  # fmt: skip


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as found:
        yield found


def page(folder: Path, *, silent: bool) -> Path:
    line = replace(performance(silent=silent), cues=lambda: CUES, flat=True)
    path = folder / "duck.html"
    export.save(line, path)
    return path


def until(window: Opened, condition: str) -> None:
    """Wait; the page's own rules forbid what Playwright would wait with."""
    for _ in range(200):
        if window.ask(condition):
            return
        window.page.wait_for_timeout(25)
    pytest.fail(f"never: {condition}")


def visible(window: Opened) -> int:
    count: int = window.ask(
        "[...document.querySelectorAll('#stage img')].filter(i => "
        "getComputedStyle(i).visibility == 'visible' && i.naturalWidth > 0).length"
    )
    return count


@pytest.mark.parametrize("silent", [False, True])
def test_the_mouth_shows_the_cue_of_each_moment(
    browser: Browser, tmp_path: Path, silent: bool
) -> None:
    with opened(browser, page(tmp_path, silent=silent)) as window:
        seen = []
        for seconds in (0.0, 0.124, 0.125, 0.24, 0.26, 0.5):
            window.at(seconds)
            seen.append(window.ask("lipwright.shape()"))
            until(window, "[...document.images].every(i => i.complete)")
            assert visible(window) == 1
        assert seen == ["X", "X", "</script>", "</script>", "X", "X"]
        # The arrow keys step by frames, and the space bar plays to the end.
        window.at(0.0)
        for _ in range(3):
            window.page.keyboard.press("ArrowRight")
        assert window.ask("lipwright.shape()") == "</script>"
        window.page.keyboard.press(" ")
        until(window, "!lipwright.playing()")
        assert window.ask("lipwright.time()") == pytest.approx(0.5)
        assert window.complaints == []
        assert [url for url in window.requests if url.startswith("http")] == []


def test_it_fits_a_phone(browser: Browser, tmp_path: Path) -> None:
    size = {"width": 360, "height": 640}
    with opened(browser, page(tmp_path, silent=True), viewport=size) as window:
        assert window.ask("document.documentElement.scrollWidth") <= 360
        box = window.page.locator("#play").bounding_box()
        assert box is not None
        assert box["y"] + box["height"] <= 640
