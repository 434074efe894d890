"""Text in several scripts: each row a text, its voice, and what the user is told.

What no voice reads is refused in one line that names the letters and the cure; what a
voice does read is spoken, with a note where it may have been meant otherwise.
"""

import json
import re
from pathlib import Path

import pytest

from lipwright.cli import main

REFUSED = [
    ("Hello Привет world", "en-us", "'Привет': the voice 'en-us' does not read Cyrillic"),
    ("Hello Привет world", "en-us", "--voice ru"),
    ("H\u0435llo there", "en-us", "two scripts: its 'е' is Cyrillic; expected words in one script"),
    ("hell\u03bf", "en-us", "its 'ο' is Greek"),
    ("ra\u0443\u0440al", "de", "'raурal' is written in two scripts: its 'у' is Cyrillic"),
    ("αβγ", "fr", "does not read Greek letters. Choose one that does: --voice el"),
    ("中文 and English", "en-us", "'中文': .*Chinese characters.*--voice cmn"),
    ("東京へ いきます", "ja", "'東京': .*kanji.*Write these words in kana"),
    ("日本", "ko", "'日本': .*hanja; expected hangul"),
    ("ひらがな", "cmn", "Hiragana letters.*--voice ja"),
    ("مرحبا hello", "en-us", "'مرحبا': .*Arabic letters.*--voice ar"),
    ("សួស្តី", "en-us", "Khmer letters. Leave them out"),
    ("\u200f\u202b\u202c", "ar", "nothing to say"),
    ("\u0301\u0308", "en-us", "nothing to say"),
    ("🙂👩\u200d👩\u200d👧 🇩🇪", "fr", "nothing to say"),
]


@pytest.mark.parametrize(("text", "voice", "words"), REFUSED)
def test_what_a_voice_cannot_read_is_refused_in_one_line(
    text: str, voice: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "a.json"
    assert main(["say", text, "--voice", voice, "-o", str(output)]) == 1
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("lipwright: ")
    assert captured.err.count("\n") == 1
    assert re.search(words, captured.err), captured.err
    assert not output.exists()


SPOKEN = [
    ("Я люблю pizza и jazz", "ru", "Я люблю pizza и jazz", "ɪ dʒ a z", ""),
    ("Hi 🙂👩\u200d👧 there 🇩🇪", "en-us", "Hi there", "h aɪ ð ɛɹ", ""),
    ("\u202bHello\u202c \u200fworld\u200e", "en-us", "Hello world", "h ə l oʊ w ɜː l d", ""),
    ("\ufeffcafe\u0301 nai\u0308ve", "en-us", "café naïve", "k æ f eɪ", ""),
    ("Z\u0337a\u0337p", "en-us", "Z\u0337a\u0337p", "z æ p", ""),
    ("Ｈｅｌｌｏ\u3000ｗｏｒｌｄ", "en-us", "Hello world", "h ə l oʊ w ɜː l d", ""),
    ("𝓗𝓮𝓵𝓵𝓸 ⓗⓔⓛⓛⓞ ʜᴇʟʟᴏ", "en-us", "Hello hello hello", "h ə l oʊ h ə l oʊ h", ""),
    ("Room ٤٢", "en-us", "Room ٤٢", "ɹ uː m f ɔːɹ", ""),
    ("Zimmer १२", "de", "Zimmer १२", "ts v œ l f", ""),
    ("① ②", "en-us", "1 2", "w ʌ n t uː", ""),
    ("١٢ كتاب", "ar", "١٢ كتاب", "k i t a b", ""),
    ("ﾊﾝｶｸ カタカナ ひらがな", "ja", "ハンカク カタカナ ひらがな", "k ä t ä k ä n ä", ""),
    ("π is 3", "en-us", "π is 3", "p aɪ ɪ z θ ɹ iː", ""),
    ("5 μm", "en-us", "5 μm", "f aɪ v m j uː", ""),
    ("नमस्ते world", "hi", "नमस्ते world", "w ɜː l d", ""),
    ("м\u0061ма", "ru", "мaма", "m", "'мaма' is written in two scripts: its 'a' is Latin"),
    ("שלום", "he", "שלום", "ʃ", "the Hebrew voice leaves out most vowels"),
]


@pytest.mark.parametrize(("text", "voice", "words", "labels", "note"), SPOKEN)
def test_what_a_voice_reads_is_spoken(
    text: str,
    voice: str,
    words: str,
    labels: str,
    note: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    output = tmp_path / "a.json"
    assert main(["say", text, "--voice", voice, "-o", str(output)]) == 0
    told = capsys.readouterr().err
    assert note in told
    animation = json.loads(output.read_text("utf-8"))
    assert " ".join(label for label, *_ in animation["words"]) == words
    assert labels in " ".join(label for label, *_ in animation["phones"] if label != "sil")
