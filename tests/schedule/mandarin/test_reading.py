"""Chinese text as syllables: words, heteronyms, 儿, both scripts, mixed text, bad text."""

import subprocess
import sys

import pytest

from lipwright.errors import TextError
from lipwright.phones import load_phone_set
from lipwright.schedule.align.model import load_model
from lipwright.schedule.mandarin import Pause, Pronounced, pronounce, read, syllables


def spelled(text: str) -> str:
    return " ".join(s.text if s.is_foreign else s.pinyin for s in syllables(text))


@pytest.mark.parametrize(
    ("text", "pinyin"),
    [
        ("你好,世界", "ni2 hao3 shi4 jie4"),
        ("你好，世界！", "ni2 hao3 shi4 jie4"),
        ("银行长大了", "yin2 hang2 zhang3 da4 le5"),
        ("銀行長大了", "yin2 hang2 zhang3 da4 le5"),
        ("中華人民共和國", "zhong1 hua2 ren2 min2 gong4 he2 guo2"),
        ("音乐很快乐", "yin1 yue4 hen3 kuai4 le4"),
        ("重要的重复", "zhong4 yao4 de5 chong2 fu4"),
        ("女儿在玩儿", "nü3 er2 zai4 wanr2"),
        ("这儿有花儿", "zher4 you3 huar1"),
        ("一点儿", "yi4 dianr3"),
        ("儿子和儿童", "er2 zi5 he2 er2 tong2"),
        ("小孩儿", "xiao3 hair2"),
        ("2026年", "er4 ling2 er4 liu4 nian2"),
        ("我有2个", "wo3 you3 liang3 ge4"),
        ("第2个", "di4 er4 ge4"),
        ("涨了3.5%", "zhang3 le5 bai3 fen1 zhi1 san1 dian3 wu3"),
        ("２０２６年", "er4 ling2 er4 liu4 nian2"),
        ("我用iPhone15", "wo3 yong4 iPhone shi2 wu3"),
        ("T恤和A4纸", "T xu4 he2 A si4 zhi3"),
        ("hello你好world", "hello ni2 hao3 world"),
        ("你好🙂世界", "ni2 hao3 shi4 jie4"),
        ("二〇二六", "er4 ling2 er4 liu4"),
        ("ni3 hao3", "ni3 hao3"),
        ("nǐ hǎo", "ni3 hao3"),
        ("Nǐhǎo, Běijīng!", "ni3 hao3 bei3 jing1"),
        ("ni hao ma", "ni hao ma"),
        ("你hao3吗", "ni3 hao3 ma5"),
        ("xiong2mao1", "xiong2 mao1"),
        ("Hello world", "Hello world"),
    ],
)
def test_texts_become_syllables(text: str, pinyin: str) -> None:
    assert spelled(text) == pinyin


def test_words_stay_as_they_were_written_and_pauses_are_marked() -> None:
    parts = read("银行在2026年，OK？")
    named = [part.mark if isinstance(part, Pause) else part.text for part in parts]
    assert named == ["银行", "在", "2026", "年", ",", "OK", "?"]
    assert [part.text for part in read("一點兒") if not isinstance(part, Pause)] == ["一點", "兒"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("zhv9", r"'zhv9': no syllables of Mandarin; expected pinyin such as zhe4"),
        ("ni3 hao7 bv2", r"'hao7', 'bv2': no syllables"),
        ("你好 привет", "does not read Cyrillic letters"),
        ("𠮷野家㐂", r"'𠮷㐂': no known reading\. Write pinyin in the place"),
    ],
)
def test_what_cannot_be_read_is_named_at_once(text: str, words: str) -> None:
    with pytest.raises(TextError, match=words):
        syllables(text)


def test_the_aligner_gets_each_way_to_say_a_word() -> None:
    ways = {word.text: word.ways for word in pronounce("你得去2026年的T恤GDP, OK")}
    assert ways["去"] == (("q", "ü"),)
    assert set(ways["得"]) >= {("d", "e"), ("d", "ei")}
    assert len(ways["2026"]) == 2
    assert ways["T"][0] == ("T", "IY")
    assert ways["GDP"][0] == ("JH", "IY", "D", "IY", "P", "IY")
    assert ways["OK"][0] == ("OW", "K", "EY")


def test_the_acoustic_model_gets_its_own_phones_for_each() -> None:
    known = set(load_model().phones)
    for word in pronounce("我的T恤有2026个字儿，思考这是什么语言"):
        heard = word.acoustic()
        assert tuple(phone for phone, _ in heard[0]) == word.ways[0]
        assert {tuple(phone for phone, _ in way) for way in heard} == set(word.ways)
        assert len(heard) <= max(6, 2 * len(word.ways))
        assert all(pieces and set(pieces) <= known for way in heard for _, pieces in way)


def test_every_phone_of_pinyin_sounds_like_something() -> None:
    known = set(load_model().phones)
    for phone in load_phone_set("pinyin").labels:
        if phone != "sil":
            ways = Pronounced("?", ((phone,),)).acoustic()
            assert all(set(pieces) <= known for way in ways for _, pieces in way)


def test_a_glide_is_looked_for_as_one() -> None:
    (word,) = pronounce("xi1wa1")
    assert [heard for _, heard in word.acoustic()[0]] == [("sh",), ("iy",), ("w",), ("aa",)]


def test_nothing_to_align_is_refused() -> None:
    with pytest.raises(TextError, match="nothing is said"):
        pronounce("，。！")


def test_without_the_extra_characters_are_refused_and_pinyin_is_read() -> None:
    code = (
        "import sys; sys.modules['pypinyin'] = sys.modules['opencc'] = None\n"
        "from lipwright.schedule.mandarin import syllables\n"
        "print(len(syllables('ni3 hao3')))\n"
        "try: syllables('你好')\n"
        "except ImportError as error: print(error)"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.splitlines() == [
        "2",
        "reading Chinese characters needs a part that is not installed. "
        "Type: pip install 'lipwright[mandarin]'",
    ]


def test_pypinyin_is_loaded_only_for_characters() -> None:
    code = (
        "import sys; from lipwright.schedule.mandarin import syllables; syllables('ni3 hao3')\n"
        "print([name for name in ('pypinyin', 'opencc') if name in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
