"""A program of its own that speaks through espeak-ng; Lipwright starts it and never imports it.

espeak-ng is under the GPL, so it stays in this process. The program uses nothing but
the standard library: it reads one request as JSON from standard input and answers on
standard output with lines of JSON. After a line with ``samples``, that many 16-bit
samples follow as they are. One process serves one request: espeak's state is global,
and a line spoken second differs by fractions of a millisecond from one spoken first.

Requests: ``{"task": "say", "text", "voice", "rate", "pitch", "mnemonics"}``,
``{"task": "pronounce", "words", "voice"}``, ``{"task": "voices"}``; each with
``libraries``, pairs of a library's path and its data's path (or null), tried in order.
"""

from __future__ import annotations

import ctypes
import json
import sys
from pathlib import Path
from typing import Any

Library = tuple[str, "str | None"]

# From speak_lib.h, the library's public interface.
_RETRIEVAL = 1  # the sound comes to the callback
_PHONEME_EVENTS, _PHONEME_IPA, _DONT_EXIT = 0x0001, 0x0002, 0x8000
_UTF8, _MNEMONICS, _END_PAUSE = 0x0001, 0x0100, 0x1000
_RATE, _PITCH = 1, 3
_EVENT_END, _EVENT_WORD, _EVENT_PHONEME = 0, 1, 7
_BUFFER_MS = 200
_AS_IPA = 0x02
_SEPARATOR = "_"


class _Id(ctypes.Union):
    # An IPA label may fill all eight bytes, without a terminator.
    _fields_ = (("number", ctypes.c_int), ("name", ctypes.c_char_p), ("string", ctypes.c_char * 8))


class _Event(ctypes.Structure):
    _fields_ = (
        ("type", ctypes.c_int),
        ("unique_identifier", ctypes.c_uint),
        ("text_position", ctypes.c_int),
        ("length", ctypes.c_int),
        ("audio_position", ctypes.c_int),
        ("sample", ctypes.c_int),
        ("user_data", ctypes.c_void_p),
        ("id", _Id),
    )


class _Voice(ctypes.Structure):
    _fields_ = (
        ("name", ctypes.c_char_p),
        ("languages", ctypes.c_void_p),
        ("identifier", ctypes.c_char_p),
        ("gender", ctypes.c_ubyte),
        ("age", ctypes.c_ubyte),
        ("variant", ctypes.c_ubyte),
        ("unused", ctypes.c_ubyte),
        ("score", ctypes.c_int),
        ("spare", ctypes.c_void_p),
    )


_Callback = ctypes.CFUNCTYPE(
    ctypes.c_int, ctypes.POINTER(ctypes.c_short), ctypes.c_int, ctypes.POINTER(_Event)
)


class Refused(Exception):
    """What cannot be done: the answer that says so."""

    def __init__(self, error: str, **more: Any) -> None:
        super().__init__(error)
        self.answer = {"error": error, **more}


def answer(value: dict[str, Any], pcm: bytes = b"") -> None:
    """Write one answer, and the sound that belongs to it."""
    sys.stdout.buffer.write(json.dumps(value).encode("ascii") + b"\n" + pcm)


class Espeak:
    """The library, started once; ``rate`` is in samples per second."""

    def __init__(self, libraries: list[Library]) -> None:
        self.library, data = _load(libraries)
        self._declare()
        options = _PHONEME_EVENTS | _PHONEME_IPA | _DONT_EXIT
        path = None if data is None else data.encode(sys.getfilesystemencoding())
        self.rate = self.library.espeak_Initialize(_RETRIEVAL, _BUFFER_MS, path, options)
        if self.rate <= 0:
            raise Refused("start", found=f"espeak-ng does not start with its data in {data}")

    def _declare(self) -> None:
        library, c = self.library, ctypes
        library.espeak_Initialize.argtypes = (c.c_int, c.c_int, c.c_char_p, c.c_int)
        library.espeak_Info.argtypes = (c.POINTER(c.c_char_p),)
        library.espeak_Info.restype = c.c_char_p
        library.espeak_SetVoiceByName.argtypes = (c.c_char_p,)
        library.espeak_SetParameter.argtypes = (c.c_int, c.c_int, c.c_int)
        library.espeak_SetSynthCallback.argtypes = (_Callback,)
        library.espeak_Synth.argtypes = (
            *(c.c_char_p, c.c_size_t, c.c_uint, c.c_int, c.c_uint, c.c_uint),
            *(c.POINTER(c.c_uint), c.c_void_p),
        )
        library.espeak_ListVoices.argtypes = (c.c_void_p,)
        library.espeak_ListVoices.restype = c.POINTER(c.POINTER(_Voice))
        library.espeak_GetCurrentVoice.restype = c.POINTER(_Voice)
        library.espeak_TextToPhonemes.argtypes = (c.POINTER(c.c_void_p), c.c_int, c.c_int)
        library.espeak_TextToPhonemes.restype = c.c_char_p

    def info(self) -> tuple[str, Path]:
        """Return the library's version and the folder of its data."""
        path = ctypes.c_char_p()
        version = self.library.espeak_Info(ctypes.byref(path))
        folder = (path.value or b"").decode(sys.getfilesystemencoding())
        return version.decode("utf-8", "replace"), Path(folder)

    def choose_voice(self, voice: str) -> str:
        """Take a voice by its name, language or file (``+variant``); return its language."""
        _, _, variant = voice.partition("+")
        # The library takes an unknown variant, and a voice that cannot speak, in silence.
        known = not variant or (self.info()[1] / "voices" / "!v" / variant).is_file()
        if known and "\0" not in voice:
            found = self.library.espeak_SetVoiceByName(voice.encode()) == 0
            current = self.library.espeak_GetCurrentVoice()
            languages = _languages(current.contents.languages) if found else []
            if _has_dictionary(languages, self.dictionaries()):
                return languages[0]
        raise Refused("voice", voices=self.voices(), variants=self.variants())

    def dictionaries(self) -> set[str]:
        """Return the names of the dictionaries that came with the library."""
        return {path.name for path in self.info()[1].glob("*_dict")}

    def voices(self) -> list[dict[str, Any]]:
        """Return every voice: its name, its languages (best first) and its file."""
        dictionaries = self.dictionaries()
        listed = self.library.espeak_ListVoices(None)
        result: list[dict[str, Any]] = []
        for pointer in iter(_pointers(listed)):
            voice = pointer.contents
            languages = _languages(voice.languages)
            if _has_dictionary(languages, dictionaries):
                name, file = voice.name.decode(), voice.identifier.decode()
                result.append({"name": name, "languages": languages, "file": file})
        return result

    def variants(self) -> list[str]:
        """Return the names that may stand after ``+`` in a voice's name."""
        folder = self.info()[1] / "voices" / "!v"
        return sorted(path.name for path in folder.iterdir()) if folder.is_dir() else []

    def say(self, text: str, rate: int, pitch: int | None, *, mnemonics: bool) -> None:
        """Speak: one answer per stretch of sound, with the phones and words in it."""
        self.library.espeak_SetParameter(_RATE, rate, 0)
        if pitch is not None:
            self.library.espeak_SetParameter(_PITCH, pitch, 0)
        callback = _Callback(_take)
        self.library.espeak_SetSynthCallback(callback)
        data = text.encode() + b"\0"
        flags = _UTF8 | _END_PAUSE | (_MNEMONICS if mnemonics else 0)
        if self.library.espeak_Synth(data, len(data), 0, 1, 0, flags, None, None) != 0:
            raise Refused("synth", found="espeak-ng does not speak this text")
        self.library.espeak_Synchronize()

    def pronounce(self, word: str) -> list[str]:
        """Return the IPA labels of one word."""
        text = ctypes.create_string_buffer(word.encode())
        rest = ctypes.c_void_p(ctypes.addressof(text))
        mode = _AS_IPA | ord(_SEPARATOR) << 8
        result: list[str] = []
        while rest.value:
            part = self.library.espeak_TextToPhonemes(ctypes.byref(rest), _UTF8, mode)
            result += part.decode("utf-8", "replace").replace(" ", _SEPARATOR).split(_SEPARATOR)
        return [label for label in result if label]


def _take(wave: Any, count: int, events: Any) -> int:
    phones: list[tuple[str, int, int]] = []
    words: list[tuple[int, int, int]] = []
    for event in iter(_events(events)):
        if event.type == _EVENT_PHONEME:
            label = bytes(event.id.string).decode("utf-8", "ignore")
            phones.append((label, event.sample, event.text_position))
        elif event.type == _EVENT_WORD:
            words.append((event.text_position, event.length, event.sample))
    pcm = ctypes.string_at(wave, 2 * count) if count > 0 else b""
    if pcm or phones or words:
        try:
            answer({"samples": count, "phones": phones, "words": words}, pcm)
        except OSError:  # nobody listens any more
            return 1
    return 0


def _events(events: Any) -> Any:
    index = 0
    while events[index].type != _EVENT_END:
        yield events[index]
        index += 1


def _pointers(pointers: Any) -> Any:
    index = 0
    while pointers[index]:
        yield pointers[index]
        index += 1


def _languages(address: int) -> list[str]:
    result = []
    while ctypes.c_ubyte.from_address(address).value:  # a priority, then the name
        name = ctypes.string_at(address + 1)
        result.append(name.decode())
        address += 2 + len(name)
    return result


def _has_dictionary(languages: list[str], dictionaries: set[str]) -> bool:
    # Some voices are listed whose dictionary is not shipped: they speak nothing.
    names = {language.split("-")[0] for language in languages} | set(languages)
    return any(f"{name}_dict" in dictionaries for name in names)


def _load(libraries: list[Library]) -> tuple[Any, str | None]:
    for path, data in libraries:
        try:
            return ctypes.CDLL(path), data
        except OSError:
            continue
    raise Refused("library")


def main() -> int:
    """Serve the one request on standard input."""
    request = json.loads(sys.stdin.buffer.read())
    try:
        espeak = Espeak(request["libraries"])
        if request["task"] == "voices":
            answer({"voices": espeak.voices(), "variants": espeak.variants()})
            return 0
        language = espeak.choose_voice(request["voice"])
        if request["task"] == "say":
            answer({"rate": espeak.rate, "language": language})
            sys.stdout.buffer.flush()
            mnemonics = request["mnemonics"]
            espeak.say(request["text"], request["rate"], request["pitch"], mnemonics=mnemonics)
        else:
            answer({"phones": [espeak.pronounce(word) for word in request["words"]]})
        answer({"done": True})
    except Refused as refused:
        answer(refused.answer)
    sys.stdout.buffer.flush()
    return 0


if __name__ == "__main__":
    sys.exit(main())
