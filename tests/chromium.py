"""Pages opened in Chromium, from disk, with everything noted that a user would not forgive."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")
FLAGS = (
    "--no-sandbox",
    # WebGL where there is no graphics card.
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
    "--autoplay-policy=no-user-gesture-required",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
PATIENCE = 60_000


@dataclass
class Opened:
    """A page, and what it said and asked for."""

    page: Page
    complaints: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    def ask(self, expression: str) -> Any:
        """Return the value of a JavaScript expression."""
        return self.page.evaluate(expression)

    def at(self, seconds: float) -> None:
        """Go to a time of a performance, and draw it."""
        self.ask(f"lipwright.seek({seconds})")

    def heights(self, mesh: str) -> list[float]:
        """Return y of each vertex of a mesh as it is drawn now."""
        positions: list[float] = self.ask(f"lipwright.positions()[{mesh!r}]")
        return positions[1::3]


@contextmanager
def chromium() -> Iterator[Browser]:
    """Start Chromium; a test without one fails, and says what is missing."""
    program = next(filter(None, map(shutil.which, NAMES)), None)
    if program is None:
        pytest.fail(f"no Chromium is on this machine: install one of {', '.join(NAMES)}")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=list(FLAGS))
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def opened(browser: Browser, path: Path, **context: Any) -> Iterator[Opened]:
    """Open a page of Lipwright from disk; ``context`` is Playwright's (viewport, color_scheme)."""
    window = browser.new_context(**{"viewport": {"width": 800, "height": 600}, **context})
    window.set_default_timeout(PATIENCE)
    result = Opened(window.new_page())
    page = result.page
    page.on("console", lambda said: result.complaints.append(f"{said.type}: {said.text}"))
    page.on("pageerror", lambda error: result.complaints.append(str(error)))
    page.on("request", lambda request: result.requests.append(request.url))
    page.goto(path.as_uri())
    try:
        yield result
    finally:
        window.close()
