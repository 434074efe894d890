"""Sound files: any rate, depth and number of channels, read block by block.

The content decides, never the name: an MP3 called ``.wav`` is an MP3. Channels are
mixed to one as their mean, and high rates are brought down while reading, so that half
an hour of studio sound stays in bounded memory. Piped WAV files without a length are
read to their end; a file that ends too early gives what it has, and a note. Sound in
m4a and mp4 is decoded by a child process (:mod:`lipwright.sound_child`), because that
decoder brings GPL parts.
"""

from __future__ import annotations

import contextlib
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from lipwright.errors import InputError, MissingExtraError, SoundError
from lipwright.sound import Sound
from lipwright.sound_headers import SteadyFile, looks_like_media, wav_data

KINDS = "WAV, FLAC, Ogg (Vorbis or Opus), MP3, AIFF, m4a or mp4"
_CUT = "the file is broken or was cut"
_BLOCK = 1 << 13
_IN_MEMORY = 1 << 26

Samples = NDArray[np.float32]


@dataclass(slots=True)
class _Source:
    """Mono blocks at the file's own rate; notes may grow until the last block."""

    rate: int
    blocks: Iterator[Samples]
    notes: list[str] = field(default_factory=list)


LOWEST_RATE = 2000


def read_sound(path: str | Path, *, highest_rate: int = 48000) -> Sound:
    """Return the sound in a file, as one channel.

    Parameters
    ----------
    path : str or Path
        The file; ``"-"`` reads standard input.
    highest_rate : int
        Files with more samples per second are brought down to this many.

    Returns
    -------
    Sound
        Mono float32 in -1..1. Floats that go beyond are scaled as a whole, never clipped.
        Its ``notes`` say what was mended.

    Raises
    ------
    SoundError
        If the file is empty, holds no samples, is of no known kind, or has samples that
        are not finite.
    InputError
        If the file is missing, a folder, or may not be read.
    MissingExtraError
        If it is m4a or mp4 and the extra ``av`` is not installed.
    """
    where = "standard input" if str(path) == "-" else str(path)
    held = bytearray()  # grows in place: joining blocks at the end would need twice the memory
    with contextlib.ExitStack() as stack:
        source = _source(stack.enter_context(_opened(path, where)), where, stack)
        if source.rate < LOWEST_RATE:
            raise SoundError(
                f"{source.rate} samples per second",
                where=where,
                expected=f"{LOWEST_RATE} or more, to hear speech",
            )
        rate = min(source.rate, highest_rate)
        blocks = _finite(source.blocks, source.rate, where)
        for block in blocks if rate == source.rate else _lowered(blocks, source.rate, rate):
            held += block.tobytes()
    if not held:
        raise SoundError("0 samples", where=where, expected="a file with sound in it")
    return _within_one(np.frombuffer(held, dtype=np.float32), rate, source.notes)


def _within_one(samples: Samples, rate: int, notes: list[str]) -> Sound:
    # Decoders and resampling pass 1 by a little, files of floats by anything.
    peak = max(float(samples.max()), -float(samples.min()))
    if peak > 1.0:
        samples /= np.float32(peak)
    if peak > 2.0:
        notes = [*notes, f"its samples reach {peak:.4g}: scaled as a whole to fit -1..1"]
    return Sound(samples, rate, tuple(notes))


def _finite(blocks: Iterator[Samples], rate: int, where: str) -> Iterator[Samples]:
    passed = 0
    for block in blocks:
        bad = np.flatnonzero(~np.isfinite(block))
        if len(bad):
            raise SoundError(
                f"the sample at {(passed + bad[0]) / rate:.4f} s is {block[bad[0]]}",
                where=where,
                expected="finite numbers",
                cure="export it again from the program that made it",
            )
        passed += len(block)
        yield block


def _lowered(blocks: Iterator[Samples], rate: int, to: int) -> Iterator[Samples]:
    import soxr  # late: only high rates need it

    stream = soxr.ResampleStream(rate, to, 1, dtype="float32")
    for block in blocks:
        yield stream.resample_chunk(block)
    yield stream.resample_chunk(np.zeros(0, dtype=np.float32), last=True)


@contextlib.contextmanager
def _opened(path: str | Path, where: str) -> Iterator[IO[bytes]]:
    """Give a file that can be sought in: what comes through a pipe is kept beside first."""
    with contextlib.ExitStack() as stack:
        piped = str(path) == "-"
        if piped and sys.stdin is None:
            raise InputError("is closed", where="standard input", cure="pipe a sound into it")
        file: IO[bytes] = sys.stdin.buffer if piped else stack.enter_context(_open(path, where))
        if piped or not file.seekable():
            pipe, file = file, stack.enter_context(tempfile.SpooledTemporaryFile(_IN_MEMORY))
            shutil.copyfileobj(pipe, file)
        if file.seek(0, 2) == 0:
            raise SoundError("is empty", where=where, expected="a sound file")
        file.seek(0)
        yield file


def _open(path: str | Path, where: str) -> IO[bytes]:
    try:
        return Path(path).open("rb")
    except FileNotFoundError:
        raise InputError("no such file", where=where, cure="check the path") from None
    except OSError as error:
        if Path(path).is_dir():
            raise InputError("is a folder", where=where, expected="a sound file") from None
        raise InputError(f"cannot be read ({error.strerror})", where=where) from None
    except ValueError as error:
        raise InputError(str(error), where=repr(where), expected="a path") from None


def _source(file: IO[bytes], where: str, stack: contextlib.ExitStack) -> _Source:
    if looks_like_media(file.read(16)):
        return _from_child(file, where, stack)
    data = wav_data(file)
    file.seek(0)
    source = _from_soundfile(SteadyFile(file, data), where, stack)
    if data is not None and data.declared is not None and data.declared > data.present:
        share = data.present / data.declared
        source.notes.append(f"the file was cut: it holds {share:.0%} of what its header says")
    return source


def _from_soundfile(file: SteadyFile, where: str, stack: contextlib.ExitStack) -> _Source:
    import soundfile  # late: it loads a library

    class Forward(soundfile.SoundFile):  # type: ignore[misc]
        def seekable(self) -> bool:
            # Else soundfile seeks after each block, and MP3 breaks at each seam.
            return False

    try:
        opened = stack.enter_context(Forward(file))
    except (soundfile.LibsndfileError, TypeError) as error:
        raise SoundError(_why_not(file, str(error)), where=where, expected=KINDS) from None
    source = _Source(opened.samplerate, iter(()))
    source.blocks = _read_on(opened, where, source.notes)
    return source


def _why_not(file: SteadyFile, error: str) -> str:
    if "malformed" in error or "chunk" in error:
        return "is broken: its header is not whole"
    file.seek(0)
    head = file.read(256)
    is_text = not any(byte < 9 or 13 < byte < 32 for byte in head)
    return "is text, not sound" if is_text else "is not a sound file that can be read"


def _read_on(opened: Any, where: str, notes: list[str]) -> Iterator[Samples]:
    import soundfile

    passed = 0
    try:
        while len(block := opened.read(_BLOCK, dtype="float32", always_2d=True)):
            passed += len(block)
            yield block[:, 0] if block.shape[1] == 1 else block.mean(axis=1, dtype=np.float32)
    except soundfile.LibsndfileError as error:
        if not passed:
            raise SoundError(f"cannot be decoded ({error})", where=where) from None
    if passed < 0.99 * opened.frames:
        notes.append(f"{_CUT}: {passed / opened.frames:.0%} of it could be read")


def _from_child(file: IO[bytes], where: str, stack: contextlib.ExitStack) -> _Source:
    if importlib.util.find_spec("av") is None:
        raise MissingExtraError.of(f"{where}: sound in m4a, mp4 and other media", "av")
    os.lseek(file.fileno(), 0, os.SEEK_SET)  # the child shares the place, not the buffer
    complaints: IO[bytes] = stack.enter_context(tempfile.TemporaryFile())  # noqa: SIM115
    child = stack.enter_context(
        subprocess.Popen(
            [sys.executable, "-P", str(Path(__file__).with_name("sound_child.py"))],
            stdin=file.fileno(),
            stdout=subprocess.PIPE,
            stderr=complaints,
        )
    )
    assert child.stdout is not None
    head = child.stdout.readline()
    if not head:
        child.wait()
        complaints.seek(0)
        last = complaints.read().decode(errors="replace").strip().rpartition("\n")[2]
        raise SoundError(f"cannot be decoded ({last})", where=where, expected=KINDS)
    source = _Source(json.loads(head)["rate"], iter(()))
    source.blocks = _from_pipe(child, source.notes)
    return source


def _from_pipe(child: subprocess.Popen[bytes], notes: list[str]) -> Iterator[Samples]:
    assert child.stdout is not None
    while data := child.stdout.read(4 * _BLOCK):
        yield np.frombuffer(data[: len(data) // 4 * 4], dtype="<f4")
    if child.wait() != 0:
        notes.append(f"{_CUT}: what comes before was read")
