"""The server: its own page gets everything, any other page gets nothing."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest
from websockets.exceptions import ConnectionClosed

from lipwright.character import keep_character
from lipwright.studio.messages import Failed, Watch
from lipwright.studio.page_views import Board
from lipwright.studio.server import Page
from tests.studio.live import TOKEN, Live, live
from tests.studio.made import opened, sound

DRAW = {
    "type": "drawCurve",
    "target": "overrides",
    "pair": ["f", "ah"],
    "pose": "open",
    "keys": [[0, 0], [0.4, 0.7], [1, 0]],
}


@pytest.fixture
def studio(desk: Path) -> Iterator[Live]:
    with live(opened("english", "low.json", "low.wav")) as where:
        yield where


def test_its_own_page_is_answered(studio: Live) -> None:
    with studio.page() as tab:
        assert len(tab.ask("start", "hello").cells) == 483


@pytest.mark.parametrize(
    "headers",
    [
        {"Origin": "http://evil.example"},
        {"Origin": "https://127.0.0.1"},
        {"Origin": "null"},
        {"Origin": "http://127.0.0.1:8"},
        {"Host": "evil.example"},
        {"Host": "evil.example:80"},
        {"Sec-Fetch-Site": "cross-site"},
        {"Sec-Fetch-Site": "same-site"},
    ],
)
@pytest.mark.parametrize("path", ["/", "/alive", "/assets/page.js", "/sounds/a.wav", "/nothing"])
def test_a_page_of_another_origin_gets_nothing(
    studio: Live, path: str, headers: dict[str, str]
) -> None:
    answer = studio.request(path, headers=headers)
    assert answer.status == 403
    assert not any(name.lower().startswith("access-control") for name in answer.headers)
    assert studio.upgrade(headers, TOKEN) == 403


@pytest.mark.parametrize("token", ["", "wrong", TOKEN[:-1], TOKEN + "x", "ünïcode"])
@pytest.mark.parametrize("path", ["/", "/alive", "/sounds/a.wav", "/models/a.glb"])
def test_without_the_token_nothing_is_told(studio: Live, path: str, token: str) -> None:
    assert studio.request(path, token=token).status == 403
    assert studio.upgrade({}, token) == 403


def test_sending_needs_the_token_too(studio: Live) -> None:
    for path in ("/sounds", "/models"):
        assert studio.request(path, token="", content=b"x").status == 403


def test_answers_forbid_to_be_framed_and_guessed_at(studio: Live) -> None:
    headers = studio.request("/alive").headers
    assert "frame-ancestors 'none'" in headers["content-security-policy"]
    assert headers["x-content-type-options"] == "nosniff"


def test_two_tabs_stay_in_step(studio: Live) -> None:
    with studio.page() as one, studio.page() as other:
        one.ask("start", "hello")
        other.ask("start", "hello")
        other.ask("watch", "watched", pair=["f", "ah"], line="1")
        changed = one.ask("edit", "changed", change=DRAW)
        heard = other.hear("changed")
        assert (heard.id, heard.revision, heard.cells) == (0, changed.revision, changed.cells)
        assert other.hear("motion").revision == changed.revision
        assert other.hear("bigram").override_curves["open"][1] == (0.4, 0.7)
        other.ask("undo", "changed")
        assert one.hear("changed").history.undo_steps == 0
        assert one.ask("redo", "changed").history.undo == "draw open of f-ah"


def test_a_page_that_comes_later_sees_what_was_done(studio: Live) -> None:
    with studio.page() as tab:
        tab.ask("edit", "changed", change=DRAW)
    with studio.page() as tab:
        hello = tab.ask("start", "hello")
        assert hello.history.undo_steps == 1
        assert [cell.pair for cell in hello.cells if cell.overridden] == [("f", "ah")]


@pytest.mark.parametrize(
    ("text", "number", "words"),
    [
        ("", 0, "makes no sense"),
        ("[]", 0, "makes no sense"),
        ("null", 0, "makes no sense"),
        ("{", 0, "makes no sense"),
        ('{"id": 3}', 3, "missing required field `type`"),
        ('{"type": "dance", "id": 4}', 4, "dance"),
        ('{"type": "edit", "id": 5}', 5, "missing required field `change`"),
        ('{"type": "edit", "id": 6, "change": {"type": "paint"}}', 6, "paint"),
        ('{"type": "undo", "id": 7, "steps": "many"}', 7, "Expected `int`"),
        ('{"type": "edit", "id": 8, "change": {"type": "drawCurve", "target": "disk", '
         '"pair": ["f", "ah"], "pose": "open", "keys": []}}', 8, "disk"),
        ('{"type": "edit", "id": 9, "change": {"type": "drawCurve", "target": "set", '
         '"pair": ["f", "ah"], "pose": "open", "keys": [[0, 1e999]]}}', 9, "makes no sense"),
        ('{"type": "edit", "id": 10, "change": {"type": "putEdit", "line": "1", '
         '"edit": {"word": "low", "phone": 0, "pose": "open"}}}', 10, "from 1"),
        ('{"type": "save", "id": 11, "document": "passwords", "digest": ""}', 11, "passwords"),
    ],
)  # fmt: skip
def test_a_message_that_makes_no_sense_is_told_and_loses_nothing(
    studio: Live, text: str, number: int, words: str
) -> None:
    with studio.page() as tab:
        tab.ask("edit", "changed", change=DRAW)
        said = tab.fail(text)
        assert said.id == number
        assert words in said.error
        assert tab.ask("start", "hello").history.undo_steps == 1


def test_a_frame_that_is_no_text_ends_only_that_page(studio: Live) -> None:
    with studio.page() as other, studio.page() as tab:
        tab.ask("edit", "changed", change=DRAW)
        tab.socket.send(b"\x00\x01")
        with pytest.raises(ConnectionClosed):
            tab.drain()
        assert other.ask("start", "hello").history.undo_steps == 1


def test_a_sound_goes_in_and_comes_out_as_the_line_names_it(studio: Live) -> None:
    data = sound(0.5).wav_bytes()
    sent = studio.request("/sounds", content=data, name="hm.wav")
    key = sent.json()["key"]
    assert studio.request(f"/sounds/{key}.wav").content == data
    with studio.page() as tab:
        tab.ask("watch", "watched", line="1")
        hello = tab.ask("start", "hello")
        assert hello.lines[0].duration == pytest.approx(1.4)


@pytest.mark.parametrize(
    ("path", "name", "content", "words"),
    [
        ("/sounds", "x.wav", b"", "x.wav"),
        ("/sounds", "x.wav", b"no sound at all", "x.wav"),
        ("/sounds", "../../x.wav", b"no sound at all", "x.wav: "),
        ("/models", "x.glb", b"no model", "x.glb"),
        ("/models", "x.exe", b"no model", "'.exe'"),
        ("/models", "", b"no model", "unnamed"),
    ],
)
def test_what_is_sent_and_broken_is_refused_by_its_name(
    studio: Live, path: str, name: str, content: bytes, words: str
) -> None:
    answer = studio.request(path, content=content, name=name)
    assert answer.status == 422
    error = answer.json()["error"]
    assert words in error
    assert "/tmp" not in error
    assert "\n" not in error


def test_a_model_that_is_dropped_in_speaks(studio: Live) -> None:
    glb = keep_character("crab").model().to_glb()
    sent = studio.request("/models", content=glb, name="krabbe.glb")
    name = sent.json()["key"]
    assert name.endswith("-krabbe.glb")
    with studio.page() as tab:
        assert name in tab.ask("start", "hello").characters
        tab.ask("watch", "watched", line="1")
        view = tab.ask("character", "character", name=name)
        assert set(view.known) >= {"open", "W", "wide"}
        model = studio.request(f"/{view.model}")
        assert model.content[:4] == b"glTF"
        motion = tab.hear("motion")
        assert motion.character == name
        assert motion.channels.names


@pytest.mark.parametrize(
    "path",
    ["/sounds/..%2f..%2fseat.wav", "/sounds/none.wav", "/models/none.glb", "/assets/../server.py"],
)
def test_nothing_else_can_be_read(studio: Live, path: str) -> None:
    assert studio.request(path).status in (403, 404)


def test_long_work_says_how_far_it_is_and_others_go_on(studio: Live) -> None:
    with studio.page() as tab:
        number = tab.send("say", text="A map.")
        assert tab.hear("progress", number).what == "speaking"
        line = tab.hear("made", number).line
        assert tab.ask("watch", "line", line=line).title == "A map."


def test_saving_is_told_to_every_page(studio: Live, desk: Path) -> None:
    with studio.page() as one, studio.page() as other:
        one.ask("edit", "changed", change=DRAW)
        preview = one.ask("preview", "preview", document="overrides", name="o.json")
        one.ask("save", "saved", document="overrides", name="o.json", digest=preview.digest)
        assert other.hear("saved").path == str(desk / "o.json")
        assert '"pair": ["f", "ah"]' in (desk / "o.json").read_text("utf-8")


def test_a_mistake_of_our_own_is_told_and_the_studio_goes_on(
    studio: Live, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def broken(*_: object) -> None:
        raise ZeroDivisionError("oh")

    with studio.page() as tab:
        tab.ask("edit", "changed", change=DRAW)
        monkeypatch.setattr("lipwright.studio.asking.why_view", broken)
        said = tab.fail('{"type": "why", "id": 9, "line": "1", "control": "open", "time": 1}')
        assert "nothing was lost" in said.error
        assert "ZeroDivisionError" in capsys.readouterr().err
        assert tab.ask("start", "hello").history.undo_steps == 1


def test_what_became_different_is_sent_though_an_answer_follows_at_once(desk: Path) -> None:
    session = opened("english", "low.json")
    board = Board(session)
    sent: list[str] = []

    class Socket:
        async def send_text(self, text: str) -> None:
            sent.append(msgspec.json.decode(text)["type"])

    async def delivered() -> None:
        page = Page(Socket(), session)  # type: ignore[arg-type]
        page.watcher.watch(Watch(pair=("f", "ah")))
        page.say(board.news(), 1)
        page.due()
        page.say(Failed(error="of the request that came behind"), 2)
        sending = asyncio.create_task(page.deliver())
        while "watched" not in sent:
            await asyncio.sleep(0.001)
        sending.cancel()

    asyncio.run(asyncio.wait_for(delivered(), 10))
    assert sent == ["changed", "failed", "bigram", "watched"]
