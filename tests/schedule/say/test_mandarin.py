"""Mandarin from the synthesiser: each syllable with its own phones, whatever is written."""

from itertools import pairwise

import pytest

from lipwright import pipeline
from lipwright.errors import TextError
from lipwright.phones import load_phone_set
from lipwright.schedule.mandarin import legal_syllables, read_syllable, sounds
from lipwright.schedule.say import say
from lipwright.speech import Speech

PARAGRAPH = (
    "2026年，妈妈和女儿坐飞机去北京旅行。她们住在银行旁边，房间很大，每天只要300元。"
    "女儿喜欢吃鱼，也爱吃苹果；妈妈说：“明天下雨，我们不怕！”这儿的花儿真美，"
    "她用iPhone拍了50%的照片，又上网买了两件T恤。去学校的路上，朋友讲了一个云南的故事。"
    "我们班一共有四十个学生，其中十四个男生，二十六个女生。春天来了，雪化了，绿草长出来了。"
    "王老师问：“你们知道兄弟两个字怎么写吗？”穷人也有理想，永远不要放弃。"
)


@pytest.fixture(scope="module")
def paragraph() -> Speech:
    return say(PARAGRAPH, voice="cmn")


def labels(speech: Speech) -> str:
    return " ".join(phone.label for phone in speech.phones if phone.label != "sil")


def test_every_syllable_is_spoken_with_its_own_phones() -> None:
    spelled = legal_syllables()
    for first in range(0, len(spelled), 110):
        part = spelled[first : first + 110]
        speech = say(", ".join(f"{each}4" for each in part), voice="cmn")
        assert speech.words.labels == tuple(f"{each}4" for each in part)
        for each, word in zip(part, speech.words, strict=True):
            syllable = read_syllable(each)
            assert syllable is not None
            inside = [p.label for p in speech.phones if word.start <= p.start < word.end]
            assert tuple(inside) == sounds(syllable)
            # Longer ones were read as letters or as English.
            assert word.duration < 0.5, each


@pytest.mark.parametrize(
    ("text", "phones", "words"),
    [
        ("你好，世界", "n i h ao sh iii j i ê", "你好 世 界"),
        ("ni3 hao3", "n i h ao", "ni3 hao3"),
        ("nǐhǎo", "n i h ao", "nǐhǎo"),
        ("兄弟穷", "x ü u ng d i q ü u ng", "兄弟 穷"),
        ("银行", "i n h a ng", "银行"),
        ("銀行", "i n h a ng", "銀行"),
        ("花儿", "h u a er", "花儿"),
        ("女儿", "n ü er", "女儿"),
        ("2个", "l i a ng g e", "2 个"),
        ("你好hello", "n i h ao HH AH L OW", "你好 hello"),
        ("嗯", "e n", "嗯"),
        ("[[你]] 好", "n i h ao", "你 好"),
    ],
)
def test_what_is_spoken(text: str, phones: str, words: str) -> None:
    speech = say(text, voice="cmn")
    assert labels(speech) == phones
    assert " ".join(speech.words.labels) == words
    assert speech.language == "cmn"


@pytest.mark.parametrize("voice", ["zh", "zh-CN", "cmn+f3", "cmn-latn-pinyin"])
def test_other_names_of_the_voice(voice: str) -> None:
    assert labels(say("ni3 hao3", voice=voice)) == "n i h ao"


def test_cantonese_is_not_mandarin() -> None:
    assert say("你好", voice="yue").phones.phone_set == "ipa"


def test_phones_cover_the_sound_without_gaps(paragraph: Speech) -> None:
    phones = list(paragraph.phones)
    assert phones[0].start == 0
    assert phones[-1].end == pytest.approx(paragraph.duration)
    assert all(a.end == pytest.approx(b.start) for a, b in pairwise(phones))
    known = set(load_phone_set("pinyin").labels)
    assert {phone.label for phone in phones} <= known


def test_inside_a_phrase_there_is_no_silence() -> None:
    speech = say("八百标兵奔北坡，炮兵并排北边跑", voice="cmn")
    silences = [phone for phone in speech.phones if phone.label == "sil"]
    assert len(silences) == 3  # before, at the comma, after


def test_a_paragraph_needs_no_stand_in_and_closes_on_each_p_b_m(paragraph: Speech) -> None:
    animation = pipeline.animate(paragraph, bigram_set="mandarin", rate=30).animation
    assert animation.report["stand_ins"] == []
    assert animation.report["nearest_classes"] == {}
    times, pressed = animation.times, animation.control("PBM")
    closures = [p for p in paragraph.phones if p.label in ("b", "p", "m", "B", "P", "M")]
    assert len(closures) > 20
    for phone in closures:
        inside = (times >= phone.start - 1e-9) & (times < phone.end - 1e-9)
        assert inside.any()
        assert pressed[inside].max() >= 0.9, phone
    rounded = animation.control("W")
    for phone in paragraph.phones:
        if phone.label == "ü" and phone.duration > 0.08:
            inside = (times >= phone.start) & (times < phone.end)
            assert rounded[inside].max() > 0.4, phone


def test_it_also_speaks_through_the_english_set() -> None:
    animation = pipeline.animate(say("女儿", voice="cmn")).animation
    assert animation.control("W").max() > 0.4


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "nothing to say"),
        ("，。！", "nothing to say"),
        ("🙂", "nothing to say"),
        ("zhv9", "'zhv9': no syllables of Mandarin"),
        ("𠮷", "'𠮷': no known reading"),
        ("你好 привет", "does not read Cyrillic letters"),
        ("こんにちは", "does not read Hiragana letters"),
    ],
)
def test_what_cannot_be_said_is_refused(text: str, words: str) -> None:
    with pytest.raises(TextError, match=words):
        say(text, voice="cmn")
