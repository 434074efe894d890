"""Studios to test with: small sets, lines from labels, a state folder that is thrown away."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from lipwright.engines.bigram import load_set
from lipwright.engines.bigram.set_text import set_bytes
from lipwright.sound import Sound
from lipwright.studio.asking import Reply, Studio
from lipwright.studio.messages import Answer, Request
from lipwright.studio.opening import Given
from lipwright.studio.page_views import Watcher
from lipwright.studio.running import open_session
from lipwright.studio.session import Session

LOW = """{"format": "lipwright/speech", "version": 1, "phone_set": "arpabet", "phones": [
["sil", 0, 0.1], ["f", 0.1, 0.2], ["ae", 0.2, 0.35], ["t", 0.35, 0.45], ["m", 0.45, 0.55],
["ae", 0.55, 0.7], ["p", 0.7, 0.8], ["l", 0.8, 0.9], ["ow", 0.9, 1.2], ["sil", 1.2, 1.4]],
"words": [["fat", 0.1, 0.45], ["map", 0.45, 0.8], ["low", 0.8, 1.2]]}
"""
"""A line without a sound: fat map low."""


def sound(seconds: float = 1.4, rate: int = 16000) -> Sound:
    """A hum that swells."""
    time = np.arange(int(seconds * rate)) / rate
    return Sound((0.3 * np.sin(2 * np.pi * 120 * time) * time / seconds).astype(np.float32), rate)


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a set, a line and its sound, and a state folder beside it."""
    monkeypatch.setenv("LIPWRIGHT_STATE", str(tmp_path / "state"))
    folder = tmp_path / "desk"
    folder.mkdir()
    monkeypatch.chdir(folder)
    (folder / "mine.json").write_bytes(set_bytes(load_set("english")))
    (folder / "low.json").write_text(LOW, "utf-8")
    (folder / "low.wav").write_bytes(sound().wav_bytes())
    return folder


def opened(*names: str, character: str = "") -> Session:
    """A session with files of the working folder."""
    return open_session(Given(names, character))


def talk(session: Session) -> tuple[Studio, Watcher]:
    """What answers a page."""
    return Studio(session), Watcher(session)


def ask(studio: Studio, watcher: Watcher, request: Request) -> tuple[Answer, ...]:
    """All answers to a request; long work is done at once."""
    reply: Reply = studio.ask(watcher, request)
    if reply.job is not None:
        reply = studio.finish(reply.job, reply.job.work(lambda share: None))
    news: tuple[Answer, ...] = ()
    if reply.changed:
        news = (studio.board.news(), *watcher.news())
    return (*reply.own, *reply.everyone, *news)
