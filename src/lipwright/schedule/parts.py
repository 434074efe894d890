"""Texts of any size as speech: cut at ends of sentences, spoken part after part.

Counting needs the phones of a whole script or book, not its sound. So a text is read in
blocks, each part is spoken on its own (:mod:`lipwright.schedule.say`), several at a
time, and its sound is dropped at once: memory does not grow with the text. A part that
holds something the voice cannot read is taken sentence by sentence, and what is left
out is named. Neighbours on both sides of a cut inside a sentence (only where one is
longer than a part) are not counted as neighbours.
"""

from __future__ import annotations

import os
import re
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from itertools import islice, pairwise

from lipwright.errors import TextError
from lipwright.schedule.say import say
from lipwright.speech import Speech

PART = 3000
"""Characters of a part: about three minutes of speech, under a second of work."""
_SENTENCE_END = re.compile(r"(?:[.!?…:;][\"'”’»)\]]*\s+)|(?:[。！？।॥؟۔]\s*)|(?:\n\s*\n)")
_LINE_END = re.compile(r"\n")
_SPACE = re.compile(r"\s+")
_BETWEEN_LINES = re.compile(r"\s*\n\s*")


@dataclass(frozen=True, slots=True)
class Part:
    """A piece of a text.

    Parameters
    ----------
    text : str
        Whole sentences, or whole lines.
    source : str
        The file it is from; empty for a text that was typed.
    line : int
        In which of its lines it begins, from 1.
    """

    text: str
    source: str = ""
    line: int = 1

    @property
    def where(self) -> str:
        """The place, for people."""
        return f"{self.source}, line {self.line}" if self.source else "the text"


def parts(
    blocks: Iterable[str], source: str = "", *, each_line: bool = False, size: int = PART
) -> Iterator[Part]:
    """Cut a text into parts to be spoken.

    Parameters
    ----------
    blocks : iterable of str
        The text, in pieces of any length.
    source : str
        Names it in errors.
    each_line : bool
        Whether each line is an utterance of its own, with silence around it, as in a
        script of game lines; else a single line break is a space.
    size : int
        Characters of a part.
    """
    held, line = "", 1
    for block in blocks:
        held += block
        start = 0
        while len(held) - start > size:
            end = _cut(held, start, start + size, each_line=each_line)
            yield from _part(held[start:end], source, line, each_line=each_line)
            line += held.count("\n", start, end)
            start = end
        held = held[start:]
    yield from _part(held, source, line, each_line=each_line)


def _cut(text: str, start: int, end: int, *, each_line: bool) -> int:
    """Return where to cut ``start``..``end``: the last good place, or else the end."""
    for pattern in (_LINE_END,) if each_line else (_SENTENCE_END, _SPACE):
        places = [found.end() for found in pattern.finditer(text, start, end)]
        if places:
            return places[-1]
    return end


def _part(text: str, source: str, line: int, *, each_line: bool) -> Iterator[Part]:
    if any(map(str.isalnum, text)):
        skipped = len(text) - len(text.lstrip())
        line += text.count("\n", 0, skipped)
        text = text.strip()
        yield Part(_BETWEEN_LINES.sub("\n\n", text) if each_line else text, source, line)


_Outcome = tuple[list[Speech], list[TextError]]


@dataclass(slots=True)
class Spoken:
    """Parts as speech without sound, in order; iterate over it once.

    Parameters
    ----------
    parts : iterable of Part
    voice : str
        See :func:`lipwright.schedule.say.say`.
    report : function, optional
        Called with the bytes of text, as UTF-8, that are done.
    workers : int, optional
        How many parts are spoken at a time; one per processor where it is not given.
    left_out : list of str
        Sentences that the voice could not read: where, and why.
    """

    parts: Iterable[Part]
    voice: str = "en-us"
    report: Callable[[int], None] | None = None
    workers: int | None = None
    left_out: list[str] = field(default_factory=list)

    def __iter__(self) -> Iterator[Speech]:
        """Yield the speech of each part.

        Raises
        ------
        TextError
            If the first part cannot be read at all.
        """
        done, spoke = 0, False
        for part, (speeches, errors) in self._worked():
            if errors and not (speeches or spoke):
                raise errors[0].at(part.where) if part.source else errors[0]
            self.left_out += [f"{part.where}: {error.found}" for error in errors]
            spoke = spoke or bool(speeches)
            yield from speeches
            done += len(part.text.encode())
            if self.report is not None:
                self.report(done)

    def _worked(self) -> Iterator[tuple[Part, _Outcome]]:
        """Speak ahead, a few parts at a time; results come in order."""
        count = self.workers or os.cpu_count() or 1
        parts = iter(self.parts)
        pool = ThreadPoolExecutor(count)
        ahead: deque[tuple[Part, Future[_Outcome]]] = deque()
        try:
            ahead += [(p, pool.submit(_speak, p.text, self.voice)) for p in islice(parts, count)]
            while ahead:
                part, future = ahead.popleft()
                outcome = future.result()
                ahead += [(p, pool.submit(_speak, p.text, self.voice)) for p in islice(parts, 1)]
                yield part, outcome
        finally:  # an error and Ctrl-C come here too
            pool.shutdown(wait=True, cancel_futures=True)


def _speak(text: str, voice: str) -> _Outcome:
    """Return a part's speech; where it cannot be read, that of the sentences that can."""
    try:
        return [_silent(text, voice)], []
    except TextError as error:
        sentences = _sentences(text)
        if len(sentences) == 1 or not _can_speak(voice):
            return [], [error]
    speeches: list[Speech] = []
    errors: list[TextError] = []
    for sentence in sentences:
        try:
            speeches.append(_silent(sentence, voice))
        except TextError as error:
            errors.append(error)
    return speeches, errors


def _can_speak(voice: str) -> bool:
    """Whether it is the text that is at fault, not the voice."""
    try:
        say("1", voice=voice)
    except TextError:
        return False
    return True


def _sentences(text: str) -> list[str]:
    edges = [0, *(found.end() for found in _SENTENCE_END.finditer(text)), len(text)]
    pieces = (text[a:b] for a, b in pairwise(edges))
    return [piece for piece in pieces if any(map(str.isalnum, piece))]


def _silent(text: str, voice: str) -> Speech:
    return replace(say(text, voice=voice), sound=None)
