"""Spellings of pinyin: tone marks, digits, ü in all its forms, and what is none."""

import pytest
from pypinyin import pinyin_dict
from pypinyin.contrib.tone_convert import to_normal

from lipwright.phones import load_phone_set, load_reduction
from lipwright.schedule.mandarin import legal_syllables, read_syllable, sounds
from lipwright.schedule.mandarin.pinyin import has_tone, read_pinyin

SYLLABLES = legal_syllables()


def test_every_reading_that_pypinyin_knows_is_a_legal_syllable() -> None:
    known = {
        to_normal(reading).replace("v", "ü")
        for readings in pinyin_dict.pinyin_dict.values()
        for reading in readings.split(",")
    }
    read = {spelling: read_syllable(spelling) for spelling in known}
    assert [spelling for spelling, syllable in read.items() if syllable is None] == []
    assert len(known) > 400


@pytest.mark.parametrize("spelling", SYLLABLES)
def test_a_syllable_is_spelled_as_it_is_read(spelling: str) -> None:
    syllable = read_syllable(spelling + "4")
    assert syllable is not None
    assert syllable.pinyin == spelling + "4"
    assert (syllable.tone, syllable.erhua) == (4, False)


@pytest.mark.parametrize(
    ("spelled", "initial", "final", "tone"),
    [
        ("nǚ", "n", "ü", 3),
        ("nü3", "n", "ü", 3),
        ("nv3", "n", "ü", 3),
        ("nu:3", "n", "ü", 3),
        ("nu3", "n", "u", 3),
        ("LÜ4", "l", "ü", 4),
        ("lüè", "l", "üe", 4),
        ("lue4", "l", "üe", 4),
        ("ju2", "j", "ü", 2),
        ("jü2", "j", "ü", 2),
        ("yuan", "", "üan", 0),
        ("yún", "", "ün", 2),
        ("wén", "", "un", 2),
        ("you3", "", "iu", 3),
        ("yōng", "", "iong", 1),
        ("zì", "z", "ii", 4),
        ("zhī", "zh", "iii", 1),
        ("ma0", "m", "a", 5),
        ("ma5", "m", "a", 5),
        ("ê", "", "ê", 0),
    ],
)
def test_initial_final_and_tone(spelled: str, initial: str, final: str, tone: int) -> None:
    syllable = read_syllable(spelled)
    assert syllable is not None
    assert (syllable.initial, syllable.final, syllable.tone) == (initial, final, tone)


@pytest.mark.parametrize(
    ("word", "syllables"),
    [
        ("nǐhǎo", "ni3 hao3"),
        ("ni3hao3", "ni3 hao3"),
        ("Běijīng", "bei3 jing1"),
        ("xian", "xian"),
        ("xi'an", "xi an"),
        ("xi’an", "xi an"),
        ("fangan", "fan gan"),
        ("fang'an", "fang an"),
        ("nǚ'ér", "nü3 er2"),
        ("nǚér", "nü3 er2"),
        ("zhōnghuárénmíngònghéguó", "zhong1 hua2 ren2 min2 gong4 he2 guo2"),
        ("huār", "huar1"),
        ("dian3r", ""),
        ("dianr3", "dianr3"),
        ("erzi", "er zi"),
        ("xiongmao", "xiong mao"),
    ],
)
def test_words_come_apart_into_syllables(word: str, syllables: str) -> None:
    assert " ".join(syllable.pinyin for syllable in read_pinyin(word)) == syllables


@pytest.mark.parametrize("word", ["zhv9", "mp3", "hello", "v", "ma6", "nǐǐ", "bü", "qa1", "", "ж"])
def test_what_is_no_pinyin_is_not_read(word: str) -> None:
    assert read_pinyin(word) == ()


def test_a_long_word_is_read_at_once_or_not_at_all() -> None:
    assert read_pinyin("an" * 40 + "x") == ()
    assert len(read_pinyin("nan" * 40)) == 40
    assert read_pinyin("na" * 5000) == ()


def test_tones_tell_pinyin_from_english() -> None:
    assert has_tone("ni3")
    assert has_tone("hǎo")
    assert not has_tone("hao")
    assert not has_tone("2026")
    assert not has_tone("mate60")


def test_every_syllable_has_phones_and_classes() -> None:
    phones = load_phone_set("pinyin").labels
    vowels = {"aa", "ah", "ao", "aw", "ay", "eh", "er", "ih", "ow", "w", "yu"}
    classes = load_reduction("pinyin", "mandarin")
    for spelling in SYLLABLES:
        syllable = read_syllable(spelling)
        assert syllable is not None
        made = sounds(syllable)
        assert set(made) <= set(phones), spelling
        shown = [classes.of(phone)[0][0].label for phone in made]
        hummed = spelling in ("m", "ng", "hm", "hng")
        # zi, ci, si show their z all through; every other syllable has one vowel or more.
        assert hummed or vowels & set(shown) or shown == ["z", "z"], spelling
        assert (shown[0] == "bmp") == (spelling[0] in "bpm"), spelling
        assert ("yu" in shown) == (syllable.final[0] == "ü" or syllable.final == "iong"), spelling


@pytest.mark.parametrize(
    ("spelling", "phones"),
    [
        ("zhong1", "zh u ng"),
        ("xiong2", "x ü u ng"),
        ("xue2", "x ü ê"),
        ("yuan2", "ü ê n"),
        ("dui4", "d u ei"),
        ("liu4", "l i ou"),
        ("wen2", "u e n"),
        ("ri4", "r iii"),
        ("huar1", "h u a er"),
        ("genr1", "g er"),
        ("er4", "er"),
    ],
)
def test_the_phones_of_a_syllable(spelling: str, phones: str) -> None:
    (syllable,) = read_pinyin(spelling)
    assert " ".join(sounds(syllable)) == phones


def test_every_phone_of_pinyin_has_a_class_and_an_example() -> None:
    pinyin = load_phone_set("pinyin")
    for target in ("mandarin", "common"):
        table = load_reduction("pinyin", target).table
        assert set(table) == set(pinyin.labels)
        known = load_phone_set(target).labels
        assert {piece.label for pieces in table.values() for piece in pieces} <= set(known)
    assert all("[" in pinyin.example(label) for label in pinyin.labels if label != "sil")
