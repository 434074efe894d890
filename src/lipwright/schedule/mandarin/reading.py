"""How Chinese text is read: characters become syllables with pypinyin (extra ``mandarin``).

Characters that are read in several ways follow the words that they stand in (银行 háng,
长大 zhǎng), as far as pypinyin's lists of words know them. The tone rules of 一, 不 and
two third tones are applied: no face shows them, but a voice that says them is clearer.
儿 that only colours the syllable before it becomes that syllable's r. Traditional
characters are looked up as simplified ones.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

from lipwright.errors import MissingExtraError, TextError
from lipwright.schedule.mandarin.pinyin import Syllable, read_syllable
from lipwright.schedule.mandarin.sounds import sounds
from lipwright.schedule.mandarin.text import Token, tokens
from lipwright.schedule.say.voices import check_script

_R = "儿"
_WHOLE_AFTER = "子童女歌媳戏科孙郎化"  # 儿子, 儿童: a syllable of its own
_WHOLE_BEFORE = "女婴幼孤男健胎宠弃产患育托少而"
_R_AFTER_ALL = ("女孩", "男孩", "小孩")
_UNKNOWN = "?"
# Characters that are common in more than one reading, where no word tells which.
_SEVERAL = (
    "得地了还行长重都着觉乐和会没便血谁这那哪"
    "给角色露薄熟大系调传朝车曾差单弹恶核壳落绿率模吓削剥嚼参藏"
)
_MOST_WAYS = 3


@dataclass(frozen=True, slots=True)
class Word:
    """A word of the text and the ways to say it.

    Parameters
    ----------
    text : str
        As it was written.
    ways : tuple of tuple of Syllable
        The first one is what is spoken. A Latin word is one syllable that is foreign.
    """

    text: str
    ways: tuple[tuple[Syllable, ...], ...]

    @property
    def syllables(self) -> tuple[Syllable, ...]:
        """The first way."""
        return self.ways[0]


@dataclass(frozen=True, slots=True)
class Pause:
    """A mark of punctuation that a voice pauses at: ``,`` ``.`` ``!`` or ``?``."""

    mark: str


def syllables(text: str) -> tuple[Syllable, ...]:
    """Return the syllables of a text: characters, pinyin, numbers, and Latin words.

    Raises
    ------
    TextError
        If there is a character of unknown reading or of another script, or what looks
        like pinyin is none.
    MissingExtraError
        If the text has characters and the extra ``mandarin`` is not installed.

    Examples
    --------
    >>> [syllable.pinyin for syllable in syllables("银行")]
    ['yin2', 'hang2']
    """
    return tuple(s for part in read(text) if isinstance(part, Word) for s in part.syllables)


def read(text: str) -> tuple[Word | Pause, ...]:
    """Return the words of a text and the pauses between them.

    Raises
    ------
    TextError, MissingExtraError
        As :func:`syllables`.
    """
    check_script(text, "cmn")
    parts: list[Word | Pause] = []
    unknown: list[str] = []
    for run in _runs(tokens(text)):
        if isinstance(run, Token):
            parts.append(_alone(run))
        else:
            parts += _read_run(run, unknown)
    if unknown:
        named = "".join(dict.fromkeys(unknown))
        raise TextError(
            f"{named!r}: no known reading",
            where="the text",
            cure="write pinyin in the place of these characters, such as ma3",
        )
    return tuple(parts)


def _runs(of: Sequence[Token]) -> Iterator[Token | list[Token]]:
    """Yield neighbouring characters and numbers together, all else alone."""
    run: list[Token] = []
    for token in of:
        if token.kind in ("hanzi", "number"):
            run.append(token)
            continue
        if run:
            yield run
            run = []
        if token.kind != "space":
            yield token
    if run:
        yield run


def _alone(token: Token) -> Word | Pause:
    if token.kind == "pause":
        return Pause(token.said[0])
    if token.kind == "pinyin":
        return Word(token.text, (token.syllables,))
    return Word(token.text, ((Syllable(token.text),),))


def _read_run(run: list[Token], unknown: list[str]) -> list[Word]:
    said = "".join(token.said[0] if token.said else token.text for token in run)
    read = _colour(_characters(said, unknown), said)
    words: list[Word] = []
    at = 0
    for token in run:
        if token.said:
            end = at + len(token.said[0])
            ways = [tuple(filter(None, read[at:end]))]
            ways += [tuple(filter(None, _characters(other, unknown))) for other in token.said[1:]]
            words.append(Word(token.text, tuple(dict.fromkeys(ways))))
            at = end
            continue
        for part in _segments(token.text):
            spoken = tuple(filter(None, read[at : at + len(part)]))
            at += len(part)
            if spoken:
                words.append(Word(part, (spoken, *_other_ways(part, spoken))))
            elif words:  # the r of 花儿 belongs to the word before
                words[-1] = replace(words[-1], text=words[-1].text + part)
    return words


def _characters(text: str, unknown: list[str]) -> list[Syllable | None]:
    """Return the syllable of each character."""
    style = _pypinyin().Style.TONE3
    spelled = _pypinyin().lazy_pinyin(
        _simplified(text),
        style=style,
        neutral_tone_with_five=True,
        tone_sandhi=True,
        errors=lambda strange: [_UNKNOWN] * len(strange),
    )
    result: list[Syllable | None] = []
    for character, spelling in zip(text, spelled, strict=True):
        syllable = read_syllable(spelling, character)
        if syllable is None:
            unknown.append(character)
        result.append(syllable)
    return result


def _colour(read: list[Syllable | None], said: str) -> list[Syllable | None]:
    """Give the r of 儿 to the syllable before it, and nothing to 儿 itself."""
    result = list(read)
    for index in range(1, len(said)):
        before = result[index - 1]
        if said[index] == _R and before is not None and _only_colours(said, index):
            result[index - 1] = replace(before, text=before.text + _R, erhua=True)
            result[index] = None
    return result


def _only_colours(said: str, index: int) -> bool:
    if said[index + 1 : index + 2] and said[index + 1] in _WHOLE_AFTER:
        return False
    if said[max(index - 2, 0) : index] in _R_AFTER_ALL:
        return True
    return said[index - 1] not in _WHOLE_BEFORE + "孩二儿"


def _segments(text: str) -> list[str]:
    """Cut characters into words, as far as pypinyin's lists know them."""
    if len(text) == 1:
        return [text]
    _pypinyin()
    from pypinyin.seg.mmseg import seg  # late, as pypinyin itself

    words: list[str] = []
    at = 0
    for word in seg.cut(_simplified(text)):
        words.append(text[at : at + len(word)])
        at += len(word)
    return words


def _other_ways(word: str, spoken: tuple[Syllable, ...]) -> tuple[tuple[Syllable, ...], ...]:
    """Return other readings of a character that stands alone; those that a face can tell."""
    if spoken[0].erhua or len(word) > 1 or _simplified(word) not in _SEVERAL:
        return ()
    style = _pypinyin().Style.TONE3
    (spelled,) = _pypinyin().pinyin(_simplified(word), style=style, heteronym=True)
    heard = {sounds(spoken[0])}
    ways = []
    for spelling in spelled:
        syllable = read_syllable(spelling, word)
        if syllable is not None and sounds(syllable) not in heard:
            heard.add(sounds(syllable))
            ways.append((syllable,))
    return tuple(ways[: _MOST_WAYS - 1])


def _simplified(text: str) -> str:
    """Return traditional characters as simplified ones, which pypinyin's words are written in."""
    plain: str = _converter().convert(text)
    return plain if len(plain) == len(text) else text


@cache
def _converter() -> Any:
    try:
        import opencc  # extra mandarin
    except ImportError:
        raise MissingExtraError.of("reading Chinese characters", "mandarin") from None
    return opencc.OpenCC("t2s")


def _pypinyin() -> Any:
    try:
        import pypinyin  # extra mandarin; it takes a quarter of a second
    except ImportError:
        raise MissingExtraError.of("reading Chinese characters", "mandarin") from None
    return pypinyin
