"""Numbers as people write them, in words: dates, times, money, years and the rest.

The words come from num2words (English). Where people say a number in more than one way,
all are given, and the sound decides among them.
"""

from __future__ import annotations

import re
from collections.abc import Callable

Form = tuple[str, ...]
Forms = tuple[Form, ...]

MONTHS = (
    "january", "february", "march", "april", "may", "june", "july", "august", "september",
    "october", "november", "december",
)  # fmt: skip
_MONEY = {
    "$": ("dollar", "dollars", "cents"),
    "£": ("pound", "pounds", "pence"),
    "€": ("euro", "euros", "cents"),
    "¥": ("yen", "yen", "sen"),
}
_SCALES = {"k": "thousand", "m": "million", "bn": "billion", "b": "billion"}
_SCALE_WORDS = ("thousand", "million", "billion", "trillion")
_UNITS = {
    "km": "kilometers", "kg": "kilograms", "cm": "centimeters", "mm": "millimeters",
    "m": "meters", "g": "grams", "mg": "milligrams", "l": "liters", "ml": "milliliters",
    "mph": "miles an hour|miles per hour", "kmh": "kilometers an hour", "ft": "feet",
    "lb": "pounds", "lbs": "pounds", "oz": "ounces", "hz": "hertz", "khz": "kilohertz",
    "mhz": "megahertz", "ghz": "gigahertz", "gb": "gigabytes", "mb": "megabytes",
    "kb": "kilobytes", "tb": "terabytes", "ms": "milliseconds", "s": "seconds",
    "min": "minutes", "h": "hours", "°": "degrees", "°c": "degrees celsius",
    "°f": "degrees fahrenheit", "am": "a m", "pm": "p m", "x": "times|x",
}  # fmt: skip
_NUMBER = r"\d{1,3}(?:,\d{3})+(?:\.\d+)?|\d+(?:\.\d+)?|\.\d+"
_LARGEST = 15  # digits; longer ones are read digit by digit


def spoken_number(core: str, before: str, after: str) -> Forms:
    """Return the ways to say a token with digits; nothing if it is not one.

    Parameters
    ----------
    core : str
        The token without punctuation around it.
    before, after : str
        Its neighbours, lower case: they tell dates and large sums.

    Examples
    --------
    >>> spoken_number("3:45", "", "pm")
    (('three', 'forty', 'five'),)
    >>> spoken_number("21", "nov", "")[0]
    ('twenty', 'first')
    """
    if not any(c.isdigit() for c in core):
        if before[:1] in _MONEY and core.lower() in _SCALE_WORDS:
            return ((core.lower(), _MONEY[before[0]][1]),)
        return ()
    for pattern, say in _KINDS:
        match = pattern.fullmatch(core)
        if match:
            forms = say(match, before, after)
            if forms:
                return _distinct(forms)
    return (_mixed(core),)


def _distinct(forms: Forms) -> Forms:
    return tuple(dict.fromkeys(form for form in forms if form))


def _words(value: str | int, kind: str = "cardinal") -> Form:
    from num2words import num2words

    said = num2words(value, to=kind)
    return tuple(re.sub(r"[-,]", " ", said).split())


def _cardinal(number: str) -> Forms:
    plain = number.replace(",", "")
    if "." in plain:
        whole, decimals = plain.split(".", 1)
        point = ("point", *(w for digit in decimals for w in _words(int(digit))))
        ahead = _words(int(whole)) if whole else ()
        return _distinct((ahead + point, point)) if whole in ("", "0") else (ahead + point,)
    if len(plain) > _LARGEST or (plain.startswith("0") and len(plain) > 1):
        return _digits(plain)
    said = _words(int(plain))
    forms = [said, tuple(w for w in said if w != "and")]
    if said[0] == "one" and len(said) > 1:
        forms.append(("a", *said[1:]))
    if len(plain) == 4 and plain[2:] != "00" and plain[1] != "0":
        forms.append(_words(int(plain[:2])) + _words(int(plain[2:])))
    return _distinct(tuple(forms))


def _digits(plain: str) -> Forms:
    one_by_one = tuple(w for digit in plain for w in _words(int(digit)))
    return _distinct((one_by_one, tuple("oh" if w == "zero" else w for w in one_by_one)))


def _year(year: str) -> Forms:
    said = _words(int(year), "year")
    pair = _words(int(year[:2]))
    last = int(year[2:])
    forms = [said, tuple(w for w in said if w != "and")]
    if last >= 10:
        forms.append(pair + _words(last))
    elif last:
        forms.append((*pair, "oh", *_words(last)))
    forms += list(_cardinal(year))
    return _distinct(tuple(forms))


def _ordinal(number: str) -> Form:
    return _words(int(number.replace(",", "")), "ordinal")


def _day_of(month: int, day: str, year: str) -> Forms:
    name = MONTHS[month - 1]
    said, plain = _ordinal(day), _words(int(day))
    ends = _year(year)[:2] if len(year) == 4 else (_words(int(year)),) if year else ((),)
    return tuple(
        form
        for end in ends
        for form in (
            (name, *said, *end),
            ("the", *said, "of", name, *end),
            (name, *plain, *end),
            (name, "the", *said, *end),
            (*plain, name, *end),
        )
    )


def _iso_date(match: re.Match[str], before: str, after: str) -> Forms:
    year, month, day = match.groups()
    if not (1 <= int(month) <= 12 and 1 <= int(day) <= 31):
        return ()
    return _day_of(int(month), day, year)


def _slash_date(match: re.Match[str], before: str, after: str) -> Forms:
    first, second, year = match.groups()
    if not (1 <= int(first) <= 31 and 1 <= int(second) <= 31):
        return ()
    forms: Forms = ()
    if int(first) <= 12:
        forms += _day_of(int(first), second, year)
    if int(second) <= 12:
        forms += _day_of(int(second), first, year)
    return forms


def _time(match: re.Match[str], before: str, after: str) -> Forms:
    hour, minute, second, half = match.groups()
    if int(hour) > 24 or int(minute) > 59:
        return ()
    ends: Form = (half[0].lower(), "m") if half else ()
    hours = _words(int(hour))
    if int(minute) == 0:
        forms: Forms = (
            (*hours, "o'clock"),
            hours,
            (*hours, "hundred"),
            (*hours, "hundred", "hours"),
        )
        forms = (hours, *forms) if half or after in ("am", "pm", "a.m.", "p.m.") else forms
    elif int(minute) < 10:
        forms = ((*hours, "oh", *_words(int(minute))),)
    else:
        forms = ((*hours, *_words(int(minute))),)
    if second:
        tail = ("and", *_words(int(second)), "seconds")
        forms = tuple((*form, *more) for form in forms for more in (_words(int(second)), tail))
    return tuple((*form, *ends) for form in forms)


def _money(match: re.Match[str], before: str, after: str) -> Forms:
    sign, number, scale = match.groups()
    one, many, small = _MONEY[sign]
    if scale:
        return tuple((*form, _SCALES[scale.lower()], many) for form in _cardinal(number))
    if after in _SCALE_WORDS:
        return _cardinal(number)
    whole, _, cents = number.replace(",", "").partition(".")
    unit = one if whole == "1" else many
    sums = tuple((*form, unit) for form in _cardinal(whole or "0"))
    if not cents or not int(cents):
        return sums
    rest = _words(int(cents.ljust(2, "0")[:2]))
    coins = (*rest, "cent" if rest == ("one",) and small == "cents" else small)
    if not int(whole or "0"):
        return (coins,)
    short = tuple((*form, *rest) for form in _cardinal(whole))
    return tuple(f for s in sums for f in ((*s, "and", *coins), (*s, *coins), (*s, *rest))) + short


def _percent(match: re.Match[str], before: str, after: str) -> Forms:
    return tuple((*form, "percent") for form in _cardinal(match[1]))


def _nth(match: re.Match[str], before: str, after: str) -> Forms:
    return (_ordinal(match[1]),)


def _decade(match: re.Match[str], before: str, after: str) -> Forms:
    century, tens = match.groups()
    if tens == "00":
        return ((*_words(int(century or "0")), "hundreds"),) if century else ()
    said = _words(int(tens))
    many = (*said[:-1], re.sub(r"y$", "ie", said[-1]) + "s")
    return ((*_words(int(century)), *many),) if century else (many,)


def _fraction(match: re.Match[str], before: str, after: str) -> Forms:
    top, bottom = match.groups()
    names = {"2": ("half", "halves"), "4": ("quarter", "quarters")}
    parts: list[Form] = []
    counts: tuple[Form, ...] = (_words(int(top)), ("a",)) if top == "1" else (_words(int(top)),)
    for count in counts:
        if bottom in names:
            parts.append((*count, names[bottom][top != "1"]))
        if int(bottom) > 2:
            ordinal = _ordinal(bottom)
            parts.append((*count, *ordinal[:-1], ordinal[-1] + ("" if top == "1" else "s")))
    parts.append((*_words(int(top)), "over", *_words(int(bottom))))
    parts.append((*_words(int(top)), "slash", *_words(int(bottom))))
    return tuple(parts)


def _range(match: re.Match[str], before: str, after: str) -> Forms:
    first, second = _cardinal(match[1]), _cardinal(match[2])
    pair = [(*a, *middle, *b) for a in first[:2] for b in second[:2] for middle in (("to",), ())]
    return (*pair, (*_digits(match[1])[0], *_digits(match[2])[0]))


def _measure(match: re.Match[str], before: str, after: str) -> Forms:
    number, unit = match.groups()
    if unit.lower() not in _UNITS:
        return ()
    ways = [way.split() for way in _UNITS[unit.lower()].split("|")]
    return tuple((*form, *way) for form in _cardinal(number) for way in ways)


def _number(match: re.Match[str], before: str, after: str) -> Forms:
    sign, number = match.groups()
    plain = number.replace(",", "")
    forms: Forms = ()
    month = before.rstrip(".")[:3]
    if any(m.startswith(month) for m in MONTHS) and len(month) == 3 and plain.isdigit():
        forms = _month_day(plain)
    if re.fullmatch(r"1[1-9]\d\d|20\d\d", number):
        forms += _year(number)
    forms += _cardinal(number)
    if sign == "#":
        return tuple(("number", *form) for form in forms)
    if sign in ("-", "+"):
        said = ("minus", "negative") if sign == "-" else ("plus",)
        return tuple((word, *form) for form in forms for word in said)
    return forms


def _month_day(plain: str) -> Forms:
    if not 1 <= int(plain) <= 31:
        return ()
    return (_ordinal(plain), ("the", *_ordinal(plain)))


def _dotted(match: re.Match[str], before: str, after: str) -> Forms:
    said = [_words(int(part)) for part in match[0].split(".")]
    with_points = [w for part in said for w in (*part, "point")][:-1]
    return (tuple(with_points), tuple(w for part in said for w in (*part, "dot"))[:-1])


def _mixed(core: str) -> Form:
    """Read letters and digits that stand together, each for itself: ``R2D2``."""
    said: list[str] = []
    for part in re.findall(r"\d+(?:\.\d+)?|[^\W\d_]+(?:'[^\W\d_]+)?", core):
        if part[0].isdigit():
            said += _cardinal(part)[0]
        elif len(part) <= 3 and (part.isupper() or len(part) == 1):
            said += list(part.lower())
        else:
            said.append(part.lower())
    return tuple(said)


Say = Callable[[re.Match[str], str, str], Forms]
_KINDS: tuple[tuple[re.Pattern[str], Say], ...] = (
    (re.compile(r"(\d{4})-(\d{1,2})-(\d{1,2})"), _iso_date),
    (re.compile(r"(\d{1,2})/(\d{1,2})/(\d{4}|\d{2})"), _slash_date),
    (re.compile(r"(\d{1,2}):(\d{2})(?::(\d{2}))?(am|pm|AM|PM)?"), _time),
    (re.compile(rf"([$£€¥])({_NUMBER})(k|K|m|M|bn|B)?"), _money),
    (re.compile(rf"({_NUMBER})%"), _percent),
    (re.compile(r"(\d[\d,]*)(?:st|nd|rd|th)", re.IGNORECASE), _nth),
    (re.compile(r"'?(\d\d)?(\d0)'?s"), _decade),
    (re.compile(r"(\d{1,2})/(\d{1,3})"), _fraction),
    (re.compile(rf"({_NUMBER})-({_NUMBER})"), _range),
    (re.compile(rf"([-+#]?)({_NUMBER})\.?"), _number),
    (re.compile(r"\d+(?:\.\d+){2,}"), _dotted),
    (re.compile(rf"({_NUMBER})-?(°?[A-Za-z]{{0,3}})"), _measure),
)
