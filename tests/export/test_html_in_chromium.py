"""The HTML page, as a user has it: opened from disk in Chromium."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from lipwright.character.character import Character
from lipwright.export import html
from lipwright.performance import Performance
from lipwright.phones import PhoneTrack
from lipwright.timeline import Tier
from tests.character.sheets import jawed
from tests.chromium import Opened, chromium, opened
from tests.export.tiny_face import GAP, pop

P, AA = 0.1, 0.35


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("a folder with spaces")


@pytest.fixture(scope="module")
def shared(browser: Browser, folder: Path) -> Iterator[Opened]:
    """One page for the tests that leave it as they found it."""
    with opened(browser, write(folder / "pop.html", pop())) as page:
        page.ask("lipwright.ready")
        yield page


@pytest.fixture
def page(shared: Opened) -> Iterator[Opened]:
    shared.ask(
        "lipwright.pause(), lipwright.setSpeed(1), lipwright.setLooping(false),"
        "lipwright.setIdle(false), lipwright.setView('mouth')"
    )
    shared.at(0)
    yield shared
    assert shared.complaints == []


def write(path: Path, performance: Performance) -> Path:
    path.write_bytes(html.encode(performance))
    return path


def gap(page: Opened) -> float:
    """Return the metres between the lips as they are drawn."""
    return min(page.heights("UpperLip")) - max(page.heights("LowerLip"))


def time_of(page: Opened) -> float:
    time: float = page.ask("lipwright.time()")
    return time


def until(page: Opened, condition: str) -> None:
    """Wait for a condition; Playwright's own way is forbidden by the page's security policy."""
    for _ in range(600):
        if page.ask(condition):
            return
        page.page.wait_for_timeout(20)
    pytest.fail(f"waited in vain for {condition}")


def test_the_lips_are_closed_in_p_and_open_in_aa(page: Opened) -> None:
    page.at(P)
    assert gap(page) == pytest.approx(0, abs=1e-6)
    assert page.ask("lipwright.morphs()")["PBM"] == 1
    page.at(AA)
    assert gap(page) == pytest.approx(GAP + 0.032, abs=1e-6)
    assert page.ask("lipwright.morphs()")["open"] == 1


def test_between_two_frames_the_weights_are_between_theirs(page: Opened) -> None:
    performance = pop()
    for time in (0.21, 0.237, 0.471):
        page.at(time)
        expected = dict(
            zip(performance.animation.controls, performance.animation.at(time)[0], strict=True)
        )
        found = page.ask("lipwright.morphs()")
        assert found["open"] == pytest.approx(expected["open"], abs=1e-4)
        assert found["PBM"] == pytest.approx(expected["PBM"], abs=1e-4)


def test_the_picture_shows_the_gap_between_the_lips(page: Opened) -> None:
    # Read in the same breath as it is drawn: afterwards the browser may have cleared it.
    background = """(seconds) => {
        lipwright.seek(seconds);
        const head = document.getElementById("head");
        const canvas = new OffscreenCanvas(head.width, head.height);
        const context = canvas.getContext("2d");
        context.drawImage(head, 0, 0);
        const { data } = context.getImageData(head.width / 2, 0, 1, head.height);
        return [...data].filter((_, index) => index % 4 === 3).map((alpha) => alpha === 0);
    }"""

    def seen_through(seconds: float) -> int:
        """Return the background's pixels between the top and the bottom of the face."""
        column = page.page.evaluate(background, seconds)
        bottom = len(column) - column[::-1].index(False)
        return sum(column[column.index(False) : bottom])

    assert seen_through(P) == 0
    assert seen_through(AA) > 20
    assert seen_through(P) == 0


def test_playing_follows_the_sound_to_the_end(page: Opened) -> None:
    heard = (
        "lipwright.play(), new Promise((done) => setTimeout(() => done(["
        "lipwright.time(), performance.now()]), 150))"
    )
    first, since = page.ask(heard)
    second, now = page.ask("[lipwright.time(), performance.now()]")
    assert first > 0
    assert second - first == pytest.approx((now - since) / 1000, abs=0.06)
    until(page, "!lipwright.playing()")
    assert time_of(page) == pytest.approx(0.8)


def test_at_half_the_speed_it_takes_twice_as_long(page: Opened) -> None:
    ask = "[lipwright.time(), performance.now()]"
    page.ask("lipwright.setSpeed(0.5), lipwright.play()")
    until(page, "lipwright.time() > 0.05")
    first, since = page.ask(ask)
    until(page, "lipwright.time() > 0.4")
    second, now = page.ask(ask)
    assert second - first == pytest.approx((now - since) / 2000, abs=0.05)


def test_looping_begins_again(page: Opened) -> None:
    page.ask("lipwright.setLooping(true), lipwright.seek(0.7), lipwright.play()")
    until(page, "lipwright.time() < 0.5")
    assert page.ask("lipwright.playing()")


def test_without_sound_it_keeps_time_by_itself_and_the_eyes_blink(
    browser: Browser, folder: Path
) -> None:
    silent = pop(sound=False)
    long = PhoneTrack(Tier.of(("p", 0.0, 4.0)))
    performance = replace(silent, animation=replace(silent.animation, phones=long))
    lids = "lipwright.seek({}), lipwright.morphs().eyeBlinkLeft"
    with opened(browser, write(folder / "silent.html", performance)) as page:
        page.ask("lipwright.ready")
        assert page.page.locator("#mute").is_hidden()
        page.ask("lipwright.play()")
        until(page, "lipwright.time() > 0.3")
        page.ask("lipwright.pause()")
        seen = [page.ask(lids.format(at / 10)) for at in range(40)]
        assert 0 < sum(lid > 0 for lid in seen) < 8
        page.ask("lipwright.setIdle(false)")
        assert page.ask(lids.format(seen.index(max(seen)) / 10)) == 0
        assert page.complaints == []


@pytest.mark.parametrize(
    ("keys", "expected"),
    [
        (["End"], 0.8),
        (["End", "Home"], -0.1),
        (["Home", "ArrowRight", "ArrowRight"], -0.1 + 2 / 60),
        (["ArrowLeft"], -1 / 60),
        (["Shift+ArrowRight"], 10 / 60),
        (["Home", "ArrowDown"], 0.1),
        (["Home", "ArrowDown", "ArrowDown"], 0.35),
        (["End", "ArrowUp", "ArrowUp"], 0.6),
        (["End", "PageUp"], 0.0),
    ],
)
def test_keys_go_where_they_say(page: Opened, keys: list[str], expected: float) -> None:
    for key in keys:
        page.page.keyboard.press(key)
    assert time_of(page) == pytest.approx(expected, abs=1e-6)


def test_keys_play_loop_slow_down_and_look(page: Opened) -> None:
    press = page.page.keyboard.press
    pressed = "[...document.querySelectorAll('#{} [aria-pressed=true]')].map((b) => b.textContent)"
    press("l")
    press("[")
    press(" ")
    assert page.ask("lipwright.playing()")
    press(" ")
    assert not page.ask("lipwright.playing()")
    assert page.page.locator("#loop").get_attribute("aria-pressed") == "true"
    assert page.ask(pressed.format("speeds")) == ["0.75×"]
    press("3")
    assert page.ask(pressed.format("views")) == ["Side"]
    press("?")
    assert page.page.locator("#help").is_visible()
    press("Escape")
    assert not page.page.locator("#help").is_visible()


def test_clicking_a_phone_shows_its_middle_and_a_word_its_start(page: Opened) -> None:
    box = page.page.locator("#timeline").bounding_box()
    assert box is not None
    reached = set()
    for y in range(2, int(box["height"]), 10):
        page.at(0.75)
        page.page.mouse.click(box["x"] + box["width"] * 0.42, box["y"] + y)
        reached.add(round(time_of(page), 2))
    # Where neither a phone nor a word was clicked it is 42 % of the way from -0.1 to 0.8 s.
    assert reached == {0.0, AA, 0.28}


def test_dragging_on_the_timeline_scrubs(page: Opened) -> None:
    box = page.page.locator("#timeline").bounding_box()
    assert box is not None
    mouse, y = page.page.mouse, box["y"] + box["height"] - 20
    mouse.move(box["x"] + box["width"] * 0.2, y)
    mouse.down()
    mouse.move(box["x"] + box["width"] * 0.5, y, steps=4)
    mouse.up()
    assert time_of(page) == pytest.approx(0.35, abs=0.005)
    assert gap(page) > GAP


def test_a_curve_can_be_hidden_and_its_value_is_shown(page: Opened) -> None:
    page.at(AA)
    button = page.page.locator("#legend button").first
    assert button.inner_text().split() == ["open", "1.00"]
    shown = page.page.locator("#timeline").screenshot()
    button.click()
    page.page.mouse.move(5, 5)
    assert button.get_attribute("aria-pressed") == "false"
    assert page.page.locator("#timeline").screenshot() != shown
    button.click()
    assert button.get_attribute("aria-pressed") == "true"


def test_the_page_says_how_it_was_made(page: Opened) -> None:
    assert page.page.title() == "Pop. – Lipwright"
    assert page.page.locator("#about").inner_text() == "bigram · english · 1 note"
    page.page.keyboard.press("n")
    assert "p-aa" in page.page.locator("#notes").inner_text()
    page.page.keyboard.press("Escape")


def test_everything_fits_into_a_narrow_a_low_and_a_wide_window(page: Opened) -> None:
    for width, height in ((390, 844), (844, 390), (1920, 1080), (800, 600)):
        page.page.set_viewport_size({"width": width, "height": height})
        for name in ("stage", "play", "timeline", "clock", "views", "legend"):
            box = page.page.locator(f"#{name}").bounding_box()
            assert box is not None
            assert box["x"] >= 0
            assert box["x"] + box["width"] <= width
            assert box["y"] >= 0
            assert box["y"] + box["height"] <= height
        stage = page.page.locator("#stage").bounding_box()
        assert stage is not None
        assert stage["height"] > 0.25 * height


def test_everything_that_can_be_pressed_has_a_name(page: Opened) -> None:
    names = page.ask("[...document.querySelectorAll('button')].map((b) => b.innerText || b.title)")
    assert all(names)
    slider = page.page.get_by_role("slider", name="Time")
    page.at(AA)
    assert slider.get_attribute("aria-valuetext") == "0:00.350, word pop, phone aa"


def test_hostile_words_are_shown_as_they_are(browser: Browser, folder: Path) -> None:
    hostile = '</script><img src=x onerror="window.broken = true"><b>'
    plain = pop()
    animation = replace(
        plain.animation,
        words=Tier.of((hostile, 0.0, 0.7)),
        phones=PhoneTrack(Tier.of((hostile, 0.0, 0.7))),
        report={hostile: [hostile]},
    )
    speech = replace(plain.speech, text=hostile, notes=(hostile,))
    path = write(folder / "hostile.html", replace(plain, animation=animation, speech=speech))
    with opened(browser, path) as page:
        page.ask("lipwright.ready")
        page.at(0.3)
        assert page.page.locator("#now-word").inner_text() == hostile
        assert page.page.locator("h1").inner_text() == hostile
        page.page.keyboard.press("n")
        assert page.page.locator("#notes").inner_text().count(hostile) >= 3
        assert page.page.locator("img, h1 b, dd b").count() == 0
        assert page.ask("window.broken === undefined")
        assert page.complaints == []


def test_the_page_asks_for_no_other_file(page: Opened) -> None:
    page.ask("lipwright.play()")
    until(page, "lipwright.time() > 0.1")
    asked = [url for url in page.requests if not url.startswith(("data:", "blob:"))]
    assert [url.rpartition("/")[2] for url in asked] == ["pop.html"]


def test_a_jaw_joint_turns_on_the_page(browser: Browser, folder: Path) -> None:
    base = pop()
    made = jawed({}, {"rotation": [0, 0, 0.5**0.5, 0.5**0.5]})
    character = Character("face", lambda: made)
    spoken = replace(base, rig=lambda: character.rig(base.animation))
    with opened(browser, write(folder / "jaw.html", spoken)) as page:
        page.ask("lipwright.ready")
        page.at(P)
        closed = page.heights("Face")
        page.at(AA)
        gain = character.fit().gains["open"]
        assert page.ask("lipwright.morphs()")["Jaw"] == pytest.approx(gain, abs=1e-3)
        moved = [before - after for before, after in zip(closed, page.heights("Face"), strict=True)]
        half = len(moved) // 2
        middle = half + 20
        assert max(map(abs, moved[:half])) < 1e-6
        assert moved[middle] == pytest.approx(max(moved), rel=0.05)
        mouth = character.calibration().mouth
        assert mouth is not None
        gap = mouth.stand(character.fit().values({"open": 1.0})).widest * mouth.width
        assert moved[middle] == pytest.approx(gap, rel=0.05)
        page.ask("lipwright.setView('mouth')")
        assert page.complaints == []
