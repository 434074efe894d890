"""The child program: found, started, stopped, and its failures told."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import espeakng_loader
import pytest

from lipwright.errors import LipwrightError, MissingExtraError
from lipwright.schedule.say import espeak, say

CHILD = Path(espeak.__file__).with_name("espeak_child.py")

REFUSES = """
import sys
sys.stdin.read()
print('{"error": "start", "found": "x is broken"}')
"""


def pretend(monkeypatch: pytest.MonkeyPatch, folder: Path, program: str) -> None:
    path = folder / "child.py"
    path.write_text(program)
    monkeypatch.setattr(espeak, "_CHILD", path)


def test_the_child_needs_neither_lipwright_nor_numpy() -> None:
    code = f"import runpy, sys; runpy.run_path({str(CHILD)!r}); print(*sys.modules)"
    done = subprocess.run(
        [sys.executable, "-I", "-S", "-c", code], capture_output=True, text=True, check=True
    )
    assert not {"lipwright", "numpy", "msgspec"} & set(done.stdout.split())


def test_espeak_is_never_loaded_into_this_process() -> None:
    code = (
        "from lipwright.schedule.say import say; say('hello')\n"
        "import pathlib\n"
        "maps = pathlib.Path('/proc/self/maps')\n"
        "print(maps.read_text() if maps.exists() else '')"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "espeak" not in done.stdout


def test_a_long_data_path_is_brought_near(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    far = tmp_path / ("a" * 100) / ("b" * 100)
    far.mkdir(parents=True)
    link = far / "espeak-ng-data"
    try:
        link.symlink_to(espeakng_loader.get_data_path(), target_is_directory=True)
    except OSError:  # Windows lets few users make links
        shutil.copytree(espeakng_loader.get_data_path(), link)
    usual = say("hello")
    monkeypatch.setattr(espeakng_loader, "get_data_path", lambda: str(link))
    again = say("hello")
    assert again.phones == usual.phones


def test_without_any_library_the_cure_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    @contextmanager
    def none() -> Iterator[list[tuple[str, str | None]]]:
        yield [("no-such-library.so", None)]

    monkeypatch.setattr(espeak, "_libraries", none)
    with pytest.raises(MissingExtraError, match=r"pip install 'lipwright\[tts\]'"):
        say("hello")


def test_without_the_extra_the_systems_library_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(espeak, "find_spec", lambda name: None)
    monkeypatch.setattr(espeak, "_SYSTEM_LIBRARIES", ("no-such-library.so",))
    with pytest.raises(MissingExtraError, match="speech from text"):
        say("hello")


@pytest.mark.parametrize(
    ("program", "words"),
    [
        ("import sys; sys.stdin.read(); sys.exit('the dictionary is torn')", "dictionary is torn"),
        ("import os, signal; os.abort()", "ended early"),
        ("print('{\"rate\": 1')", "ended early"),
        (REFUSES, "x is broken. Install it again"),
    ],
)
def test_a_child_that_fails_is_an_error_with_its_last_words(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, program: str, words: str
) -> None:
    pretend(monkeypatch, tmp_path, program)
    with pytest.raises(LipwrightError, match=words):
        say("hello")


def test_a_child_that_hangs_is_ended(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    pretend(monkeypatch, tmp_path, "import time; time.sleep(60)")
    monkeypatch.setattr(espeak, "_PATIENCE", 0.2)
    with pytest.raises(LipwrightError, match="ended early"):
        say("hello")


def test_an_interrupt_ends_the_child(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    pretend(
        monkeypatch,
        tmp_path,
        "import sys, time; sys.stdin.read()\n"
        'print(\'{"rate": 1, "language": "en"}\', flush=True); time.sleep(60)',
    )
    started: list[subprocess.Popen[bytes]] = []

    class Popen(subprocess.Popen):  # type: ignore[type-arg]
        def __init__(self, *arguments: Any, **options: Any) -> None:
            super().__init__(*arguments, **options)
            started.append(self)

    def interrupt(language: str) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(subprocess, "Popen", Popen)
    with pytest.raises(KeyboardInterrupt):
        espeak.speak("hello", "en", rate=175, pitch=None, accept=interrupt)
    assert started[0].returncode is not None


def test_the_child_answers_a_text_that_fills_a_pipe() -> None:
    speech = say("a. " * 100 + os.linesep + "b " * 4000)
    assert len(speech.words) == 4100
