"""How words sound: the user's lexicon, the CMU dictionary of pocketsphinx, then a guess.

A user's file has the format of the CMU dictionary, a pronunciation a line::

    lipwright  L IH P R AY T
    lipwright(2)  L IH P R IH T

Lines that start with ``;;;`` or ``#`` are comments; digits after vowels (stress) are
dropped. Words that neither knows are guessed by the extra ``tts``.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import chain
from pathlib import Path

from lipwright.errors import FileFormatError, LabelError, MissingExtraError, TextError
from lipwright.files import read_bytes
from lipwright.schedule.align.model import load_model, model_folder
from lipwright.schedule.align.text import Token

Pronunciation = tuple[str, ...]
Ways = tuple[Pronunciation, ...]
LexiconLike = Path | str | Mapping[str, str | Sequence[str]] | None

_VOICELESS = {"p", "t", "k", "f", "th"}
_HISSING = {"s", "z", "sh", "zh", "ch", "jh"}
# The model knows no schwa of its own: the CMU dictionary writes AH.
_STAND_INS = {"ax": "ah", "axr": "er", "ix": "ih", "ux": "uw", "dx": "d", "nx": "n"}


@dataclass(frozen=True, slots=True)
class Spoken:
    """A token with the pronunciations of each word of each of its forms."""

    label: str
    forms: tuple[tuple[Ways, ...], ...]


def pronounced(
    tokens: Sequence[Token], lexicon: LexiconLike = None
) -> tuple[tuple[Spoken, ...], tuple[str, ...]]:
    """Return the tokens with their pronunciations, and the words that were guessed.

    Parameters
    ----------
    tokens : sequence of Token
    lexicon : path, mapping or None
        The user's pronunciations: a file, or ``{"lipwright": "L IH P R AY T"}``.

    Raises
    ------
    TextError
        If words stay unknown: all are named at once.
    FileFormatError
        If the lexicon's file breaks the format.
    """
    own = read_lexicon(lexicon)
    words = dict.fromkeys(chain.from_iterable(chain.from_iterable(t.forms for t in tokens)))
    known = {word: ways for word in words if (ways := look_up(word, own))}
    missing = [word for word in words if word not in known]
    guessed = _guess(missing)
    known.update(guessed)
    unknown = [
        word
        for token in tokens
        if not any(all(w in known for w in form) for form in token.forms)
        for word in token.forms[0]
        if word not in known
    ]
    if unknown:
        raise TextError(
            f"no pronunciation for {', '.join(dict.fromkeys(unknown))}",
            cure="type: pip install 'lipwright[tts]', or give their sounds with --lexicon FILE"
            " (a line each, such as: lipwright  L IH P R AY T)",
        )
    spoken = tuple(Spoken(t.label, _known_forms(t, known)) for t in tokens)
    used = {w for t in tokens for form in t.forms if all(x in known for x in form) for w in form}
    return spoken, tuple(word for word in guessed if word in used)


def _known_forms(token: Token, known: Mapping[str, Ways]) -> tuple[tuple[Ways, ...], ...]:
    forms = [form for form in token.forms if all(word in known for word in form)]
    return tuple(dict.fromkeys(tuple(known[word] for word in form) for form in forms))


def look_up(word: str, own: Mapping[str, Ways] | None = None) -> Ways:
    """Return all pronunciations of a word, or none.

    Where the spelling itself is unknown, this tries it without accents, without
    apostrophes, and a possessive or plural by its stem.
    """
    for spelling in _spellings(word):
        if own and spelling in own:
            return own[spelling]
        if ways := _dictionary_rows(spelling):
            return ways
    stem = re.fullmatch(r"(.{2,}?)('s|s'|')", word)
    if stem:
        ways_of_stem = look_up(stem[1], own)
        return tuple(_with_s(way) for way in ways_of_stem)
    return ()


def _spellings(word: str) -> tuple[str, ...]:
    plain = _without_accents(word)
    bare = plain.strip("'")
    spellings = (word, plain, plain.rstrip("'"), bare, bare.replace("'", ""))
    return tuple(dict.fromkeys(spellings))


def _without_accents(word: str) -> str:
    spelled = word.translate({ord("ß"): "ss", ord("æ"): "ae", ord("œ"): "oe", ord("ø"): "o"})
    apart = unicodedata.normalize("NFD", spelled)
    return "".join(c for c in apart if not unicodedata.combining(c))


def _with_s(way: Pronunciation) -> Pronunciation:
    if way[-1] in _HISSING:
        return (*way, "ih", "z")
    return (*way, "s" if way[-1] in _VOICELESS else "z")


@cache
def _dictionary() -> str:
    return (model_folder() / "en-us" / "cmudict-en-us.dict").read_text(encoding="utf-8")


def _dictionary_rows(word: str) -> Ways:
    """Find a word by bisection: to split all 135,000 lines would take a tenth of a second."""
    text = _dictionary()
    low, high = 0, len(text)
    while low < high:
        start = text.rfind("\n", 0, (low + high) // 2) + 1
        if _headword(text, start) < word:
            low = text.find("\n", (low + high) // 2) + 1 or len(text)
        else:
            high = start
    ways = []
    while low < len(text) and _headword(text, low) == word:
        end = text.find("\n", low)
        ways.append(tuple(text[low:end].lower().split()[1:]))
        low = end + 1
    return tuple(ways)


def _headword(text: str, start: int) -> str:
    return text[start : text.find(" ", start)].partition("(")[0]


def _guess(words: Sequence[str]) -> dict[str, Ways]:
    if not words:
        return {}
    from lipwright.schedule.pronounce import pronounce  # starts a program: only when needed

    try:
        said = pronounce(words)
    except MissingExtraError:
        return {}
    return {word: (way,) for word in words if (way := _plain(said.get(word, ())))}


def _plain(sounds: Iterable[str]) -> Pronunciation:
    phones = load_model().phones
    plain = tuple(_STAND_INS.get(sound, sound) for sound in sounds)
    return plain if all(sound in phones for sound in plain) else ()


def read_lexicon(lexicon: LexiconLike) -> dict[str, Ways]:
    """Return a user's pronunciations.

    Raises
    ------
    FileFormatError
        If a line of the file is not a word and its phones: it names file and line.
    LabelError
        If a mapping holds phones that the model does not know.
    """
    if lexicon is None:
        return {}
    result: dict[str, Ways] = {}
    if isinstance(lexicon, Mapping):
        for word, sounds in lexicon.items():
            split = sounds.split() if isinstance(sounds, str) else list(sounds)
            try:
                way = _checked(split)
            except LabelError as error:
                raise error.at(f"pronunciation of {word!r}") from None
            result[word.lower()] = (*result.get(word.lower(), ()), way)
        return result
    for number, line in enumerate(_lines(lexicon), 1):
        content = line.split("#")[0].strip()
        if not content or content.startswith(";;;"):
            continue
        word, *sounds = content.split()
        where = f"{lexicon}, line {number}"
        try:
            way = _checked(sounds)
        except LabelError as error:
            raise FileFormatError(error.found, where=where, expected=error.expected) from None
        spelling = re.sub(r"\(\d+\)$", "", word).lower().replace("’", "'")
        result[spelling] = (*result.get(spelling, ()), way)
    return result


def _lines(path: Path | str) -> list[str]:
    try:
        return read_bytes(path).decode("utf-8-sig").splitlines()
    except UnicodeDecodeError:
        raise FileFormatError("not UTF-8 text", where=str(path), expected="a lexicon") from None


def _checked(sounds: Sequence[str]) -> Pronunciation:
    phones = load_model().phones
    speech = [p for p in phones if p != "sil" and not p.startswith("+")]
    plain = [re.sub(r"(?<=[a-z])\d$", "", sound.lower()) for sound in sounds]
    way = tuple(_STAND_INS.get(sound, sound) for sound in plain)
    unknown = [s for s, p in zip(sounds, way, strict=True) if p not in speech]
    if unknown or not way:
        found = f"unknown phones {' '.join(unknown)}" if unknown else "a word without phones"
        raise LabelError(found, expected=f"phones among {' '.join(speech).upper()}")
    return way
