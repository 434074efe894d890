"""A tab of Chromium with the studio in it, and hands that do as a person does."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from playwright.sync_api import Browser, Page

from tests.chromium import PATIENCE
from tests.studio.live import Live


@dataclass
class Tab:
    """The page, and what it complained of."""

    page: Page
    complaints: list[str] = field(default_factory=list)

    def ask(self, expression: str) -> Any:
        """Return the value of a JavaScript expression."""
        return self.page.evaluate(expression)

    def settle(self) -> None:
        """Wait until nothing is on its way and what came is drawn."""
        self.ask("studio.idle()")

    def until(self, condition: str, given: Any = None) -> None:
        """Wait until a JavaScript function of ``given`` is true."""
        self.page.wait_for_function(condition, arg=given)

    def pair(self, first: str, second: str) -> None:
        """Choose a pair in the matrix."""
        self.page.locator("#tab-pairs").click()
        self.page.locator(f".cell[data-first={first}][data-second={second}]").click()
        self.until("pair => `${studio.editor().pair}` === `${pair}`", [first, second])
        self.settle()

    def pose(self, name: str) -> None:
        """Choose a pose of the pair."""
        self.page.get_by_title(f"Edit {name}", exact=True).click()
        self.until("name => studio.editor().pose === name", name)
        self.settle()

    def say(self, text: str) -> None:
        """Type a text, and press Enter."""
        self.page.locator("#text").fill(text)
        self.page.locator("#text").press("Enter")
        self.page.wait_for_function(
            "text => [...document.querySelectorAll('#line option')]"
            ".some(one => one.textContent.includes(text))",
            arg=text,
        )
        self.settle()

    def curve(self, pose: str) -> list[list[float]]:
        """The keys of a pose, as the editor has them."""
        keys: list[list[float]] = self.ask("studio.editor()")["curves"][pose]
        return keys

    def is_curve(self, pose: str, keys: list[list[float]], *, same: bool = True) -> None:
        """Wait until a pose's keys are these, or others."""
        sign = "===" if same else "!=="
        self.until(
            f"([pose, keys]) => JSON.stringify(studio.editor().curves[pose]) {sign} "
            "JSON.stringify(keys)",
            [pose, keys],
        )

    def drag(self, place: dict[str, float], right: float, down: float) -> None:
        """Drag from a place on the page, in pixels, in a few moves."""
        mouse = self.page.mouse
        mouse.move(place["x"], place["y"])
        mouse.down()
        for step in (0.3, 0.7, 1.0):
            mouse.move(place["x"] + step * right, place["y"] + step * down)
        mouse.up()
        self.settle()

    def drag_key(self, pose: str, index: int, right: float, down: float) -> None:
        """Drag a key of the editor."""
        place = self.ask(f"studio.keyAt({pose!r}, {index})")
        assert place is not None
        self.drag(place, right, down)

    def undo_all(self) -> None:
        """Undo to the start."""
        button = self.page.locator("#undo")
        while button.is_enabled():
            button.click()
            self.settle()

    def control(self, name: str, seconds: float) -> float:
        """A control of the line at an instant."""
        value: float = self.ask(f"studio.controls({seconds})")[name]
        return value

    def face(self, seconds: float) -> dict[str, float]:
        """What the rig holds at an instant."""
        self.ask(f"studio.seek({seconds})")
        self.settle()
        found: dict[str, float] = self.ask("studio.morphs()")
        return found


@contextmanager
def tab(browser: Browser, where: Live, **context: Any) -> Iterator[Tab]:
    """Open the studio's page, ready to be used; ``context`` is Playwright's."""
    window = browser.new_context(viewport={"width": 1280, "height": 720}, **context)
    window.set_default_timeout(PATIENCE)
    result = Tab(window.new_page())
    result.page.on("pageerror", lambda error: result.complaints.append(str(error)))
    result.page.on(
        "console",
        lambda said: result.complaints.append(said.text) if said.type == "error" else None,
    )
    result.page.goto(f"http://{where.host}/?token={where.token}")
    result.ask("studio.ready")
    result.settle()
    try:
        yield result
    finally:
        window.close()
