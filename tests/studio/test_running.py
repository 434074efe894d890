"""The command: it opens, is killed in the middle of an edit, goes on, and ends when told to."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

from tests.studio.live import PATIENCE, Live
from tests.studio.test_server import DRAW

INTERRUPT = getattr(signal, "CTRL_C_EVENT", signal.SIGINT)
ROOT = Path(__file__).parents[2]


@contextmanager
def running(desk: Path, *arguments: str) -> Iterator[tuple[subprocess.Popen[str], list[str]]]:
    """The command line's studio, and what it said until it was open."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "src"), "PYTHONUNBUFFERED": "1"}
    process = subprocess.Popen(
        [sys.executable, "-m", "lipwright", "studio", "--no-browser", *arguments],
        cwd=desk,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    watchdog = threading.Timer(PATIENCE, process.kill)
    watchdog.start()
    try:
        assert process.stdout is not None
        yield process, [process.stdout.readline()]
    finally:
        watchdog.cancel()
        if process.poll() is None:
            process.kill()
        process.communicate()


def where(said: list[str]) -> Live:
    link = next(word for word in said[0].split() if word.startswith("http"))
    parts = urlsplit(link)
    assert parts.hostname == "127.0.0.1"
    assert parts.port is not None
    return Live(parts.port, parse_qs(parts.query)["token"][0])


def test_killed_in_the_middle_of_an_edit_it_goes_on_where_it_was(desk: Path) -> None:
    with running(desk, "english", "low.json") as (process, said):
        first = where(said)
        with first.page() as tab:
            session = tab.ask("start", "hello").session
            tab.ask("edit", "changed", change=DRAW, merge="drag")
            moved = {**DRAW, "keys": [[0, 0], [0.4, 0.8], [1, 0]]}
            tab.ask("edit", "changed", change=moved, merge="drag")
            tab.send("edit", change={**DRAW, "keys": [[0, 0], [0.4, 0.9], [1, 0]]}, merge="drag")
            process.kill()
            process.wait(PATIENCE)
    with running(desk, "english", "low.json") as (_, said):
        again = where(said)
        assert again == first
        with again.page() as tab:
            stranger = tab.ask("start", "hello")
            assert stranger.draft.steps == 1
            assert stranger.draft.summary == "draw open of f-ah"
            hello = tab.ask("start", "hello", session=session)
            assert hello.draft is None
            assert hello.history.undo_steps == 1
            tab.ask("watch", "watched", pair=["f", "ah"])
            shown: Any = tab.ask("edit", "changed", change={**DRAW, "pose": "wide"})
            height = tab.hear("bigram").override_curves["open"][1][1]
            assert height in (0.8, 0.9)
            assert shown.history.undo_steps == 2


def test_it_ends_when_it_is_interrupted_and_says_what_is_kept(desk: Path) -> None:
    with running(desk, "english") as (process, said):
        with where(said).page() as tab:
            tab.ask("edit", "changed", change=DRAW)
            process.send_signal(INTERRUPT)
            out, errors = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0
        assert "what was not saved is kept" in out
        assert errors == ""


def test_the_same_opened_twice_is_one_studio(desk: Path) -> None:
    with running(desk, "english") as (_, said), running(desk, "english") as (second, again):
        second.wait(PATIENCE)
        assert second.returncode == 0
        assert again[0].startswith("The studio is open already: ")
        assert where(again) == where(said)


def test_a_port_that_is_taken_is_said(desk: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        with running(desk, "english", "--port", port) as (process, _):
            _, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1
    assert errors.startswith(f"lipwright: port {port} is taken")
    assert "--port" in errors
    assert errors.count("\n") == 1


def test_its_own_port_is_free_again_at_once(desk: Path) -> None:
    with running(desk, "english") as (process, said):
        port = where(said).port
        process.kill()
        process.wait(PATIENCE)
    with running(desk, "mine.json", "--port", str(port)) as (_, said):
        assert where(said).port == port
