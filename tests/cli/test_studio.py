"""``lipwright studio``: what is named wrongly is said in one line; help is quick."""

from __future__ import annotations

import builtins
import os
import sys
from pathlib import Path
from typing import Any

import pytest

from lipwright.cli import main
from tests.studio.made import desk

__all__ = ["desk"]


@pytest.fixture(autouse=True)
def never_open(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing here may get as far as a server."""
    monkeypatch.setattr("asyncio.run", lambda *_: pytest.fail("a studio was opened"))
    monkeypatch.setattr("webbrowser.open", lambda *_: pytest.fail("a page was opened"))


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["klingon"], 1, "klingon: no such set, line or character; expected a set (crab, english"),
        (["gone.wav"], 1, "gone.wav: no such file"),
        (["gone.json"], 1, "gone.json: no such file"),
        (["broken.json"], 1, "broken.json"),
        (["list.json"], 1, "list.json"),
        (["strange.json"], 1, "'someone/else'"),
        (["notes.txt"], 1, "notes.txt: cannot be opened here"),
        (["quiet"], 1, "quiet.wav"),
        (["empty"], 1, "empty: no sounds or labels in it"),
        (["english", "mine.json"], 1, "a second set: english and mine.json"),
        (["low.json", "other.json", "some.edits.json"], 1, "edits of which line?"),
        (["english", "--character", "nobody"], 1, "no character 'nobody'"),
        (["english", "--preset", "brisk"], 1, "no preset 'brisk'"),
        (["english", "--say", "  "], 1, "no words to say"),
        (["english", "--text", "hello"], 2, "--text goes with one sound"),
        (["low.wav", "--text", "hello", "--labels", "low.json"], 2, "not both"),
        (["--port", "99999"], 2, "99999"),
        (["half.json"], 1, "bigram f-ah"),
    ],
)
def test_bad_input(
    desk: Path,
    capsys: pytest.CaptureFixture[str],
    arguments: list[str],
    status: int,
    words: str,
) -> None:
    (desk / "broken.json").write_text("{", "utf-8")
    (desk / "list.json").write_text("[]", "utf-8")
    (desk / "strange.json").write_text('{"format": "someone/else"}', "utf-8")
    (desk / "notes.txt").write_text("hello", "utf-8")
    (desk / "empty").mkdir()
    (desk / "other.json").write_text((desk / "low.json").read_text("utf-8"), "utf-8")
    (desk / "some.edits.json").write_text(
        '{"format": "lipwright/edits", "version": 1, "edits": []}', "utf-8"
    )
    (desk / "half.json").write_text(
        '{"format": "lipwright/bigram-set", "version": 1, "name": "half", "base": "english", '
        '"bigrams": [{"pair": ["f", "ah"], "curves": {"open": [[0, 0.5], [1, 0]]}}]}',
        "utf-8",
    )
    (desk / "quiet").mkdir()
    (desk / "quiet" / "quiet.wav").write_bytes(b"RIFF")
    assert main(["studio", "--no-browser", *arguments]) == status
    told = capsys.readouterr().err
    assert words in told
    if status == 1:
        assert told.startswith("lipwright: ")
        assert told.count("\n") == 1
    assert not any((desk.parent / "state").rglob("journal.jsonl"))


def test_without_the_extra_the_line_to_type_is_said(
    desk: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    real = builtins.__import__

    def without(name: str, *rest: Any) -> Any:
        if name.split(".")[0] in ("uvicorn", "starlette"):
            raise ImportError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    assert main(["studio", "--no-browser"]) == 1
    assert "pip install 'lipwright[studio]'" in capsys.readouterr().err


def test_help_brings_no_server_and_no_engine() -> None:
    import subprocess

    code = (
        "import sys; from lipwright.cli import main; main(['studio', '--help']); "
        "print([m for m in ('numpy', 'starlette', 'uvicorn', 'msgspec') if m in sys.modules])"
    )
    run = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=os.environ
    )
    assert run.stdout.splitlines()[-1] == "[]"
    assert "--no-browser" in run.stdout
