"""Numbers as people write them in Chinese text, in characters as people say them.

Years are said digit by digit before 年, quantities by value, telephone numbers by digit
with 幺 for 1. Where people say a number in more than one way, the first is what is
spoken, and all are given to the aligner. A symbol or unit beside a number is read with it.
"""

from __future__ import annotations

import re
from collections.abc import Callable

DIGITS = "零一二三四五六七八九"
_PLACES = ("", "十", "百", "千")
_GROUPS = ("", "万", "亿", "万亿")
_LARGEST = 16  # digits; longer ones are read digit by digit
_MEASURES = (
    "个位名只头匹条张本把件次天年年间周岁分秒点块元毛家所座辆台部种样层颗棵朵片首支枝瓶杯碗盘双对套"
    "场遍趟回份封句页倍米斤里百千万亿"
)
_MONEY = {"¥": "元", "￥": "元", "$": "美元", "€": "欧元", "£": "英镑"}
_UNITS = {
    "km/h": "公里每小时", "km": "公里", "cm": "厘米", "mm": "毫米", "m": "米", "kg": "公斤",
    "mg": "毫克", "g": "克", "ml": "毫升", "l": "升", "°C": "摄氏度", "°F": "华氏度", "°": "度",
}  # fmt: skip
_UNIT = "|".join(map(re.escape, _UNITS))
_SIGNS = "-−+¥￥$€£"
_PLAIN = r"\d{1,3}(?:,\d{3})+(?:\.\d+)?|\d+(?:\.\d+)?"
_NUMBER = rf"[-−+]?(?:{_PLAIN})"

Readings = tuple[str, ...]


def find_number(text: str, at: int) -> tuple[int, Readings] | None:
    """Return where the number that begins at a place ends, and how it is said.

    Parameters
    ----------
    text : str
        In plain forms (NFKC): full-width digits and signs are not known here.
    at : int
        Index of its first character: a digit, a sign, or a currency's sign.

    Returns
    -------
    tuple of (int, tuple of str), or None
        The index behind it, and what is said, the most usual first.

    Examples
    --------
    >>> find_number("2026年", 0)
    (4, ('二零二六', '两千零二十六'))
    >>> find_number("2个", 0), find_number("-3.5%", 0)
    ((1, ('两',)), (5, ('负百分之三点五',)))
    """
    if not (text[at].isdigit() or text[at] in _SIGNS):
        return None
    before = text[at - 1] if at else ""
    for pattern, say in _KINDS:
        match = pattern.match(text, at)
        if match is None or (match[0][0] in "-−+" and before.isalnum()):
            continue
        # 第2个 is an ordinal: it is not counted.
        following = "" if before == "第" else text[match.end() : match.end() + 1]
        said = say(match, following)
        if said:
            return match.end(), tuple(dict.fromkeys(said))
    return None


def by_digit(digits: str, one: str = "一") -> str:
    """Return digits one by one: ``"2026"`` is 二零二六."""
    return "".join(one if d == "1" else DIGITS[int(d)] for d in digits)


def by_value(digits: str) -> str:
    """Return a whole number as a quantity.

    Examples
    --------
    >>> by_value("2026"), by_value("10"), by_value("110"), by_value("100000001")
    ('两千零二十六', '十', '一百一十', '一亿零一')
    """
    digits = digits.lstrip("0") or "0"
    if len(digits) > _LARGEST:
        return by_digit(digits)
    if digits == "0":
        return DIGITS[0]
    groups = [digits[max(end - 4, 0) : end] for end in range(len(digits), 0, -4)]
    said = ""
    for number in range(len(groups) - 1, -1, -1):
        group = groups[number]
        if not int(group):
            continue
        # A place that is left out is said as one 零, never at the end.
        gap = said and (int(group) < 1000 or not int(groups[number + 1]))
        name = _GROUPS[number]
        if name == "万亿" and int(groups[2]):
            name = "万"  # 万 of the 亿 that follow
        said += ("零" if gap else "") + _group(int(group), leads=not said) + name
    return said


def _group(value: int, *, leads: bool) -> str:
    said, skipped = "", False
    digits = str(value)
    for index, digit in enumerate(digits):
        place = len(digits) - 1 - index
        if digit == "0":
            skipped = True
            continue
        word = DIGITS[int(digit)]
        if digit == "2" and place >= 2:
            word = "两"
        if digit == "1" and place == 1 and leads and not said:
            word = ""  # 十二, but 一百一十二
        said += ("零" if skipped and said else "") + word + _PLACES[place]
        skipped = False
    if leads and len(digits) == 1 and value == 2:
        return "二"
    return said


def _amount(number: str) -> str:
    """Say a number with its sign and decimals."""
    sign = {"-": "负", "−": "负", "+": "正"}.get(number[0], "")
    whole, _, decimals = number.lstrip("-−+").replace(",", "").partition(".")
    is_code = len(whole) > 1 and whole[0] == "0" and not decimals  # 007
    said = by_digit(whole) if is_code else _two_groups(by_value(whole))
    return sign + said + ("点" + by_digit(decimals) if decimals else "")


def _two_groups(said: str) -> str:
    return re.sub(r"^二(?=[万亿])", "两", said)


def _counted(number: str, following: str) -> str:
    """Say a number before what is counted: 2个 is 两个."""
    said = _amount(number)
    return (
        said[:-1] + "两"
        if said in ("二", "负二") and following and following in _MEASURES
        else said
    )


def _year(match: re.Match[str], following: str) -> Readings:
    return (by_digit(match[1]), by_value(match[1])) if following == "年" else ()


def _date(match: re.Match[str], following: str) -> Readings:
    year, month, day = match[1], int(match[2]), int(match[3])
    if not (1 <= month <= 12 and 1 <= day <= 31):
        return ()
    rest = f"{by_value(str(month))}月{by_value(str(day))}"
    return (f"{by_digit(year)}年{rest}日", f"{by_digit(year)}年{rest}号")


def _time(match: re.Match[str], following: str) -> Readings:
    hour, minute, second = int(match[1]), int(match[2]), match[3]
    if hour > 24 or minute > 59 or (second and int(second) > 59):
        return ()
    said = ("两" if hour == 2 else by_value(str(hour))) + "点"
    if second:
        return (said + _part(minute) + "分" + _part(int(second)) + "秒",)
    if not minute:
        return (said, said + "整")
    exact = said + _part(minute)
    return (exact + "分", exact, *((said + "半",) if minute == 30 else ()))


def _part(value: int) -> str:
    return ("零" if value < 10 else "") + by_value(str(value))


def _telephone(match: re.Match[str], following: str) -> Readings:
    digits = re.sub(r"\D", "", match[0])
    return (by_digit(digits, "幺"), by_digit(digits))


def _share(match: re.Match[str], following: str) -> Readings:
    name = "百分之" if match[2] == "%" else "千分之"
    said = _amount(match[1])
    sign, said = (said[0], said[1:]) if said[0] in "负正" else ("", said)
    return (sign + name + said,)


def _fraction(match: re.Match[str], following: str) -> Readings:
    return (f"{by_value(match[2])}分之{by_value(match[1])}",)


def _range(match: re.Match[str], following: str) -> Readings:
    if following == "年" and len(match[1]) == len(match[2]) == 4:
        return (f"{by_digit(match[1])}到{by_digit(match[2])}",)
    return (f"{_amount(match[1])}到{_counted(match[2], following)}",)


def _score(match: re.Match[str], following: str) -> Readings:
    return (f"{by_value(match[1])}比{by_value(match[2])}",)


def _money(match: re.Match[str], following: str) -> Readings:
    unit = _MONEY[match[1]]
    said = _amount(match[2])
    if following and following in "万亿":
        return (said,)  # ¥3万: the scale is said first, and the unit left to the reader
    return (("两" if said == "二" else said) + unit,)


def _measured(match: re.Match[str], following: str) -> Readings:
    said = _amount(match[1])
    return (("两" if said == "二" else said) + _UNITS[match[2]],)


def _version(match: re.Match[str], following: str) -> Readings:
    return ("点".join(_amount(part) for part in match[0].split(".")),)


def _plain(match: re.Match[str], following: str) -> Readings:
    number = match[0]
    said = _counted(number, following)
    if number.isdigit() and len(number) == 4 and number[0] in "12":
        return (said, by_digit(number))
    if number.isdigit() and len(number) == 3:
        return (said, by_digit(number, "幺"), by_digit(number))
    return (said, said.replace("两百", "二百")) if "两百" in said else (said,)


_KINDS: tuple[tuple[re.Pattern[str], Callable[[re.Match[str], str], Readings]], ...] = tuple(
    (re.compile(pattern), say)
    for pattern, say in (
        (r"(\d{4})[-/.](\d{1,2})[-/.](\d{1,2})(?!\d)", _date),
        (r"(\d{1,2}):(\d{2})(?::(\d{2}))?(?![\d:])", _time),
        (r"(\d{1,3}):(\d{1,3})(?![\d:])", _score),
        (r"1\d{10}(?!\d)|1\d{2}[- ]\d{4}[- ]\d{4}(?!\d)|0\d{2,3}-\d{7,8}(?!\d)", _telephone),
        (r"(\d{4})(?!\d)", _year),
        (r"\d+(?:\.\d+){2,}", _version),
        (rf"({_NUMBER})\s*([%‰])", _share),
        (rf"([¥￥$€£])\s*({_PLAIN})", _money),
        (rf"({_NUMBER})\s*({_UNIT})(?![A-Za-z])", _measured),
        (r"(\d+)[/⁄](\d+)(?![\d/])", _fraction),
        (rf"({_PLAIN})\s*[-–—~～]\s*({_PLAIN})(?![\d-])", _range),
        (_NUMBER, _plain),
    )
)
