"""Praat TextGrid, long and short, in the text encodings that Praat writes.

Praat reads such a file as a row of numbers, quoted strings and flags and passes over
everything else (Praat manual, "TextGrid file formats"); one reader of tokens therefore
serves the long and the short form, and can name the line of a mistake. Points tiers
are passed over. What is written is the long form in UTF-8; it loses confidences. A tier
of phones may name their set, as in ``phones (pinyin)``: it does where the labels alone
would be taken for another's.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from lipwright.errors import LabelError
from lipwright.phones import SILENCE, phone_set_names
from lipwright.schedule.labels.notation import fits_a_phone_set, has_to_be_named
from lipwright.schedule.labels.rows import Parsed, Row, decode, is_number
from lipwright.speech import Speech
from lipwright.timeline import Tier

PHONE_TIERS = (
    "phones",
    "phone",
    "phonemes",
    "phoneme",
    "segments",
    "segment",
    "segs",
    "mau",
    "phn",
    "ipa",
    "sampa",
    "allophones",
)
WORD_TIERS = ("words", "word", "ort-mau", "ort", "orthography", "tokens", "wrd")

_NAMED = re.compile(r"\s*\((\w+)\)\s*$")
_TOKEN = re.compile(
    r'(?P<string>"(?:[^"]|"")*")|(?P<open>")|(?P<comment>(?<!\S)!.*)|(?P<word>[^\s"=]+)|\n'
)


@dataclass(frozen=True, slots=True)
class _TierRows:
    name: str
    rows: tuple[Row, ...]


def sniff(text: str) -> bool:
    """Tell whether a text looks like a TextGrid."""
    return "TextGrid" in text[:200]


def parse(data: bytes, where: str) -> Parsed:
    """Return the phones and words of a TextGrid.

    Raises
    ------
    LabelError
        If the file is broken, or no tier, or more than one, can be the phones.
    """
    if data.startswith(b"ooBinaryFile"):
        raise LabelError(
            "is a binary TextGrid",
            where=where,
            cure="save it in Praat with 'Save as text file...'",
        )
    tiers = _tiers(_Tokens(decode(data, where), where))
    phones = _phones(tiers, where)
    words = next((tier.rows for tier in tiers if _is_named(tier.name, WORD_TIERS)), ())
    named = _NAMED.search(phones.name)
    return Parsed(
        phones.rows,
        words if words != phones.rows else (),
        phone_set=named[1].casefold() if named and named[1].casefold() in phone_set_names() else "",
    )


class _Tokens:
    """The numbers and strings of a file in their order, each with its line."""

    def __init__(self, text: str, where: str) -> None:
        self._where = where
        self._line = 1
        self._tokens = self._scan(text.replace("\r\n", "\n").replace("\r", "\n"))

    def _scan(self, text: str) -> Iterator[str]:
        for match in _TOKEN.finditer(text):
            token = match.group()
            if match.lastgroup == "open":
                raise LabelError("a quote that is never closed", where=self.place)
            if match.lastgroup == "string" or (
                match.lastgroup == "word" and re.match(r"<|[-+]?\.?\d", token)
            ):
                yield token
            self._line += token.count("\n")

    @property
    def place(self) -> str:
        return f"{self._where}, line {self._line}"

    def _next(self, expected: str) -> str:
        token = next(self._tokens, None)
        if token is None:
            raise LabelError(
                "ends too early",
                where=self.place,
                expected=expected,
                cure="the file was cut: save it again",
            )
        return token

    def string(self, expected: str) -> str:
        token = self._next(expected)
        if not token.startswith('"'):
            raise LabelError(token, where=self.place, expected=f"{expected} in quotes")
        return token[1:-1].replace('""', '"')

    def number(self, expected: str) -> float:
        token = self._next(expected)
        if not is_number(token):
            cure = "write decimals with a point" if is_number(token.replace(",", ".")) else ""
            raise LabelError(token, where=self.place, expected=expected, cure=cure)
        return float(token)

    def exists(self) -> bool:
        return self._next("<exists>") == "<exists>"


def _tiers(tokens: _Tokens) -> list[_TierRows]:
    """Return the tiers of intervals; tiers of points are passed over."""
    kind, content = tokens.string("'ooTextFile'"), tokens.string("'TextGrid'")
    if not kind.startswith("ooTextFile") or content != "TextGrid":
        raise LabelError(
            f"a file of type {kind!r}, {content!r}",
            where=tokens.place,
            expected="'ooTextFile', 'TextGrid'",
        )
    tokens.number("the start of the file")
    tokens.number("the end of the file")
    count = int(tokens.number("the number of tiers")) if tokens.exists() else 0
    tiers = (_tier(tokens) for _ in range(count))
    return [tier for tier in tiers if tier is not None]


def _tier(tokens: _Tokens) -> _TierRows | None:
    kind = tokens.string("'IntervalTier' or 'TextTier'")
    name = tokens.string("the tier's name")
    tokens.number("the tier's start")
    tokens.number("the tier's end")
    size = int(tokens.number("the number of intervals"))
    if kind == "IntervalTier":
        return _TierRows(name, tuple(_interval(tokens, name) for _ in range(size)))
    for _ in range(size):
        tokens.number("the time of a point")
        tokens.string("the mark of a point")
    return None


def _interval(tokens: _Tokens, name: str) -> Row:
    start = tokens.number(f"the start of an interval of {name!r}")
    place = tokens.place.rpartition(", ")[2]
    end = tokens.number(f"the end of an interval of {name!r}")
    return Row(tokens.string(f"a label of {name!r}").strip(), start, end, place)


def _is_named(name: str, names: tuple[str, ...]) -> bool:
    return _plain_name(name) in names


def _plain_name(name: str) -> str:
    # The Montreal aligner puts the speaker first: "mary - phones".
    return _NAMED.sub("", name).strip().casefold().rpartition(" - ")[2]


def _phones(tiers: list[_TierRows], where: str) -> _TierRows:
    named = [tier for tier in tiers if _is_named(tier.name, PHONE_TIERS)]
    if len(named) > 1:
        best = min(PHONE_TIERS.index(_plain_name(tier.name)) for tier in named)
        named = [tier for tier in named if _is_named(tier.name, (PHONE_TIERS[best],))]
    found = named or [
        tier
        for tier in tiers
        if not _is_named(tier.name, WORD_TIERS)
        and fits_a_phone_set([row.label for row in tier.rows])
    ]
    if len(found) != 1:
        names = ", ".join(repr(tier.name) for tier in found or tiers) or "no tier of intervals"
        raise LabelError(
            f"{len(found) or 'no'} tiers of phones among {names}",
            where=where,
            expected="one tier called 'phones'",
            cure="rename or remove tiers in Praat",
        )
    return found[0]


def encode(speech: Speech) -> bytes:
    """Return a TextGrid with the tiers ``words`` and ``phones``; silence is unlabelled."""
    start = min(0.0, speech.phones.tier.start, speech.words.start)
    end = max(speech.duration, speech.phones.tier.end, speech.words.end)
    named = f" ({speech.phones.phone_set})" if has_to_be_named(speech.phones) else ""
    tiers = [("words", speech.words), (f"phones{named}", speech.phones.tier)]
    head = [
        'File type = "ooTextFile"',
        'Object class = "TextGrid"',
        "",
        *_span(start, end),
        "tiers? <exists>",
        f"size = {len(tiers)}",
        "item []:",
    ]
    for number, (name, tier) in enumerate(tiers, start=1):
        head.append(f"    item [{number}]:")
        head += _written(name, _filled(tier, start, end), start, end)
    return ("\n".join(head) + "\n").encode()


def _filled(tier: Tier, start: float, end: float) -> list[tuple[str, float, float]]:
    """Return the tier without gaps, as Praat wants it."""
    result: list[tuple[str, float, float]] = []
    reached = start
    for interval in tier:
        if interval.start > reached:
            result.append(("", reached, interval.start))
        label = "" if interval.label == SILENCE else interval.label
        result.append((label, interval.start, interval.end))
        reached = interval.end
    if end > reached:
        result.append(("", reached, end))
    return result


def _written(
    name: str, intervals: list[tuple[str, float, float]], start: float, end: float
) -> Iterator[str]:
    yield '        class = "IntervalTier"'
    yield f"        name = {_quoted(name)}"
    yield from _span(start, end, " " * 8)
    yield f"        intervals: size = {len(intervals)}"
    for number, (label, low, high) in enumerate(intervals, start=1):
        yield f"        intervals [{number}]:"
        yield from _span(low, high, " " * 12)
        yield f"            text = {_quoted(label)}"


def _span(start: float, end: float, indent: str = "") -> list[str]:
    return [f"{indent}xmin = {_number(start)}", f"{indent}xmax = {_number(end)}"]


def _number(value: float) -> str:
    return repr(float(value)).removesuffix(".0")


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'
