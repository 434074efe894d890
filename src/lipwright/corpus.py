"""What a corpus asks of a bigram set: texts and label files of any size in, coverage out.

Schedules and the bigram engine meet here, as in :mod:`lipwright.pipeline`; counting is
in :mod:`lipwright.engines.bigram.coverage`, speaking part after part in
:mod:`lipwright.schedule.parts`. Nothing of a line is kept once it is counted.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from lipwright.errors import LabelError, TextError
from lipwright.files import STANDARD_STREAM, decode_text, read_standard_input, text_blocks

if TYPE_CHECKING:
    from lipwright.engines.bigram.coverage import Coverage
    from lipwright.schedule.parts import Part
    from lipwright.speech import Speech

Progress = Callable[[float], None]


@dataclass(frozen=True, slots=True)
class Corpus:
    """What is counted.

    Parameters
    ----------
    text : str, optional
        Words, as people write them.
    text_files : sequence of path
        UTF-8 files with the same, of any size; ``"-"`` is standard input.
    labels : sequence of path
        Phone times that exist.
    voice : str
        Who says the texts, see :func:`lipwright.say`.
    each_line : bool
        Whether each line of a text is an utterance of its own.
    phone_set : str, optional
        The notation of the labels, where it is not clear.
    """

    text: str | None = None
    text_files: Sequence[str | Path] = ()
    labels: Sequence[str | Path] = ()
    voice: str = "en-us"
    each_line: bool = False
    phone_set: str | None = None

    @property
    def is_text(self) -> bool:
        """Whether there is anything to be spoken."""
        return self.text is not None or bool(self.text_files)


def coverage(
    bigram_set: str | Path | None = None,
    corpus: Corpus | None = None,
    *,
    overrides: str | Path | None = None,
    character: str | Path | None = None,
    reduction: str | Path | None = None,
    within_words: bool = False,
    silence: bool = True,
    by: Literal["count", "time"] = "count",
    progress: Progress | None = None,
) -> Coverage:
    """Return which pairs a corpus needs, and which of them a set has.

    Parameters
    ----------
    bigram_set : str or path, optional
        Else the character's, else English.
    corpus : Corpus, optional
        Without it every pair of the set's classes counts once.
    overrides : path, optional
        A file whose bigrams are counted as the set's own.
    character : str or path, optional
        Who speaks: what its file draws is counted too.
    reduction, within_words, silence, by
        See :func:`lipwright.engines.bigram.coverage.coverage`.
    progress : function, optional
        Called with the share of the texts that is done, 0..1.

    Raises
    ------
    InputError
        If the set or a file cannot be used.
    TextError
        If there is nothing to say, or no voice for it.
    LabelError
        If phones have no class in the set.

    Examples
    --------
    >>> found = coverage(corpus=Corpus("A map."))
    >>> [need.word for need in found.needs() if need.pair == ("bmp", "ah")]
    ['map']
    """
    from lipwright.casting import set_for
    from lipwright.engines.bigram import read_overrides
    from lipwright.engines.bigram.coverage import coverage as count

    of = set_for(bigram_set, character)
    lines = None if corpus is None else _Lines(corpus, progress)
    try:
        found = count(
            read_overrides(overrides, of) if overrides else of,
            lines,
            str(reduction) if reduction else None,
            within_words=within_words,
            silence=silence,
            by=by,
        )
    except LabelError as error:
        raise error.at(lines.where) if lines and lines.where else error from None
    return found if lines is None else replace(found, notes=tuple(lines.left_out))


@dataclass(slots=True)
class _Lines:
    """The corpus as speech, line after line; ``where`` is the label file at hand."""

    corpus: Corpus
    progress: Progress | None
    where: str = ""
    left_out: list[str] = field(default_factory=list)

    def __iter__(self) -> Iterator[Speech]:
        from lipwright.schedule.labels import speech_from_labels

        for path in self.corpus.labels:
            speech = speech_from_labels(Path(path), None, phone_set=self.corpus.phone_set)
            self.where = str(path)
            yield speech
            self.where = ""
        if self.corpus.is_text:
            yield from self._spoken()

    def _spoken(self) -> Iterator[Speech]:
        from lipwright.schedule.parts import Spoken

        for path in self.corpus.text_files:
            _check_text(path)
        spoke = False
        spoken = Spoken(_parts(self.corpus), self.corpus.voice, self._reporter())
        for speech in spoken:
            spoke = True
            yield speech
        if not spoke:
            names = ", ".join(map(str, self.corpus.text_files)) or "the text"
            raise TextError("nothing to say", where=names, expected="at least one word")
        self.left_out += spoken.left_out

    def _reporter(self) -> Callable[[int], None] | None:
        show = self.progress
        if show is None:
            return None
        total = max(_size(self.corpus), 1)
        return lambda done: show(min(done / total, 1.0))


def _parts(corpus: Corpus) -> Iterator[Part]:
    from lipwright.schedule.parts import parts

    yield from parts([corpus.text or ""], each_line=corpus.each_line)
    for path in corpus.text_files:
        name = "standard input" if str(path) == STANDARD_STREAM else str(path)
        yield from parts(_blocks(path), name, each_line=corpus.each_line)


def _blocks(path: str | Path) -> Iterable[str]:
    if str(path) == STANDARD_STREAM:
        return [decode_text(read_standard_input(), "standard input")]
    return text_blocks(path)


def _check_text(path: str | Path) -> None:
    """Refuse a file that is no text before minutes are spent on its beginning."""
    if str(path) != STANDARD_STREAM:
        for _ in text_blocks(path):
            pass


def _size(corpus: Corpus) -> int:
    """Return the bytes of all texts; what has no size (standard input) counts nothing."""
    files = [Path(path) for path in corpus.text_files if Path(path).is_file()]
    return len((corpus.text or "").encode()) + sum(path.stat().st_size for path in files)
