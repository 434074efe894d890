"""The studio in Chromium, used as a person would use it."""

from __future__ import annotations

import threading
from base64 import b64encode
from collections.abc import Iterator
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import pytest
from playwright.sync_api import Browser, expect

from lipwright.character import keep_character
from lipwright.engines.bigram import read_edits, read_set
from lipwright.studio.server import PAGE
from tests.chromium import PATIENCE, chromium
from tests.studio.live import live
from tests.studio.made import opened
from tests.studio.tab import Tab, tab
from tests.studio.test_running import running, where

LINE = "The fat cat is low."


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as started:
        yield started


def dropped(page: Tab, name: str, content: bytes) -> None:
    """Let a file fall onto the page."""
    page.page.evaluate(
        """([name, content]) => {
            const bytes = Uint8Array.from(atob(content), letter => letter.charCodeAt(0));
            const data = new DataTransfer();
            data.items.add(new File([bytes], name));
            for (const type of ["dragenter", "dragover", "drop"])
                document.body.dispatchEvent(
                    new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true }));
        }""",
        [name, b64encode(content).decode()],
    )


def test_an_animator_changes_a_pair_sees_hears_saves_and_takes_it_back(
    browser: Browser, desk: Path
) -> None:
    path = desk / "mine.json"
    before = path.read_bytes()
    session = opened("mine.json")
    with live(session) as studio, tab(browser, studio) as page:
        page.say(LINE)
        page.pair("f", "ah")
        page.pose("open")
        time = page.ask("studio.time()")
        drawn = page.curve("open")
        peak = max(range(len(drawn)), key=lambda index: drawn[index][1])
        instant = (
            next(at / 100 for at in range(300) if page.control("FV", at / 100) > 0.9) + 0.1
        )  # just behind f the mouth is on its way to a
        was, face = page.control("open", instant), page.face(instant)
        page.drag_key("open", peak, 0, -80)
        assert page.curve("open")[peak][1] > drawn[peak][1] + 0.2
        assert page.control("open", instant) > was + 0.05
        assert page.face(instant)["open"] > face["open"] + 0.05
        page.ask(f"studio.seek({time})")
        page.page.locator("#play").click()
        page.page.wait_for_function("() => studio.sounding() && studio.time() > 0.2")
        page.page.locator("#play").click()
        page.page.locator("#save").click()
        diff = page.page.locator("#saving .diff")
        expect(diff).to_contain_text('"open": [[')
        page.page.locator("#write").click()
        expect(page.page.locator("#unsaved")).to_be_hidden()
        old, new = before.decode().splitlines(), path.read_text("utf-8").splitlines()
        changed = [row for row, other in zip(new, old, strict=True) if row != other]
        assert len(changed) == 1
        assert read_set(path).bigrams["f", "ah"].curves["open"].values.max() > 0.5
        page.page.keyboard.press("Escape")
        page.undo_all()
        assert page.curve("open") == drawn
        assert session.state.lines == {}
        assert page.complaints == []


def test_a_boundary_is_dragged_and_everything_follows(browser: Browser, desk: Path) -> None:
    session = opened("english", "low.json", "low.wav")
    with live(session) as studio, tab(browser, studio) as page:
        place = page.ask("studio.edgeAt(3)")
        # In 0.47 s m has begun: the lips are shut. When it begins later they are not yet.
        assert page.control("PBM", 0.47) > 0.9
        page.drag(place, 14, 0)
        moved = session.state.lines["1"].phones[3][2]
        assert 0.46 < moved < 0.545
        assert session.state.lines["1"].words[0][2] == moved
        assert page.control("PBM", 0.47) < 0.9
        page.page.keyboard.press("Control+z")
        page.settle()
        assert session.state.lines["1"].phones[3][2] == 0.45


def test_two_tabs_on_one_set_stay_in_step(browser: Browser, desk: Path) -> None:
    session = opened("mine.json", "low.json")
    with live(session) as studio, tab(browser, studio) as one, tab(browser, studio) as other:
        for page in (one, other):
            page.pair("l", "ow")
            page.pose("W")
        drawn = one.curve("W")
        peak = max(range(len(drawn)), key=lambda index: drawn[index][1])
        one.drag_key("W", peak, 0, 60)
        one.is_curve("W", drawn, same=False)
        there = "([n, height]) => Math.abs(studio.editor().curves.W[n][1] - height) < 1e-3"
        other.page.wait_for_function(there, arg=[peak, one.curve("W")[peak][1]])
        other.page.locator("#undo").click()
        for page in (one, other):
            page.is_curve("W", drawn)


def test_killed_in_the_middle_of_an_edit_the_page_goes_on(browser: Browser, desk: Path) -> None:
    with running(desk, "english", "low.json") as (process, said):
        studio = where(said)
        with tab(browser, studio) as page:
            page.pair("l", "ow")
            page.pose("W")
            page.drag_key("W", 1, 0, 40)
            half = page.curve("W")
            place = page.ask("studio.keyAt('W', 1)")
            page.page.mouse.move(place["x"], place["y"])
            page.page.mouse.down()
            page.page.mouse.move(place["x"], place["y"] + 10)
            process.kill()
            process.wait(60)
            page.page.mouse.move(place["x"], place["y"] + 30)
            page.page.mouse.up()
            expect(page.page.locator("#offline")).to_be_visible(timeout=PATIENCE)
            with running(desk, "english", "low.json") as (_, again):
                assert where(again) == studio
                expect(page.page.locator("#offline")).to_be_hidden(timeout=PATIENCE)
                page.settle()
                assert page.curve("W")[1][1] < half[1][1]
                expect(page.page.locator("#undo")).to_be_enabled()
                page.undo_all()
                assert page.curve("W")[1][1] > half[1][1]


def test_a_model_that_is_dropped_in_speaks(browser: Browser, desk: Path) -> None:
    session = opened("english", "low.json")
    with live(session) as studio, tab(browser, studio) as page:
        dropped(page, "krabbe.glb", keep_character("crab").model().to_glb())
        page.page.wait_for_function(
            "() => document.querySelector('#character').value.endsWith('-krabbe.glb')"
        )
        page.settle()
        assert session.actor.name.endswith("-krabbe.glb")
        assert any(value > 0.3 for value in page.face(1.0).values())


def test_a_sound_with_labels_that_are_dropped_in_become_a_line(
    browser: Browser, desk: Path
) -> None:
    session = opened("english")
    sound = (desk / "low.wav").read_bytes()
    with live(session) as studio, tab(browser, studio) as page:
        dropped(page, "low.wav", sound)
        dialog = page.page.locator("dialog[open]")
        expect(dialog).to_be_visible()
        assert "low.wav" in (dialog.text_content() or "")


def test_from_the_face_to_the_key_and_back(browser: Browser, desk: Path) -> None:
    session = opened("english", "low.json")
    with live(session) as studio, tab(browser, studio) as page:
        place = page.ask("studio.curveAt('W', 0.95)")
        page.page.mouse.click(place["x"], place["y"])
        chain = page.page.locator("#why .chain button").first
        expect(chain).to_be_visible()
        assert "ow" in (page.page.locator("#why").text_content() or "")
        chain.click()
        page.settle()
        editor = page.ask("studio.editor()")
        assert editor["pose"] == "W"
        assert editor["pair"] in (["l", "ow"], ["ow", "sil"])
        was = page.control("W", 0.95)
        drawn = page.curve("W")
        peak = max(range(len(drawn)), key=lambda index: drawn[index][1])
        page.drag_key("W", peak, 0, 80)
        assert page.control("W", 0.95) < was - 0.05


class Hostile(BaseHTTPRequestHandler):
    """Serves an empty page, and tells nobody."""

    def do_GET(self) -> None:
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(b"<!doctype html><title>hostile</title>")

    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture(scope="module")
def hostile() -> Iterator[str]:
    """A page on another port: of the same site for a browser, and of another origin."""
    with ThreadingHTTPServer(("127.0.0.1", 0), Hostile) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_port}/"
        server.shutdown()
        thread.join()


@pytest.mark.parametrize("own", ["another port", "no origin"])
def test_a_page_of_another_origin_gets_nothing_even_with_the_token(
    browser: Browser, desk: Path, hostile: str, own: str
) -> None:
    with live(opened("english", "low.json")) as studio:
        window = browser.new_context()
        page = window.new_page()
        page.goto(hostile if own == "another port" else "data:text/html,<title>hostile</title>")
        address = f"127.0.0.1:{studio.port}"
        told = page.evaluate(
            """async ([address, token, asset]) => {
                const told = [];
                const fetched = async (path, how) => {
                    try { told.push(await (await fetch(`http://${address}${path}`, how)).text()); }
                    catch { told.push("refused"); }
                };
                await fetched("/?token=" + token);
                await fetched("/alive", { headers: { "X-Lipwright-Token": token } });
                await fetched("/sounds?token=" + token, { method: "POST", body: "x" });
                told.push(await new Promise(done => {
                    const socket = new WebSocket(`ws://${address}/talk?token=${token}`);
                    socket.onopen = () => done("open");
                    socket.onerror = () => done("refused");
                }));
                const script = document.createElement("script");
                script.src = `http://${address}/assets/${asset}?token=${token}`;
                told.push(await new Promise(done => {
                    script.onload = () => done("loaded");
                    script.onerror = () => done("refused");
                    document.head.append(script);
                }));
                const frame = document.createElement("iframe");
                frame.src = `http://${address}/?token=${token}`;
                document.body.append(frame);
                await new Promise(done => { frame.onload = done; });
                return told;
            }""",
            [address, studio.token, next((PAGE / "assets").glob("*.js")).name],
        )
        framed = page.frames[1].evaluate("document.body.textContent")
        window.close()
        assert told == ["refused"] * 5
        assert "Lipwright" not in framed
        assert not list(studio_sounds(desk))


def studio_sounds(desk: Path) -> Iterator[Path]:
    """Sounds that a studio has kept."""
    return (desk.parent / "state").rglob("*.wav")


def test_what_somebody_else_wrote_is_shown_and_kept(browser: Browser, desk: Path) -> None:
    path = desk / "mine.json"
    with live(opened("mine.json")) as studio, tab(browser, studio) as page:
        page.pair("f", "ah")
        page.pose("open")
        page.drag_key("open", 1, 0, -40)
        ours = page.curve("open")[1][1]
        theirs = path.read_text("utf-8").replace('"word": "low"', '"word": "slowly"')
        path.write_text(theirs, "utf-8")
        page.page.locator("#save").click()
        conflict = page.page.locator("#conflict")
        expect(conflict).to_contain_text('"word": "slowly"')
        assert path.read_text("utf-8") == theirs
        page.page.get_by_role("button", name="Read theirs, lay ours over it").click()
        expect(conflict).to_be_hidden()
        page.page.locator("#write").click()
        expect(page.page.locator("#unsaved")).to_be_hidden()
        made = read_set(path)
        assert made.bigrams["l", "ow"].word == "slowly"
        assert made.bigrams["f", "ah"].curves["open"].pairs()[1][1] == ours


def test_a_correction_hangs_on_its_phone_and_is_saved_beside_the_line(
    browser: Browser, desk: Path
) -> None:
    session = opened("english", "low.json")
    with live(session) as studio, tab(browser, studio) as page:
        page.page.locator("#tab-edits").click()
        edge = page.ask("studio.edgeAt(8)")  # the end of ow in "low"
        page.page.mouse.click(edge["x"] - 12, edge["y"])
        page.page.get_by_label("Pose to correct").select_option("open")
        was = page.control("open", 1.05)
        slider = page.page.get_by_label("reaches: a weight in the middle")
        slider.fill("0.9")
        page.settle()
        assert page.control("open", 1.05) > was + 0.2
        (edit,) = session.state.lines["1"].edits
        assert (edit.word, edit.phone, edit.label, edit.level) == ("low", 2, "ow", 0.9)
        page.page.locator("#save").click()
        page.page.locator("#write").click()
        expect(page.page.locator("#unsaved")).to_be_hidden()
        assert read_edits(desk / "low.edits.json") == (edit,)


def test_an_example_word_is_heard(browser: Browser, desk: Path) -> None:
    with live(opened("english")) as studio, tab(browser, studio) as page:
        page.pair("bmp", "ah")
        page.page.locator("#hear-word").click()
        page.page.wait_for_function("() => studio.sounding()")


def test_a_key_is_moved_and_taken_back_by_keyboard_alone(browser: Browser, desk: Path) -> None:
    session = opened("mine.json", "low.json")
    with live(session) as studio, tab(browser, studio) as page:
        page.pair("l", "ow")
        page.pose("W")
        drawn = page.curve("W")
        page.page.locator("#curves").focus()
        press = page.page.keyboard.press
        for _ in range(len(drawn)):
            press(".")
            press("Shift+ArrowUp")
            page.settle()
        page.is_curve("W", drawn, same=False)
        steps = session.history.undo_steps
        assert 1 <= steps <= len(drawn)
        for _ in range(steps):
            press("Control+z")
            page.settle()
        page.is_curve("W", drawn)
        assert session.history.undo_steps == 0
        press("Control+Shift+z")
        page.settle()
        page.is_curve("W", drawn, same=False)
