"""espeak-ng from the outside: the child program is started, asked once, and read.

Holds the parent's side of :mod:`lipwright.schedule.say.espeak_child`, which is never
imported. The library comes from the wheel ``espeakng-loader`` (extra ``tts``) or else
from the system. What its phones and words mean for the text is not known here.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import InputError, LipwrightError, MissingExtraError

_CHILD = Path(__file__).with_name("espeak_child.py")
_SYSTEM_LIBRARIES = (
    "libespeak-ng.so.1",
    "libespeak-ng.1.dylib",
    "/opt/homebrew/lib/libespeak-ng.1.dylib",
    "/usr/local/lib/libespeak-ng.1.dylib",
    "C:\\Program Files\\eSpeak NG\\libespeak-ng.dll",
)
# The library keeps its data path in 160 bytes, together with what it appends.
_LONGEST_DATA_PATH = 120
_PATIENCE = 60.0  # seconds for any text; espeak-ng needs about 10 ms a second of speech
_PATIENCE_PER_CHARACTER = 0.01
# From 450 words a minute on the library compresses its own sound, and says the times of
# phones as they were before (espeak-ng 1.52, sonic).
_FASTEST = 449


class UnknownVoiceError(LookupError):
    """The library has no voice of that name; holds those that it has."""

    def __init__(self, voices: list[dict[str, Any]], variants: list[str]) -> None:
        super().__init__("no such voice")
        self.voices = voices
        self.variants = variants


@dataclass(frozen=True, slots=True, eq=False)
class Spoken:
    """What espeak-ng spoke.

    Parameters
    ----------
    samples : (N,) float32
        The sound, in -1..1.
    rate : int
        Samples per second.
    phones : tuple of (str, int, int)
        Label as the library writes it (IPA with stress, empty for a pause), first
        sample, and index of the character where its word begins. A phone lasts until
        the next one starts.
    language : str
        Of the voice, as the library names it.
    """

    samples: NDArray[np.float32]
    rate: int
    phones: tuple[tuple[str, int, int], ...]
    language: str


def speak(
    text: str,
    voice: str,
    *,
    rate: int,
    pitch: int | None,
    accept: Callable[[str], None] = lambda language: None,
    mnemonics: bool = False,
) -> Spoken:
    """Return the sound and phones of a text.

    Parameters
    ----------
    text : str
        What to speak.
    voice : str
        As the library names it.
    rate : int
        Words per minute.
    pitch : int or None
        0..99; None for the voice's own.
    accept : function, optional
        Called with the voice's language before it speaks; what it raises stops all.
    mnemonics : bool
        Whether ``[[ ]]`` in the text holds the library's own names of phonemes.

    Raises
    ------
    UnknownVoiceError
        If the library has no such voice.
    MissingExtraError
        If there is no library.
    InputError
        If the voice is a fast one by itself, and cannot be made this fast as well.
    LipwrightError
        If the child program fails.
    """
    request = {"task": "say", "text": text, "voice": voice, "pitch": pitch}
    request |= {"rate": min(rate, _FASTEST), "mnemonics": mnemonics}
    patience = _PATIENCE + _PATIENCE_PER_CHARACTER * len(text)
    samples_per_second, language = 0, ""
    sound = bytearray()
    phones: list[tuple[str, int, int]] = []
    for answer, pcm in _ask(request, patience):
        if "rate" in answer:
            samples_per_second, language = answer["rate"], answer["language"]
            accept(language)
        sound += pcm
        for label, sample, position in answer.get("phones", ()):
            phones.append((label, sample, position - 1))
    if any(after < before for (_, before, _), (_, after, _) in pairwise(phones)):
        raise InputError(
            f"rate {rate} with the voice {voice!r}: it loses its times",
            expected="fewer words per minute",
            cure="take a lower rate, or leave the +variant out",
        )
    samples = np.frombuffer(sound, "<i2").astype(np.float32)
    samples /= 32768
    return Spoken(samples, samples_per_second, tuple(phones), language)


def pronounce(words: list[str], voice: str) -> list[list[str]]:
    """Return the IPA labels of each word, as the library writes them."""
    request = {"task": "pronounce", "words": words, "voice": voice}
    result: list[list[str]] = []
    for answer, _ in _ask(request, _PATIENCE + 0.1 * len(words)):
        result += answer.get("phones", [])
    return result


def installed_voices() -> tuple[list[dict[str, Any]], list[str]]:
    """Return the library's voices (``name``, ``languages``, ``file``) and variants."""
    for answer, _ in _ask({"task": "voices"}, _PATIENCE):
        if "voices" in answer:
            return answer["voices"], answer["variants"]
    return [], []


def _ask(request: dict[str, Any], patience: float) -> Iterator[tuple[dict[str, Any], bytes]]:
    """Yield the child's answers, each with its sound; the child is gone afterwards."""
    command = [sys.executable, "-I", "-S", str(_CHILD)]
    with _libraries() as libraries, tempfile.TemporaryFile() as last_words:
        child = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=last_words
        )
        timer = threading.Timer(patience, child.kill)
        timer.start()
        finished = False
        try:
            assert child.stdin is not None
            assert child.stdout is not None
            with contextlib.suppress(BrokenPipeError):  # its last words say why
                child.stdin.write(json.dumps({**request, "libraries": libraries}).encode())
                child.stdin.close()
            for answer, pcm in _answers(child.stdout):
                _refuse(answer)
                finished = finished or "done" in answer
                yield answer, pcm
        finally:  # an error and Ctrl-C come here too
            timer.cancel()
            child.kill()
            child.wait()
            for pipe in (child.stdin, child.stdout):
                with contextlib.suppress(OSError):
                    pipe.close()  # type: ignore[union-attr]
        if not finished:
            raise _crash(child.returncode, last_words)


def _answers(stream: IO[bytes]) -> Iterator[tuple[dict[str, Any], bytes]]:
    for line in stream:
        try:
            answer = json.loads(line)
        except ValueError:  # cut off by a crash
            return
        yield answer, stream.read(2 * answer.get("samples", 0))


def _refuse(answer: dict[str, Any]) -> None:
    error = answer.get("error")
    if error == "voice":
        raise UnknownVoiceError(answer["voices"], answer["variants"])
    if error == "library":
        raise MissingExtraError.of("speech from text", "tts")
    if error is not None:
        raise LipwrightError(
            answer["found"], cure="install it again: pip install --force-reinstall espeakng-loader"
        )


def _crash(status: int, last_words: IO[bytes]) -> LipwrightError:
    last_words.seek(0)
    lines = last_words.read().decode("utf-8", "replace").strip().splitlines()
    return LipwrightError(
        f"espeak-ng's program ended early (status {status}): {lines[-1] if lines else 'no word'}",
        cure="try a shorter text, or another voice",
    )


@contextlib.contextmanager
def _libraries() -> Iterator[list[tuple[str, str | None]]]:
    """Give the libraries to try, as (path, path of the data)."""
    system: list[tuple[str, str | None]] = [(name, None) for name in _SYSTEM_LIBRARIES]
    if find_spec("espeakng_loader") is None:
        yield system
        return
    import espeakng_loader  # extra tts: only the paths are asked for, nothing is loaded

    library, data = espeakng_loader.get_library_path(), espeakng_loader.get_data_path()
    if len(os.fsencode(data)) <= _LONGEST_DATA_PATH:
        yield [(library, data), *system]
        return
    with tempfile.TemporaryDirectory(prefix="lipwright-") as folder:
        near = Path(folder) / "espeak-ng-data"
        try:
            near.symlink_to(data, target_is_directory=True)
        except OSError:  # Windows lets few users make links
            shutil.copytree(data, near)
        yield [(library, str(near)), *system]
