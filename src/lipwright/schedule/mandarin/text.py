"""Chinese text as people write it, cut into what is said: words, numbers, Latin words, pauses.

Pinyin is told from English by its tones. Without any, Latin letters are pinyin where the
text has no characters and all of it can be read so. How characters are read is
:mod:`.reading`'s.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from typing import Literal

from lipwright.errors import TextError
from lipwright.schedule.mandarin.numbers import Readings, find_number
from lipwright.schedule.mandarin.pinyin import Syllable, has_tone, read_pinyin

Kind = Literal["hanzi", "number", "pinyin", "latin", "pause", "space"]

_HANZI = re.compile("[〇\u3400-\u4dbf\u4e00-\u9fff\uf900-\ufaff\U00020000-\U0003ffff]+")
_LETTERS = re.compile(r"[^\W\d_][^\W_\u3400-\u9fff]*(?:['’:][^\W\d_][^\W_\u3400-\u9fff]*)*")
_RUNS = re.compile(r"\d+|[^\W\d_]+(?:['’][^\W\d_]+)*")
_PAUSES = {
    **dict.fromkeys(",、，,﹐(（)）[]【】《》", ","),
    **dict.fromkeys("。.．…｡", "."),
    **dict.fromkeys("!！", "!"),
    **dict.fromkeys("?？", "?"),
    **dict.fromkeys(";；:：—–\n", ","),
}
_SIGNS = {
    "%": "百分号", "&": "和", "+": "加", "=": "等于", "×": "乘", "÷": "除以", "@": "艾特",
    "#": "井号", "℃": "摄氏度", "°": "度", "<": "小于", ">": "大于", "$": "美元", "€": "欧元",
    "£": "英镑", "¥": "元",
}  # fmt: skip
_PINYIN_LIKE = re.compile(r"[a-zü:]+\d+")
_IS_CHINESE = re.compile("[〇\u3400-\u9fff\uf900-\ufaff\U00020000-\U0003ffff]")
_MOST_NAMED = 8


@dataclass(frozen=True, slots=True)
class Token:
    """A stretch of text that is said in one way.

    Parameters
    ----------
    text : str
        As it was written, in plain forms.
    kind : str
        ``"hanzi"``, ``"number"``, ``"pinyin"``, ``"latin"``, ``"pause"`` or ``"space"``.
    said : tuple of str
        Of a number what is said, in characters, the most usual first; of a pause the mark.
    syllables : tuple of Syllable
        Of pinyin.
    """

    text: str
    kind: Kind
    said: Readings = ()
    syllables: tuple[Syllable, ...] = ()


def tokens(text: str) -> tuple[Token, ...]:
    """Return what is said of a text, in order.

    Raises
    ------
    TextError
        If something looks like pinyin and is none: all of it is named.

    Examples
    --------
    >>> [(token.text, token.kind) for token in tokens("我有2个iPhone。")]
    [('我有', 'hanzi'), ('2', 'number'), ('个', 'hanzi'), ('iPhone', 'latin'), ('。', 'pause')]
    """
    plain = _plain(text)
    is_chinese = _IS_CHINESE.search(plain) is not None
    as_pinyin = not is_chinese and _all_pinyin(plain)
    found: list[Token] = []
    unknown: list[str] = []
    at = 0
    while at < len(plain):
        number = find_number(plain, at)
        if number is not None:
            end, said = number
            found.append(Token(plain[at:end], "number", said))
        elif hanzi := _HANZI.match(plain, at):
            end = hanzi.end()
            found.append(Token(hanzi[0], "hanzi"))
        elif letters := _LETTERS.match(plain, at):
            end = letters.end()
            read = _latin(letters[0], is_chinese=is_chinese, as_pinyin=as_pinyin)
            if not read:
                unknown.append(letters[0])
            found += read
        else:
            end = at + 1
            found += _sign(plain[at])
        at = end
    if unknown:
        raise _no_pinyin(unknown)
    return tuple(found)


def _plain(text: str) -> str:
    # An ellipsis and the sign for ℃ are told apart from full stops and letters later on.
    kept = "".join(c if c == "…" else unicodedata.normalize("NFKC", c) for c in text)
    return unicodedata.normalize("NFC", kept)


def _latin(word: str, *, is_chinese: bool, as_pinyin: bool) -> list[Token]:
    """Return a Latin word as pinyin or as English, or nothing if it is broken pinyin."""
    named = word[:1].isupper() and not word[1:2].islower()  # A4, B2: not pinyin
    if (has_tone(word) and not (named and is_chinese)) or as_pinyin:
        syllables = read_pinyin(word)
        if syllables:
            return [Token(word, "pinyin", syllables=syllables)]
    if not is_chinese and _PINYIN_LIKE.fullmatch(word):
        return []
    return _runs(word)


def _runs(word: str) -> list[Token]:
    """Cut ``iPhone15`` into its letters and its number."""
    result: list[Token] = []
    for run in _RUNS.findall(word):
        number = find_number(run, 0) if run[0].isdigit() else None
        result.append(Token(run, "number", number[1]) if number else Token(run, "latin"))
    return result


def _sign(character: str) -> list[Token]:
    if character in _SIGNS:
        return [Token(character, "number", (_SIGNS[character],))]
    if character in _PAUSES:
        return [Token(character, "pause", (_PAUSES[character],))]
    if character.isspace():
        return [Token(character, "space")]
    return []


def _all_pinyin(plain: str) -> bool:
    words = _LETTERS.findall(plain)
    return bool(words) and all(read_pinyin(word) for word in words)


def _no_pinyin(words: list[str]) -> TextError:
    named = ", ".join(repr(word) for word in dict.fromkeys(words[:_MOST_NAMED]))
    return TextError(
        f"{named}: no syllables of Mandarin",
        where="the text",
        expected="pinyin such as zhe4 or zhè",
        cure="write letters and numbers apart if they are not meant as pinyin",
    )
