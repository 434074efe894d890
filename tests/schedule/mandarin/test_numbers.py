"""Numbers in Chinese text, in characters as they are said."""

import pytest

from lipwright.schedule.mandarin.numbers import by_value, find_number

SAID = [
    ("2026年", "二零二六"), ("2026", "两千零二十六"), ("98年", "九十八"),
    ("0", "零"), ("2", "二"), ("2个", "两"), ("12个", "十二"), ("200", "两百"), ("2万", "两"),
    ("10", "十"), ("110", "一百一十"), ("1010", "一千零一十"), ("10010", "一万零一十"),
    ("101000", "十万一千"), ("20000", "两万"), ("100000001", "一亿零一"),
    ("1,234,567", "一百二十三万四千五百六十七"),
    ("123456789012", "一千两百三十四亿五千六百七十八万九千零一十二"),
    ("3.14", "三点一四"), ("-5", "负五"), ("−0.5", "负零点五"), ("007", "零零七"),
    ("30%", "百分之三十"), ("-3.5%", "负百分之三点五"), ("3‰", "千分之三"), ("1/3", "三分之一"),
    ("3-5天", "三到五"), ("2020-2026年", "二零二零到二零二六"),
    ("12:30", "十二点三十分"), ("8:05", "八点零五分"), ("2:00", "两点"),
    ("12:30:05", "十二点三十分零五秒"), ("3:2", "三比二"),
    ("2026-11-22", "二零二六年十一月二十二日"), ("2026/1/2", "二零二六年一月二日"),
    ("13812345678", "幺三八幺二三四五六七八"), ("¥3.50", "三点五零元"), ("$5", "五美元"),
    ("25°C", "二十五摄氏度"), ("5km", "五公里"), ("5GB", "五"), ("3.14.2", "三点十四点二"),
    ("12345678901234567", "一二三四五六七八九零一二三四五六七"),
]  # fmt: skip


@pytest.mark.parametrize(("written", "said"), SAID)
def test_a_number_is_said_by_its_kind(written: str, said: str) -> None:
    found = find_number(written, 0)
    assert found is not None
    assert found[1][0] == said


def test_all_ways_are_given_to_the_aligner() -> None:
    found = find_number("2026年", 0)
    assert found == (4, ("二零二六", "两千零二十六"))
    half = find_number("12:30", 0)
    assert half is not None
    assert "十二点半" in half[1]


def test_an_ordinal_is_not_counted() -> None:
    found = find_number("第2个", 1)
    assert found is not None
    assert found[1][0] == "二"


def test_a_word_is_no_number() -> None:
    assert find_number("年", 0) is None
    assert find_number("a-5", 1) is None


def value_of(said: str) -> int:
    """Read a quantity back, by its places."""
    total = section = digit = 0
    for character in said:
        if character in "零一二三四五六七八九两":
            digit = 2 if character == "两" else "零一二三四五六七八九".index(character)
        elif character in "十百千":
            section += (digit or 1) * {"十": 10, "百": 100, "千": 1000}[character]
            digit = 0
        else:
            scale = {"万": 10**4, "亿": 10**8}[character]
            total = (
                (total + section + digit) * scale
                if scale == 10**8
                else (total + (section + digit) * scale)
            )
            section = digit = 0
    return total + section + digit


@pytest.mark.parametrize("power", range(1, 12))
def test_a_quantity_means_its_value(power: int) -> None:
    for number in (10**power, 10**power + 1, 10**power - 1, 7 * 10**power + 20, 3 * 10**power // 2):
        assert value_of(by_value(str(number))) == number
